//! What can be wrong with a file: its name, the place in it, the kind of error and the cause.
//!
//! A reader knows bytes, not paths: it says a [`Fault`]. [`super::open`] adds the file and makes it an [`AssetError`].

use std::fmt;
use std::path::{Path, PathBuf};

use crate::mesh::BuildError;

/// Where in a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Place {
    /// The file as a whole.
    Whole,
    /// A line, from 1.
    Line(u64),
    /// A byte, from 0.
    Byte(u64),
    /// A face, from 0, in the order of the file.
    Face(u64),
    /// A field of a document.
    Field(String),
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Whole => write!(f, "the file"),
            Self::Line(n) => write!(f, "line {n}"),
            Self::Byte(n) => write!(f, "byte {n}"),
            Self::Face(n) => write!(f, "face {n}"),
            Self::Field(name) => write!(f, "`{name}`"),
        }
    }
}

/// What kind of error it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FaultKind {
    /// The file cannot be read or written.
    Io,
    /// It does not follow the grammar of its format.
    Syntax,
    /// A number that is none, or is out of range.
    Number,
    /// An index that points nowhere.
    Index,
    /// It ends too early.
    Truncated,
    /// It is well formed, but asks for something that is not supported.
    Unsupported,
    /// A face uses a coordinate that is NaN or infinite.
    NotFinite,
    /// More than two faces share an edge.
    NotManifold,
    /// Its faces have no common orientation.
    NotOrientable,
    /// There is no face in it.
    Empty,
    /// There is more of something than ids or time allow.
    TooLarge,
}

/// What is wrong, and where in the file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// Where.
    pub place: Place,
    /// What kind of error.
    pub kind: FaultKind,
    /// The cause, for a person.
    pub detail: String,
}

impl Fault {
    pub(super) fn new(place: Place, kind: FaultKind, detail: impl Into<String>) -> Self {
        Self { place, kind, detail: detail.into() }
    }

    pub(super) fn whole(kind: FaultKind, detail: impl Into<String>) -> Self {
        Self::new(Place::Whole, kind, detail)
    }

    pub(super) fn line(line: u64, kind: FaultKind, detail: impl Into<String>) -> Self {
        Self::new(Place::Line(line), kind, detail)
    }

    pub(super) fn byte(byte: usize, kind: FaultKind, detail: impl Into<String>) -> Self {
        Self::new(Place::Byte(byte as u64), kind, detail)
    }

    /// What [`crate::mesh::Mesh::build`] refused; `place` says where a face stands in the file.
    pub(super) fn build(error: &BuildError, place: impl Fn(usize) -> Place) -> Self {
        let (kind, at) = match *error {
            BuildError::Empty => (FaultKind::Empty, Place::Whole),
            BuildError::TooLarge { .. } => (FaultKind::TooLarge, Place::Whole),
            BuildError::Ragged | BuildError::Unused { .. } => (FaultKind::Syntax, Place::Whole),
            BuildError::Index { face } => (FaultKind::Index, place(face)),
            BuildError::NotFinite { .. } => (FaultKind::NotFinite, Place::Whole),
            BuildError::Degenerate { face } => (FaultKind::Syntax, place(face)),
            BuildError::NonManifoldEdge { face, .. } => (FaultKind::NotManifold, place(face)),
            BuildError::Orientation { face, .. } => (FaultKind::NotOrientable, place(face)),
            BuildError::NonManifoldNode { .. } => (FaultKind::NotManifold, Place::Whole),
        };
        Self::new(at, kind, error.to_string())
    }

    /// Says which file it is about.
    #[must_use]
    pub fn in_file(self, path: &Path) -> AssetError {
        AssetError { path: path.to_path_buf(), fault: self }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.place {
            Place::Whole => write!(f, "{}", self.detail),
            place => write!(f, "{place}: {}", self.detail),
        }
    }
}

impl std::error::Error for Fault {}

/// What is wrong with a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AssetError {
    /// The file, or a name for what is none (`builtin:NAME`, `inline`).
    pub path: PathBuf,
    /// What is wrong in it.
    pub fault: Fault,
}

impl AssetError {
    pub(super) fn io(path: &Path, error: &std::io::Error) -> Self {
        Fault::whole(FaultKind::Io, error.to_string()).in_file(path)
    }
}

impl fmt::Display for AssetError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.path.display(), self.fault)
    }
}

impl std::error::Error for AssetError {}
