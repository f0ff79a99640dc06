//! What a session is asked from outside, without knowing its engine.

use std::sync::Arc;

use super::run::sizes;
use super::{Session, counts};
use crate::canvas::RenderError;
use crate::canvas::frame::{Frame, Orbit, View};
use crate::canvas::image::{Image, MapId};
use crate::engine::{Control, Engine, Event, Input};
use crate::mesh::Mesh;
use crate::replay::stages::{Planting, require_row};
use crate::replay::{CheckpointFrame, Replay, Shot, digest};
use crate::report::{EventDelta, EventReport, Finding, RunReport, StateReport};

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

impl<E: Engine> Session<E> {
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
