//! What verifying came to, as plain data.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Divergence;
use super::image::ImageReport;
use super::shard::ShardReport;
use super::skips::{self, Skips};
use crate::canvas::Adapter;
use crate::report::{Finding, SCHEMA};

/// What became of a recording.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// It is what its goldens say, and every invariant held.
    Verified,
    /// An invariant broke, something diverged, or a golden is missing, damaged, orphaned or does not know something.
    Failed,
    /// It could not be replayed.
    Unreadable,
}

/// What there is to say of a recording.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct RecordingReport {
    /// Its name: its path under `recordings`, or its path.
    pub recording: String,
    /// What became of it.
    pub verdict: Verdict,
    /// How many events it has.
    pub events: usize,
    /// How many of them took a cut through the stages.
    pub cuts: usize,
    /// How many were applied.
    pub applied: usize,
    /// How many were rejected.
    pub rejected: usize,
    /// How many invariants were looked at.
    pub checks: usize,
    /// The invariants that broke.
    pub findings: Vec<Finding>,
    /// Where it differs first from its goldens.
    pub divergence: Option<Divergence>,
    /// Wherever it differs from them, in the order of the run; of very many the first.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub divergences: Vec<Divergence>,
    /// How many facts differ from its goldens.
    pub differing: usize,
    /// The checkpoints' pictures.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub images: Vec<ImageReport>,
    /// What was skipped of rendering them, by pass.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub skips: Vec<Skips>,
    /// What its goldens do not know, such as `digest GP.jobs`.
    pub new: Vec<String>,
    /// Which goldens are missing, damaged or orphaned.
    pub goldens: Vec<String>,
    /// Why it could not be replayed, or how the replay broke down.
    pub error: Option<String>,
    /// Digest of the run.
    pub digest: String,
    /// Milliseconds from opening to the last comparison.
    pub ms: f64,
}

impl RecordingReport {
    /// A report of which nothing is known yet.
    pub(super) fn new(recording: String) -> Self {
        Self {
            recording,
            verdict: Verdict::Unreadable,
            events: 0,
            cuts: 0,
            applied: 0,
            rejected: 0,
            checks: 0,
            findings: Vec::new(),
            divergence: None,
            divergences: Vec::new(),
            differing: 0,
            images: Vec::new(),
            skips: Vec::new(),
            new: Vec::new(),
            goldens: Vec::new(),
            error: None,
            digest: String::new(),
            ms: 0.0,
        }
    }

    /// What is wrong, a line each; the first broken invariant stands for all.
    pub fn problems(&self) -> Vec<String> {
        let finding = self.findings.first().map(|f| {
            let at = f.event.map_or("at the end".into(), |event| format!("event {event}"));
            let culprits = f.check.culprits.join(" ");
            format!("{at}: {} broke: {} {culprits}", f.name(), f.check.detail).trim_end().to_string()
        });
        let divergence = self.divergence.as_ref().map(ToString::to_string);
        let new = (!self.new.is_empty()).then(|| format!("new: {}", self.new.join(", ")));
        let images = self.images.iter().flat_map(ImageReport::problems);
        let lines = self.error.iter().cloned().chain(finding).chain(divergence).chain(images).chain(new);
        lines.chain(self.goldens.iter().cloned()).collect()
    }
}

/// What verifying came to.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct VerifyReport {
    /// Version of this layout.
    pub schema: u32,
    /// Who rendered the pictures; none where nobody was asked to.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub adapter: Option<Adapter>,
    /// Which part of the recordings this is, where it is one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shard: Option<ShardReport>,
    /// The recordings, by path.
    pub recordings: Vec<RecordingReport>,
    /// What was skipped of rendering all pictures, by pass.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub skips: Vec<Skips>,
    /// Goldens of recordings that are no more.
    pub orphans: Vec<String>,
    /// What could not be looked at.
    pub errors: Vec<String>,
    /// How many recordings were left out after the first failure.
    pub left_out: usize,
    /// Milliseconds of all.
    pub ms: f64,
}

impl VerifyReport {
    /// A report of some recordings.
    pub(super) fn new(adapter: Option<Adapter>, recordings: Vec<RecordingReport>) -> Self {
        let skips = skips::sum(recordings.iter().flat_map(|recording| &recording.skips));
        Self {
            schema: SCHEMA,
            adapter,
            shard: None,
            recordings,
            skips,
            orphans: Vec::new(),
            errors: Vec::new(),
            left_out: 0,
            ms: 0.0,
        }
    }

    /// The same with every time at zero: two reports of the same recordings are compared so.
    #[must_use]
    pub fn without_times(&self) -> Self {
        let mut report = Self { ms: 0.0, ..self.clone() };
        report.recordings.iter_mut().for_each(|recording| recording.ms = 0.0);
        let of_recordings = report.recordings.iter_mut().flat_map(|recording| &mut recording.skips);
        of_recordings.chain(&mut report.skips).for_each(|skips| skips.us = 0.0);
        report
    }

    /// 0 all verified, 1 something diverged or an invariant broke, 2 bad input or it could not run.
    pub fn exit_code(&self) -> u8 {
        let any = |verdict| self.recordings.iter().any(|r| r.verdict == verdict);
        if any(Verdict::Unreadable) || !self.errors.is_empty() {
            2
        } else if any(Verdict::Failed) || !self.orphans.is_empty() {
            1
        } else {
            0
        }
    }
}
