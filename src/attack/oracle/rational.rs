//! FC beside FC in rational arithmetic, which was written apart from the engine: the same line, or one that is as long, or the same reason why there is
//! none.
//!
//! Not compared: a line of which an end was snapped, since that is a line between other picks.

use super::{Verdict, Witness};
use crate::attack::{Finding, Hits};
use crate::measure::exact::{Agreement, Question, compare, compare_chain};

pub(super) fn look(witness: &Witness<'_>, hits: &mut Hits) -> Verdict {
    let Some((cut, picked)) = witness.ran.cut().and_then(|cut| Some((cut, cut.picked.as_ref()?))) else {
        return Ok(());
    };
    let mesh = &witness.before.mesh;
    let agreed = match &cut.plane {
        Some(plane) if plane.snapped() > 0 => return Ok(()),
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
