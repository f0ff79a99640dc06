//! What is finite is tested exhaustively: the nine configurations in all rotations of a face, in both directions, and the subdivisions.

use super::kit::{applied, assert_sound, mode, plate, run, sphere, state};
use crate::engine::wound::{Mode, Pick, State, WoundEvent};
use crate::engine::{Engine, Start, wound::Wound};
use crate::mesh::{FaceId, IndexedMesh, Mesh};
use crate::report::{Counter, Outcome};

/// A face that no other test's rounding has touched.
const FACE: FaceId = FaceId(17);

fn fresh(mesh: &IndexedMesh) -> State {
    let mut state = state(mesh);
    mode(&mut state, Mode::Merge);
    state
}

/// Picks of every class in a face: its corners, two points on each side, and points inside of each of its three thirds.
fn picks(mesh: &Mesh) -> Vec<(char, Pick)> {
    let face = mesh.face(FACE);
    let mut picks: Vec<(char, Pick)> = face.nodes.iter().map(|&n| ('N', Pick::Node(n))).collect();
    picks.extend(face.edges.iter().flat_map(|&e| [0.25, 0.7].map(|t| ('E', Pick::Edge(e, t)))));
    let inside = [(0.2, 0.2), (0.6, 0.2), (0.2, 0.6), (1.0 / 3.0, 1.0 / 3.0)];
    picks.extend(inside.map(|(u, v)| ('F', Pick::Face(FACE, u, v))));
    picks
}

/// Runs one cut through FC and MC with all their invariants, and gives the chain's configurations.
fn configurations(state: &mut State, from: Pick, to: Pick) -> Vec<(String, u64)> {
    let event = WoundEvent::Cut { from, to };
    let Start::Run(mut work) = Wound::start(state, &event, 0) else { panic!("{event:?} does not start") };
    applied(state, &mut work, &event);
    let shown = Wound::show(state, &work);
    Wound::commit(state, &mut work);
    match &shown.counters["configurations"] {
        Counter::ByName(names) => names.clone().into_iter().collect(),
        Counter::Count(_) => panic!("configurations are counted by name"),
    }
}

#[test]
fn every_pair_of_places_in_a_face_is_merged_as_one_link() {
    for mesh in [sphere(1), plate(3)] {
        let all = picks(&fresh(&mesh).mesh);
        let mut seen = std::collections::BTreeSet::new();
        for (i, &(a, from)) in all.iter().enumerate() {
            for (j, &(b, to)) in all.iter().enumerate().filter(|(j, _)| *j != i) {
                let mut state = fresh(&mesh);
                let faces = state.mesh.face_count();
                let found = configurations(&mut state, from, to);
                assert_eq!(found, [(format!("{a}{b}"), 1)], "{i} to {j}");
                assert_eq!(state.mesh.face_count() == faces, (a, b) == ('N', 'N'), "{i} to {j}");
                assert_sound(&state);
                seen.insert(found[0].0.clone());
            }
        }
        assert_eq!(seen.len(), 9);
    }
}

#[test]
fn a_second_point_on_a_spoke_of_the_first_is_merged() {
    // On exact coordinates the second point lies exactly between a corner and the first.
    let mesh = plate(3);
    for (u, v) in [(0.125, 0.125), (0.75, 0.125), (0.125, 0.75)] {
        let mut state = fresh(&mesh);
        let found = configurations(&mut state, Pick::Face(FACE, 0.25, 0.25), Pick::Face(FACE, u, v));
        assert_eq!(found, [("FF".to_owned(), 1)]);
        assert_sound(&state);
    }
}

#[test]
fn a_face_is_divided_into_three_four_and_six() {
    for (into, more) in [(3, 2), (4, 3 + 3), (6, 5 + 3)] {
        let mut state = state(&sphere(2));
        let faces = state.mesh.face_count();
        let (outcome, why) = run(&mut state, &WoundEvent::Subdivide { at: [320.0, 180.0], into });
        assert_eq!(outcome, Outcome::Applied, "{why}");
        assert_eq!(state.mesh.face_count(), faces + more);
        assert_sound(&state);
    }
}
