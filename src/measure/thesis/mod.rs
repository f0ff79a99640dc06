//! The thesis's performance tests, beside its own figures (Lam 2016, §6.5).
//!
//! | test | what it asks | here |
//! | --- | --- | --- |
//! | Table 6.2 | what a cut costs, stage by stage | [`stages`] |
//! | Table 6.3 | what cuts in view add to a frame | [`frames`] |
//! | Figure 6.7 | what the local discoloration adds to the scattering | [`frames`] |

pub mod frames;
pub mod published;
pub mod stages;

use std::path::Path;

use schemars::JsonSchema;
use serde::Serialize;

use super::{MeasureError, Progress};
use crate::canvas::{Adapter, Studio};
use crate::report::Table;

/// How much is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Repeat {
    /// Runs of each cut.
    pub cuts: usize,
    /// Frames of each kind.
    pub frames: usize,
}

/// All three tests.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct ThesisReport {
    /// Who rendered.
    pub adapter: Adapter,
    /// Table 6.2.
    pub cuts: stages::Samples,
    /// Table 6.3 and Figure 6.7.
    pub frames: frames::Frames,
}

/// Runs the tests, with the thesis's cuts in a folder of recordings.
pub fn measure(
    folder: &Path,
    repeat: Repeat,
    studio: &dyn Studio,
    progress: Progress<'_>,
) -> Result<ThesisReport, MeasureError> {
    Ok(ThesisReport {
        adapter: studio.adapter().clone(),
        cuts: stages::measure(folder, repeat.cuts, studio, progress)?,
        frames: frames::measure(repeat.frames, studio, progress)?,
    })
}

impl ThesisReport {
    /// The report for people.
    pub fn tables(&self) -> Vec<Table> {
        let mut tables = vec![self.cuts.table()];
        tables.extend(self.frames.tables());
        tables.iter_mut().for_each(|table| table.title = format!("{}; {}", table.title, self.adapter));
        tables
    }
}
