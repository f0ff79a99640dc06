//! The thesis's eighteen cuts, stage by stage, beside its own figures (Lam 2016, §6.5.1, Table 6.2).
//!
//! Each sample is a recording, `thesis-SIZE-PLACE.lancet`, whose first applied cut is run again and again from the same state, as the thesis
//! averages over 100 runs; ours are medians. The times are of the stages alone, everything kept up to date in them: the hierarchy for
//! picks, the journal. The hierarchy is there when the clock starts, as it is for every cut but a session's first.
//!
//! The thesis's machine was another (2015), so a ratio says how far apart the figures are, not how far apart the algorithms. Its columns GP
//! and PP have no counterpart here yet, so its total below is FC + MC + CI.

use std::path::Path;

use schemars::JsonSchema;
use serde::Serialize;

use super::figure::table;
use super::{Figure, MeasureError, Progress};
use crate::replay::{Case, Options, Replay};
use crate::report::{Counter, EventReport, Outcome, Overlay, Table};

/// The stages that are timed, in order.
const STAGES: [&str; 3] = ["FC", "MC", "CI"];

/// A row of the thesis's table: its name, faces, length, and milliseconds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Published {
    /// Size and place, such as `small I`.
    pub name: &'static str,
    /// Faces that the line crosses.
    pub faces: u32,
    /// Length of the line, in the thesis's unit.
    pub length: f64,
    /// Milliseconds of FC, MC and CI.
    pub ms: [f64; 3],
}

const fn published(name: &'static str, faces: u32, length: f64, ms: [f64; 3]) -> Published {
    Published { name, faces, length, ms }
}

/// Table 6.2, in its order.
pub const TABLE: [Published; 18] = [
    published("small I", 4, 0.025, [0.014, 3.638, 2.721]),
    published("small III", 6, 0.042, [0.017, 2.154, 1.106]),
    published("small II", 6, 0.051, [0.017, 2.184, 1.120]),
    published("small VI", 8, 0.027, [0.019, 2.006, 1.011]),
    published("small V", 8, 0.038, [0.020, 1.839, 0.924]),
    published("small IV", 9, 0.048, [0.018, 2.049, 0.966]),
    published("medium I", 9, 0.052, [0.021, 2.540, 1.199]),
    published("medium III", 11, 0.084, [0.025, 2.180, 1.044]),
    published("medium II", 11, 0.096, [0.022, 2.307, 1.044]),
    published("medium IV", 17, 0.095, [0.026, 3.222, 1.388]),
    published("medium VI", 18, 0.061, [0.027, 3.471, 1.419]),
    published("medium V", 19, 0.076, [0.030, 3.446, 1.450]),
    published("large I", 22, 0.119, [0.035, 4.085, 1.593]),
    published("large II", 24, 0.191, [0.036, 4.081, 1.690]),
    published("large III", 25, 0.176, [0.038, 4.073, 1.727]),
    published("large IV", 30, 0.173, [0.040, 4.962, 1.916]),
    published("large V", 39, 0.155, [0.051, 6.079, 2.347]),
    published("large VI", 46, 0.151, [0.053, 7.562, 2.672]),
];

impl Published {
    /// Milliseconds of FC, MC and CI together.
    pub fn total(&self) -> f64 {
        self.ms.iter().sum()
    }

    /// The file of its recording.
    pub fn file(&self) -> String {
        format!("thesis-{}.lancet", self.name.replace(' ', "-"))
    }
}

/// A sample as measured, beside the thesis's row.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Sample {
    /// The thesis's row.
    pub thesis: Published,
    /// Faces that the line crosses.
    pub faces: u64,
    /// Links of the line.
    pub links: u64,
    /// Arc length of the line, model units.
    pub length: f64,
    /// Milliseconds of FC, MC and CI.
    pub ms: [Figure; 3],
    /// Milliseconds of the three together.
    pub total_ms: Figure,
    /// Microseconds of the three together for each link.
    pub us_per_link: f64,
    /// The thesis's total over ours.
    pub ratio: f64,
}

/// All samples.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct ThesisReport {
    /// How often each cut was run.
    pub repeat: usize,
    /// The samples, in the thesis's order.
    pub samples: Vec<Sample>,
    /// Mean of the samples' totals, milliseconds.
    pub mean_ms: f64,
    /// The same of the thesis's.
    pub thesis_mean_ms: f64,
}

/// Runs the samples in a folder of recordings, each cut so many times.
pub fn measure(folder: &Path, repeat: usize, progress: Progress<'_>) -> Result<ThesisReport, MeasureError> {
    let sample = |(done, thesis): (usize, &Published)| {
        progress(done, TABLE.len(), thesis.name);
        sample(*thesis, &folder.join(thesis.file()), repeat)
    };
    let samples = TABLE.iter().enumerate().map(sample).collect::<Result<Vec<Sample>, _>>()?;
    let mean = |of: fn(&Sample) -> f64| samples.iter().map(of).sum::<f64>() / samples.len() as f64;
    let (mean_ms, thesis_mean_ms) = (mean(|s| s.total_ms.median), mean(|s| s.thesis.total()));
    Ok(ThesisReport { repeat, samples, mean_ms, thesis_mean_ms })
}

fn sample(thesis: Published, path: &Path, repeat: usize) -> Result<Sample, MeasureError> {
    let case = Case::open(path)?;
    let mut replay = case.replay(&case.recording, Options::default(), None)?;
    let none = || MeasureError::NoCut(path.display().to_string());
    let cut = first_cut(replay.as_mut()).ok_or_else(none)?;
    // Stopped after its last stage, the cut is taken back, so that each run begins where the first did. The first one warms up.
    let runs = (0..=repeat).map(|_| replay.until(cut, STAGES[2])).skip(1);
    let runs = runs.collect::<Result<Vec<EventReport>, String>>().map_err(MeasureError::Rejected)?;
    runs.last().map(|last| row(thesis, last, &runs)).ok_or_else(none)
}

/// The first cut that is applied.
fn first_cut(replay: &mut dyn Replay) -> Option<usize> {
    while let Some(event) = replay.step() {
        if event.cut && event.outcome == Outcome::Applied {
            return Some(event.index);
        }
    }
    None
}

fn row(thesis: Published, last: &EventReport, runs: &[EventReport]) -> Sample {
    let us = |run: &EventReport, id: &str| run.stages.iter().find(|s| s.id == id).map_or(0.0, |s| s.us);
    let ms = STAGES.map(|id| Figure::of(runs.iter().map(|run| us(run, id) / 1e3)));
    let total = |run: &EventReport| STAGES.map(|id| us(run, id)).iter().sum::<f64>() / 1e3;
    let total_ms = Figure::of(runs.iter().map(total));
    let links = count(last, "links");
    Sample {
        thesis,
        faces: count(last, "faces"),
        links,
        length: length(last),
        ms,
        total_ms,
        us_per_link: total_ms.median * 1e3 / links.max(1) as f64,
        ratio: thesis.total() / total_ms.median,
    }
}

fn count(event: &EventReport, name: &str) -> u64 {
    match event.counters.get(name) {
        Some(Counter::Count(n)) => *n,
        _ => 0,
    }
}

/// Arc length of the cutting line that an event shows.
fn length(event: &EventReport) -> f64 {
    let line = event.overlays.iter().find_map(|overlay| match overlay {
        Overlay::Line { name, points } if name == "line" => Some(points),
        _ => None,
    });
    let part = |w: &[[f64; 3]]| glam::DVec3::from(w[0]).distance(glam::DVec3::from(w[1]));
    line.map_or(0.0, |points| points.windows(2).map(part).sum())
}

impl ThesisReport {
    /// The report for people.
    pub fn tables(&self) -> Vec<Table> {
        let columns = [
            "sample",
            "faces",
            "thesis",
            "length",
            "FC ms",
            "thesis",
            "MC ms",
            "thesis",
            "CI ms",
            "thesis",
            "total ms",
            "thesis",
            "ratio",
            "µs a link",
        ];
        let title = format!(
            "Table 6.2 of the thesis, and ours: median ± half the quartile range of {} runs",
            self.repeat
        );
        let mut rows: Vec<Vec<String>> = self.samples.iter().map(Sample::cells).collect();
        let mut mean = vec![String::new(); columns.len()];
        mean[0] = "mean".into();
        mean[10] = format!("{:.4}", self.mean_ms);
        mean[11] = format!("{:.3}", self.thesis_mean_ms);
        mean[12] = format!("{:.0}", self.thesis_mean_ms / self.mean_ms);
        rows.push(mean);
        vec![table(&title, &columns, rows)]
    }
}

impl Sample {
    fn cells(&self) -> Vec<String> {
        let head = [
            self.thesis.name.to_owned(),
            self.faces.to_string(),
            self.thesis.faces.to_string(),
            format!("{:.3}", self.length),
        ];
        let stages = self
            .ms
            .iter()
            .zip(self.thesis.ms)
            .flat_map(|(ours, thesis)| [ours.text(4), format!("{thesis:.3}")]);
        let tail = [
            self.total_ms.text(4),
            format!("{:.3}", self.thesis.total()),
            format!("{:.0}", self.ratio),
            format!("{:.2}", self.us_per_link),
        ];
        head.into_iter().chain(stages).chain(tail).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assets;

    #[test]
    fn the_table_is_the_theses() {
        let mean = TABLE.iter().map(Published::total).sum::<f64>() / TABLE.len() as f64;
        assert!((mean - 4.985).abs() < 1e-3, "{mean}");
        assert!(TABLE.is_sorted_by_key(|row| row.faces));
    }

    #[test]
    fn a_sample_is_its_first_applied_cut_and_nothing_is_left_of_it() {
        let script = r#"{ "version": 1, "scene": "builtin:bust:2000", "events": [
            { "click": [1, 1] }, { "click": [600, 250] }, { "click": [660, 262] },
            { "cut": { "from": { "pixel": [600, 300] }, "to": { "pixel": [601, 300] } } } ] }"#;
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("cut.json");
        assets::write_file(&path, script.as_bytes()).expect("it is written");
        let sample = sample(TABLE[0], &path, 3).expect("it has a cut");
        let [fc, mc, ci] = sample.ms.map(|figure| figure.median);
        assert!(fc > 0.0 && mc > 0.0 && ci > 0.0 && sample.total_ms.median >= ci, "{sample:?}");
        assert!(sample.links >= sample.faces && sample.faces > 1 && sample.length > 1.0, "{sample:?}");
        assert!((sample.ratio - TABLE[0].total() / sample.total_ms.median).abs() < 1e-9);
        let missing = measure(folder.path(), 1, &|_, _, _| {});
        assert!(matches!(missing, Err(MeasureError::Open(_))));
    }
}
