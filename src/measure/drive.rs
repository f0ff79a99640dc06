//! One event through the stages of the wound engine, as the session does it but for digests: a clock around each stage, and its checks
//! where they are wanted.

use std::time::Instant;

use crate::engine::wound::{Edit, State, Work, Wound, WoundEvent};
use crate::engine::{Engine, Part, Start};
use crate::report::{Check, Outcome, Rejection};

/// What came of an event.
#[derive(Debug)]
pub(super) struct Ran {
    pub(super) outcome: Outcome,
    pub(super) rejection: Option<Rejection>,
    /// The stages that ran, and their microseconds.
    pub(super) stages: Vec<(&'static str, f64)>,
    /// The invariants that broke, and after which stage.
    pub(super) broken: Vec<(&'static str, Check)>,
    /// The work, as the stages left it.
    pub(super) work: Option<Work>,
    /// What was committed.
    pub(super) patch: Option<Edit>,
}

impl Ran {
    fn done(outcome: Outcome, rejection: Option<Rejection>) -> Self {
        Self { outcome, rejection, stages: Vec::new(), broken: Vec::new(), work: None, patch: None }
    }

    /// Microseconds of a stage; 0 where it did not run.
    pub(super) fn us(&self, stage: &str) -> f64 {
        self.stages.iter().find(|s| s.0 == stage).map_or(0.0, |s| s.1)
    }
}

/// Runs an event to its end: committed, or rolled back. With `look`, every stage is followed by its checks.
pub(super) fn run(state: &mut State, event: &WoundEvent, look: bool) -> Ran {
    let mut work = match Wound::start(state, event, 0) {
        Start::Done(outcome) => return Ran::done(outcome, None),
        Start::Rejected(rejection) => return Ran::done(Outcome::Rejected, Some(rejection)),
        Start::Run(work) => work,
    };
    let mut ran = Ran::done(Outcome::Applied, None);
    match stages(state, &mut work, look, &mut ran) {
        Ok(()) => ran.patch = Some(Wound::commit(state, &mut work)),
        Err(rejection) => {
            Wound::rollback(state, &mut work);
            (ran.outcome, ran.rejection) = (Outcome::Rejected, Some(rejection));
        }
    }
    Ran { work: Some(work), ..ran }
}

fn stages(state: &mut State, work: &mut Work, look: bool, ran: &mut Ran) -> Result<(), Rejection> {
    for stage in Wound::STAGES.iter() {
        if (stage.part)(work) != Part::Run {
            continue;
        }
        let clock = Instant::now();
        let result = (stage.run)(state, work);
        ran.stages.push((stage.id, clock.elapsed().as_nanos() as f64 / 1e3));
        result?;
        if look {
            let broken = (stage.check)(state, work).into_iter().filter(|check| !check.ok);
            ran.broken.extend(broken.map(|check| (stage.id, check)));
        }
    }
    Ok(())
}
