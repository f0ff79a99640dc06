//! Where scenes lie, seen from another folder.

use std::path::Path;

use super::args::Target;
use super::failure::Failure;
use crate::assets;
use crate::recording::SceneRef;

/// A scene that a file in `from` names, as it is from where the answer goes.
pub(super) fn moved(scene: &SceneRef, from: &Path, target: &Target) -> Result<SceneRef, Failure> {
    match target {
        Target::File(path) => Ok(assets::moved(scene, from, path)?),
        _ => Ok(scene.clone()),
    }
}

/// An answer must not be written over what it was asked of.
pub(super) fn require_other(input: &Path, output: &Path) -> Result<(), Failure> {
    // Known before anything is run; what else is read on the way is known when the answer is written.
    if assets::is_same_file(input, output) {
        Err(Failure::new(format_args!("{}: would be written over its own input", output.display())))
    } else {
        Ok(())
    }
}
