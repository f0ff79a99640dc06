//! Random cuts of every kind over each other: all invariants hold after each of them.

use std::collections::BTreeMap;

use super::kit::{Random, assert_sound, cut, mode, plate, run, sphere, state};
use crate::engine::wound::{CameraChange, Mode, Pick, State, WoundEvent};
use crate::mesh::{EdgeId, FaceId, NodeId};
use crate::report::Outcome;

fn random_pick(state: &State, random: &mut Random) -> Pick {
    match random.below(8) {
        0 => Pick::Node(NodeId::of(random.below(state.mesh.node_count()))),
        1 => Pick::Edge(EdgeId::of(random.below(state.mesh.edge_count())), random.unit()),
        2 => {
            let (u, v) = (random.unit(), random.unit());
            let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
            Pick::Face(FaceId::of(random.below(state.mesh.face_count())), u, v)
        }
        _ => Pick::Pixel([180.0 + 280.0 * random.unit(), 30.0 + 300.0 * random.unit()]),
    }
}

/// A pick near another one.
fn near(state: &State, random: &mut Random, pick: Pick) -> Pick {
    match pick {
        Pick::Pixel([x, y]) => {
            Pick::Pixel([x + 60.0 * (random.unit() - 0.5), y + 60.0 * (random.unit() - 0.5)])
        }
        Pick::Node(n) => {
            let face = state.mesh.face(state.mesh.anchor(n));
            let across = state.mesh.edge(face.edges[random.below(3)]).other_face(state.mesh.anchor(n));
            Pick::Node(across.some().map_or(face.nodes[0], |f| state.mesh.face(f).nodes[random.below(3)]))
        }
        Pick::Edge(e, _) => {
            Pick::Edge(state.mesh.face(state.mesh.edge(e).faces[0]).edges[random.below(3)], random.unit())
        }
        Pick::Face(f, ..) => {
            let across = state.mesh.edge(state.mesh.face(f).edges[random.below(3)]).other_face(f);
            Pick::Face(across.some().unwrap_or(f), 0.3, 0.3)
        }
    }
}

fn stress(state: &mut State, seed: u64, cuts: usize) -> BTreeMap<String, usize> {
    let mut random = Random(seed);
    let mut outcomes = BTreeMap::new();
    for i in 0..cuts {
        let a = std::f64::consts::TAU * random.unit();
        run(
            state,
            &WoundEvent::Camera(CameraChange {
                azimuth: Some(a),
                zenith: Some(0.3 + 2.5 * random.unit()),
                distance: None,
            }),
        );
        mode(state, if i % 3 == 0 { Mode::Merge } else { Mode::Carve });
        let from = random_pick(state, &mut random);
        let to = if random.below(2) == 0 {
            near(state, &mut random, from)
        } else {
            random_pick(state, &mut random)
        };
        let (outcome, why) = cut(state, from, to);
        let key = match outcome {
            Outcome::Applied => "applied".to_owned(),
            _ => why.split(':').next().unwrap_or("").to_owned(),
        };
        *outcomes.entry(key).or_insert(0) += 1;
        if i % 50 == 0 {
            assert_sound(state);
        }
    }
    assert_sound(state);
    outcomes
}

#[test]
fn random_cuts_on_a_sphere_keep_every_invariant() {
    let mut state = state(&sphere(3));
    assert!(stress(&mut state, 1, 300)["applied"] > 100);
}

#[test]
fn random_cuts_on_exact_coordinates_keep_every_invariant() {
    let mut state = state(&plate(8));
    assert!(stress(&mut state, 2, 300)["applied"] > 80);
}
