//! recording

mod scene_ref;

pub use scene_ref::{InlineMesh, SceneRef};
