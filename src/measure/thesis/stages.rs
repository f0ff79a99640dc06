//! The thesis's eighteen cuts, stage by stage, beside its own figures (Lam 2016, §6.5.1, Table 6.2).
//!
//! Each sample is a recording, `thesis-SIZE-PLACE.lancet`, whose first applied cut is run again and again from the same state, as the thesis
//! averages over 100 runs; ours are medians. The times are of the stages alone, everything kept up to date in them: the hierarchy for
//! picks, the journal. The hierarchy is there when the clock starts, as it is for every cut but a session's first.
//!
//! GP's and PP's times include the renderer's work, until it is done.
//!
//! The thesis's machine was another (2015), so a ratio says how far apart the figures are, not how far apart the algorithms.

use std::path::Path;

use schemars::JsonSchema;
use serde::Serialize;

use super::published::{CUTS, Published, STAGES};
use crate::canvas::Studio;
use crate::measure::figure::table;
use crate::measure::{Figure, MeasureError, Progress};
use crate::replay::{Case, Options, Replay};
use crate::report::{Counter, EventReport, Outcome, Overlay, Table};

/// The places in [`STAGES`] of those that work on the mesh.
const MESH_STAGES: [usize; 3] = [0, 3, 4];

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
    /// Texels of the patch along the line.
    pub patch_width: u64,
    /// Milliseconds of the five stages.
    pub ms: [Figure; 5],
    /// Milliseconds of FC, MC and CI together.
    pub mesh_ms: Figure,
    /// Milliseconds of all five together.
    pub total_ms: Figure,
    /// Microseconds of FC, MC and CI together for each link.
    pub us_per_link: f64,
    /// The thesis's total over ours.
    pub ratio: f64,
}

/// All samples.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Samples {
    /// How often each cut was run.
    pub repeat: usize,
    /// The samples, in the thesis's order.
    pub samples: Vec<Sample>,
    /// Mean of FC, MC and CI together, milliseconds: ours and the thesis's.
    pub mean_mesh_ms: [f64; 2],
    /// The same of all five.
    pub mean_ms: [f64; 2],
}

/// Runs the samples in a folder of recordings, each cut so many times.
pub fn measure(
    folder: &Path,
    repeat: usize,
    studio: &dyn Studio,
    progress: Progress<'_>,
) -> Result<Samples, MeasureError> {
    let sample = |(done, thesis): (usize, &Published)| {
        progress(done, CUTS.len(), thesis.name);
        sample(*thesis, &folder.join(thesis.file()), repeat, studio)
    };
    let samples = CUTS.iter().enumerate().map(sample).collect::<Result<Vec<Sample>, _>>()?;
    let mean = |of: fn(&Sample) -> f64| samples.iter().map(of).sum::<f64>() / samples.len() as f64;
    Ok(Samples {
        repeat,
        mean_mesh_ms: [mean(|s| s.mesh_ms.median), mean(|s| s.thesis.mesh())],
        mean_ms: [mean(|s| s.total_ms.median), mean(|s| s.thesis.total())],
        samples,
    })
}

fn sample(
    thesis: Published,
    path: &Path,
    repeat: usize,
    studio: &dyn Studio,
) -> Result<Sample, MeasureError> {
    let case = Case::open(path)?;
    let options = Options { pictures: true, ..Options::default() };
    let mut replay = case.replay(&case.recording, options, Some(studio))?;
    let none = || MeasureError::NoCut(path.display().to_string());
    let cut = first_cut(replay.as_mut()).ok_or_else(none)?;
    // Stopped after its last stage, the cut is taken back, so that each run begins where the first did. The first one warms up.
    let runs = (0..=repeat).map(|_| replay.hold(cut, STAGES[4])).skip(1);
    let runs = runs.collect::<Result<Vec<EventReport>, String>>().map_err(MeasureError::Rejected)?;
    if let Some(error) = replay.failure() {
        return Err(MeasureError::Render(error.clone()));
    }
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
    let mesh = |run: &EventReport| MESH_STAGES.map(|i| us(run, STAGES[i])).iter().sum::<f64>() / 1e3;
    let (total_ms, mesh_ms) = (Figure::of(runs.iter().map(total)), Figure::of(runs.iter().map(mesh)));
    let links = count(last, "links");
    Sample {
        thesis,
        faces: count(last, "faces"),
        links,
        length: length(last),
        patch_width: count(last, "patch_width"),
        ms,
        mesh_ms,
        total_ms,
        us_per_link: mesh_ms.median * 1e3 / links.max(1) as f64,
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

impl Samples {
    /// The samples for people.
    pub fn table(&self) -> Table {
        let head = ["sample", "faces", "thesis", "length", "texels"].map(str::to_owned);
        let stages = STAGES.iter().flat_map(|id| [format!("{id} ms"), "thesis".into()]);
        let tail = ["total ms", "thesis", "ratio", "µs a link"].map(str::to_owned);
        let columns: Vec<String> = head.into_iter().chain(stages).chain(tail).collect();
        let columns: Vec<&str> = columns.iter().map(String::as_str).collect();
        let mut rows: Vec<Vec<String>> = self.samples.iter().map(Sample::cells).collect();
        rows.push(mean("mean of all five", self.mean_ms, columns.len()));
        rows.push(mean("mean of FC, MC, CI", self.mean_mesh_ms, columns.len()));
        let title = format!(
            "Table 6.2 of the thesis, and ours: median ± half the quartile range of {} runs; the ratio is of all five",
            self.repeat
        );
        table(&title, &columns, rows)
    }
}

/// A row with a mean below the totals.
fn mean(name: &str, [ours, thesis]: [f64; 2], columns: usize) -> Vec<String> {
    let mut row = vec![String::new(); columns];
    row[0] = name.into();
    row[columns - 4] = format!("{ours:.4}");
    row[columns - 3] = format!("{thesis:.3}");
    row[columns - 2] = format!("{:.0}", thesis / ours);
    row
}

impl Sample {
    fn cells(&self) -> Vec<String> {
        let head = [
            self.thesis.name.to_owned(),
            self.faces.to_string(),
            self.thesis.faces.to_string(),
            format!("{:.3}", self.length),
            self.patch_width.to_string(),
        ];
        let ours = self.ms.iter().zip(self.thesis.ms);
        let stages = ours.flat_map(|(ours, thesis)| [ours.text(4), format!("{thesis:.3}")]);
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
    use crate::render::reference::Reference;

    #[test]
    fn a_sample_is_its_first_applied_cut_and_nothing_is_left_of_it() {
        let script = r#"{ "version": 1, "scene": "builtin:bust:2000", "events": [
            { "click": [1, 1] }, { "click": [600, 250] }, { "click": [660, 262] },
            { "cut": { "from": { "pixel": [600, 300] }, "to": { "pixel": [601, 300] } } } ] }"#;
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("cut.json");
        assets::write_file(&path, script.as_bytes()).expect("it is written");
        let studio = Reference::new();
        let sample = sample(CUTS[0], &path, 3, &studio).expect("it has a cut");
        assert!(sample.ms.iter().all(|figure| figure.median > 0.0), "{sample:?}");
        assert!(sample.total_ms.median >= sample.mesh_ms.median, "{sample:?}");
        assert!(sample.patch_width >= 8, "{sample:?}");
        assert!(sample.links >= sample.faces && sample.faces > 1 && sample.length > 1.0, "{sample:?}");
        assert!((sample.ratio - CUTS[0].total() / sample.total_ms.median).abs() < 1e-9);
        let missing = measure(folder.path(), 1, &studio, &|_, _, _| {});
        assert!(matches!(missing, Err(MeasureError::Open(_))));
    }
}
