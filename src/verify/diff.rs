//! Two runs, compared as a run is with its goldens.
//!
//! A side is a recording or a script, which is replayed, or the report of a replay (`lancet replay --json`), which is not: of a stored report
//! everything can be told but the elements at which buffers differ.

use std::path::Path;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::Divergence;
use super::compare::compare;
use super::facts;
use super::golden::{Found, Stored};
use super::one::{Watch, run_opened};
use super::values::Values;
use crate::assets;
use crate::recording::{AnyRecording, first_difference};
use crate::replay::{Case, Options};
use crate::report::{EventDelta, RunReport, SCHEMA};

/// A run, and what its stages changed as far as that is known.
#[derive(Clone, Debug)]
pub struct Side {
    /// What was replayed, where that is known.
    pub recording: Option<AnyRecording>,
    /// Its report.
    pub run: RunReport,
    /// What the stages changed; without it no element can be named.
    pub deltas: Vec<EventDelta>,
}

impl Side {
    /// Reads the report of a replay, or replays a recording or a script. An error says what is wrong with the file.
    pub fn open(path: &Path, watch: Watch<'_>) -> Result<Self, String> {
        let bytes = assets::read_file(path).map_err(|error| error.to_string())?;
        match report(&bytes).map_err(|why| format!("{}: {why}", path.display()))? {
            Some(run) => Ok(Self { recording: None, run, deltas: Vec::new() }),
            None => Self::replay(path, watch),
        }
    }

    fn replay(path: &Path, watch: Watch<'_>) -> Result<Self, String> {
        let case = Case::open(path).map_err(|error| error.to_string())?;
        let found = run_opened(&path.display().to_string(), &Options::default(), None, watch, |options| {
            case.replay(&case.recording, options, None).map_err(|error| error.to_string())
        });
        let Found { run, deltas, .. } = found.map_err(|failure| failure.why())?;
        Ok(Self { recording: Some(case.recording), run, deltas })
    }
}

/// The report of a replay, which is JSON with the version of its layout.
fn report(bytes: &[u8]) -> Result<Option<RunReport>, String> {
    let value = serde_json::from_slice::<Value>(bytes).ok();
    match value.as_ref().and_then(|value| value.get("schema")) {
        None => Ok(None),
        Some(version) if version == SCHEMA => {
            serde_json::from_slice(bytes).map(Some).map_err(|error| error.to_string())
        }
        Some(other) => Err(format!("a report of schema {other}, not {SCHEMA}")),
    }
}

/// How two runs differ.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Diff {
    /// What the recordings say differently first, where both are known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inputs: Option<String>,
    /// The first place at which they differ.
    pub divergence: Option<Divergence>,
    /// Wherever they differ, in the order of the run; of very many the first.
    #[serde(default)]
    pub divergences: Vec<Divergence>,
    /// How many facts differ.
    pub differing: usize,
    /// What only the second knows, such as `digest GP.jobs`.
    pub new: Vec<String>,
}

impl Diff {
    /// Whether the runs are the same.
    pub fn is_empty(&self) -> bool {
        self.divergence.is_none() && self.new.is_empty()
    }
}

/// Compares two runs; the first is what the second is expected to be.
pub fn diff(expected: Side, found: Side) -> Diff {
    let recordings = expected.recording.zip(found.recording);
    let inputs = recordings.and_then(|(a, b)| first_difference(&a, &b));
    let expected = Found::new(expected.run, expected.deltas);
    let comparison = compare(&Found::new(found.run, found.deltas), &as_stored(&expected));
    Diff {
        inputs: inputs.map(|difference| difference.to_string()),
        divergence: comparison.first(),
        divergences: comparison.divergences,
        differing: comparison.differing,
        new: comparison.new,
    }
}

/// A run in the place of goldens.
fn as_stored(expected: &Found) -> Stored {
    let digest = &expected.run.totals.digest;
    let checkpoints = expected.checkpoints().into_iter().map(|(name, (_, facts))| (name.to_owned(), facts));
    Stored {
        run: Some(expected.facts()),
        values: Values::read(&Values::file(&expected.deltas, digest), digest).ok(),
        checkpoints: checkpoints.collect(),
        checks: facts::of_checks(&expected.run),
        ..Stored::default()
    }
}
