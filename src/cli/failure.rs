//! Why a command could not do what it was asked: bad input, or a machine that will not.

use std::fmt;
use std::path::Path;

use crate::assets::AssetError;
use crate::recording::WriteError;
use crate::replay::OpenError;

/// A line for the user.
#[derive(Clone, Debug)]
pub(super) struct Failure(String);

impl Failure {
    pub(super) fn new(what: impl fmt::Display) -> Self {
        Self(what.to_string())
    }

    /// About a file.
    pub(super) fn about(path: &Path) -> impl Fn(&dyn fmt::Display) -> Self {
        move |what| Self(format!("{}: {what}", path.display()))
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl From<std::io::Error> for Failure {
    fn from(error: std::io::Error) -> Self {
        Self(format!("writing: {error}"))
    }
}

impl From<OpenError> for Failure {
    fn from(error: OpenError) -> Self {
        Self::new(error)
    }
}

impl From<AssetError> for Failure {
    fn from(error: AssetError) -> Self {
        Self::new(error)
    }
}

impl From<WriteError> for Failure {
    fn from(error: WriteError) -> Self {
        Self::new(error)
    }
}
