//! The line does not depend on what axes are called, which way is left, where zero is, where a face's corners begin, or from which end one goes.
//!
//! Signs stay exactly, or all turn around; lengths are rounded otherwise. So the constructs along the line must be the same, unless two ways from
//! pick to pick are equally long (which rational arithmetic has to confirm of both), or something was snapped (which goes by rounded distances). A shift counts only where no
//! coordinate, nor the eye or a pick, is rounded by it.

use glam::DVec3;

use super::exact::is_by_ids;
use super::map::Map;
use super::rational::is_rounded;
use super::{Verdict, Witness, require};
use crate::attack::{Finding, Hits};
use crate::engine::wound::chain::{At, Chain};
use crate::engine::wound::form::trace;
use crate::engine::wound::plane::CutPlane;
use crate::engine::wound::{Cut, Pick, State, Work, Wound, WoundEvent, pick};
use crate::engine::{Engine, Start};
use crate::measure::exact::{Question, compare_chain};
use crate::mesh::{Face, FaceId};
use crate::report::Rejection;

/// Of two ways of so nearly equal length either may be taken.
const TIE: f64 = 1e-9;
/// The eye is put on a grid of so many parts of a unit before it is shifted.
const GRID: f64 = 1024.0;

/// One way to see the same cut otherwise.
#[derive(Clone, Copy, Debug)]
enum Way {
    Mapped(Map),
    /// Every face begins at another corner.
    Turned,
    /// From the second pick to the first.
    Back,
}

pub(super) fn look(witness: &Witness<'_>, hits: &mut Hits) -> Verdict {
    let (Some(cut), true) = (witness.ran.cut(), is_by_ids(witness.event)) else { return Ok(()) };
    let way = choose(witness.seed);
    let eye = match way {
        Way::Mapped(map) if map.shift != DVec3::ZERO => (cut.eye * GRID).round() / GRID,
        _ => cut.eye,
    };
    let mine = form(witness.before.clone(), witness.event, eye);
    let Some(theirs) = otherwise(way, witness, eye) else { return Ok(()) };
    hits.note("oracle alike");
    compare(way, &mine, &theirs)
}

fn choose(seed: u64) -> Way {
    let mapped = |axes, factors: [f64; 3], shift: [f64; 3]| {
        Way::Mapped(Map { axes, factors: DVec3::from(factors), shift: DVec3::from(shift) })
    };
    let none = [0.0; 3];
    // Other bits than those by which the exact maps are chosen.
    match seed >> 32 & 7 {
        0 => mapped([1, 2, 0], [1.0; 3], none),
        1 => mapped([1, 0, 2], [1.0, 1.0, -1.0], none),
        2 => Way::Turned,
        3 => Way::Back,
        4 => mapped([0, 1, 2], [-1.0, 1.0, 1.0], none),
        5 => mapped([0, 1, 2], [1.0; 3], [3.0, -64.0, 1024.0]),
        6 => mapped([2, 1, 0], [1.0, -1.0, 1.0], none),
        _ => mapped([0, 1, 2], [1.0; 3], [-1_048_576.0, 0.5, 16.0]),
    }
}

/// What FC made of a cut: its line, or why there is none; and whether rounding had a say in that.
struct Form {
    state: State,
    cut: Result<Box<Cut>, Rejection>,
    rounded: bool,
}

/// FC alone, taken back again.
fn form(mut state: State, event: &WoundEvent, eye: DVec3) -> Form {
    let none = |state| Form { state, cut: Err(Rejection::new("none", "it is no cut")), rounded: false };
    let Start::Run(mut work) = Wound::start(&mut state, event, 0) else { return none(state) };
    if let Work::Cut(cut) = &mut work {
        cut.eye = eye;
    }
    let ran = (Wound::STAGES[0].run)(&mut state, &mut work);
    Wound::rollback(&mut state, &mut work);
    let Work::Cut(cut) = work else { return none(state) };
    let rounded = match &ran {
        Ok(()) => is_rounded(&cut),
        Err(rejection) => was_snapped(&state, &cut, rejection),
    };
    Form { state, cut: ran.map(|()| cut), rounded }
}

/// Whether a cut was rejected for what it was snapped to: without that there is a line, or there is none for another reason.
fn was_snapped(state: &State, cut: &Cut, rejection: &Rejection) -> bool {
    let Some([from, to]) = cut.picked else { return false };
    let Some(plane) = CutPlane::through([cut.eye, from.through, to.through]) else { return false };
    let traced = trace(&state.mesh, &plane, &from.point, &to.point);
    traced.err().is_none_or(|other| other.reason != rejection.reason)
}

/// The same cut seen otherwise; None where that would be another cut.
fn otherwise(way: Way, witness: &Witness<'_>, eye: DVec3) -> Option<Form> {
    let mine = through(&mut witness.before.clone(), witness.event)?;
    match way {
        Way::Mapped(map) => {
            let mut image = map.state(witness.ground, witness.before);
            let theirs = through(&mut image, witness.event)?;
            let all = witness.before.mesh.positions().iter().chain([&eye]).chain(&mine);
            let is_same =
                all.into_iter().all(|p| map.is_exact_at(*p)) && theirs == mine.map(|p| map.point(p));
            is_same.then(|| form(image, witness.event, map.point(eye)))
        }
        Way::Turned => {
            let (mut image, event) = turned(witness)?;
            let is_same = through(&mut image, &event)? == mine;
            is_same.then(|| form(image, &event, eye))
        }
        Way::Back => {
            let WoundEvent::Cut { from, to } = *witness.event else { return None };
            let event = WoundEvent::Cut { from: to, to: from };
            Some(form(witness.before.clone(), &event, eye))
        }
    }
}

/// The exact data of a cut's picks.
fn through(state: &mut State, event: &WoundEvent) -> Option<[DVec3; 2]> {
    let WoundEvent::Cut { from, to } = *event else { return None };
    let mut resolve = |pick| pick::resolve(state, pick).ok().map(|picked| picked.through);
    Some([resolve(from)?, resolve(to)?])
}

/// The state with the corners of every face turned by one, and the event that names the same picks there.
fn turned(witness: &Witness<'_>) -> Option<(State, WoundEvent)> {
    let mut state = Map::IDENTITY.state(witness.ground, witness.before);
    for f in (0..state.mesh.face_count()).map(FaceId::of) {
        let Face { mut nodes, mut vertices, mut edges, surface } = *state.mesh.face(f);
        nodes.rotate_left(1);
        vertices.rotate_left(1);
        edges.rotate_left(1);
        state.mesh.set_face(f, Face { nodes, vertices, edges, surface });
    }
    // The weights are 1 − u − v, u, v; turned they are u, v, 1 − u − v.
    let turn = |pick: Pick| match pick {
        Pick::Face(f, u, v) => Pick::Face(f, v, 1.0 - u - v),
        other => other,
    };
    match *witness.event {
        WoundEvent::Cut { from, to } => Some((state, WoundEvent::Cut { from: turn(from), to: turn(to) })),
        _ => None,
    }
}

fn compare(way: Way, mine: &Form, theirs: &Form) -> Verdict {
    if mine.rounded || theirs.rounded {
        return Ok(());
    }
    match (&mine.cut, &theirs.cut) {
        (Ok(a), Ok(b)) => {
            lines(way, [&a.formed.chain, &b.formed.chain])?.map_or(Ok(()), |what| {
                // Another way that is as long: each has to be one of the shortest by rational arithmetic.
                let wrong =
                    [(mine, a), (theirs, b)].into_iter().find_map(|(form, cut)| form.disagreement(cut));
                require(wrong.is_none(), "alike-line", || format!("{what}: {}", wrong.unwrap_or_default()))
            })
        }
        // Where the way ends depends on where it begins.
        (Err(_), Err(_)) if matches!(way, Way::Back) => Ok(()),
        (Err(a), Err(b)) => require(a.reason == b.reason, "alike-outcome", || {
            format!("{way:?}: {} became {}", a.reason, b.reason)
        }),
        (Ok(_), Err(b)) => require(false, "alike-outcome", || format!("{way:?}: rejected: {}", b.detail)),
        (Err(a), Ok(_)) => require(false, "alike-outcome", || format!("{way:?}: only there: {}", a.detail)),
    }
}

impl Form {
    /// What rational arithmetic says against a line.
    fn disagreement(&self, cut: &Cut) -> Option<String> {
        let question = Question::of(cut.eye, cut.picked.as_ref()?);
        let compared = compare_chain(&self.state.mesh, &question, &Ok(cut.formed.chain.clone()));
        compared.err().map(|wrong| wrong.to_string())
    }
}

/// Whether two lines are as long, which they must be. Says how they differ, where they go through other places.
fn lines(way: Way, [a, b]: [&Chain; 2]) -> Result<Option<String>, Box<Finding>> {
    let places = |chain: &Chain| chain.points.iter().map(|p| p.at).collect::<Vec<At>>();
    let scale = match way {
        Way::Mapped(map) => map.scale(),
        _ => 1.0,
    };
    let (mine, mut theirs) = (places(a), places(b));
    if matches!(way, Way::Back) {
        theirs.reverse();
    }
    let [long, other] = [a.length() * scale, b.length()];
    let tie = (long - other).abs() <= TIE * long.max(other);
    let what = format!("{way:?}: {mine:?} became {theirs:?}");
    require(tie, "alike-length", || format!("{what}, {long} long and {other}"))?;
    Ok((mine != theirs).then_some(what))
}

#[cfg(test)]
mod tests {
    use super::super::tests::Case;
    use super::*;
    use crate::engine::wound::Mode;

    fn formed() -> Form {
        let case = Case::new(Mode::Carve);
        let eye = case.ran.cut().expect("a cut").eye;
        form(case.before.clone(), &case.event, eye)
    }

    fn broken(form: &Form) -> String {
        let found = compare(Way::Turned, &formed(), form).expect_err("it is doctored");
        found.check
    }

    #[test]
    fn another_length_another_line_and_another_outcome_are_findings() {
        compare(Way::Turned, &formed(), &formed()).expect("they are the same");
        let mut other = formed();
        other.cut.as_mut().expect("a line").formed.chain.points[2].position *= 1.01;
        assert_eq!(broken(&other), "alike-length");
        // As long, through a place where it never was.
        let mut other = formed();
        other.cut.as_mut().expect("a line").formed.chain.points[2].at = At::Face(FaceId(0));
        assert_eq!(broken(&other), "alike-line");
        let mut other = formed();
        other.cut = Err(Rejection::new("grazing", "by hand"));
        assert_eq!(broken(&other), "alike-outcome");
    }
}
