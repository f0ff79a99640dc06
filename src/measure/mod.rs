//! The figures: what a cut costs, how that grows with the mesh, and whether anything breaks.
//!
//! | command | what it measures |
//! | --- | --- |
//! | [`thesis`] | the thesis's performance tests (Lam 2016, §6.5), beside its figures |
//! | [`scaling`] | the same cut and pick on meshes from 8 thousand to 4 million faces |
//! | [`stability`] | random and adversarial cuts: outcomes, and every broken invariant; how far coordinates may go |
//! | [`exact`] | FC in rational arithmetic: what lines are compared with, and their errors measured from |
//! | [`baseline`] | FC with an ε, in plain f32 and f64, for comparison |
//! | [`accuracy`] | time against error, with a [`plot`] of each |
//!
//! A report is plain data that serializes, and gives itself as [`Table`](crate::report::Table)s; this room writes nowhere but the
//! scripts of findings. Times are medians with their quartiles, since a shared machine disturbs in one direction only and means follow it.

pub mod accuracy;
pub mod baseline;
mod drive;
pub mod exact;
mod figure;
pub mod plot;
mod random;
pub mod scaling;
pub mod stability;
pub mod thesis;

use std::fmt;

pub use figure::Figure;
pub use random::Random;

use crate::assets::builtin::BuiltinError;
use crate::canvas::RenderError;
use crate::mesh::BuildError;
use crate::replay::OpenError;

/// Told how far a measurement is: so many done, of so many, and what is next.
pub type Progress<'a> = &'a (dyn Fn(usize, usize, &str) + Sync);

/// Why something cannot be measured.
#[derive(Debug)]
pub enum MeasureError {
    /// A recording cannot be opened.
    Open(OpenError),
    /// A recording has no cut that is applied.
    NoCut(String),
    /// A cut that is to be measured is rejected.
    Rejected(String),
    /// The renderer failed.
    Render(RenderError),
    /// There is no such built-in scene.
    Builtin(BuiltinError),
    /// A scene is no mesh.
    Build(BuildError),
    /// There is nothing of this name to measure.
    NoSubject(String),
}

impl fmt::Display for MeasureError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Open(error) => error.fmt(f),
            Self::NoCut(recording) => {
                write!(f, "{recording}: no cut in it is applied, so there is nothing to measure")
            }
            Self::Rejected(what) => write!(f, "{what}"),
            Self::Render(error) => error.fmt(f),
            Self::Builtin(error) => error.fmt(f),
            Self::Build(error) => error.fmt(f),
            Self::NoSubject(what) => write!(f, "there is no subject {what}"),
        }
    }
}

impl std::error::Error for MeasureError {}

impl From<OpenError> for MeasureError {
    fn from(error: OpenError) -> Self {
        Self::Open(error)
    }
}

impl From<BuiltinError> for MeasureError {
    fn from(error: BuiltinError) -> Self {
        Self::Builtin(error)
    }
}

impl From<BuildError> for MeasureError {
    fn from(error: BuildError) -> Self {
        Self::Build(error)
    }
}
