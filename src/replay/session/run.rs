//! One event run for the first time, or again: through the stages, kept or taken back, and its report.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::Session;
use crate::canvas::frame::{Frame, View};
use crate::engine::{Control, Engine, Event, Start};
use crate::replay::stages::{Pipeline, Planting};
use crate::replay::timeline::{Change, Keyframe, Step};
use crate::replay::{CHECKPOINT_SIZE, CheckpointFrame, digest};
use crate::report::{EventReport, Outcome, Rejection};

impl<E: Engine> Session<E> {
    /// Runs the event at the position, and keeps its report and its step.
    pub(super) fn run(&mut self) {
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
    pub(super) fn run_stages(
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
    pub(super) fn let_go(&mut self) {
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

    pub(super) fn render(&mut self, limit: Option<[u32; 2]>) -> Option<(Frame, View)> {
        let mut job = E::frame(&self.state, self.version, self.options.everything)?;
        job.view = limit.map_or(job.view, |limit| job.view.within(limit));
        let frame = self.pixels.frame(E::paintings(&self.state), &job)?;
        Some((frame, job.view))
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

pub(super) fn sizes(
    before: &[(&'static str, u64)],
    after: &[(&'static str, u64)],
) -> BTreeMap<String, [u64; 2]> {
    before.iter().zip(after).map(|((name, old), (_, new))| ((*name).into(), [*old, *new])).collect()
}
