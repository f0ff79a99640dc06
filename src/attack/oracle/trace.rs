//! What is taken back is as it never was, and what is done again is as it was, bit for bit.

use super::{Verdict, Witness, require};
use crate::attack::drive::digest;
use crate::engine::Engine;
use crate::engine::wound::Wound;
use crate::report::Outcome;

pub(super) fn look(witness: &Witness<'_>) -> Verdict {
    match &witness.ran.edit {
        Some(_) => undo_and_redo(witness),
        None if witness.ran.outcome == Outcome::Rejected => no_trace(witness),
        None => Ok(()),
    }
}

fn no_trace(witness: &Witness<'_>) -> Verdict {
    // A rejection takes back a first click that waited; nothing else of the control state may change.
    let mut before = witness.before.clone();
    before.control.pending = witness.after.control.pending;
    let same = digest(&before) == digest(witness.after);
    require(same, "no-trace", || format!("{} left a trace", witness.ran.word()))
}

fn undo_and_redo(witness: &Witness<'_>) -> Verdict {
    let Some(edit) = &witness.ran.edit else { return Ok(()) };
    let mut state = witness.after.clone();
    Wound::revert(&mut state, edit);
    let mut before = witness.before.clone();
    before.control.pending = state.control.pending;
    require(digest(&state) == digest(&before), "undo", || "undone, it is not as it was before".into())?;
    Wound::apply(&mut state, edit);
    require(digest(&state) == digest(witness.after), "redo", || "done again, it is not as it was".into())?;
    require(Wound::check(&state).iter().all(|check| check.ok), "redo", || {
        "an invariant broke on the way".into()
    })
}
