//! The engine agrees with the exact way: in every configuration, on the built-in scenes, and on small meshes full of coincidences.

use std::collections::BTreeMap;

use glam::DVec3;
use proptest::prelude::*;

use super::known::sheet;
use crate::assets::builtin::builtin;
use crate::engine::wound::pick::resolve;
use crate::engine::wound::{Pick, State};
use crate::measure::Random;
use crate::measure::exact::{Agreement, Disagreement, compare};
use crate::measure::scaling::default_scene;
use crate::mesh::{EdgeId, FaceId, IndexedMesh, Mesh, NodeId};

fn state(mesh: &IndexedMesh) -> State {
    State::new(Mesh::build(mesh).expect("a mesh"), default_scene())
}

/// Compares the line between two picks; `None` where a pick meets nothing.
fn ask(state: &mut State, eye: DVec3, picks: [Pick; 2]) -> Option<Result<Agreement, Disagreement>> {
    let [from, to] = picks.map(|pick| resolve(state, pick).ok());
    Some(compare(&state.mesh, eye, &[from?, to?]))
}

/// Corners, two points of each side and points inside of a face.
fn places_of(mesh: &Mesh, face: FaceId) -> Vec<Pick> {
    let f = mesh.face(face);
    let nodes = f.nodes.map(Pick::Node);
    let edges = f.edges.into_iter().flat_map(|e| [0.25, 0.75].map(|t| Pick::Edge(e, t)));
    let inside = [(0.25, 0.25), (0.5, 0.25), (0.25, 0.5)].map(|(u, v)| Pick::Face(face, u, v));
    nodes.into_iter().chain(edges).chain(inside).collect()
}

#[test]
fn in_every_configuration_within_a_face_and_over_a_neighbour() {
    for name in ["grid", "sphere:20", "slab"] {
        let mut state = state(&builtin(name).expect("a scene").mesh);
        let eye = state.control.camera.eye();
        let across = |state: &State, side: usize| {
            let edge = state.mesh.face(FaceId(0)).edges[side];
            state.mesh.edge(edge).other_face(FaceId(0))
        };
        let mut seen = BTreeMap::new();
        for face in [FaceId(0), across(&state, 0), across(&state, 1), across(&state, 2)] {
            let (from, to) = (places_of(&state.mesh, FaceId(0)), places_of(&state.mesh, face));
            for (a, b) in from.iter().flat_map(|a| to.iter().map(move |b| (*a, *b))) {
                let result = ask(&mut state, eye, [a, b]).expect("it is there");
                let agreement = result.unwrap_or_else(|d| panic!("{name}: {a:?} to {b:?}: {d}"));
                *seen.entry(agreement).or_insert(0) += 1;
            }
        }
        assert!(seen[&Agreement::Same] > 200, "{name}: {seen:?}");
        assert!(seen[&Agreement::Refused] >= 12, "{name}: the same point twice: {seen:?}");
    }
}

fn any_pick(state: &State, random: &mut Random) -> Pick {
    let mesh = &state.mesh;
    match random.below(6) {
        0 => Pick::Node(NodeId::of(random.below(mesh.node_count()))),
        1 => Pick::Edge(EdgeId::of(random.below(mesh.edge_count())), random.within(0.01, 0.99)),
        2 => Pick::Face(FaceId::of(random.below(mesh.face_count())), 0.3, 0.4),
        _ => {
            let [a, b, c] = mesh.triangle(FaceId::of(random.below(mesh.face_count())));
            Pick::Pixel(state.control.camera.project((a + b + c) / 3.0).unwrap_or([0.0; 2]))
        }
    }
}

#[test]
fn on_the_built_in_scenes() {
    let mut seen = BTreeMap::new();
    for (part, name) in ["bust:2000", "sphere:500", "torus", "two-fingers", "grid", "slab"].iter().enumerate()
    {
        let mut state = state(&builtin(name).expect("a scene").mesh);
        let mut random = Random::of(7, part as u64, "exact");
        for _ in 0..20 {
            state.control.camera.azimuth = random.within(-3.0, 3.0);
            state.control.camera.zenith = random.within(0.1, 3.0);
            let eye = state.control.camera.eye();
            let picks = [any_pick(&state, &mut random), any_pick(&state, &mut random)];
            let Some(result) = ask(&mut state, eye, picks) else { continue };
            *seen
                .entry(result.unwrap_or_else(|d| panic!("{name}: {picks:?} from {eye}: {d}")))
                .or_insert(0) += 1;
        }
    }
    assert!(seen[&Agreement::Same] > 60, "{seen:?}");
}

/// A mesh with many coincidences, and a cut of it.
#[derive(Clone, Debug)]
struct Case {
    heights: Vec<u8>,
    holes: Vec<usize>,
    eye: [i8; 3],
    picks: [(u8, usize, u8); 2],
}

fn case() -> impl Strategy<Value = Case> {
    let eye = [-6..=9i8, -6..=9i8, -3..=9i8];
    let pick = || (0..3u8, 0..1000usize, 1..8u8);
    (
        proptest::collection::vec(0..3u8, 25),
        proptest::collection::vec(0..32usize, 0..4),
        eye,
        [pick(), pick()],
    )
        .prop_map(|(heights, holes, eye, picks)| Case { heights, holes, eye, picks })
}

impl Case {
    /// A sheet over a grid of integers, with integer heights and with holes; `None` where what is left is no mesh.
    fn state(&self) -> Option<State> {
        let mut mesh = sheet(4, |i, j| f64::from(self.heights[(j * 5 + i) as usize]));
        let mut face = 0;
        mesh.faces.retain(|_| {
            face += 1;
            !self.holes.contains(&(face - 1))
        });
        Some(State::new(Mesh::build(&mesh).ok()?, default_scene()))
    }

    fn pick(&self, mesh: &Mesh, (kind, index, eighths): (u8, usize, u8)) -> Pick {
        let t = f64::from(eighths) / 8.0;
        match kind {
            0 => Pick::Node(NodeId::of(index % mesh.node_count())),
            1 => Pick::Edge(EdgeId::of(index % mesh.edge_count()), t),
            _ => Pick::Face(FaceId::of(index % mesh.face_count()), t * 0.5, 0.25),
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(3000) })]

    #[test]
    fn on_small_meshes_full_of_coincidences(case in case()) {
        if let Some(mut state) = case.state() {
            let picks = case.picks.map(|pick| case.pick(&state.mesh, pick));
            let eye = DVec3::from(case.eye.map(f64::from));
            let answer = ask(&mut state, eye, picks).expect("elements that are there");
            prop_assert!(answer.is_ok(), "{picks:?}: {}", answer.expect_err("it"));
            // On eighths of integers nothing is rounded.
            prop_assert_ne!(answer, Ok(Agreement::NotPosed));
        }
    }
}
