//! Plain floats with an epsilon: right where nothing is near, and wrong as they are expected to be.

use glam::DVec3;

use super::{Failure, SHARES, cut, epsilon, judge};
use crate::assets::builtin::builtin;
use crate::engine::wound::chain::At;
use crate::engine::wound::pick::{Picked, resolve};
use crate::engine::wound::{Pick, State};
use crate::measure::exact::{Question, Section};
use crate::measure::scaling::default_scene;
use crate::mesh::{FaceId, IndexedMesh, Mesh};

/// A strip of four squares, cut along their diagonals, shifted along x.
fn strip(shift: f64, lift: f64) -> Mesh {
    let positions = (0..10u32).map(|i| {
        let (column, row) = (i % 5, i / 5);
        let z = if i == 2 { lift } else { 0.0 };
        DVec3::new(shift + f64::from(column), f64::from(row), z)
    });
    let faces = (0..4u32).flat_map(|i| [[i, i + 1, i + 6], [i, i + 6, i + 5]]).collect();
    Mesh::build(&IndexedMesh { positions: positions.collect(), faces, ..IndexedMesh::default() })
        .expect("a strip")
}

fn picks(mesh: Mesh, picks: [Pick; 2]) -> (State, [Picked; 2]) {
    let mut state = State::new(mesh, default_scene());
    let picked = picks.map(|pick| resolve(&mut state, pick).expect("it is there"));
    (state, picked)
}

/// From the first square to the last, a little above the lower border.
fn across(shift: f64, above: f64) -> (State, [Picked; 2], DVec3) {
    let mesh = strip(shift, 0.0);
    let ends = [Pick::Face(FaceId(0), 0.5, above), Pick::Face(FaceId(6), 0.25, above)];
    let (state, picked) = picks(mesh, ends);
    (state, picked, DVec3::new(shift + 2.0, above, 9.0))
}

#[test]
fn both_kinds_of_floats_go_the_exact_way_where_nothing_is_near() {
    let (state, picked, eye) = across(0.0, 0.25);
    let section = Section::of(&state.mesh, &Question::of(eye, &picked)).expect("a section");
    let line = section.line().expect("a line");
    let [coarse, fine] = SHARES.map(|share| epsilon(&state.mesh, share));
    let chains = [cut::<f32>(&state.mesh, eye, &picked, coarse), cut::<f64>(&state.mesh, eye, &picked, fine)];
    for chain in chains.map(|chain| chain.expect("a line")) {
        assert_eq!(judge(&section, &line, &chain, fine), Ok(()));
        assert_eq!(chain.faces, line.faces);
        assert_eq!((chain.places.len(), chain.faces.len()), (8, 7));
    }
}

#[test]
fn what_is_within_epsilon_of_a_node_is_taken_for_it() {
    let (state, picked, eye) = across(0.0, 1e-3);
    let section = Section::of(&state.mesh, &Question::of(eye, &picked)).expect("a section");
    let line = section.line().expect("a line");
    let tight = cut::<f64>(&state.mesh, eye, &picked, 1e-6).expect("a line");
    assert_eq!(judge(&section, &line, &tight, 1e-6), Ok(()));
    let loose = cut::<f64>(&state.mesh, eye, &picked, 1e-2).expect("another line");
    assert!(loose.places[1..].iter().any(|place| matches!(place.0, At::Node(_))), "{loose:?}");
    assert_eq!(judge(&section, &line, &loose, 1e-2), Err(Failure::Moved));
    assert_eq!(judge(&section, &line, &loose, 1e-4), Err(Failure::WrongConstruct));
}

#[test]
fn far_from_the_origin_f32_fails_first() {
    let fails = |shift: f64| {
        let (state, picked, eye) = across(shift, 0.25);
        let [coarse, fine] = SHARES.map(|share| epsilon(&state.mesh, share));
        [
            cut::<f32>(&state.mesh, eye, &picked, coarse).err(),
            cut::<f64>(&state.mesh, eye, &picked, fine).err(),
        ]
        .map(|failure| failure.is_some_and(Failure::is_lost))
    };
    assert_eq!([0.0, 1e9].map(fails), [[false, false], [true, false]]);
}

#[test]
fn a_child_without_area_is_found() {
    // All of the strip in one line, as f32 sees it.
    let mut indexed = strip(0.0, 0.0).to_indexed();
    indexed.positions.iter_mut().for_each(|p| p.y *= 1e-50);
    let mesh = Mesh::build(&indexed).expect("a strip");
    let (state, picked) = picks(mesh, [Pick::Face(FaceId(0), 0.5, 0.25), Pick::Face(FaceId(0), 0.25, 0.25)]);
    let eye = DVec3::new(2.0, 0.0, 9.0);
    assert_eq!(cut::<f32>(&state.mesh, eye, &picked, 0.0).err(), Some(Failure::DegenerateChild));
}

#[test]
fn a_line_that_leaves_the_wedge_of_the_rays_is_found() {
    // Over the rim of a slab, from front to back.
    let indexed = builtin("slab").expect("a scene").mesh;
    let mut state = State::new(Mesh::build(&indexed).expect("a mesh"), default_scene());
    let eye = state.control.camera.eye();
    let ends =
        [FaceId(0), FaceId(40)].map(|face| resolve(&mut state, Pick::Face(face, 0.3, 0.3)).expect("it"));
    let section = Section::of(&state.mesh, &Question::of(eye, &ends)).expect("a section");
    let line = section.line().expect("a line");
    let wide = epsilon(&state.mesh, SHARES[1]);
    let chain = cut::<f64>(&state.mesh, eye, &ends, wide).expect("a line");
    assert_eq!(judge(&section, &line, &chain, wide), Ok(()));
}
