//! Time against error: what a setting costs, and how far its result is from what is known to be right.
//!
//! | subject | settings | what is known to be right |
//! | --- | --- | --- |
//! | [`opening`] | resolution of the mesh | the closed form of the opening, on a plate and on a sphere |
//! | [`painting`] | distances on the surface or in the texture, resolution | exact geodesics on a cylinder and on a sphere |
//! | [`scattering`] | samples of the kernel | the full convolution with six Gaussians |
//! | [`shadows`] | sizes of map and filter | rays to the lamp that a filter stands for |
//! | [`patch`] | octaves, resolution | the patch that they converge to |
//! | [`keyframes`] | bytes kept for seeking | linear replay: its states, exactly |
//! | [`lines`] | f32 and f64 with an ε, exact signs | FC in rational arithmetic |
//! | [`picks`] | every face in f32 and f64, the hierarchy | the ray's meeting with the face, as a fraction |
//! | [`gates`] | measures of a picture | the defects that were planted |
//!
//! A subject gives one or more [`Curve`]s: rows of setting, time and error, and the Pareto front among them. An error says which distance it is, in
//! which unit. No distance is taken on trust: each curve **plants** a known error in a result that is otherwise exact and says what was measured of
//! it; a run in which they differ is no result ([`Curve::is_trusted`]).
//!
//! **Times** are medians of rounds in which all settings of a subject take turns, beside a yardstick that no change of the program touches. A
//! [gate](against) keeps what is stored of a run's curves from getting both slower, by the yardstick, and less accurate, and from going missing.
//!
//! Not promised: seconds that hold on another machine.

pub mod against;
pub mod curve;
pub mod flip;
mod frames;
pub mod gates;
pub mod keyframes;
pub mod lines;
pub mod opening;
pub mod painting;
pub mod patch;
pub mod picks;
pub mod scattering;
pub mod shadows;
mod shapes;
mod turns;

#[cfg(test)]
mod tests;

use std::path::Path;

use schemars::JsonSchema;
use serde::Serialize;

use super::{MeasureError, Progress};
use crate::canvas::Studio;
use crate::report::Table;
pub use against::Stored;
pub use curve::{Curve, Measure, Planted, Row};

/// What is asked of a subject.
pub struct Ask<'a> {
    /// Fewer and smaller settings.
    pub quick: bool,
    /// How many rounds to take times in.
    pub rounds: usize,
    /// The folder of recordings.
    pub recordings: &'a Path,
    /// Who renders.
    pub studio: &'a dyn Studio,
}

impl Ask<'_> {
    /// The settings of a full or of a quick run: those of a quick one stand first.
    fn of<'s, T>(&self, settings: &'s [T], quick: usize) -> &'s [T] {
        if self.quick { &settings[..quick.min(settings.len())] } else { settings }
    }
}

/// Something whose time is measured against its error.
pub struct Subject {
    /// What to call it.
    pub name: &'static str,
    /// What it measures.
    pub about: &'static str,
    /// Measures it.
    pub run: fn(&Ask<'_>) -> Result<Vec<Curve>, MeasureError>,
}

/// All subjects.
pub const SUBJECTS: &[Subject] = &[
    Subject {
        name: "opening",
        about: "width and volume of an incision against the closed form",
        run: opening::run,
    },
    Subject { name: "painting", about: "where a patch lies against exact geodesics", run: painting::run },
    Subject {
        name: "scattering",
        about: "the separable kernel against the full convolution",
        run: scattering::run,
    },
    Subject { name: "shadows", about: "filtered shadow maps against a lamp", run: shadows::run },
    Subject { name: "patch", about: "octaves and resolution against the converged patch", run: patch::run },
    Subject { name: "keyframes", about: "the time of a seek by the memory kept for it", run: keyframes::run },
    Subject {
        name: "lines",
        about: "FC by an ε and by exact signs, against rational arithmetic",
        run: lines::run,
    },
    Subject { name: "picks", about: "picks against rational arithmetic", run: picks::run },
    Subject { name: "gates", about: "what comparing costs, and the smallest defect caught", run: gates::run },
];

/// What was measured.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct AccuracyReport {
    /// Whether it was a quick run.
    pub quick: bool,
    /// How many rounds were run.
    pub rounds: usize,
    /// What was measured, by name.
    pub subjects: Vec<String>,
    /// The curves, by subject.
    pub curves: Vec<Curve>,
}

/// Measures the subjects of these names; all of them if none is named.
pub fn measure(
    only: &[String],
    ask: &Ask<'_>,
    progress: Progress<'_>,
) -> Result<AccuracyReport, MeasureError> {
    let subjects = chosen(only)?;
    let mut curves = Vec::new();
    for (done, subject) in subjects.iter().enumerate() {
        progress(done, subjects.len(), subject.name);
        curves.extend((subject.run)(ask)?);
    }
    let subjects = subjects.iter().map(|subject| subject.name.to_owned()).collect();
    Ok(AccuracyReport { quick: ask.quick, rounds: ask.rounds, subjects, curves })
}

fn chosen(only: &[String]) -> Result<Vec<&'static Subject>, MeasureError> {
    if let Some(unknown) = only.iter().find(|name| SUBJECTS.iter().all(|s| s.name != **name)) {
        let names: Vec<&str> = SUBJECTS.iter().map(|s| s.name).collect();
        return Err(MeasureError::NoSubject(format!("{unknown:?}; there are {}", names.join(", "))));
    }
    let named = |subject: &&Subject| only.is_empty() || only.iter().any(|name| name == subject.name);
    Ok(SUBJECTS.iter().filter(named).collect())
}

impl AccuracyReport {
    /// The report for people.
    pub fn tables(&self) -> Vec<Table> {
        self.curves.iter().map(|curve| curve.table(self.rounds)).collect()
    }

    /// What is said of curves whose planted error was not measured as such, and of errors that are no numbers.
    pub fn untrusted(&self) -> Vec<String> {
        self.curves.iter().flat_map(Curve::doubts).collect()
    }
}
