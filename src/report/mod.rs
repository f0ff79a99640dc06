//! What a run has to say, as plain data: any front end shows any engine through it, and knows none by name.

mod delta;
mod run;
mod stop;
mod text;
mod trace;

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use delta::{Buffer, Difference, EventDelta, Scalar, StageDelta};
pub use run::{Finding, RunReport, StateReport, Totals};
pub use stop::Stop;
pub use text::{printable, quoted};
pub use trace::trace;

/// Version of the JSON report.
pub const SCHEMA: u32 = 1;

/// An invariant that was looked at.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Check {
    /// Its name, as in the table of the engine's stages.
    pub name: String,
    /// Whether it holds.
    pub ok: bool,
    /// What was measured, where there is one figure for it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value: Option<f64>,
    /// What is wrong, or what was looked at.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub detail: String,
    /// Ids of the elements at fault, such as `n12` or `f7`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub culprits: Vec<String>,
}

impl Check {
    /// An invariant that holds.
    pub fn pass(name: &str) -> Self {
        Self { name: name.into(), ok: true, value: None, detail: String::new(), culprits: Vec::new() }
    }

    /// An invariant that is broken, with what is wrong.
    pub fn fail(name: &str, detail: impl Into<String>) -> Self {
        Self { ok: false, detail: detail.into(), ..Self::pass(name) }
    }

    /// Holds while a measured value is at most a bound.
    pub fn at_most(name: &str, value: f64, bound: f64) -> Self {
        // A NaN is not at most anything.
        let ok = value <= bound;
        let detail = if ok { String::new() } else { format!("{value:e} is more than {bound:e}") };
        Self { ok, value: Some(value), detail, ..Self::pass(name) }
    }

    /// Adds the elements at fault.
    #[must_use]
    pub fn culprits<T: ToString>(mut self, culprits: impl IntoIterator<Item = T>) -> Self {
        self.culprits.extend(culprits.into_iter().map(|c| c.to_string()));
        self
    }
}

/// What became of an event.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Outcome {
    /// It changed the state as asked.
    Applied,
    /// It could not be done, for a named reason, and left no trace.
    Rejected,
    /// A first click waits for its second.
    Pending,
    /// It took back a pending click.
    Cancelled,
    /// Nothing to decide.
    None,
}

/// Why something was not done: a fixed word, and what it means here.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Rejection {
    /// A word in kebab case, such as `miss` or `silhouette`.
    pub reason: String,
    /// The same for a person, with ids and figures.
    pub detail: String,
}

impl Rejection {
    /// A rejection for a named reason.
    pub fn new(reason: &str, detail: impl Into<String>) -> Self {
        Self { reason: reason.into(), detail: detail.into() }
    }
}

/// A count, or counts by name.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum Counter {
    /// One number.
    Count(u64),
    /// A number for each name.
    ByName(BTreeMap<String, u64>),
}

/// Counters by name.
pub type Counters = BTreeMap<String, Counter>;

/// A table that a front end can show, with rows that can be selected.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Table {
    /// What it shows.
    pub title: String,
    /// Column heads.
    pub columns: Vec<String>,
    /// Rows: the ids that selecting one selects, and a cell for each column.
    pub rows: Vec<Row>,
}

/// A row of a [`Table`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Row {
    /// Ids that selecting the row selects.
    pub ids: Vec<String>,
    /// A cell for each column.
    pub cells: Vec<String>,
}

/// Something to draw over a frame.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Overlay {
    /// Points, in model units.
    Points {
        /** Its name. */
        name: String,
        /** Positions. */
        points: Vec<[f64; 3]>,
    },
    /// A polyline, in model units.
    Line {
        /** Its name. */
        name: String,
        /** Positions, in order. */
        points: Vec<[f64; 3]>,
    },
    /// A set of faces, by index.
    Faces {
        /** Its name. */
        name: String,
        /** Face indices. */
        faces: Vec<u32>,
    },
}

/// A part of rendering a frame.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Pass {
    /// What it is: `upload`, `shadow 0`, …, `skin`, `scatter`, `compose`.
    pub id: String,
    /// Microseconds that it took; the device's where that can be asked.
    pub us: f64,
    /// Why it was not done.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub skipped: Option<String>,
    /// How many tiles of the screen it worked through; 0 of a pass that has none.
    pub tiles: u32,
    /// Of how many.
    pub of: u32,
}

impl Overlay {
    /// Its name.
    pub fn name(&self) -> &str {
        match self {
            Self::Points { name, .. } | Self::Line { name, .. } | Self::Faces { name, .. } => name,
        }
    }

    /// Whether there is nothing to draw.
    pub fn is_empty(&self) -> bool {
        match self {
            Self::Points { points, .. } | Self::Line { points, .. } => points.is_empty(),
            Self::Faces { faces, .. } => faces.is_empty(),
        }
    }

    /// What it is shown together with: the word before the first space of its name.
    pub fn group(&self) -> &str {
        self.name().split(' ').next().unwrap_or_default()
    }
}

/// What a stage did at one event.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct StageReport {
    /// The stage's short name, such as `FC`.
    pub id: String,
    /// Microseconds of the stage's run alone.
    pub us: f64,
    /// Why it did not run.
    pub skipped: Option<String>,
    /// Digest of all that it changed; `None` when it did not run through.
    pub digest: Option<String>,
    /// The same for each buffer.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub buffers: BTreeMap<String, String>,
    /// Its invariants.
    pub checks: Vec<Check>,
}

impl StageReport {
    /// The row of a stage that did not run, for a reason.
    pub fn skipped(id: &str, reason: &str) -> Self {
        Self {
            id: id.into(),
            us: 0.0,
            skipped: Some(reason.into()),
            digest: None,
            buffers: BTreeMap::new(),
            checks: Vec::new(),
        }
    }
}

/// What became of one event.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct EventReport {
    /// Its place in the recording.
    pub index: usize,
    /// What it is, such as `cut`.
    pub kind: String,
    /// The mode in force, such as `carve`.
    pub mode: String,
    /// What became of it.
    pub outcome: Outcome,
    /// The reason of a rejection.
    pub reason: Option<String>,
    /// The same for a person.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub detail: Option<String>,
    /// What was counted.
    pub counters: Counters,
    /// The stages, in the order of the engine's table.
    pub stages: Vec<StageReport>,
    /// Whether it took a cut through the stages.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub cut: bool,
    /// A checkpoint's name.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub checkpoint: Option<String>,
    /// A checkpoint's frame, or why there is none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frame: Option<String>,
    /// What was done for the frame.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub passes: Vec<Pass>,
    /// Digest of the whole state, at a checkpoint, at the end and with `--paranoid`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub state: Option<String>,
    /// The same for each buffer of the state.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub state_buffers: BTreeMap<String, String>,
    /// Counts of the whole state, such as `faces` and `euler`, where it was digested.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub counts: BTreeMap<String, i64>,
    /// What the state was made of before the event and after it, such as `faces`.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub sizes: BTreeMap<String, [u64; 2]>,
    /// Invariants of the whole state, where they were looked at.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub checks: Vec<Check>,
    /// Tables to show.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub tables: Vec<Table>,
    /// Things to draw.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub overlays: Vec<Overlay>,
}

impl EventReport {
    /// A report of which nothing is known but what the event is.
    pub fn new(index: usize, kind: &str) -> Self {
        Self {
            index,
            kind: kind.into(),
            mode: String::new(),
            outcome: Outcome::None,
            reason: None,
            detail: None,
            counters: Counters::new(),
            stages: Vec::new(),
            cut: false,
            checkpoint: None,
            frame: None,
            passes: Vec::new(),
            state: None,
            state_buffers: BTreeMap::new(),
            counts: BTreeMap::new(),
            sizes: BTreeMap::new(),
            checks: Vec::new(),
            tables: Vec::new(),
            overlays: Vec::new(),
        }
    }

    /// The same with every time at zero, and without what was done for its frame, which depends on the frame before: two
    /// runs of one recording are compared so.
    #[must_use]
    pub fn without_times(&self) -> Self {
        let mut report = Self { passes: Vec::new(), ..self.clone() };
        report.stages.iter_mut().for_each(|s| s.us = 0.0);
        report
    }

    /// Whether there is anything of it to draw.
    pub fn has_overlays(&self) -> bool {
        !self.overlays.iter().all(Overlay::is_empty)
    }

    /// Keeps why it was rejected.
    pub fn reject(&mut self, rejection: Rejection) {
        self.outcome = Outcome::Rejected;
        self.reason = Some(rejection.reason);
        self.detail = Some(rejection.detail);
    }

    /// The broken invariants of the event, with the stage at which they broke.
    pub fn findings(&self) -> impl Iterator<Item = (&str, &Check)> {
        let stages = self.stages.iter().flat_map(|s| s.checks.iter().map(move |c| (s.id.as_str(), c)));
        stages.chain(self.checks.iter().map(|c| ("state", c))).filter(|(_, c)| !c.ok)
    }
}
