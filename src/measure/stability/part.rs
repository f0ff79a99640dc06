//! One part: some cuts on a fresh scene, one after another, until they are through or something breaks.

use std::any::Any;
use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};

use super::cuts::{self, Kind, Past};
use super::scenes::Prepared;
use crate::engine::Engine;
use crate::engine::wound::carve::Opened;
use crate::engine::wound::{CameraChange, Cut, State, Work, Wound, WoundEvent};
use crate::measure::Random;
use crate::measure::drive::{self, Ran};
use crate::mesh::NodeId;
use crate::report::{Buffer, Check, Outcome};

/// How often it is looked at bit for bit whether a rejected cut left a trace: once in so many cuts.
const TRACE_EVERY: usize = 16;

/// How cuts ended.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Tally {
    /// All of them.
    pub(super) cuts: usize,
    /// Both of whose picks met the surface.
    pub(super) two_hits: usize,
    /// That were applied.
    pub(super) applied: usize,
    /// That were rejected, by reason.
    pub(super) rejected: BTreeMap<String, usize>,
    /// Applied after an end was moved to a node.
    pub(super) snapped: usize,
    /// Applied with a narrower opening than planned.
    pub(super) narrowed: usize,
    /// Applied with a shallower gutter than planned.
    pub(super) shallowed: usize,
}

impl Tally {
    /// Adds another's counts.
    pub(super) fn add(&mut self, other: &Self) {
        self.cuts += other.cuts;
        self.two_hits += other.two_hits;
        self.applied += other.applied;
        self.snapped += other.snapped;
        self.narrowed += other.narrowed;
        self.shallowed += other.shallowed;
        for (reason, count) in &other.rejected {
            *self.rejected.entry(reason.clone()).or_default() += count;
        }
    }

    fn count(&mut self, ran: &Ran) {
        self.cuts += 1;
        if let Some(rejection) = &ran.rejection {
            *self.rejected.entry(rejection.reason.clone()).or_default() += 1;
        }
        let Some(Work::Cut(cut)) = &ran.work else { return };
        self.two_hits += usize::from(cut.picked.is_some());
        if ran.outcome == Outcome::Applied {
            self.applied += 1;
            self.snapped += usize::from(cut.plane.as_ref().is_some_and(|plane| plane.snapped() > 0));
            self.narrowed += usize::from(cut.carved.narrowed > 0);
            self.shallowed += usize::from(cut.carved.shallowed > 0);
        }
    }
}

/// What broke, and what led there.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Broken {
    /// The cut within the part.
    pub(super) cut: usize,
    /// The stage, or `state`, or `panic`.
    pub(super) stage: String,
    /// The invariant.
    pub(super) check: Check,
    /// Every event from the fresh scene to this one.
    pub(super) events: Vec<WoundEvent>,
}

/// What a part came to.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Part {
    /// Which part of the run.
    pub(super) number: usize,
    /// By kind of cut.
    pub(super) tallies: BTreeMap<Kind, Tally>,
    /// The first cut that broke something ends the part.
    pub(super) broken: Vec<Broken>,
}

struct Runner<'a> {
    state: State,
    past: Past,
    random: Random,
    events: Vec<WoundEvent>,
    part: &'a mut Part,
    fitting: f64,
}

/// Runs a part of a run.
pub(super) fn run(seed: u64, number: usize, scene: &Prepared, cuts: usize) -> Part {
    let mut part = Part { number, tallies: BTreeMap::new(), broken: Vec::new() };
    let state = scene.state.clone();
    let fitting = state.control.camera.distance;
    let random = Random::of(seed, number as u64, "stability");
    let mut runner =
        Runner { state, past: Past::default(), random, events: Vec::new(), part: &mut part, fitting };
    for cut in 0..cuts {
        // What a panic leaves half done is not looked at again.
        let ended = catch_unwind(AssertUnwindSafe(|| runner.cut(cut)));
        if let Err(payload) = ended {
            runner.keep(cut, "panic", [Check::fail("no-panic", message(payload.as_ref()))]);
        }
        if !runner.part.broken.is_empty() {
            return part;
        }
    }
    let whole = catch_unwind(AssertUnwindSafe(|| Wound::check(&runner.state)));
    let whole = whole.unwrap_or_else(|payload| vec![Check::fail("no-panic", message(payload.as_ref()))]);
    runner.keep(cuts.saturating_sub(1), "state", whole);
    part
}

/// What a panic says.
pub(super) fn message(payload: &(dyn Any + Send)) -> String {
    let text = payload.downcast_ref::<&str>().map(|text| (*text).to_owned());
    text.or_else(|| payload.downcast_ref::<String>().cloned())
        .unwrap_or_else(|| "a panic without words".into())
}

impl Runner<'_> {
    /// Draws a cut, and runs it.
    fn cut(&mut self, cut: usize) {
        let kind = Kind::draw(&self.past, &mut self.random);
        let events = cuts::draw(kind, &self.state, &self.past, self.fitting, &mut self.random);
        self.events.extend(events.clone());
        let [camera, mode, event] = events;
        drive::run(&mut self.state, &camera, true);
        drive::run(&mut self.state, &mode, true);
        let counts = Wound::counts(&self.state);
        let whole = self.random.once_in(TRACE_EVERY).then(|| digest(&self.state));
        let ran = drive::run(&mut self.state, &event, true);
        self.part.tallies.entry(kind).or_default().count(&ran);
        if ran.outcome != Outcome::Applied {
            let same = counts == Wound::counts(&self.state) && whole.is_none_or(|d| d == digest(&self.state));
            let check = Check { ok: same, ..Check::fail("no-trace", "the rejected cut left a trace") };
            self.keep(cut, "rollback", [check]);
        }
        for (stage, check) in ran.broken.iter().cloned() {
            self.keep(cut, stage, [check]);
        }
        if let (Some(_), Some(Work::Cut(done)), WoundEvent::Camera(change)) = (&ran.patch, &ran.work, camera)
        {
            self.remember(change, done);
        }
    }

    /// Keeps the checks that failed.
    fn keep(&mut self, cut: usize, stage: &str, checks: impl IntoIterator<Item = Check>) {
        let failed = checks.into_iter().filter(|check| !check.ok);
        let broken = |check| Broken { cut, stage: stage.into(), check, events: self.events.clone() };
        self.part.broken.extend(failed.map(broken));
    }

    fn remember(&mut self, change: CameraChange, cut: &Cut) {
        let opened = |of: fn(&Opened) -> NodeId| cut.carved.opened.iter().map(of).collect::<Vec<_>>();
        self.past.lines.push(cut.line.nodes.clone());
        if !cut.carved.opened.is_empty() {
            self.past.lines.extend([opened(|o| o.right), opened(|o| o.bottom)]);
        }
        self.past.gutter.extend(&cut.carved.gutter);
        self.past.picks.push((change, cut.picks));
    }
}

/// Every buffer of the state.
fn digest(state: &State) -> Vec<blake3::Hash> {
    Wound::buffers(state).iter().map(Buffer::digest).collect()
}
