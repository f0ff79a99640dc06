//! FC beside FC in rational arithmetic, which was written apart from the engine: the same line, or one that is as long, or the same reason why there is
//! none.
//!
//! Not compared: a line of which an end was snapped, since that is a line between other picks.

use super::{Verdict, Witness};
use crate::attack::{Finding, Hits};
use crate::engine::wound::Cut;
use crate::engine::wound::chain::Chain;
use crate::measure::exact::{Agreement, Question, compare_chain};

/// Why FC makes no line, for reasons that do not go by rounding.
const REASONS: [&str; 6] =
    ["degenerate-plane", "same-point", "grazing", "other-component", "boundary", "silhouette"];

pub(super) fn look(witness: &Witness<'_>, hits: &mut Hits) -> Verdict {
    let Some((cut, picked)) = witness.ran.cut().and_then(|cut| Some((cut, cut.picked.as_ref()?))) else {
        return Ok(());
    };
    let Some(found) = found(witness, cut) else { return Ok(()) };
    match compare_chain(&witness.before.mesh, &Question::of(cut.eye, picked), &found) {
        Ok(Agreement::NotPosed) => Ok(()),
        Ok(_) => {
            hits.note("oracle rational");
            Ok(())
        }
        Err(disagreement) => Err(Finding::new("rational", disagreement.to_string())),
    }
}

/// What FC found; None where that went by rounding. A stage behind FC may have rejected the cut for a reason of its own.
fn found(witness: &Witness<'_>, cut: &Cut) -> Option<Result<Chain, String>> {
    match (&cut.plane, &witness.ran.rejection) {
        (Some(plane), _) => (plane.snapped() == 0).then(|| Ok(cut.formed.chain.clone())),
        (None, Some(why)) => REASONS.contains(&why.reason.as_str()).then(|| Err(why.reason.clone())),
        (None, None) => None,
    }
}
