//! Stored goldens against a run: what differs, in the order of the run, how much differs, and what is new.
//!
//! Within an event, digests come before what they led to, in the order of the stages; what is missing comes last, since an event that
//! ended early has said so in its outcome. Checks are compared between two runs alone, where both looked at them: a golden holds none.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::facts::{self, Fact, Kind, Place};
use super::golden::{Found, Stored};
use super::values::Values;
use crate::report::Buffer;

/// A place at which a run is not what its goldens say.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Divergence {
    /// The event; none for the scene, the end and the sums.
    pub event: Option<usize>,
    /// What differs, as the golden's text calls it, such as `event 4 digest MC.nodes`.
    pub what: String,
    /// The stage, where it was one.
    pub stage: Option<String>,
    /// The buffer, where it was one.
    pub buffer: Option<String>,
    /// The element, such as `n120`, or the block of elements.
    pub element: Option<String>,
    /// What the golden says.
    pub expected: String,
    /// What the run says; floats with their distance in ulps.
    pub found: String,
    /// Why no element can be named, where that is so.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub note: Option<String>,
}

impl fmt::Display for Divergence {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.event, &self.stage, &self.buffer) {
            (Some(event), Some(stage), Some(buffer)) => {
                write!(f, "event {event}, stage {stage}, buffer {buffer}")?
            }
            _ => write!(f, "{}", self.what)?,
        }
        if let Some(element) = &self.element {
            write!(f, ", element {element}")?;
        }
        write!(f, ": expected {}, found {}", self.expected, self.found)?;
        self.note.as_ref().map_or(Ok(()), |note| write!(f, " ({note})"))
    }
}

/// What comparing a run came to.
#[derive(Debug, Default)]
pub(super) struct Comparison {
    /// Where they differ, in the order of the run; of very many the first [`NAMED`].
    pub(super) divergences: Vec<Divergence>,
    /// How many facts differ.
    pub(super) differing: usize,
    /// What the goldens do not know, such as `digest GP.jobs`.
    pub(super) new: Vec<String>,
}

impl Comparison {
    /// Where they differ first.
    pub(super) fn first(&self) -> Option<Divergence> {
        self.divergences.first().cloned()
    }
}

/// A fact that differs: missing from one side, or of another value.
struct Differing<'a> {
    /// Where it stands in the order of the run.
    order: (Place, bool, Kind, usize),
    what: String,
    fact: &'a Fact,
    expected: Option<&'a str>,
    found: Option<&'a str>,
}

const NOTHING: &str = "nothing";
/// As many divergences are named: a recording has hundreds of facts, and a report should not grow with a long one's.
const NAMED: usize = 1000;

/// Compares a run with its goldens.
pub(super) fn compare(found: &Found, stored: &Stored) -> Comparison {
    let (facts, checkpoints) = (found.facts(), found.checkpoints());
    let mut sides = Vec::new();
    if let Some(run) = &stored.run {
        sides.push((None, None, run.as_slice(), facts.as_slice()));
    }
    for (name, (event, facts)) in &checkpoints {
        if let Some(expected) = stored.checkpoints.get(*name) {
            sides.push((Some(*name), Some(*event), expected.as_slice(), facts.as_slice()));
        }
    }
    let looked_at = facts::in_both(&stored.checks, &facts::of_checks(&found.run));
    sides.push((None, None, &looked_at[0], &looked_at[1]));
    let (mut all, mut new) = (Vec::new(), BTreeSet::new());
    for (checkpoint, event, expected, found) in sides {
        new.extend(unknown(expected, found));
        all.extend(differing(expected, found).map(|d| d.at_checkpoint(checkpoint, event)));
    }
    // A run with something new in it has another digest: that alone says nothing.
    all.retain(|d| new.is_empty() || !(d.fact.place == Place::Total && d.fact.name == "digest"));
    all.sort_by_key(|d| d.order);
    let named = all.iter().take(NAMED).map(|d| d.name(found, stored.values.as_ref()));
    Comparison { divergences: named.collect(), differing: all.len(), new: new.into_iter().collect() }
}

type Key<'a> = (Place, Kind, &'a str);

fn key(fact: &Fact) -> Key<'_> {
    (fact.place, fact.kind, &fact.name)
}

/// What a fact is about, wherever it stands: its kind and name.
fn subject(fact: &Fact) -> (Kind, &str) {
    (fact.kind, &fact.name)
}

fn unknown(expected: &[Fact], found: &[Fact]) -> BTreeSet<String> {
    let known: BTreeSet<_> = expected.iter().map(subject).collect();
    let unknown = found.iter().filter(|f| !known.contains(&subject(f)));
    let text = |f: &Fact| match f.kind {
        Kind::Digest => format!("digest {}", f.name),
        Kind::Counter => format!("counter {}", f.name),
        Kind::Count | Kind::Check => f.key(),
        Kind::Outcome => "events".into(),
    };
    unknown.map(text).collect()
}

/// The facts that differ, but for those that are about something new.
fn differing<'a>(expected: &'a [Fact], found: &'a [Fact]) -> impl Iterator<Item = Differing<'a>> {
    let by_key = |facts: &'a [Fact]| -> BTreeMap<Key<'a>, &'a str> {
        facts.iter().map(|f| (key(f), f.value.as_str())).collect()
    };
    let (old, now) = (by_key(expected), by_key(found));
    let known: BTreeSet<_> = expected.iter().map(subject).collect();
    let missing = expected.iter().enumerate().filter(move |(_, f)| !now.contains_key(&key(f)));
    let missing = missing.map(|(at, fact)| Differing::new(at, fact, Some(&fact.value), None));
    let changed = found.iter().enumerate().filter_map(move |(at, fact)| {
        let value = old.get(&key(fact)).copied();
        let differs = value != Some(&fact.value) && known.contains(&subject(fact));
        differs.then(|| Differing::new(at, fact, value, Some(&fact.value)))
    });
    changed.chain(missing)
}

impl<'a> Differing<'a> {
    fn new(at: usize, fact: &'a Fact, expected: Option<&'a str>, found: Option<&'a str>) -> Self {
        let one_sided = expected.is_none() || found.is_none();
        Self { order: (fact.place, one_sided, fact.kind, at), what: fact.key(), fact, expected, found }
    }

    /// Moves it from a checkpoint's own text to the event where the checkpoint stands.
    fn at_checkpoint(mut self, checkpoint: Option<&str>, event: Option<usize>) -> Self {
        if let (Some(name), Some(event)) = (checkpoint, event) {
            self.order.0 = Place::Event(event);
            self.what = format!("checkpoint {name} {}", self.what);
        }
        self
    }

    fn name(&self, found: &Found, values: Option<&Values>) -> Divergence {
        let event = match self.order.0 {
            Place::Event(event) => Some(event),
            _ => None,
        };
        let text = |value: Option<&str>| value.unwrap_or(NOTHING).to_string();
        let mut divergence = Divergence {
            event,
            what: self.what.clone(),
            stage: None,
            buffer: None,
            element: None,
            expected: text(self.expected),
            found: text(self.found),
            note: None,
        };
        match (self.fact.kind, self.fact.place) {
            (Kind::Digest, Place::Event(event)) => self.name_element(event, found, values, &mut divergence),
            (Kind::Digest, _) => divergence.buffer = Some(self.fact.name.clone()),
            (Kind::Check, _) => divergence.stage = self.fact.name.split('.').next().map(Into::into),
            _ => {}
        }
        divergence
    }

    fn name_element(
        &self,
        event: usize,
        found: &Found,
        values: Option<&Values>,
        divergence: &mut Divergence,
    ) {
        let Some((stage, buffer)) = self.fact.name.split_once('.') else { return };
        (divergence.stage, divergence.buffer) = (Some(stage.into()), Some(buffer.into()));
        let values = values.ok_or("the values beside the golden cannot be read");
        let changed = find(found, event, stage, buffer).ok_or(match found.deltas.is_empty() {
            true => "a report has the digests of buffers, and not what is in them",
            false => "the run has no such buffer",
        });
        match values.and_then(|values| values.first_difference(event, stage, changed?)) {
            Ok(first) => {
                divergence.element = Some(first.element);
                (divergence.expected, divergence.found) = (first.expected, first.found);
            }
            Err(why) => divergence.note = Some(why.into()),
        }
    }
}

fn find<'a>(found: &'a Found, event: usize, stage: &str, buffer: &str) -> Option<&'a Buffer> {
    let event = found.deltas.iter().find(|d| d.event == event)?;
    let stage = event.stages.iter().find(|s| s.stage == stage)?;
    stage.buffers.iter().find(|b| b.name == buffer)
}
