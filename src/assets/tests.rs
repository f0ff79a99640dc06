//! Whole files: opening, hashing, caching, and the meshes of the kit.

use std::fs;
use std::path::{Path, PathBuf};

use super::*;
use crate::mesh::Mesh;
use crate::recording::{InlineMesh, SceneRef};

const TETRAHEDRON: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 0\nvt 0 1\nv 0 0 1\n\
    f 1/1 3/3 2/2\nf 1/1 2/2 4/3\nf 2/2 3/3 4/1\nf 3/3 1/1 5/2\n";

fn folder() -> tempfile::TempDir {
    tempfile::tempdir().expect("a folder")
}

fn open_mesh(folder: &Path, name: &str, cache: &CacheOptions) -> Result<Loaded, AssetError> {
    open(&SceneRef::Mesh(name.into()), folder, cache)
}

fn assert_same(a: &Mesh, b: &Mesh) {
    assert_eq!((a.positions(), a.vertices(), a.edges()), (b.positions(), b.vertices(), b.edges()));
    assert_eq!((a.faces(), a.is_textured()), (b.faces(), b.is_textured()));
    for node in 0..a.node_count() {
        let node = crate::mesh::NodeId::of(node);
        assert_eq!(a.anchor(node), b.anchor(node));
    }
}

#[test]
fn the_cache_gives_the_same_mesh_and_notes() {
    let folder = folder();
    fs::write(folder.path().join("t.obj"), TETRAHEDRON).expect("written");
    let cache = CacheOptions::at(folder.path().join("cache"));
    let first = open_mesh(folder.path(), "t.obj", &cache).expect("a mesh");
    let again = open_mesh(folder.path(), "t.obj", &cache).expect("a mesh");
    assert_eq!((first.from_cache, again.from_cache), (false, true));
    assert_eq!((first.notes.len(), &first.notes), (1, &again.notes));
    assert_eq!((first.mesh_hash, first.scene_hash), (again.mesh_hash, again.scene_hash));
    assert_same(&first.mesh, &again.mesh);
    assert_eq!(fs::read_dir(folder.path().join("cache")).expect("a folder").count(), 1, "no draft is left");
    fs::write(folder.path().join("t.obj"), TETRAHEDRON.replace("v 1 0 0", "v 2 0 0")).expect("written");
    let changed = open_mesh(folder.path(), "t.obj", &cache).expect("a mesh");
    assert!(!changed.from_cache && changed.mesh_hash != first.mesh_hash);
}

#[test]
fn a_damaged_cache_is_built_again() {
    let folder = folder();
    fs::write(folder.path().join("t.obj"), TETRAHEDRON).expect("written");
    let cache = CacheOptions::at(folder.path().join("cache"));
    let first = open_mesh(folder.path(), "t.obj", &cache).expect("a mesh");
    let kept = fs::read_dir(folder.path().join("cache"))
        .expect("a folder")
        .next()
        .expect("a file")
        .expect("it")
        .path();
    let whole = fs::read(&kept).expect("bytes");
    let flips = (0..whole.len()).map(|at| {
        let mut bytes = whole.clone();
        bytes[at] ^= 0x41;
        bytes
    });
    let cuts = (0..whole.len()).step_by(7).map(|end| whole[..end].to_vec());
    let longer = [whole.clone(), vec![0]].concat();
    for bytes in flips.chain(cuts).chain([longer]) {
        fs::write(&kept, bytes).expect("written");
        let again = open_mesh(folder.path(), "t.obj", &cache).expect("a mesh");
        assert!(!again.from_cache);
        assert_same(&first.mesh, &again.mesh);
    }
    assert_eq!(fs::read(&kept).expect("bytes"), whole, "and is whole again");
}

#[test]
fn a_folder_that_cannot_be_written_is_no_error() {
    let folder = folder();
    fs::write(folder.path().join("t.obj"), TETRAHEDRON).expect("written");
    // A file where the folder should be cannot be written into, whoever runs this.
    let cache = CacheOptions::at(folder.path().join("t.obj"));
    assert!(!open_mesh(folder.path(), "t.obj", &cache).expect("a mesh").from_cache);
}

#[test]
fn a_scene_file_leads_to_its_mesh_and_settings() {
    let folder = folder();
    fs::create_dir(folder.path().join("sub")).expect("made");
    fs::write(folder.path().join("sub/t.obj"), TETRAHEDRON).expect("written");
    fs::write(folder.path().join("sub/scene.json"), r#"{"mesh": "t.obj", "unit_cm": 2}"#).expect("written");
    let off = CacheOptions::off();
    let scene = open(&SceneRef::File("sub/scene.json".into()), folder.path(), &off).expect("a scene");
    let mesh = open_mesh(folder.path(), "sub/t.obj", &off).expect("a mesh");
    assert_eq!((scene.settings.unit_cm, scene.mesh_hash), (2.0, mesh.mesh_hash));
    assert_ne!(scene.scene_hash, mesh.scene_hash);
    assert_eq!(mesh.mesh_hash, *blake3::hash(TETRAHEDRON.as_bytes()).as_bytes());
}

#[test]
fn errors_name_the_file() {
    let folder = folder();
    fs::write(folder.path().join("bad.obj"), "v 0 0\n").expect("written");
    fs::write(folder.path().join("empty.ply"), "").expect("written");
    fs::write(folder.path().join("scene.json"), r#"{"mesh": "none.obj"}"#).expect("written");
    let off = CacheOptions::off();
    let says = |scene: SceneRef| open(&scene, folder.path(), &off).expect_err("invalid").to_string();
    assert!(
        says(SceneRef::Mesh("bad.obj".into()))
            .ends_with("bad.obj: line 1: a number is missing at the end of the line")
    );
    assert!(says(SceneRef::Mesh("empty.ply".into())).contains("empty.ply: line 1: "));
    assert!(says(SceneRef::Mesh("t.stl".into())).contains("t.stl: a mesh file ends in"));
    assert!(says(SceneRef::File("scene.json".into())).contains("none.obj: "));
    assert!(says(SceneRef::Mesh(".".into())).contains("a mesh file ends in"));
}

fn inline() -> InlineMesh {
    let nodes = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    InlineMesh { nodes, faces: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]], uv: Vec::new() }
}

fn open_inline(mesh: InlineMesh) -> Result<Loaded, AssetError> {
    open(&SceneRef::Inline(mesh), Path::new(""), &CacheOptions::off())
}

#[test]
fn an_inline_mesh_is_taken_as_it_is_or_refused() {
    let loaded = open_inline(inline()).expect("a mesh");
    assert_eq!(loaded.mesh.to_indexed().faces, inline().faces);
    let mut textured = inline();
    textured.uv = vec![[0.0, 0.0]; 4];
    let other = open_inline(textured.clone()).expect("a mesh");
    assert!(other.mesh.is_textured() && other.mesh_hash != loaded.mesh_hash);
    textured.uv.pop();
    assert_eq!(open_inline(textured).expect_err("ragged").fault.place, Place::Field("uv".into()));
    let mut double = inline();
    double.faces.push([0, 2, 1]);
    assert_eq!(open_inline(double).expect_err("crowded").fault.place, Place::Face(4));
    let mut loose = inline();
    loose.nodes.push([0.0, 0.0, 1.0]);
    assert!(open_inline(loose).is_err(), "ids must stay, so nothing is dropped");
}

/// Compares every mesh of the kit that `LANCET_KIT` names with the facts in its manifest.
#[test]
fn the_meshes_of_the_kit_are_what_its_manifest_says() {
    let Some(kit) = std::env::var_os("LANCET_KIT").map(PathBuf::from) else {
        // Said on standard error, which the test runner captures unless it is asked not to.
        eprintln!("skipped: LANCET_KIT names no kit");
        return;
    };
    let Ok(manifest) = fs::read(kit.join("MANIFEST.json")) else {
        eprintln!("skipped: the kit has no manifest");
        return;
    };
    let manifest: serde_json::Value = serde_json::from_slice(&manifest).expect("JSON");
    for entry in manifest["meshes"].as_array().expect("a list") {
        let path = kit.join("..").join(entry["obj"].as_str().expect("a path"));
        compare_with_manifest(&path, &entry["facts"]);
    }
}

fn compare_with_manifest(path: &Path, facts: &serde_json::Value) {
    let loaded = match open(&SceneRef::Mesh(path.into()), Path::new(""), &CacheOptions::off()) {
        Ok(loaded) => loaded,
        Err(error) => {
            let good = facts["edge_manifold"] == true && facts["oriented"] == true;
            return assert!(!good, "{error}");
        }
    };
    let found = inspect(&loaded.mesh);
    assert!(found.manifold && found.oriented, "{}", path.display());
    if loaded.notes.is_empty() {
        let count = |name: &str| facts[name].as_i64().expect("a count");
        assert_eq!(
            [found.faces as i64, found.nodes as i64, found.edges as i64, found.euler],
            ["faces", "verts", "edges", "euler"].map(count),
            "{}",
            path.display()
        );
        assert_eq!(found.boundary_edges as i64, count("boundary_edges"));
        assert_eq!(found.boundary_loops as i64, count("boundary_loops_approx"));
        assert_eq!(found.seam_edges as i64, facts["uv"]["seam_edges"].as_i64().unwrap_or(0));
        let area = facts["area"].as_f64().expect("an area");
        // The manifest has six decimals.
        assert!((found.area - area).abs() < 1e-6 * area.max(1.0));
    }
}
