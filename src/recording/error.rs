//! What can be wrong with a recording, and where.

use std::fmt;

use super::frame::VERSION;
use super::{AnyRecording, ENGINES};
use crate::report::quoted;

/// What is wrong with a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Cause {
    /// It does not begin as a recording does.
    NotARecording,
    /// A format that this program does not know, newer than itself.
    UnknownVersion(u32),
    /// No engine of this name.
    UnknownEngine(String),
    /// The bytes end before the frame does, by at least this many.
    CutOff {
        /** Bytes missing. */
        missing: u64,
    },
    /// The frame is not what was written.
    Checksum,
    /// The frame is longer than any that is written.
    TooLong {
        /** Its length, bytes. */
        bytes: u64,
    },
    /// A frame of this kind does not belong here.
    WrongKind(u8),
    /// The frame is whole, but what is in it does not decode.
    Malformed(String),
    /// What is in the frame decodes, but may not be: the field, then what.
    Invalid(String),
    /// The end frame counts other events than there are.
    Count {
        /** What it says. */
        said: u64,
        /** Events there are. */
        found: u64,
    },
    /// The recording is whole, but something follows it.
    Trailing {
        /** How much, bytes. */
        bytes: u64,
    },
}

impl fmt::Display for Cause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotARecording => write!(f, "not a recording: it does not begin as one"),
            Self::UnknownVersion(v) => write!(f, "format version {v}; this program knows 1 to {VERSION}"),
            Self::UnknownEngine(name) => {
                write!(f, "there is no engine {}; there is {}", quoted(name), ENGINES.join(", "))
            }
            Self::CutOff { missing } => {
                write!(f, "the file ends here; bytes missing: at least {missing}, or a length is damaged")
            }
            Self::Checksum => write!(f, "damaged: the checksum does not match"),
            Self::TooLong { bytes } => write!(f, "a frame of {bytes} bytes is longer than any"),
            Self::WrongKind(kind) => write!(f, "a frame of kind {kind} does not belong here"),
            Self::Malformed(what) => write!(f, "cannot be decoded: {what}"),
            Self::Invalid(what) => write!(f, "{what}"),
            Self::Count { said, found } => write!(f, "there should be {said} events, there are {found}"),
            Self::Trailing { bytes } => write!(f, "{bytes} bytes follow the end"),
        }
    }
}

/// A file that could not be read as a whole.
#[derive(Clone, Debug, PartialEq)]
pub struct ReadError {
    /// Where, bytes from the beginning: where the frame begins, or where the file ends too early.
    pub offset: u64,
    /// Which frame: 0 is the head, 1 the scene, 2 the first event.
    pub frame: u64,
    /// What is wrong.
    pub cause: Cause,
    /// The valid part before it, when the scene was read.
    pub prefix: Option<AnyRecording>,
}

impl fmt::Display for ReadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "byte {}, frame {} ", self.offset, self.frame)?;
        match self.frame {
            0 => write!(f, "(the head)")?,
            1 => write!(f, "(the scene)")?,
            n => write!(f, "(after {} events)", n - 2)?,
        }
        write!(f, ": {}", self.cause)
    }
}

impl std::error::Error for ReadError {}

/// A script that is not one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ScriptError {
    /// Line and column, from 1; `None` when the text as a whole is at fault.
    pub at: Option<(usize, usize)>,
    /// The field, such as `events[3].cut.from`; empty for the text as a whole.
    pub field: String,
    /// What is wrong.
    pub message: String,
}

impl fmt::Display for ScriptError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some((line, column)) = self.at {
            write!(f, "line {line}, column {column}: ")?;
        }
        if !self.field.is_empty() {
            write!(f, "{}: ", self.field)?;
        }
        write!(f, "{}", self.message)
    }
}

impl std::error::Error for ScriptError {}

/// A recording that could not be written.
#[derive(Debug)]
pub enum WriteError {
    /// It could not be read again: the field, then what is wrong with it.
    Invalid(String),
    /// The writer failed.
    Io(std::io::Error),
}

impl fmt::Display for WriteError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Invalid(what) => write!(f, "{what}"),
            Self::Io(error) => write!(f, "{error}"),
        }
    }
}

impl std::error::Error for WriteError {}

impl From<std::io::Error> for WriteError {
    fn from(error: std::io::Error) -> Self {
        Self::Io(error)
    }
}
