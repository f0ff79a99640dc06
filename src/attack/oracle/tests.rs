//! Each oracle fails where what it looks at is not so: a cut that holds is witnessed, then the witness is doctored.

use super::*;
use crate::attack::drive;
use crate::attack::trial::Trial;
use crate::engine::wound::chain::At;
use crate::engine::wound::{CameraChange, Mode, Pick, Work};
use crate::mesh::{FaceId, NodeId};
use crate::recording::{Keyed, Recording, SceneRef};
use crate::report::{Check, Outcome};

/// A cut that was applied, with all that an oracle asks for.
pub(super) struct Case {
    pub(super) ground: Ground,
    pub(super) before: State,
    pub(super) after: State,
    pub(super) event: WoundEvent,
    pub(super) ran: Ran,
    pub(super) earlier: Option<Earlier>,
    /// What led here.
    events: Vec<WoundEvent>,
}

const SEED: u64 = 7;

impl Case {
    /// The first cut between nodes of a sphere, seen from above, that is applied and has so many inner places.
    pub(super) fn new(mode: Mode) -> Self {
        let blank = Trial::blank(SceneRef::Builtin("sphere:320".into()), SEED);
        let ground = Ground::of(&blank).expect("there is such a scene");
        let above = CameraChange { azimuth: Some(0.3), zenith: Some(0.2), distance: Some(64.0) };
        let events = vec![WoundEvent::Camera(above), WoundEvent::Mode(mode)];
        let mut before = ground.state();
        events.iter().for_each(|event| drop(drive::run(&mut before, event, SEED, None)));
        Self::after_events(ground, before, events, None, |_| true)
    }

    fn after_events(
        ground: Ground,
        before: State,
        events: Vec<WoundEvent>,
        earlier: Option<Earlier>,
        fits: impl Fn(&Witness<'_>) -> bool,
    ) -> Self {
        let nodes = before.mesh.node_count();
        let pairs = (0..nodes).flat_map(|from| (0..nodes).map(move |to| [from, to].map(NodeId::of)));
        for [from, to] in pairs {
            let event = WoundEvent::Cut { from: Pick::Node(from), to: Pick::Node(to) };
            let mut after = before.clone();
            let ran = drive::run(&mut after, &event, SEED, None);
            let inner = ran.applied().map_or(0, |cut| cut.formed.chain.points.len());
            let witness = Witness {
                ground: &ground,
                before: &before,
                after: &after,
                event: &event,
                seed: SEED,
                key: 2,
                ran: &ran,
                earlier: earlier.as_ref(),
            };
            if inner > 4 && fits(&witness) {
                return Self { ground, before, after, event, ran, earlier, events };
            }
        }
        panic!("no such cut")
    }

    /// The same with a further cut that has nothing to do with this one.
    fn with_another(self) -> Self {
        let earlier = Earlier::of(self.before, &self.event, SEED, &self.ran, &self.after);
        let apart = |witness: &Witness<'_>| {
            let mut hits = Hits::default();
            commute::look(witness, &mut hits).is_ok() && hits.0.contains_key("oracle commute")
        };
        Self::after_events(self.ground, self.after, Vec::new(), earlier, apart)
    }

    pub(super) fn witness(&self) -> Witness<'_> {
        Witness {
            ground: &self.ground,
            before: &self.before,
            after: &self.after,
            event: &self.event,
            seed: SEED,
            key: 2,
            ran: &self.ran,
            earlier: self.earlier.as_ref(),
        }
    }

    /// Moves a node by the least that there is.
    fn nudge(&mut self, node: usize) {
        let mesh = &mut self.after.mesh;
        let mut at = mesh.position(NodeId::of(node));
        // Of a coordinate of zero the next float would vanish when it is scaled.
        let axis = at.abs().max_position();
        at[axis] = at[axis].next_up();
        mesh.set_position(NodeId::of(node), at);
    }

    /// Says of a place in the middle of the line that it is another.
    fn misplace(&mut self) {
        let Some(Work::Cut(cut)) = &mut self.ran.work else { panic!("no cut") };
        cut.formed.chain.points[2].at = At::Face(FaceId(0));
    }
}

fn broken(verdict: Verdict) -> String {
    verdict.expect_err("it is doctored").check
}

#[test]
fn a_cut_that_holds_has_no_finding() {
    for mode in [Mode::Carve, Mode::Merge, Mode::Patch] {
        let case = Case::new(mode);
        let mut hits = Hits::default();
        look(&case.witness(), &mut hits).expect("no finding");
        for oracle in ["oracle exact", "oracle alike", "oracle rational"] {
            assert!(hits.0.contains_key(oracle), "{oracle}: {hits:?}");
        }
    }
}

#[test]
fn an_invariant_that_broke_is_a_finding() {
    let mut case = Case::new(Mode::Carve);
    case.ran.broken.push(("FC", Check::fail("planted", "by hand")));
    assert_eq!(broken(invariants::look(&case.witness())), "FC/planted");
}

#[test]
fn a_trace_that_is_left_is_a_finding() {
    let mut case = Case::new(Mode::Carve);
    case.nudge(0);
    assert_eq!(broken(trace::look(&case.witness())), "undo");
    (case.ran.edit, case.ran.outcome) = (None, Outcome::Rejected);
    assert_eq!(broken(trace::look(&case.witness())), "no-trace");
}

#[test]
fn elements_area_and_volume_that_do_not_come_out_are_findings() {
    let mut case = Case::new(Mode::Merge);
    let node = NodeId::of(case.after.mesh.node_count() - 1);
    let at = case.after.mesh.position(node);
    case.after.mesh.set_position(node, at * 1.001);
    assert_eq!(broken(census::look(&case.witness())), "area");
    case.after = case.before.clone();
    assert_eq!(broken(census::look(&case.witness())), "census");
}

#[test]
fn a_last_bit_under_a_half_turn_is_a_finding() {
    let mut case = Case::new(Mode::Carve);
    case.nudge(0);
    assert_eq!(broken(exact::look(&case.witness(), &mut Hits::default())), "exact-positions");
}

#[test]
fn another_line_than_the_rational_one_is_a_finding() {
    let mut case = Case::new(Mode::Merge);
    case.misplace();
    assert_eq!(broken(rational::look(&case.witness(), &mut Hits::default())), "rational");
}

#[test]
fn another_surface_in_another_order_is_a_finding() {
    let mut case = Case::new(Mode::Carve).with_another();
    case.nudge(0);
    assert_eq!(broken(commute::look(&case.witness(), &mut Hits::default())), "commute");
}

#[test]
fn another_end_than_the_sessions_is_a_finding() {
    let mut case = Case::new(Mode::Carve);
    let events = case.events.iter().chain([&case.event]).cloned();
    let events = (0..).zip(events).map(|(key, event)| Keyed { key, event }).collect();
    let recording: Recording<WoundEvent> =
        Trial::blank(SceneRef::Builtin("sphere:320".into()), SEED).with_events(events);
    case.nudge(0);
    let verdict = session::look(&case.ground, &recording, &case.after, &mut Hits::default());
    assert_eq!(broken(verdict), "session-state");
}
