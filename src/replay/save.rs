//! A recording on its way to a file: as what its name says, on its scene as it is seen from there.

use std::fmt;
use std::path::{Path, PathBuf};

use crate::assets::{self, AssetError};
use crate::recording::{AnyRecording, Script, WriteError, to_bytes};

/// Why a recording cannot be saved.
#[derive(Debug)]
pub enum SaveError {
    /// The file's name says nothing of a form.
    Name(PathBuf),
    /// The file cannot be written.
    Asset(AssetError),
    /// The recording has no such form.
    Write {
        /** The file. */
        path: PathBuf,
        /** Why. */
        error: WriteError,
    },
}

impl fmt::Display for SaveError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Name(path) => {
                write!(f, "{}: a recording ends in .lancet, a script in .json", path.display())
            }
            Self::Asset(error) => error.fmt(f),
            Self::Write { path, error } => write!(f, "{}: {error}", path.display()),
        }
    }
}

impl std::error::Error for SaveError {}

/// Whether a file's name says what form a recording has in it.
pub fn require_form(path: &Path) -> Result<(), SaveError> {
    form(path).map(drop)
}

/// Writes a recording whose paths are relative to `folder`: packed as `.lancet`, as a script as `.json`. Gives it as it was written.
pub fn save(recording: &AnyRecording, folder: &Path, path: &Path) -> Result<AnyRecording, SaveError> {
    let (form, mut recording) = (form(path)?, recording.clone());
    recording.set_scene(assets::moved(recording.scene(), folder, path).map_err(SaveError::Asset)?);
    let bytes = form(&recording).map_err(|error| SaveError::Write { path: path.into(), error })?;
    assets::write_file(path, &bytes).map_err(SaveError::Asset)?;
    Ok(recording)
}

/// What makes a file's bytes of a recording.
type Form = fn(&AnyRecording) -> Result<Vec<u8>, WriteError>;

fn form(path: &Path) -> Result<Form, SaveError> {
    match path.extension().and_then(|end| end.to_str()) {
        Some("lancet") => Ok(to_bytes),
        Some("json") => Ok(script),
        _ => Err(SaveError::Name(path.into())),
    }
}

fn script(recording: &AnyRecording) -> Result<Vec<u8>, WriteError> {
    let mut text = Vec::new();
    Script::of(recording).write(&mut text)?;
    Ok(text)
}
