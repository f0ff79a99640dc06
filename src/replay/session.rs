//! One engine's recording on its way: where it stands, what it reported, and how it goes forth and back.

mod replay;
mod run;

use std::collections::BTreeMap;
use std::sync::Arc;

use super::pixels::Pixels;
use super::stages::Planting;
use super::timeline::{Stacks, Timeline};
use super::{CheckpointFrame, Options, Replay};
use crate::canvas::Renderer;
use crate::engine::Engine;
use crate::report::{Check, EventDelta, EventReport, Finding, StageDelta, StateReport};

/// A recording being replayed by an engine.
pub struct Session<E: Engine> {
    /// Key and event.
    events: Arc<Vec<(u32, E::Event)>>,
    seed: u64,
    options: Options,
    state: E::State,
    stacks: Stacks<E>,
    /// The control state before the first event.
    first: E::Control,
    /// Counts of the state before the first event.
    scene: BTreeMap<String, i64>,
    position: usize,
    /// By event, as far as the run has ever gone.
    reports: Vec<EventReport>,
    timeline: Timeline<E>,
    deltas: Vec<EventDelta>,
    finding: Option<Finding>,
    end: Option<StateReport>,
    planting: Planting,
    pixels: Pixels,
    frames: Vec<CheckpointFrame>,
    /// Another number whenever the body may be another.
    version: u64,
    /// The event that stopped at a stage, and the control state before it.
    held: Option<(E::Work, E::Control)>,
    /// Events may come yet: there is no end to look at.
    live: bool,
}

impl<E: Engine> Session<E> {
    /// Stands before the first of some events, each with its key.
    pub fn new(state: E::State, events: Vec<(u32, E::Event)>, seed: u64, options: Options) -> Self {
        let mut session = Self {
            events: Arc::new(events),
            seed,
            first: E::control(&state),
            scene: counts::<E>(&state),
            state,
            stacks: Stacks::default(),
            position: 0,
            reports: Vec::new(),
            timeline: Timeline::new(options.budget_bytes),
            deltas: Vec::new(),
            finding: None,
            end: None,
            planting: Planting::Open,
            pixels: Pixels::default(),
            frames: Vec::new(),
            version: 0,
            held: None,
            live: false,
            options,
        };
        session.look_at_end();
        session
    }

    /// The same, with a renderer of the scene as it is before the first event.
    #[must_use]
    pub fn with_renderer(self, renderer: Option<Box<dyn Renderer>>) -> Self {
        Self { pixels: Pixels::new(renderer), ..self }
    }

    /// The state as it is now.
    pub fn engine_state(&self) -> &E::State {
        &self.state
    }

    /// Runs or walks the event at the position. False at the end.
    fn forward(&mut self) -> bool {
        if self.position == self.events.len() {
            return false;
        }
        match self.timeline.step(self.position) {
            Some(step) => {
                step.forward(&mut self.state, &mut self.stacks);
                self.version += u64::from(step.change.is_edit());
            }
            None => self.run(),
        }
        self.position += 1;
        self.look_at_end();
        true
    }

    /// Takes the last event back, where its step is kept.
    fn walk_back(&mut self) -> bool {
        let Some(step) = self.position.checked_sub(1).and_then(|last| self.timeline.step(last)) else {
            return false;
        };
        step.backward(&mut self.state, &mut self.stacks);
        self.version += u64::from(step.change.is_edit());
        self.position -= 1;
        true
    }

    /// Goes to the nearest keyframe at or before an event, or to the beginning.
    fn restore(&mut self, event: usize) {
        self.version += 1;
        if let Some((at, keyframe)) = self.timeline.keyframe(event) {
            self.state.clone_from(&keyframe.state);
            self.stacks = keyframe.stacks.clone();
            self.position = at;
        } else {
            self.stacks.rewind(&mut self.state);
            E::set_control(&mut self.state, self.first.clone());
            self.position = 0;
        }
    }

    /// Looks at the whole state where the options or a checkpoint ask for it.
    fn look_after(&mut self, report: &mut EventReport, edited: bool) {
        let whole = self.options.paranoid || report.checkpoint.is_some();
        if whole {
            let state = self.state();
            (report.state, report.state_buffers) = (Some(state.digest), state.buffers);
            (report.counts, report.checks) = (state.counts, state.checks);
        } else if edited && self.is_check_due() {
            report.checks = E::check(&self.state);
        }
    }

    fn is_check_due(&self) -> bool {
        let every = self.options.check_every;
        every > 0 && self.stacks.edits.is_multiple_of(every)
    }

    /// Looks at the whole state when the last event is done for the first time.
    fn look_at_end(&mut self) {
        if self.position == self.events.len() && self.end.is_none() && !self.live {
            let end = self.state();
            let broken = end.checks.iter().find(|c| !c.ok).cloned();
            self.latch(broken.map(|check| Finding { event: None, stage: "state".into(), check }));
            self.end = Some(end);
        }
    }

    fn keep_deltas(&mut self, event: usize, stages: Vec<StageDelta>) {
        if !stages.is_empty() {
            self.deltas.push(EventDelta { event, stages });
        }
    }

    /// Keeps a report. An event that is run again has to report the same.
    fn keep_report(&mut self, report: EventReport) {
        let event = Some(report.index);
        let broken = report.findings().next().map(|(stage, check)| (stage.to_string(), check.clone()));
        self.latch(broken.map(|(stage, check)| Finding { event, stage, check }));
        match self.reports.get(report.index) {
            None => self.reports.push(report),
            Some(old) if old.without_times() == report.without_times() => {}
            Some(_) => {
                let check = Check::fail("repeats", "run again, the event reports something else");
                self.latch(Some(Finding { event, stage: "replay".into(), check }));
            }
        }
    }

    fn latch(&mut self, finding: Option<Finding>) {
        if self.finding.is_none() {
            self.finding = finding;
        }
    }
}

fn counts<E: Engine>(state: &E::State) -> BTreeMap<String, i64> {
    E::counts(state).into_iter().map(|(name, count)| (name.into(), count)).collect()
}
