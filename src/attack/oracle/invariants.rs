//! The engine's own invariants: those of each stage, and after every event those of the whole state.

use super::{Verdict, Witness};
use crate::attack::Finding;
use crate::engine::Engine;
use crate::engine::wound::Wound;
use crate::report::Check;

pub(super) fn look(witness: &Witness<'_>) -> Verdict {
    let stages = witness.ran.broken.iter().map(|(stage, check)| (*stage, check.clone()));
    let whole =
        Wound::check(witness.after).into_iter().filter(|check| !check.ok).map(|check| ("state", check));
    match stages.chain(whole).next() {
        None => Ok(()),
        Some((stage, check)) => Err(finding(stage, &check)),
    }
}

/// Named as the reports name it: stage and invariant.
fn finding(stage: &str, check: &Check) -> Box<Finding> {
    let culprits = check.culprits.join(" ");
    Finding::new(&format!("{stage}/{}", check.name), format!("{} {culprits}", check.detail).trim_end())
}
