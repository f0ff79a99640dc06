//! Bytes to the readers of meshes. The first byte says which: `o` OBJ, `p` PLY, `g` glTF; any other is as good as one of these.
//!
//! What must hold: a fault names a place in the file; a mesh is a manifold, finite and without flat faces, no larger than the file
//! justifies, and survives the cache's form bit for bit; written as OBJ and as PLY it reads back as the same mesh, id by id. Where nodes share a place that
//! last one says less: the readers decide anew which of them are one, so only that the mesh is read again is asked, and of a PLY not even that.
//!
//! Not looked at: how much was set aside on the way. libFuzzer's `-malloc_limit_mb` does that.

use std::path::Path;

use super::{Finding, Hits, Outcome};
use crate::assets::export::{write_obj, write_ply};
use crate::assets::{AssetError, FaultKind, Place, read_mesh};
use crate::geometry::predicates::collinear;
use crate::mesh::{Mesh, check};

/// The readers, by the first byte.
const READERS: [(u8, &str); 3] = [(b'o', "file.obj"), (b'p', "file.ply"), (b'g', "file.glb")];
/// Faces that a byte of a file may make, beside a few: a glTF may show a mesh more than once.
const MOST_FACES_A_BYTE: usize = 64;

/// The reader that a file goes to, and the file.
fn split(data: &[u8]) -> Option<(&'static Path, &[u8])> {
    let (first, file) = data.split_first()?;
    let named = READERS.iter().find(|(byte, _)| byte == first);
    Some((Path::new(named.unwrap_or(&READERS[usize::from(*first) % READERS.len()]).1), file))
}

pub(super) fn run(data: &[u8]) -> Outcome {
    let mut hits = Hits::default();
    let Some((name, file)) = split(data) else { return Ok(hits) };
    match read_mesh(name, file) {
        Err(error) => {
            hits.note(format!("{} {:?}", name.display(), error.fault.kind));
            fault(&error, file)?;
        }
        Ok((mesh, notes)) => {
            notes.iter().for_each(|note| hits.note(format!("{} {}", name.display(), note.what)));
            hits.note(format!("{} read", name.display()));
            sound(&mesh, file.len())?;
            cached(&mesh)?;
            exported("obj", &mesh, write_obj)?;
            exported("ply", &mesh, write_ply)?;
        }
    }
    Ok(hits)
}

fn fault(error: &AssetError, file: &[u8]) -> Result<(), Box<Finding>> {
    let lines = 1 + file.iter().filter(|&&b| b == b'\n').count() as u64;
    let within = match error.fault.place {
        Place::Line(line) => (1..=lines).contains(&line),
        Place::Byte(byte) => byte <= file.len() as u64,
        _ => true,
    };
    let what = || format!("{error}, of {} bytes and {lines} lines", file.len());
    if within && !error.fault.detail.is_empty() {
        Ok(())
    } else {
        Err(Finding::new("fault-within-file", what()))
    }
}

fn sound(mesh: &Mesh, bytes: usize) -> Result<(), Box<Finding>> {
    check::whole(mesh)
        .map_err(|broken| Finding::new("mesh-is-sound", format!("{} {}", broken.element, broken.what)))?;
    if !mesh.positions().iter().all(|p| p.is_finite()) {
        return Err(Finding::new("mesh-is-finite", "a coordinate is not"));
    }
    let flat = |nodes: [_; 3]| {
        let [a, b, c] = nodes.map(|n| mesh.position(n));
        collinear(a, b, c)
    };
    if let Some(face) = mesh.faces().iter().position(|face| flat(face.nodes)) {
        return Err(Finding::new("faces-have-area", format!("f{face} has none")));
    }
    let most = MOST_FACES_A_BYTE * bytes + MOST_FACES_A_BYTE;
    if mesh.face_count() > most {
        return Err(Finding::new(
            "file-justifies-size",
            format!("{} faces of {bytes} bytes", mesh.face_count()),
        ));
    }
    Ok(())
}

/// The form in which the cache keeps it.
fn cached(mesh: &Mesh) -> Result<(), Box<Finding>> {
    let failed = |what: String| Finding::new("survives-the-cache", what);
    let mut bytes = Vec::new();
    mesh.write_raw(&mut bytes).map_err(|e| failed(e.to_string()))?;
    let raw = Mesh::read_raw(&mut bytes.as_slice(), bytes.len() as u64).map_err(|e| failed(e.to_string()))?;
    let again = raw.validate().map_err(|_| failed("it is refused".into()))?;
    let (mut second, same) = (Vec::new(), same_mesh(mesh, &again));
    again.write_raw(&mut second).map_err(|e| failed(e.to_string()))?;
    if same && bytes == second { Ok(()) } else { Err(failed("it is another mesh".into())) }
}

fn exported(
    end: &str,
    mesh: &Mesh,
    write: impl Fn(&Mesh, &mut Vec<u8>) -> std::io::Result<()>,
) -> Result<(), Box<Finding>> {
    let failed = |what: String| Finding::new("reads-what-it-wrote", format!("as {end}: {what}"));
    let mut bytes = Vec::new();
    write(mesh, &mut bytes).map_err(|e| failed(e.to_string()))?;
    match read_mesh(Path::new(&format!("again.{end}")), &bytes) {
        Ok((again, _)) if share_a_place(mesh) || same_mesh(mesh, &again) => Ok(()),
        Ok(_) => Err(failed("it is another mesh".into())),
        Err(error) if welds_to_none(end, mesh, &error) => Ok(()),
        Err(error) => Err(failed(error.to_string())),
    }
}

/// A PLY cannot say that two nodes at one place are two, and as one they may make an edge of three faces, or a strip of one side.
fn welds_to_none(end: &str, mesh: &Mesh, error: &AssetError) -> bool {
    let kinds = [FaultKind::NotManifold, FaultKind::NotOrientable];
    end == "ply" && share_a_place(mesh) && kinds.contains(&error.fault.kind)
}

fn share_a_place(mesh: &Mesh) -> bool {
    let mut places: Vec<[u64; 3]> =
        mesh.positions().iter().map(|p| p.to_array().map(|v| (v + 0.0).to_bits())).collect();
    places.sort_unstable();
    places.windows(2).any(|pair| pair[0] == pair[1])
}

/// The same positions, faces, edges and texture coordinates at the corners; how these are shared out to vertices is each reader's own.
fn same_mesh(a: &Mesh, b: &Mesh) -> bool {
    let corners = |mesh: &Mesh| -> Vec<_> {
        let uvs =
            |face: &crate::mesh::Face| face.vertices.map(|v| mesh.vertex(v).uv.to_array().map(f32::to_bits));
        mesh.faces().iter().map(|face| (face.nodes, face.edges, uvs(face))).collect()
    };
    a.positions() == b.positions() && a.edges() == b.edges() && corners(a) == corners(b)
}

#[cfg(test)]
mod tests {
    use super::*;

    const TETRAHEDRON: &str = "ov 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0.25\nvt 1 0\nvt 0 1\n\
        f 1/1 3/3 2/2\nf 1/1 2/2 4/3\nf 2/2 3/3 4/1\nf 3/3 1/1 4/2\n";

    #[test]
    fn a_mesh_holds_and_so_does_every_part_of_its_file() {
        let whole = TETRAHEDRON.as_bytes();
        assert!(run(whole).expect("no finding").0.contains_key("file.obj read"));
        (0..whole.len()).for_each(|end| drop(run(&whole[..end]).expect("no finding")));
    }

    #[test]
    fn what_is_not_so_is_found() {
        let (mesh, _) = read_mesh(Path::new("t.obj"), &TETRAHEDRON.as_bytes()[1..]).expect("a mesh");
        assert_eq!(sound(&mesh, 0).map_err(|f| f.check), Ok(()));
        let mut torn = mesh.clone();
        torn.set_position(crate::mesh::NodeId(3), glam::DVec3::new(0.5, 0.5, 0.0));
        assert_eq!(sound(&torn, 100).map_err(|f| f.check), Err("faces-have-area".into()));
        assert!(!same_mesh(&mesh, &torn));
        let writes_less = |mesh: &Mesh, to: &mut Vec<u8>| {
            write_obj(mesh, to)?;
            to.truncate(to.len() - 12);
            Ok(())
        };
        let finding = exported("obj", &mesh, writes_less).expect_err("a face is missing");
        assert_eq!(finding.check, "reads-what-it-wrote");
    }
}
