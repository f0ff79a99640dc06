//! From what a recording says it was recorded on, to a mesh and its settings.

use std::path::{Path, PathBuf};

use glam::{DVec3, Vec2};

use super::error::{AssetError, Fault, FaultKind, Place};
use super::maps::MapSources;
use super::scene::{self, MapFiles, SceneSettings};
use super::source::Source;
use super::{CacheOptions, Note, builtin, cache, read_file};
use crate::geometry::predicates::collinear;
use crate::mesh::{IndexedMesh, Mesh};
use crate::recording::{InlineMesh, SceneRef};

/// What a mesh made by code is called in a scene file.
const BUILTIN: &str = "builtin:";

/// A scene, ready to be cut.
#[derive(Clone, Debug)]
pub struct Loaded {
    /// The mesh, repaired where need be.
    pub mesh: Mesh,
    /// Everything else that the scene says.
    pub settings: SceneSettings,
    /// Where the maps come from.
    pub maps: MapSources,
    /// What was changed or passed over while reading.
    pub notes: Vec<Note>,
    /// blake3 of the settings and of the maps' files; what a scene file looks like does not matter, what it says does.
    pub scene_hash: [u8; 32],
    /// blake3 of the mesh file's bytes; of a mesh inline or made by code, that of its positions, faces and texture coordinates.
    pub mesh_hash: [u8; 32],
    /// Whether the mesh came from the cache.
    pub from_cache: bool,
}

struct Opened {
    mesh: Mesh,
    notes: Vec<Note>,
    hash: [u8; 32],
    from_cache: bool,
}

/// Opens a scene. Paths in it are relative to `base`, those in a scene file to that file. Of maps only the headers are read, but for
/// a picture of the surroundings, which becomes the look's irradiance.
pub fn open(scene: &SceneRef, base: &Path, options: &CacheOptions) -> Result<Loaded, AssetError> {
    let plain = |opened: Opened, builtin: Option<&str>| {
        opened.into_loaded(builtin, SceneSettings::default(), &MapFiles::default(), base)
    };
    match scene {
        SceneRef::Builtin(name) => plain(open_builtin(name)?, Some(name)),
        SceneRef::File(path) => open_scene_file(&base.join(path), options),
        SceneRef::Mesh(path) => plain(open_mesh(&base.join(path), options)?, None),
        SceneRef::Inline(inline) => plain(open_inline(inline)?, None),
    }
}

fn open_scene_file(path: &Path, options: &CacheOptions) -> Result<Loaded, AssetError> {
    let bytes = read_file(path)?;
    let (mesh, settings, maps) = scene::parse(&bytes).map_err(|fault| fault.in_file(path))?;
    let folder = path.parent().unwrap_or(Path::new(""));
    let builtin = mesh.strip_prefix(BUILTIN);
    let opened = match builtin {
        Some(name) => open_builtin(name)?,
        None => open_mesh(&folder.join(&mesh), options)?,
    };
    opened.into_loaded(builtin, settings, &maps, folder)
}

impl Opened {
    /// With what the scene says besides; the maps' paths are relative to `folder`.
    fn into_loaded(
        self,
        builtin: Option<&str>,
        mut settings: SceneSettings,
        files: &MapFiles,
        folder: &Path,
    ) -> Result<Loaded, AssetError> {
        let Self { mesh, notes, hash: mesh_hash, from_cache } = self;
        let maps = MapSources::new(builtin, mesh.is_textured(), &settings.look.skin);
        let maps = maps.with_files(files, folder)?;
        let scene_hash = settings.hash(&maps.hashes());
        if let Some(irradiance) = maps.irradiance()? {
            settings.look.ambient.irradiance = irradiance;
        }
        Ok(Loaded { mesh, settings, maps, notes, scene_hash, mesh_hash, from_cache })
    }
}

fn open_mesh(path: &Path, options: &CacheOptions) -> Result<Opened, AssetError> {
    let source = Source::read(path)?;
    let hash = source.hash();
    let key = cache::key(source.format as u8, &hash);
    if let Some((mesh, notes)) = options.load(&key) {
        return Ok(Opened { mesh, notes, hash, from_cache: true });
    }
    let (mesh, notes) = source.build()?;
    options.store(&key, &mesh, &notes);
    Ok(Opened { mesh, notes, hash, from_cache: false })
}

fn open_builtin(name: &str) -> Result<Opened, AssetError> {
    let path = PathBuf::from(format!("{BUILTIN}{name}"));
    let made = builtin::builtin(name)
        .map_err(|why| Fault::whole(FaultKind::Unsupported, why.to_string()).in_file(&path))?;
    as_it_is(&made.mesh).map_err(|fault| fault.in_file(&path))
}

fn open_inline(inline: &InlineMesh) -> Result<Opened, AssetError> {
    from_inline(inline)
        .and_then(|indexed| as_it_is(&indexed))
        .map_err(|fault| fault.in_file(Path::new("inline")))
}

/// An inline mesh's ids are named by the recording, so nothing is welded or repaired: it must be a mesh as it stands.
fn from_inline(inline: &InlineMesh) -> Result<IndexedMesh, Fault> {
    if !inline.uv.is_empty() && inline.uv.len() != inline.nodes.len() {
        let detail = format!("{} texture coordinates for {} nodes", inline.uv.len(), inline.nodes.len());
        return Err(Fault::new(Place::Field("uv".into()), FaultKind::Syntax, detail));
    }
    if let Some(node) = inline.uv.iter().position(|uv| !uv.iter().all(|v| v.is_finite())) {
        let detail = format!("the texture coordinate of node {node} is not finite");
        return Err(Fault::new(Place::Field("uv".into()), FaultKind::NotFinite, detail));
    }
    Ok(IndexedMesh {
        positions: inline.nodes.iter().map(|&p| DVec3::from(p) + DVec3::ZERO).collect(),
        faces: inline.faces.clone(),
        uvs: inline.uv.iter().map(|&t| Vec2::from(t) + Vec2::ZERO).collect(),
        face_uvs: if inline.uv.is_empty() { Vec::new() } else { inline.faces.clone() },
        surfaces: Vec::new(),
    })
}

/// Whether a face's corners lie on one line, exactly. Corners that do not exist are the build's to refuse.
fn has_no_area(indexed: &IndexedMesh, face: &[u32; 3]) -> bool {
    let corner = |i: usize| indexed.positions.get(face[i] as usize).filter(|p| p.is_finite());
    corner(0).zip(corner(1)).zip(corner(2)).is_some_and(|((a, b), c)| collinear(*a, *b, *c))
}

fn as_it_is(indexed: &IndexedMesh) -> Result<Opened, Fault> {
    if let Some(face) = indexed.faces.iter().position(|f| has_no_area(indexed, f)) {
        return Err(Fault::new(Place::Face(face as u64), FaultKind::NotManifold, "it has no area"));
    }
    let mesh = Mesh::build(indexed).map_err(|error| Fault::build(&error, |face| Place::Face(face as u64)))?;
    Ok(Opened { mesh, notes: Vec::new(), hash: hash_of(indexed), from_cache: false })
}

/// blake3 of a face set: each list with its length in front, numbers little-endian.
fn hash_of(mesh: &IndexedMesh) -> [u8; 32] {
    let mut hasher = blake3::Hasher::new();
    let mut list = |len: usize, bytes: Vec<u8>| {
        hasher.update(&(len as u64).to_le_bytes());
        hasher.update(&bytes);
    };
    let reals = mesh.positions.iter().flat_map(|p| p.to_array()).flat_map(f64::to_le_bytes);
    list(mesh.positions.len(), reals.collect());
    list(mesh.faces.len(), mesh.faces.iter().flatten().flat_map(|n| n.to_le_bytes()).collect());
    let reals = mesh.uvs.iter().flat_map(|t| t.to_array()).flat_map(f32::to_le_bytes);
    list(mesh.uvs.len(), reals.collect());
    list(mesh.face_uvs.len(), mesh.face_uvs.iter().flatten().flat_map(|n| n.to_le_bytes()).collect());
    *hasher.finalize().as_bytes()
}
