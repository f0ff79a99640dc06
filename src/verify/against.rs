//! One recording against what it should be, for who looks at all of it: every divergence, and every picture beside its golden.
//!
//! [`verify()`](super::verify()) says the same of many recordings, and keeps no picture.

use std::path::Path;

use super::diff::{Diff, Side, diff};
use super::home;
use super::image::{ImageReport, Rules};
use super::one::{Seen, look, open_file};
use super::report::RecordingReport;
use super::suite::read_gates;
use crate::canvas::Studio;
use crate::canvas::image::Image;
use crate::replay::{CheckpointFrame, Options};

/// A recording, as it is and as its goldens are.
#[derive(Clone, Debug)]
pub struct Compared {
    /// What [`verify()`](super::verify()) says of it; its divergences are all that there are.
    pub report: RecordingReport,
    /// The checkpoints' pictures, in the order of the run; none without a renderer.
    pub pictures: Vec<ComparedPicture>,
}

/// A checkpoint's picture beside its golden.
#[derive(Clone, Debug)]
pub struct ComparedPicture {
    /// The checkpoint.
    pub checkpoint: String,
    /// Its event.
    pub event: usize,
    /// The golden, of the same size; none where it is missing, damaged or of another size, which the report says.
    pub golden: Option<Image>,
    /// What was rendered now.
    pub actual: Image,
    /// How far the one is from the other.
    pub report: ImageReport,
}

/// Replays a recording once, and compares it with its goldens. An error says why there is nothing to compare.
pub fn against_goldens(
    path: &Path,
    options: &Options,
    studio: Option<&dyn Studio>,
) -> Result<Compared, String> {
    let rules =
        studio.map(|studio| read_gates(&home::gates(path)).map(|gates| Rules::new(&gates, studio.adapter())));
    let (report, seen) = look(path, options, studio, rules.transpose()?.as_ref(), &open_file);
    match seen {
        Some(seen) => Ok(Compared { pictures: pictures(seen, &report.images), report }),
        None => Err(report.error.unwrap_or_default()),
    }
}

fn pictures(seen: Seen, reports: &[ImageReport]) -> Vec<ComparedPicture> {
    let Seen { found, mut stored } = seen;
    let beside = |(frame, report): (CheckpointFrame, &ImageReport)| ComparedPicture {
        golden: stored.pictures.remove(&frame.name).map(|picture| picture.image),
        checkpoint: frame.name,
        event: frame.event,
        actual: frame.frame.image,
        report: report.clone(),
    };
    found.frames.into_iter().zip(reports).map(beside).collect()
}

/// Compares a recording, a script or a report of a replay with another, which it is expected to be.
pub fn against_run(path: &Path, expected: &Path) -> Result<Diff, String> {
    Ok(diff(Side::open(expected)?, Side::open(path)?))
}
