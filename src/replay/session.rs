//! One engine's recording on its way: where it stands, what it reported, and how it goes forth and back.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::digest;
use super::pixels::Pixels;
use super::stages::{Pipeline, Planting, require_row};
use super::timeline::{Change, Keyframe, Stacks, Step, Timeline};
use super::{CHECKPOINT_SIZE, CheckpointFrame, Options, Replay, Shot};
use crate::canvas::frame::{Frame, Orbit, View};
use crate::canvas::image::{Image, MapId};
use crate::canvas::{RenderError, Renderer};
use crate::engine::{Control, Engine, Event, Input, Start};
use crate::mesh::Mesh;
use crate::report::{
    Check, EventDelta, EventReport, Finding, Outcome, Rejection, RunReport, StageDelta, StateReport,
};

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

    /// Runs the event at the position, and keeps its report and its step.
    fn run(&mut self) {
        let index = self.position;
        if self.timeline.wants_keyframe(index, E::state_bytes(&self.state)) {
            let keyframe = Keyframe { state: self.state.clone(), stacks: self.stacks.clone() };
            self.timeline.keep_keyframe(index, keyframe);
        }
        let events = Arc::clone(&self.events);
        let (key, event) = &events[index];
        let before = E::control(&self.state);
        let sizes_before = E::sizes(&self.state);
        let mut report = EventReport::new(index, event.kind());
        let change = match event.control() {
            Control::Step => self.run_step(*key, event, &mut report),
            Control::Undo => self.undo(event, &mut report),
            Control::Redo => self.redo(event, &mut report),
            Control::Checkpoint(name) => self.checkpoint(event, name, &mut report),
        };
        report.mode = E::mode(&self.state).into();
        report.sizes = sizes(&sizes_before, &E::sizes(&self.state));
        self.stacks.edits += usize::from(change.is_edit());
        self.version += u64::from(change.is_edit());
        self.look_after(&mut report, change.is_edit());
        self.timeline.keep_step(index, Step { before, after: E::control(&self.state), change });
        self.keep_report(report);
    }

    /// The engine's own work: through the stages, then kept or taken back.
    fn run_step(&mut self, key: u32, event: &E::Event, report: &mut EventReport) -> Change<E> {
        match self.run_stages(key, event, report, None) {
            Some((mut work, Ok(()))) => self.commit(&mut work, report),
            Some((mut work, Err(rejection))) => {
                report.reject(rejection);
                self.roll_back(&mut work)
            }
            None => Change::None,
        }
    }

    /// Through the stages, or up to one; none where there is nothing to run through them. The transaction stays open.
    fn run_stages(
        &mut self,
        key: u32,
        event: &E::Event,
        report: &mut EventReport,
        last: Option<&str>,
    ) -> Option<(E::Work, Result<(), Rejection>)> {
        let seed = digest::event_seed(self.seed, key, "cut");
        let work = match E::start(&mut self.state, event, seed) {
            Start::Done(outcome) => {
                report.outcome = outcome;
                return None;
            }
            Start::Rejected(rejection) => {
                report.reject(rejection);
                return None;
            }
            Start::Run(work) => work,
        };
        let mut pipeline = Pipeline::<E>::new(&mut self.state, work, &mut self.pixels);
        pipeline.plant = self.options.plant.as_ref().filter(|p| p.event == report.index);
        pipeline.keep_deltas = self.options.keep_deltas && last.is_none();
        pipeline.last = last;
        let result = pipeline.run();
        pipeline.describe(report);
        let Pipeline { work, deltas, planting, .. } = pipeline;
        self.keep_deltas(report.index, deltas);
        if planting != Planting::Open {
            self.planting = planting;
        }
        Some((work, result))
    }

    /// Takes back what is held.
    fn let_go(&mut self) {
        if let Some((mut work, before)) = self.held.take() {
            E::rollback(&mut self.state, &mut work);
            E::set_control(&mut self.state, before);
            self.version += 1;
        }
    }

    fn commit(&mut self, work: &mut E::Work, report: &mut EventReport) -> Change<E> {
        report.outcome = Outcome::Applied;
        let patch = Arc::new(E::commit(&mut self.state, work));
        let cleared = self.stacks.commit(Arc::clone(&patch));
        Change::Commit { patch, cleared }
    }

    fn roll_back(&mut self, work: &mut E::Work) -> Change<E> {
        E::rollback(&mut self.state, work);
        Change::None
    }

    fn undo(&mut self, event: &E::Event, report: &mut EventReport) -> Change<E> {
        E::interrupt(&mut self.state, event);
        let done = self.stacks.undo(&mut self.state).then_some(Change::Undo);
        settle(done, report, Rejection::new("nothing-to-undo", "no applied edit is left to take back"))
    }

    fn redo(&mut self, event: &E::Event, report: &mut EventReport) -> Change<E> {
        E::interrupt(&mut self.state, event);
        let done = self.stacks.redo(&mut self.state).then_some(Change::Redo);
        settle(done, report, Rejection::new("nothing-to-redo", "no undone edit is left to do again"))
    }

    fn checkpoint(&mut self, event: &E::Event, name: &str, report: &mut EventReport) -> Change<E> {
        if E::interrupt(&mut self.state, event) {
            report.outcome = Outcome::Cancelled;
        }
        report.checkpoint = Some(name.into());
        self.picture(name, report);
        Change::None
    }

    /// Renders a checkpoint's frame, and keeps it.
    fn picture(&mut self, name: &str, report: &mut EventReport) {
        report.frame = Some("skipped: no renderer".into());
        let Some((frame, view)) = self.render(Some(CHECKPOINT_SIZE)) else { return };
        report.frame = Some(format!("{} x {}", view.size[0], view.size[1]));
        report.passes.clone_from(&frame.passes);
        let background = E::frame(&self.state, self.version, false).map(|job| job.look.background);
        let background = background.map_or([0; 4], |colour| colour.bytes());
        self.frames.push(CheckpointFrame { event: report.index, name: name.into(), frame, background });
    }

    fn render(&mut self, limit: Option<[u32; 2]>) -> Option<(Frame, View)> {
        let mut job = E::frame(&self.state, self.version, self.options.everything)?;
        job.view = limit.map_or(job.view, |limit| job.view.within(limit));
        let frame = self.pixels.frame(E::paintings(&self.state), &job)?;
        Some((frame, job.view))
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

    /// Why an event cannot be stopped after a stage.
    fn require_stage(&self, event: usize, stage: &str) -> Result<(), String> {
        if event >= self.events.len() {
            return Err(format!("there is no event {event}: the recording has {}", self.events.len()));
        }
        let ids: Vec<&str> = E::STAGES.iter().map(|s| s.id).collect();
        if ids.contains(&stage) {
            Ok(())
        } else {
            Err(format!("there is no stage `{stage}`: {} has {}", E::NAME, ids.join(", ")))
        }
    }
}

fn settle<E: Engine>(done: Option<Change<E>>, report: &mut EventReport, otherwise: Rejection) -> Change<E> {
    match done {
        Some(change) => {
            report.outcome = Outcome::Applied;
            change
        }
        None => {
            report.reject(otherwise);
            Change::None
        }
    }
}

fn sizes(before: &[(&'static str, u64)], after: &[(&'static str, u64)]) -> BTreeMap<String, [u64; 2]> {
    before.iter().zip(after).map(|((name, old), (_, new))| ((*name).into(), [*old, *new])).collect()
}

fn counts<E: Engine>(state: &E::State) -> BTreeMap<String, i64> {
    E::counts(state).into_iter().map(|(name, count)| (name.into(), count)).collect()
}

impl<E: Engine> Replay for Session<E> {
    fn engine(&self) -> &'static str {
        E::NAME
    }

    fn stages(&self) -> Vec<(&'static str, &'static str)> {
        E::STAGES.iter().map(|s| (s.id, s.title)).collect()
    }

    fn len(&self) -> usize {
        self.events.len()
    }

    fn position(&self) -> usize {
        self.position
    }

    fn step(&mut self) -> Option<&EventReport> {
        self.let_go();
        let index = self.position;
        if self.forward() { self.reports.get(index) } else { None }
    }

    fn back(&mut self) -> bool {
        match self.position.checked_sub(1) {
            Some(last) => self.seek(last),
            None => return false,
        }
        true
    }

    fn seek_while(&mut self, event: usize, go_on: &mut dyn FnMut(usize) -> bool) -> bool {
        self.let_go();
        let event = event.min(self.events.len());
        while self.position > event && self.walk_back() {
            if self.position > event && !go_on(self.position) {
                return false;
            }
        }
        if self.position > event {
            self.restore(event);
        }
        while self.position < event && self.forward() {
            if self.position < event && !go_on(self.position) {
                return false;
            }
        }
        true
    }

    fn hold(&mut self, event: usize, stage: &str) -> Result<EventReport, String> {
        self.require_stage(event, stage)?;
        self.seek(event);
        let events = Arc::clone(&self.events);
        let (key, input) = &events[event];
        let mut report = EventReport::new(event, input.kind());
        report.mode = E::mode(&self.state).into();
        if input.control() == Control::Step {
            let (before, sizes_before) = (E::control(&self.state), E::sizes(&self.state));
            match self.run_stages(*key, input, &mut report, Some(stage)) {
                Some((work, result)) => {
                    self.held = Some((work, before));
                    self.version += 1;
                    result.map_or_else(|rejection| report.reject(rejection), drop);
                }
                None => E::set_control(&mut self.state, before),
            }
            report.sizes = sizes(&sizes_before, &E::sizes(&self.state));
        }
        let there = require_row(&report, stage);
        if there.is_err() {
            self.let_go();
        }
        there.map(|()| report)
    }

    fn release(&mut self) {
        self.let_go();
    }

    fn append(&mut self, key: u32, input: &Input) -> Result<(), String> {
        let event = input.event()?;
        Arc::make_mut(&mut self.events).push((key, event));
        (self.live, self.end) = (true, None);
        Ok(())
    }

    fn truncate(&mut self, events: usize) {
        if events < self.events.len() {
            self.seek(self.position.min(events));
            Arc::make_mut(&mut self.events).truncate(events);
            self.reports.truncate(events);
            self.timeline.truncate(events);
            self.finding = self.finding.take().filter(|finding| finding.event.is_some_and(|at| at < events));
            (self.live, self.end) = (true, None);
        }
    }

    fn event(&self, index: usize) -> Option<&EventReport> {
        self.reports.get(index)
    }

    fn end(&self) -> Option<&StateReport> {
        self.end.as_ref()
    }

    fn finding(&self) -> Option<&Finding> {
        self.finding.as_ref()
    }

    fn run_report(&self, recording: &str) -> RunReport {
        let (events, end) = (self.reports.clone(), self.end.clone());
        let mut run = RunReport::new(recording, E::NAME, self.scene.clone(), events, end);
        run.totals.digest = digest::of_run(&run.events, run.end.as_ref());
        run
    }

    fn state(&self) -> StateReport {
        let (digest, buffers) = digest::of_buffers(&E::buffers(&self.state));
        StateReport { digest, buffers, counts: counts::<E>(&self.state), checks: E::check(&self.state) }
    }

    fn mesh(&self) -> Option<&Mesh> {
        E::mesh(&self.state)
    }

    fn take_deltas(&mut self) -> Vec<EventDelta> {
        std::mem::take(&mut self.deltas)
    }

    fn planting(&self) -> &Planting {
        &self.planting
    }

    fn sizes(&self) -> Vec<(&'static str, u64)> {
        E::sizes(&self.state)
    }

    fn orbit(&self) -> Option<Orbit> {
        E::orbit(&self.state)
    }

    fn mode(&self) -> &'static str {
        E::mode(&self.state)
    }

    fn kept_bytes(&self) -> usize {
        self.timeline.bytes()
    }

    fn shoot(&mut self, shot: &Shot) -> Option<(Frame, View)> {
        let Some(orbit) = shot.orbit else { return self.render(shot.limit) };
        let before = E::control(&self.state);
        E::look(&mut self.state, orbit);
        let rendered = self.render(shot.limit);
        E::set_control(&mut self.state, before);
        rendered
    }

    fn map(&mut self, map: MapId) -> Option<Image> {
        self.pixels.map(E::paintings(&self.state), map)
    }

    fn take_frames(&mut self) -> Vec<CheckpointFrame> {
        std::mem::take(&mut self.frames)
    }

    fn failure(&self) -> Option<&RenderError> {
        self.pixels.failure()
    }
}
