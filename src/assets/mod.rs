//! Files: meshes as OBJ, glTF and PLY, scenes as JSON, maps as PNG, JPEG and DDS, and the binary cache of finished meshes. The only room that opens
//! files.
//!
//! A mesh goes through four hands: a reader (`obj`, `ply`, `gltf`) makes triangles with their places in the file; `weld` makes equal positions one
//! node; `repair` drops, turns and splits what can be mended in one way, and refuses the rest with the line or face named;
//! [`crate::mesh::Mesh::build`] makes the topology. What was changed on the way is told in [`Note`]s. The [`cache`] then keeps the result.
//!
//! Promised: whatever the bytes, a typed error or a manifold, oriented mesh; never a panic, never an allocation that the
//! size of the file does not justify. Not promised: that a mesh does not intersect itself.

pub mod builtin;
pub mod cache;
mod error;
mod exact;
pub mod export;
mod files;
#[cfg(feature = "gltf")]
mod gltf;
pub mod inspect;
mod links;
mod maps;
mod obj;
mod open;
mod outputs;
mod ply;
mod polygon;
mod repair;
pub mod scene;
mod soup;
mod source;
mod weld;

use serde::{Deserialize, Serialize};

pub use cache::CacheOptions;
pub use error::{AssetError, Fault, FaultKind, Place};
pub use files::{
    is_file, is_folder, is_same_file, list_files, list_folder, moved, newest_files, read_file, real_folder,
    remove_file, take_file, write_file,
};
pub use inspect::{MeshFacts, inspect};
pub use maps::{MapSources, read_png, write_png};
pub use open::{Loaded, open};
pub use outputs::{begin_outputs, claim_output, write_output};
pub use scene::SceneSettings;
pub use source::{is_mesh, read_mesh};

/// Something that was changed or passed over while a mesh was read.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, schemars::JsonSchema)]
pub struct Note {
    /// A word for it in kebab case, such as `welded`.
    pub what: String,
    /// How often.
    pub count: usize,
    /// The same for a person, with the first place.
    pub detail: String,
}

impl Note {
    fn new(what: &str, count: usize, detail: String) -> Self {
        Self { what: what.into(), count, detail }
    }
}

/// A list of notes to add to.
trait Notes {
    fn note(&mut self, what: &str, count: usize, detail: String);
}

impl Notes for Vec<Note> {
    fn note(&mut self, what: &str, count: usize, detail: String) {
        self.push(Note::new(what, count, detail));
    }
}

#[cfg(test)]
mod tests;
