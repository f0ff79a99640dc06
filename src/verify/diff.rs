//! Two runs, compared as a run is with its goldens.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Divergence;
use super::compare::compare;
use super::golden::{Found, Stored};
use super::values::Values;
use crate::report::{EventDelta, RunReport};

/// A run, and what its stages changed as far as that is known.
#[derive(Clone, Debug)]
pub struct Side {
    /// Its report.
    pub run: RunReport,
    /// What the stages changed; without it no element can be named.
    pub deltas: Vec<EventDelta>,
}

/// How two runs differ.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Diff {
    /// The first place at which they differ.
    pub divergence: Option<Divergence>,
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
    let [expected, found] = [expected, found].map(|side| Found::new(side.run, side.deltas));
    let values = Values::file(&expected.deltas, &expected.run.totals.digest);
    let checkpoints = expected.checkpoints().into_iter().map(|(name, (_, facts))| (name.to_owned(), facts));
    let stored = Stored {
        run: Some(expected.facts()),
        values: Values::read(&values, &expected.run.totals.digest).ok(),
        checkpoints: checkpoints.collect(),
        ..Stored::default()
    };
    let comparison = compare(&found, &stored);
    Diff { divergence: comparison.divergence, differing: comparison.differing, new: comparison.new }
}
