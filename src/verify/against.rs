//! One recording against what it should be, for who looks at all of it: every divergence, and every picture beside its golden.
//!
//! [`verify()`](super::verify()) says the same of many recordings, and keeps no picture.

use std::path::Path;
use std::sync::Arc;

use super::diff::{Diff, Side, diff};
use super::home;
use super::image::{ImageReport, Rules, difference};
use super::one::{Seen, Watch, look, open_file};
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
    pub golden: Option<Arc<Image>>,
    /// What was rendered now.
    pub actual: Arc<Image>,
    /// How the one differs from the other, as [`difference()`] shows it; none without a golden.
    pub difference: Option<Arc<Image>>,
    /// How far the one is from the other.
    pub report: ImageReport,
}

/// Replays a recording once, and compares it with its goldens. An error says why there is nothing to compare; that nobody wants to watch any
/// longer is one.
pub fn against_goldens(
    path: &Path,
    options: &Options,
    studio: Option<&dyn Studio>,
    watch: Watch<'_>,
) -> Result<Compared, String> {
    let rules =
        studio.map(|studio| read_gates(&home::gates(path)).map(|gates| Rules::new(&gates, studio.adapter())));
    let (report, seen) = look(path, options, studio, rules.transpose()?.as_ref(), &open_file, watch);
    match seen {
        Some(seen) => Ok(Compared { pictures: pictures(seen, &report.images), report }),
        None => Err(report.error.unwrap_or_default()),
    }
}

fn pictures(seen: Seen, reports: &[ImageReport]) -> Vec<ComparedPicture> {
    let Seen { found, mut stored } = seen;
    let beside = |(frame, report): (CheckpointFrame, &ImageReport)| {
        let golden = stored.pictures.remove(&frame.name).map(|picture| picture.image);
        let actual = frame.frame.image;
        ComparedPicture {
            difference: golden.as_ref().map(|golden| difference(golden, &actual).into()),
            golden: golden.map(Arc::new),
            actual: actual.into(),
            checkpoint: frame.name,
            event: frame.event,
            report: report.clone(),
        }
    };
    found.frames.into_iter().zip(reports).map(beside).collect()
}

/// Compares a recording, a script or a report of a replay with another, which it is expected to be.
pub fn against_run(path: &Path, expected: &Path, watch: Watch<'_>) -> Result<Diff, String> {
    Ok(diff(Side::open(expected, watch)?, Side::open(path, watch)?))
}
