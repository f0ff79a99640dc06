//! FC beside FC in rational arithmetic, which was written apart from the engine: the same line, or one that is as long, or the same reason why there is
//! none.
//!
//! Not compared: a line of which an end was snapped, since that is a line between other picks.

use super::{Verdict, Witness};
use crate::attack::{Finding, Hits};
use crate::engine::wound::Cut;
use crate::measure::exact::{Agreement, Question, compare, compare_chain};

pub(super) fn look(witness: &Witness<'_>, hits: &mut Hits) -> Verdict {
    let Some((cut, picked)) = witness.ran.cut().and_then(|cut| Some((cut, cut.picked.as_ref()?))) else {
        return Ok(());
    };
    let mesh = &witness.before.mesh;
    let agreed = match &cut.plane {
        Some(_) if is_rounded(cut) => return Ok(()),
        Some(_) => compare_chain(mesh, &Question::of(cut.eye, picked), &Ok(cut.formed.chain.clone())),
        // There is no line; whether something was snapped on the way is not known any more, so it is traced again without.
        None => compare(mesh, cut.eye, picked),
    };
    match agreed {
        Ok(Agreement::NotPosed) => Ok(()),
        Ok(_) => {
            hits.note("oracle rational");
            Ok(())
        }
        Err(disagreement) => Err(Finding::new("rational", disagreement.to_string())),
    }
}

/// Whether rounding had a say in a line: a node counts as lying on the plane, or an end lies elsewhere than its pick.
pub(super) fn is_rounded(cut: &Cut) -> bool {
    let ends = [cut.formed.chain.points.first(), cut.formed.chain.points.last()].map(|end| end.map(|p| p.at));
    let picked = cut.picked.map(|picks| picks.map(|p| Some(p.point.at)));
    cut.plane.as_ref().is_none_or(|plane| plane.snapped() > 0) || picked != Some(ends)
}
