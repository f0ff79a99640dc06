//! What a recording was recorded on.

use std::path::PathBuf;

/// Where a scene comes from. Paths are relative to the recording.
#[derive(Clone, Debug, PartialEq)]
pub enum SceneRef {
    /// `"builtin:bust"`: made by code.
    Builtin(String),
    /// `{"file": "scene.json"}`: a scene description.
    File(PathBuf),
    /// `{"mesh": "head.obj"}`: a mesh, everything else at its default.
    Mesh(PathBuf),
    /// `{"inline": {"nodes": …, "faces": …, "uv": …}}`: a mesh in the recording itself.
    Inline(InlineMesh),
}

/// A mesh written out in a script. Its nodes and faces keep their indices as ids.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct InlineMesh {
    /// Positions, in model units.
    pub nodes: Vec<[f64; 3]>,
    /// Triangles, counter-clockwise from outside.
    pub faces: Vec<[u32; 3]>,
    /// Texture coordinates by node; empty for none.
    #[serde(default)]
    pub uv: Vec<[f32; 2]>,
}
