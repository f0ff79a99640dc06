//! What must hold, whatever the input.
//!
//! | oracle | what it says |
//! | --- | --- |
//! | [`invariants`] | every stage's invariants, and those of the whole state |
//! | [`trace`] | a rejected cut leaves none; undo gives the first digest, redo the second, bit for bit |
//! | [`census`] | nodes, edges, faces, area and volume are what the line says they must be |
//! | [`exact`] | turned by half turns and scaled by powers of two, everything is the same to the last bit |
//! | [`alike`] | axes permuted, mirrored, shifted on the grid, corners turned, picks exchanged: the same line |
//! | [`rational`] | FC in rational arithmetic, written apart, finds the same line |
//! | [`commute`] | cuts that have nothing in common can be made in either order |
//! | [`session`] | the session gives the same state, with and without what it keeps for seeking |

mod alike;
mod census;
mod commute;
mod exact;
mod invariants;
mod map;
mod rational;
mod session;
#[cfg(test)]
mod tests;
mod trace;

use super::drive::Ran;
use super::trial::Ground;
use super::{Finding, Hits};
use crate::engine::wound::{State, WoundEvent};
use crate::recording::Recording;

pub(super) use commute::Earlier;

type Verdict = Result<(), Box<Finding>>;

/// Larger meshes are looked at less: what is slow there is the whole of them, and a cut touches little of it.
const SMALL: usize = 600;
/// How often the whole of a large one is.
const SELDOM: u32 = 4;

/// An event, and the states before and after it.
pub(super) struct Witness<'a> {
    pub(super) ground: &'a Ground,
    pub(super) before: &'a State,
    pub(super) after: &'a State,
    pub(super) event: &'a WoundEvent,
    pub(super) seed: u64,
    pub(super) key: u32,
    pub(super) ran: &'a Ran,
    /// The cut before, if it was applied and nothing happened since.
    pub(super) earlier: Option<&'a Earlier>,
}

/// Looks at an event with every oracle.
pub(super) fn look(witness: &Witness<'_>, hits: &mut Hits) -> Verdict {
    let is_small = witness.before.mesh.face_count() <= SMALL;
    invariants::look(witness)?;
    if is_small || witness.key.is_multiple_of(SELDOM) {
        trace::look(witness)?;
        census::look(witness)?;
    }
    if is_small {
        exact::look(witness, hits)?;
        alike::look(witness, hits)?;
        rational::look(witness, hits)?;
        commute::look(witness, hits)?;
    }
    Ok(())
}

/// Looks at a whole recording.
pub(super) fn whole(
    ground: &Ground,
    recording: &Recording<WoundEvent>,
    end: &State,
    hits: &mut Hits,
) -> Verdict {
    session::look(ground, recording, end, hits)
}

/// A verdict: a finding with what is wrong, unless it holds.
fn require(holds: bool, check: &str, detail: impl FnOnce() -> String) -> Verdict {
    if holds { Ok(()) } else { Err(Finding::new(check, detail())) }
}
