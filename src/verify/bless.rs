//! Writing goldens: the only place that does.
//!
//! Refused without a reason, and for a run with a broken invariant: a golden says what is right. What is as it was is not written
//! again, so that its reason stays. Pictures are blessed from the CPU reference alone, since it gives the same ones everywhere.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::compare::compare;
use super::golden::{Found, Stored};
use super::one::{Failure, Open, open_file, run, unwatched};
use super::suite::{find, in_parallel};
use super::{Divergence, Progress, facts, home};
use crate::assets;
use crate::canvas::{Kind, Studio};
use crate::replay::Options;

/// How goldens are blessed.
#[derive(Clone, Default)]
pub struct BlessOptions {
    /// Why the runs are right as they are; written into the goldens.
    pub reason: String,
    /// Says what would change, and writes nothing.
    pub dry_run: bool,
    /// Only recordings with this in their name.
    pub filter: Option<String>,
    /// How many at a time; 0 is 1.
    pub jobs: usize,
    /// Who renders the checkpoints' pictures. Only runs whose goldens have none can do without.
    pub studio: Option<Arc<dyn Studio>>,
}

/// What became of a recording's goldens.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Change {
    /// There were none.
    New,
    /// They said something else, or could not be read.
    Changed,
    /// They are as they were.
    Same,
    /// A run with a broken invariant, or one that cannot be replayed or written, is not blessed.
    Refused,
}

/// What there is to say of a recording's goldens.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Blessed {
    /// Its name.
    pub recording: String,
    /// What became of them.
    pub change: Change,
    /// How many facts changed.
    pub differing: usize,
    /// The first of them.
    pub divergence: Option<Divergence>,
    /// What they did not know before.
    pub new: Vec<String>,
    /// What was missing, damaged or orphaned.
    pub goldens: Vec<String>,
    /// Why it was refused.
    pub error: Option<String>,
}

/// What blessing came to.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct BlessReport {
    /// The recordings, by path.
    pub recordings: Vec<Blessed>,
    /// Goldens of recordings that are no more. They are left where they are.
    pub orphans: Vec<String>,
    /// What could not be looked at.
    pub errors: Vec<String>,
}

impl BlessReport {
    /// 0 all blessed, 2 something was refused or could not run.
    pub fn exit_code(&self) -> u8 {
        let refused = self.recordings.iter().any(|r| r.change == Change::Refused);
        if refused || !self.errors.is_empty() { 2 } else { 0 }
    }
}

/// Replays recordings, and folders of them, and writes what they are now as their goldens.
pub fn bless(paths: &[PathBuf], options: &BlessOptions, progress: &dyn Progress) -> BlessReport {
    bless_with(paths, options, progress, &open_file)
}

pub(super) fn bless_with(
    paths: &[PathBuf],
    options: &BlessOptions,
    progress: &dyn Progress,
    open: &Open<'_>,
) -> BlessReport {
    if let Some(error) = objection(options) {
        return BlessReport { recordings: Vec::new(), orphans: Vec::new(), errors: vec![error] };
    }
    let found = find(paths, options.filter.as_deref());
    let recordings =
        in_parallel(&found.recordings, options.jobs, progress, &|_, path| bless_one(path, options, open));
    BlessReport { recordings, orphans: found.orphans, errors: found.errors }
}

/// Why nothing at all can be blessed.
fn objection(options: &BlessOptions) -> Option<String> {
    let adapter = options.studio.as_ref().map(|studio| studio.adapter());
    if facts::one_line(&options.reason).is_empty() {
        return Some("a golden needs a reason for blessing it".into());
    }
    let other = adapter.filter(|adapter| adapter.kind != Kind::Reference)?;
    Some(format!("pictures are blessed from the CPU reference alone, and not from {other}"))
}

fn bless_one(path: &Path, options: &BlessOptions, open: &Open<'_>) -> Blessed {
    let found = match run(path, &Options::default(), options.studio.as_deref(), open, &unwatched) {
        Ok(found) => found,
        Err(Failure::BadInput(why) | Failure::Panic(why)) => return refused(path, why),
    };
    if let Some(finding) = found.run.findings().next() {
        return refused(path, format!("{} broke: {}", finding.name(), finding.check.detail));
    }
    let stored = Stored::read(&home::goldens(path), &found);
    if let (None, Some(drawn)) = (&found.adapter, stored.drawn.first()) {
        return refused(path, format!("checkpoint {drawn} has a picture, and nobody was asked to render"));
    }
    let blessed = compared(path, &found, stored);
    if blessed.change == Change::Same || options.dry_run {
        return blessed;
    }
    match write(path, &found, &options.reason) {
        Ok(()) => blessed,
        Err(why) => refused(path, why),
    }
}

fn refused(path: &Path, why: String) -> Blessed {
    Blessed {
        recording: home::name(path),
        change: Change::Refused,
        differing: 0,
        divergence: None,
        new: Vec::new(),
        goldens: Vec::new(),
        error: Some(why),
    }
}

fn compared(path: &Path, found: &Found, stored: Stored) -> Blessed {
    let comparison = compare(found, &stored);
    let same = comparison.differing == 0 && comparison.new.is_empty() && stored.problems.is_empty();
    let change = match (same, stored.is_empty()) {
        (true, _) => Change::Same,
        (false, true) => Change::New,
        (false, false) => Change::Changed,
    };
    Blessed {
        recording: home::name(path),
        change,
        differing: comparison.differing,
        divergence: comparison.first(),
        new: comparison.new,
        goldens: [stored.problems, stored.orphans].concat(),
        error: None,
    }
}

fn write(path: &Path, found: &Found, reason: &str) -> Result<(), String> {
    let folder = home::goldens(path);
    let files = found.files(reason)?.into_iter();
    files
        .map(|(name, bytes)| assets::write_file(&folder.join(name), &bytes))
        .try_for_each(|written| written.map_err(|e| e.to_string()))
}
