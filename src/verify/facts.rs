//! A run as a list of facts, and their text.
//!
//! ```text
//! lancet golden 1
//! reason = the first blessing
//! scene faces = 8998
//! event 4 = cut applied
//! event 4 counter configurations.EE = 20
//! end euler = 2
//! total cuts = 1
//!
//! event 4 digest MC.nodes = 0d5e…
//! end digest nodes = 77a1…
//!
//! facts = 7
//! ```
//!
//! A fact is a place, a name and a value. Digests stand below, so that a change of the text reads from what it means to what it is
//! made of. The number of facts at the end tells a text that was cut off.
//!
//! A checkpoint's text tells of its frame too: size and digest are facts (`frame width = 640`, `frame digest image = 3f…`); who rendered the picture that
//! was blessed (`renderer`, `adapter`, `shaders`) is, like the reason, there to be read, and is not compared.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use crate::canvas::image::Image;
use crate::canvas::{Adapter, Kind as Renderer};
use crate::report::{Check, Counter, EventReport, Outcome, RunReport};

/// Version of the text.
const HEAD: &str = "lancet golden 1";
/// Lines that are there to be read, and are no facts.
const REMARKS: [&str; 4] = ["reason = ", "renderer = ", "adapter = ", "shaders = "];
/// The name of a frame's digest.
const IMAGE: &str = "image";

/// Where in a run, in its order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Place {
    /// Before the first event.
    Scene,
    /// An event.
    Event(usize),
    /// The whole state at a checkpoint.
    State,
    /// A checkpoint's frame.
    Frame,
    /// The whole state after the last event.
    End,
    /// The sums.
    Total,
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Scene => write!(f, "scene"),
            Self::Event(index) => write!(f, "event {index}"),
            Self::State => write!(f, "state"),
            Self::Frame => write!(f, "frame"),
            Self::End => write!(f, "end"),
            Self::Total => write!(f, "total"),
        }
    }
}

/// What kind of fact, in the order in which a place's are compared: what was computed first, then what it came to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Kind {
    /// A buffer's digest: `STAGE.BUFFER` at an event, else `BUFFER`.
    Digest,
    /// What became of an event; it has no name.
    Outcome,
    /// Something that was counted at an event.
    Counter,
    /// A count of the whole state, or a sum.
    Count,
    /// Whether an invariant held, `STAGE.CHECK`; no golden holds any.
    Check,
}

/// One thing that a golden says.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Fact {
    pub(super) place: Place,
    pub(super) kind: Kind,
    pub(super) name: String,
    pub(super) value: String,
}

impl Fact {
    fn new(place: Place, kind: Kind, name: &str, value: impl ToString) -> Self {
        // Blanks separate the words of a key, and lines the facts.
        let name = name.replace(char::is_whitespace, "-");
        Self { place, kind, name, value: one_line(&value.to_string()) }
    }

    /// Its place, kind and name, as they stand in the text.
    pub(super) fn key(&self) -> String {
        let Self { place, kind, name, .. } = self;
        match kind {
            Kind::Digest => format!("{place} digest {name}"),
            Kind::Outcome => place.to_string(),
            Kind::Counter => format!("{place} counter {name}"),
            Kind::Count => format!("{place} {name}"),
            Kind::Check => format!("{place} check {name}"),
        }
    }

    /// Whether it is the digest of a checkpoint's picture.
    pub(super) fn is_image_digest(&self) -> bool {
        (self.place, self.kind, self.name.as_str()) == (Place::Frame, Kind::Digest, IMAGE)
    }

    fn parse(line: &str) -> Option<Self> {
        let (key, value) = line.split_once(" = ")?;
        let words: Vec<&str> = key.split(' ').collect();
        let (place, rest) = match words.as_slice() {
            ["event", index, rest @ ..] => (Place::Event(index.parse().ok()?), rest),
            ["scene", rest @ ..] => (Place::Scene, rest),
            ["state", rest @ ..] => (Place::State, rest),
            ["frame", rest @ ..] => (Place::Frame, rest),
            ["end", rest @ ..] => (Place::End, rest),
            ["total", rest @ ..] => (Place::Total, rest),
            _ => return None,
        };
        let (kind, name) = match (place, rest) {
            (Place::Event(_), []) => (Kind::Outcome, ""),
            (Place::Event(_), ["counter", name]) => (Kind::Counter, *name),
            (_, ["digest", name]) => (Kind::Digest, *name),
            (_, [name]) => (Kind::Count, *name),
            _ => return None,
        };
        Some(Self::new(place, kind, name, value))
    }
}

/// A text on one line.
pub(super) fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The facts of a run, in its order.
pub(super) fn of_run(run: &RunReport) -> Vec<Fact> {
    let mut facts: Vec<Fact> = counts(Place::Scene, &run.scene).collect();
    run.events.iter().for_each(|event| of_event(event, &mut facts));
    if let Some(end) = &run.end {
        facts.extend(counts(Place::End, &end.counts));
        facts.extend(digests(Place::End, &end.buffers));
    }
    let totals = &run.totals;
    let sums = [
        ("cuts", totals.cuts),
        ("applied", totals.applied),
        ("rejected", totals.rejected),
        ("findings", totals.findings),
    ];
    facts.extend(sums.map(|(name, sum)| Fact::new(Place::Total, Kind::Count, name, sum)));
    facts.push(Fact::new(Place::Total, Kind::Count, "digest", &totals.digest));
    facts
}

/// The facts of the whole state at a checkpoint.
pub(super) fn of_checkpoint(event: &EventReport) -> Vec<Fact> {
    counts(Place::State, &event.counts).chain(digests(Place::State, &event.state_buffers)).collect()
}

/// The facts of a checkpoint's frame; with its digest, where the renderer is exact.
pub(super) fn of_frame(image: &Image, exact: bool) -> Vec<Fact> {
    let [width, height] = image.size;
    let sides = [("width", width), ("height", height)];
    let sides = sides.map(|(name, side)| Fact::new(Place::Frame, Kind::Count, name, side));
    let digest = exact.then(|| Fact::new(Place::Frame, Kind::Digest, IMAGE, image.digest()));
    sides.into_iter().chain(digest).collect()
}

/// The invariants that a run looked at, in its order.
pub(super) fn of_checks(run: &RunReport) -> Vec<Fact> {
    let mut facts = Vec::new();
    for event in &run.events {
        let place = Place::Event(event.index);
        event.stages.iter().for_each(|stage| facts.extend(checks(place, &stage.id, &stage.checks)));
        facts.extend(checks(place, "state", &event.checks));
    }
    facts.extend(run.end.iter().flat_map(|end| checks(Place::End, "state", &end.checks)));
    facts
}

fn checks(place: Place, stage: &str, checks: &[Check]) -> impl Iterator<Item = Fact> {
    let word = |check: &Check| if check.ok { "holds" } else { "broken" };
    checks.iter().map(move |c| Fact::new(place, Kind::Check, &format!("{stage}.{}", c.name), word(c)))
}

/// Of two lists of facts those that stand in both, whatever they say.
pub(super) fn in_both(a: &[Fact], b: &[Fact]) -> [Vec<Fact>; 2] {
    let shared = |of: &[Fact], with: &[Fact]| {
        let there: BTreeSet<String> = with.iter().map(Fact::key).collect();
        of.iter().filter(|fact| there.contains(&fact.key())).cloned().collect()
    };
    [shared(a, b), shared(b, a)]
}

fn of_event(event: &EventReport, facts: &mut Vec<Fact>) {
    let place = Place::Event(event.index);
    facts.push(Fact::new(place, Kind::Outcome, "", outcome(event)));
    for (name, counter) in &event.counters {
        match counter {
            Counter::Count(n) => facts.push(Fact::new(place, Kind::Counter, name, n)),
            Counter::ByName(by_name) => facts.extend(
                by_name.iter().map(|(sub, n)| Fact::new(place, Kind::Counter, &format!("{name}.{sub}"), n)),
            ),
        }
    }
    for stage in &event.stages {
        let of_stage = |(buffer, digest): (&String, &String)| {
            Fact::new(place, Kind::Digest, &format!("{}.{buffer}", stage.id), digest)
        };
        facts.extend(stage.buffers.iter().map(of_stage));
    }
}

fn outcome(event: &EventReport) -> String {
    let word = match event.outcome {
        Outcome::Applied => "applied",
        Outcome::Rejected => "rejected",
        Outcome::Pending => "pending",
        Outcome::Cancelled => "cancelled",
        Outcome::None => "none",
    };
    [&event.kind, word, event.reason.as_deref().unwrap_or("")].join(" ")
}

type ByName<T> = BTreeMap<String, T>;

fn counts(place: Place, counts: &ByName<i64>) -> impl Iterator<Item = Fact> {
    counts.iter().map(move |(name, n)| Fact::new(place, Kind::Count, name, n))
}

fn digests(place: Place, digests: &ByName<String>) -> impl Iterator<Item = Fact> {
    digests.iter().map(move |(name, digest)| Fact::new(place, Kind::Digest, name, digest))
}

/// What a text says besides facts: why it was blessed, and who rendered the picture, where there is one.
pub(super) fn remarks(reason: &str, adapter: Option<&Adapter>) -> String {
    let mut lines = format!("reason = {}\n", one_line(reason));
    if let Some(adapter) = adapter {
        let renderer = if adapter.kind == Renderer::Reference { "reference" } else { "gpu" };
        let shaders = if adapter.shaders.is_empty() { "none" } else { &adapter.shaders };
        let name = one_line(&adapter.to_string());
        lines += &format!("renderer = {renderer}\nadapter = {name}\nshaders = {shaders}\n");
    }
    lines
}

/// The text of some facts, below some remarks.
pub(super) fn write(remarks: &str, facts: &[Fact]) -> String {
    let lines = |digests: bool| -> String {
        let of_kind = facts.iter().filter(|f| (f.kind == Kind::Digest) == digests);
        of_kind.map(|f| format!("{} = {}\n", f.key(), f.value)).collect()
    };
    format!("{HEAD}\n{remarks}{}\n{}\nfacts = {}\n", lines(false), lines(true), facts.len())
}

/// The facts of a text. An error says what is wrong with it, and where.
pub(super) fn parse(text: &[u8]) -> Result<Vec<Fact>, String> {
    let text = std::str::from_utf8(text).map_err(|e| format!("byte {}: not UTF-8", e.valid_up_to()))?;
    let mut lines = text.lines().enumerate().filter(|(_, line)| !line.is_empty());
    if lines.next().is_none_or(|(_, line)| line != HEAD) {
        return Err(format!("line 1: it does not begin with `{HEAD}`"));
    }
    let (mut facts, mut said) = (Vec::new(), BTreeSet::new());
    for (at, line) in lines.filter(|(_, line)| !REMARKS.iter().any(|remark| line.starts_with(remark))) {
        if let Some(count) = line.strip_prefix("facts = ") {
            if count != facts.len().to_string() {
                return Err(format!("line {}: it holds {} facts, not {count}", at + 1, facts.len()));
            }
            let beyond = text.lines().enumerate().skip(at + 1).find(|(_, line)| !line.is_empty());
            return beyond
                .map_or(Ok(facts), |(at, line)| Err(format!("line {}: `{line}` is beyond its end", at + 1)));
        }
        let fact = Fact::parse(line).ok_or_else(|| format!("line {}: `{line}` is no fact", at + 1))?;
        if !said.insert(fact.key()) {
            return Err(format!("line {}: `{}` is said twice", at + 1, fact.key()));
        }
        facts.push(fact);
    }
    Err("its end is missing".into())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::{Rejection, StageReport, StateReport};

    fn sample() -> RunReport {
        let mut cut = EventReport::new(0, "cut");
        (cut.outcome, cut.cut) = (Outcome::Applied, true);
        cut.counters = [
            ("configurations".into(), Counter::ByName([("EE".into(), 20)].into())),
            ("snapped".into(), Counter::Count(1)),
        ]
        .into();
        let buffers = [("nodes".into(), "0d5e".into())].into();
        cut.stages.push(StageReport { buffers, ..StageReport::skipped("MC", "") });
        let mut miss = EventReport::new(1, "click");
        miss.reject(Rejection::new("miss", "beside the mesh"));
        let end = StateReport {
            buffers: [("nodes".into(), "77a1".into())].into(),
            counts: [("euler".into(), 2)].into(),
            ..StateReport::default()
        };
        RunReport::new("a", "wound", [("faces".into(), 12)].into(), vec![cut, miss], Some(end))
    }

    #[test]
    fn a_golden_reads_from_what_it_means_to_what_it_is_made_of() {
        let text = write(&remarks("a first\n\tblessing", None), &of_run(&sample()));
        let expected = "lancet golden 1\n\
            reason = a first blessing\n\
            scene faces = 12\n\
            event 0 = cut applied\n\
            event 0 counter configurations.EE = 20\n\
            event 0 counter snapped = 1\n\
            event 1 = click rejected miss\n\
            end euler = 2\n\
            total cuts = 1\n\
            total applied = 1\n\
            total rejected = 1\n\
            total findings = 0\n\
            total digest = \n\
            \n\
            event 0 digest MC.nodes = 0d5e\n\
            end digest nodes = 77a1\n\
            \n\
            facts = 13\n";
        assert_eq!(text, expected);
    }

    #[test]
    fn a_text_holds_all_facts() {
        let mut facts = of_run(&sample());
        let mut parsed = parse(write(&remarks("why", None), &facts).as_bytes()).expect("a golden");
        let key = |f: &Fact| (f.place, f.kind, f.name.clone());
        facts.sort_by_key(key);
        parsed.sort_by_key(key);
        assert_eq!(parsed, facts);
    }

    #[test]
    fn a_damaged_text_is_named() {
        let text = write(&remarks("why", None), &of_run(&sample()));
        for end in 0..text.len() - 1 {
            assert!(parse(&text.as_bytes()[..end]).is_err(), "cut off at byte {end}");
        }
        let without_a_line = text.replace("event 0 counter snapped = 1\n", "");
        assert_eq!(parse(without_a_line.as_bytes()), Err("line 17: it holds 12 facts, not 13".into()));
        let garbled = text.replace("end euler = 2", "end euler is 2");
        assert_eq!(parse(garbled.as_bytes()), Err("line 8: `end euler is 2` is no fact".into()));
        let beyond = format!("{text}\n<<<<<<< HEAD\n");
        assert_eq!(parse(beyond.as_bytes()), Err("line 20: `<<<<<<< HEAD` is beyond its end".into()));
        let twice = text
            .replace("end euler = 2\n", "end euler = 2\nend euler = 4\n")
            .replace("facts = 13", "facts = 14");
        assert_eq!(parse(twice.as_bytes()), Err("line 9: `end euler` is said twice".into()));
        assert!(parse(&[b'l', 0xff]).is_err_and(|e| e.starts_with("byte 1")));
        assert!(parse(b"lancet golden 2\nfacts = 0\n").is_err_and(|e| e.starts_with("line 1")));
    }
}
