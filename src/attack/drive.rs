//! One event through the stages of the wound engine, as the session does it; where an oracle asks for it, from an eye that no camera has.

use glam::DVec3;

use crate::engine::wound::{Cut, Edit, State, Work, Wound, WoundEvent};
use crate::engine::{Engine, Part, Start};
use crate::report::{Buffer, Check, Outcome, Rejection};

/// What came of an event.
pub(super) struct Ran {
    pub(super) outcome: Outcome,
    pub(super) rejection: Option<Rejection>,
    /// The work, as the stages left it.
    pub(super) work: Option<Work>,
    /// What was committed.
    pub(super) edit: Option<Edit>,
    /// The invariants that broke, and after which stage.
    pub(super) broken: Vec<(&'static str, Check)>,
}

impl Ran {
    fn done(outcome: Outcome, rejection: Option<Rejection>) -> Self {
        Self { outcome, rejection, work: None, edit: None, broken: Vec::new() }
    }

    /// The cut, if it was one that got as far as having picks.
    pub(super) fn cut(&self) -> Option<&Cut> {
        match &self.work {
            Some(Work::Cut(cut)) => Some(cut),
            _ => None,
        }
    }

    /// The cut, if it was applied.
    pub(super) fn applied(&self) -> Option<&Cut> {
        self.cut().filter(|_| self.outcome == Outcome::Applied)
    }

    /// The outcome, and the reason of a rejection.
    pub(super) fn word(&self) -> String {
        let reason = self.rejection.as_ref().map_or("", |r| r.reason.as_str());
        format!("{:?} {reason}", self.outcome).to_lowercase().trim_end().to_owned()
    }
}

/// Runs an event to its end: committed, or rolled back. Every stage is followed by its checks.
pub(super) fn run(state: &mut State, event: &WoundEvent, seed: u64, eye: Option<DVec3>) -> Ran {
    let mut work = match Wound::start(state, event, seed) {
        Start::Done(outcome) => return Ran::done(outcome, None),
        Start::Rejected(rejection) => return Ran::done(Outcome::Rejected, Some(rejection)),
        Start::Run(work) => work,
    };
    if let (Work::Cut(cut), Some(eye)) = (&mut work, eye) {
        cut.eye = eye;
    }
    let mut ran = Ran::done(Outcome::Applied, None);
    match stages(state, &mut work, &mut ran.broken) {
        Ok(()) => ran.edit = Some(Wound::commit(state, &mut work)),
        Err(rejection) => {
            Wound::rollback(state, &mut work);
            (ran.outcome, ran.rejection) = (Outcome::Rejected, Some(rejection));
        }
    }
    Ran { work: Some(work), ..ran }
}

fn stages(
    state: &mut State,
    work: &mut Work,
    broken: &mut Vec<(&'static str, Check)>,
) -> Result<(), Rejection> {
    for stage in Wound::STAGES.iter() {
        if (stage.part)(work) == Part::Run {
            (stage.run)(state, work)?;
            let failed = (stage.check)(state, work).into_iter().filter(|check| !check.ok);
            broken.extend(failed.map(|check| (stage.id, check)));
        }
    }
    Ok(())
}

/// Every buffer of the state.
pub(super) fn digest(state: &State) -> Vec<blake3::Hash> {
    Wound::buffers(state).iter().map(Buffer::digest).collect()
}
