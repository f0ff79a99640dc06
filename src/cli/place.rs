//! Where scenes lie, seen from another folder.

use std::path::{Path, absolute};

use super::args::Target;
use super::failure::Failure;
use crate::recording::SceneRef;

/// A scene that a file in `from` names, as it is from where the answer goes.
pub(super) fn moved(scene: &SceneRef, from: &Path, target: &Target) -> Result<SceneRef, Failure> {
    let Target::File(path) = target else { return Ok(scene.clone()) };
    let folder = |path: &Path| match path.as_os_str().is_empty() {
        true => absolute("."),
        false => absolute(path),
    };
    let to = folder(path.parent().unwrap_or(Path::new("")));
    Ok(scene.moved(&folder(from).map_err(Failure::new)?, &to.map_err(Failure::new)?))
}

/// An answer must not be written over what it was asked of.
pub(super) fn require_other(input: &Path, output: &Path) -> Result<(), Failure> {
    let same = absolute(input).ok().zip(absolute(output).ok()).is_some_and(|(a, b)| a == b);
    if same {
        Err(Failure::new(format_args!("{}: would be written over its own input", output.display())))
    } else {
        Ok(())
    }
}
