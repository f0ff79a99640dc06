//! One event through the rows of a stage table: clock, run, buffers, digests, checks.

use std::time::Instant;

use super::digest;
use super::pixels::Pixels;
use crate::engine::{Engine, Part, Stage};
use crate::report::{EventReport, Rejection, StageDelta, StageReport};

/// A defect to put into a run, as a broken stage would: right after the stage, before its buffers are taken.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Plant {
    /// The event.
    pub event: usize,
    /// The stage, such as `MC`.
    pub stage: String,
    /// The buffer, such as `nodes`.
    pub buffer: String,
    /// The element.
    pub element: u32,
    /// How far one of its scalars is moved, in units of its last place.
    pub ulps: i64,
}

impl std::str::FromStr for Plant {
    type Err = String;

    /// Reads `EVENT.STAGE:BUFFER:ELEMENT:ULPS`, such as `4.MC:nodes:n120:1`.
    fn from_str(text: &str) -> Result<Self, String> {
        let wrong = || format!("`{text}` is not EVENT.STAGE:BUFFER:ELEMENT:ULPS, such as 4.MC:nodes:120:1");
        let [place, buffer, element, ulps] =
            <[&str; 4]>::try_from(text.split(':').collect::<Vec<_>>()).map_err(|_| wrong())?;
        let (event, stage) = place.split_once('.').ok_or_else(wrong)?;
        let element = element.trim_start_matches(|c: char| c.is_ascii_alphabetic());
        Ok(Self {
            event: event.parse().map_err(|_| wrong())?,
            stage: stage.into(),
            buffer: buffer.into(),
            element: element.parse().map_err(|_| wrong())?,
            ulps: ulps.parse().map_err(|_| wrong())?,
        })
    }
}

/// What became of a defect to plant.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Planting {
    /// There is none, or its place was not reached.
    #[default]
    Open,
    /// It is in.
    Done,
    /// There is no such place, for this reason.
    Failed(String),
}

/// One event's work on its way through the stages.
pub(super) struct Pipeline<'a, E: Engine> {
    pub(super) state: &'a mut E::State,
    pub(super) work: E::Work,
    /// Who carries the stages' jobs out, if anybody does.
    pixels: &'a mut Pixels,
    /// The defect to plant at this event.
    pub(super) plant: Option<&'a Plant>,
    pub(super) planting: Planting,
    pub(super) keep_deltas: bool,
    /// Stages after this one do not run.
    pub(super) last: Option<&'a str>,
    pub(super) rows: Vec<StageReport>,
    pub(super) deltas: Vec<StageDelta>,
    /// Why no further stage runs.
    halted: Option<&'static str>,
    rejection: Option<Rejection>,
}

impl<'a, E: Engine> Pipeline<'a, E> {
    pub(super) fn new(state: &'a mut E::State, work: E::Work, pixels: &'a mut Pixels) -> Self {
        pixels.follow(E::paintings(state));
        Self {
            state,
            work,
            pixels,
            plant: None,
            planting: Planting::Open,
            keep_deltas: false,
            last: None,
            rows: Vec::new(),
            deltas: Vec::new(),
            halted: None,
            rejection: None,
        }
    }

    /// Runs every stage that takes part. An error is why the event is rejected.
    pub(super) fn run(&mut self) -> Result<(), Rejection> {
        for stage in E::STAGES {
            let row = match (stage.part)(&self.work) {
                Part::Absent => continue,
                Part::Skip(reason) => StageReport::skipped(stage.id, reason),
                Part::Run => match self.halted {
                    Some(reason) => StageReport::skipped(stage.id, reason),
                    None => self.run_stage(stage),
                },
            };
            self.rows.push(row);
            if self.last == Some(stage.id) && self.halted.is_none() {
                self.halted = Some("until");
            }
        }
        self.rejection.take().map_or(Ok(()), Err)
    }

    fn run_stage(&mut self, stage: &Stage<E>) -> StageReport {
        let clock = Instant::now();
        let result = (stage.run)(self.state, &mut self.work);
        if let (Ok(()), Some(job)) = (&result, (stage.job)(&self.work)) {
            self.pixels.carry_out(job);
        }
        let us = clock.elapsed().as_nanos() as f64 / 1e3;
        let mut row = StageReport { us, skipped: None, ..StageReport::skipped(stage.id, "") };
        match result {
            Err(rejection) => {
                self.rejection = Some(rejection);
                self.halted = Some("rejected");
            }
            Ok(()) => self.look(stage, &mut row),
        }
        row
    }

    /// Digests what the stage changed and checks its invariants.
    fn look(&mut self, stage: &Stage<E>, row: &mut StageReport) {
        self.plant_after(stage);
        let buffers = (stage.buffers)(self.state, &self.work);
        let (digest, by_name) = digest::of_buffers(&buffers);
        (row.digest, row.buffers) = (Some(digest), by_name);
        if self.keep_deltas {
            self.deltas.push(StageDelta { stage: stage.id.into(), buffers });
        }
        row.checks = (stage.check)(self.state, &self.work);
        row.checks.extend((stage.job)(&self.work).into_iter().flat_map(|job| self.pixels.check(job)));
    }

    fn plant_after(&mut self, stage: &Stage<E>) {
        if let Some(plant) = self.plant.filter(|p| p.stage == stage.id) {
            self.planting = match E::plant(self.state, &plant.buffer, plant.element, plant.ulps) {
                Ok(()) => Planting::Done,
                Err(reason) => Planting::Failed(reason),
            };
        }
    }

    /// Moves what the stages had to say into the event's report, and what there is to show.
    pub(super) fn describe(&mut self, report: &mut EventReport) {
        let shown = E::show(self.state, &self.work);
        report.cut = E::is_cut(&self.work);
        report.stages = std::mem::take(&mut self.rows);
        (report.counters, report.tables, report.overlays) = (shown.counters, shown.tables, shown.overlays);
    }
}

/// An error says that an event went through no such stage.
pub(super) fn require_row(report: &EventReport, stage: &str) -> Result<(), String> {
    let ids: Vec<&str> = report.stages.iter().map(|row| row.id.as_str()).collect();
    if ids.contains(&stage) {
        return Ok(());
    }
    let of = report.reason.as_ref().map_or_else(String::new, |reason| format!(", rejected: {reason}"));
    let has = if ids.is_empty() { "none".into() } else { ids.join(", ") };
    Err(format!("event {} ({}{of}) has no stage `{stage}`; it has {has}", report.index, report.kind))
}
