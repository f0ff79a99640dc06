//! Recordings as they come in: a file or a script, from a path.

use std::path::{Path, PathBuf, absolute};

use super::args::Target;
use super::failure::Failure;
use crate::assets::{self, CacheOptions};
use crate::recording::{self, AnyRecording, SceneRef, Script};

/// A recording, and the folder that its paths are relative to.
pub(super) struct Input {
    pub(super) recording: AnyRecording,
    pub(super) base: PathBuf,
}

/// Reads a recording or a script as it stands: a script's hashes are zero.
pub(super) fn read(path: &Path) -> Result<Input, Failure> {
    let bytes = assets::read_file(path).map_err(Failure::new)?;
    let recording = if is_script(path, &bytes) {
        script(path, &bytes)?.unhashed().clone()
    } else {
        recording::read(&bytes).map_err(|e| Failure::about(path)(&e))?
    };
    Ok(Input { recording, base: folder(path) })
}

/// Reads a recording or a script, and looks up what the scene of a script hashes to.
pub(super) fn hashed(path: &Path) -> Result<Input, Failure> {
    let mut input = read(path)?;
    if input.recording.hashes() == [[0; 32]; 2] {
        let cache = CacheOptions::from_environment();
        let loaded = assets::open(input.recording.scene(), &input.base, &cache).map_err(Failure::new)?;
        input.recording.set_hashes([loaded.scene_hash, loaded.mesh_hash]);
    }
    Ok(input)
}

/// Reads a script.
pub(super) fn script(path: &Path, bytes: &[u8]) -> Result<Script, Failure> {
    Script::parse(bytes).map_err(|e| Failure::about(path)(&e))
}

/// A script has its name, or at least does not begin as a recording does.
pub(super) fn is_script(path: &Path, bytes: &[u8]) -> bool {
    let named = |extension| path.extension().is_some_and(|e| e == extension);
    !recording::is_binary(bytes) && (named("json") || !named("lancet"))
}

/// The folder that a file's paths are relative to.
pub(super) fn folder(path: &Path) -> PathBuf {
    path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new(".")).to_owned()
}

/// A scene's path, as it is from where the answer goes.
pub(super) fn moved(scene: &SceneRef, base: &Path, target: &Target) -> Result<SceneRef, Failure> {
    let Target::File(path) = target else { return Ok(scene.clone()) };
    let (from, to) = (absolute(base), absolute(folder(path)));
    Ok(scene.moved(&from.map_err(Failure::new)?, &to.map_err(Failure::new)?))
}
