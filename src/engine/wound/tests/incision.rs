//! CI: what a wound looks like, cuts over cuts, and that undoing leaves no trace.

use std::collections::BTreeMap;

use super::kit::{applied, assert_sound, carved, cut, mode, plate, run, sphere, state};
use crate::engine::wound::carve::opening::{cod_cm, depth_cm};
use crate::engine::wound::{Mode, Pick, State, Wound, WoundEvent};
use crate::engine::{Engine, Start};
use crate::mesh::{FaceId, IndexedMesh, Surface};
use crate::report::{Buffer, Outcome, Overlay};

fn buffers(state: &State) -> Vec<Buffer> {
    Wound::buffers(state)
}

fn apply(state: &mut State, from: Pick, to: Pick) {
    let (outcome, why) = cut(state, from, to);
    assert_eq!(outcome, Outcome::Applied, "{why}");
    assert_sound(state);
}

#[test]
fn an_incision_is_as_wide_and_deep_as_its_length_asks() {
    let mut state = state(&sphere(4));
    let carved = carved(&mut state, Pick::Pixel([290.0, 170.0]), Pick::Pixel([350.0, 190.0]));
    let (length, depth) = (carved.length, depth_cm(carved.length));
    assert!((3.0..12.0).contains(&length), "{length}");
    let middle = carved.opened[carved.middle];
    let (l, r, g) = (middle.left, middle.right, middle.bottom);
    let width = state.mesh.position(l).distance(state.mesh.position(r));
    assert!((width - cod_cm(length, depth)).abs() < 1e-13, "{width}");
    assert!((state.mesh.position(g).distance(middle.at) - depth).abs() < 1e-12);
    assert!(state.mesh.position(g).length() < 10.0 - 0.9 * depth, "the gutter does not go inwards");
    assert_eq!((carved.narrowed, carved.shallowed), (0, 0));
    assert!(carved.gutter.iter().all(|&f| state.mesh.face(f).surface == Surface::Gutter));
    assert!((middle.s - length * 0.5).abs() < 1e-6 * length);
}

/// The sets of a group that a cut shows, by name.
fn shown(state: &mut State, group: &str) -> BTreeMap<String, Vec<u32>> {
    let event = WoundEvent::Cut { from: Pick::Pixel([290.0, 170.0]), to: Pick::Pixel([350.0, 190.0]) };
    let Start::Run(mut work) = Wound::start(state, &event, 0) else { panic!("{event:?} does not start") };
    applied(state, &mut work, &event);
    let overlays = Wound::show(state, &work).overlays;
    Wound::commit(state, &mut work);
    let sets = overlays.into_iter().filter(|overlay| overlay.group() == group);
    sets.filter_map(|set| match set {
        Overlay::Faces { name, faces } => Some((name, faces)),
        _ => None,
    })
    .collect()
}

#[test]
fn each_stage_shows_the_faces_that_it_worked_on() {
    let mut state = state(&sphere(4));
    let before = state.mesh.face_count() as u32;
    let stages = shown(&mut state, "stage");
    let of = |stage: &str| &stages[&format!("stage {stage}")];
    assert_eq!(stages.len(), 5);
    assert!(!of("FC").is_empty() && of("FC").iter().all(|face| *face < before && of("MC").contains(face)));
    assert!(of("MC").iter().any(|face| *face >= before), "MC divides");
    assert!(of("GP").iter().all(|face| of("PP").contains(face)) && of("GP").len() < of("PP").len());
    let gutter = |face: &&u32| state.mesh.face(FaceId(**face)).surface == Surface::Gutter;
    let all = (before..state.mesh.face_count() as u32).filter(|face| gutter(&face)).count();
    assert_eq!((of("CI").iter().filter(gutter).count(), all > 0), (all, true));
    mode(&mut state, Mode::Patch);
    let stages = shown(&mut state, "stage");
    assert!(stages["stage MC"].is_empty() && stages["stage CI"].is_empty() && !stages["stage FC"].is_empty());
}

#[test]
fn a_wound_in_a_thin_plate_does_not_come_out_at_the_back() {
    let mut thin = plate(10);
    thin.positions.iter_mut().for_each(|p| p.z *= 0.02);
    let mut state = state(&thin);
    let carved = carved(&mut state, Pick::Pixel([250.0, 170.0]), Pick::Pixel([380.0, 190.0]));
    let deepest = carved.opened.iter().map(|o| state.mesh.position(o.bottom).z).fold(0.0, f64::min);
    assert!(deepest < 0.0 && deepest > -0.08, "{deepest}");
    assert!(carved.shallowed > 0);
    assert_sound(&state);
}

#[test]
fn cuts_across_along_and_over_earlier_cuts_are_made() {
    for mesh in [sphere(3), plate(8)] {
        let mut state = state(&mesh);
        let (a, b) = (Pick::Pixel([280.0, 180.0]), Pick::Pixel([360.0, 184.0]));
        apply(&mut state, a, b);
        apply(&mut state, Pick::Pixel([322.0, 150.0]), Pick::Pixel([318.0, 212.0]));
        apply(&mut state, a, b);
        apply(&mut state, a, b);
        // A tee: from beside into the wound.
        apply(&mut state, Pick::Pixel([300.0, 150.0]), Pick::Pixel([300.0, 181.0]));
        apply(&mut state, Pick::Pixel([285.0, 181.5]), Pick::Pixel([350.0, 183.0]));
    }
}

#[test]
fn a_rejected_cut_leaves_no_trace() {
    let mut state = state(&sphere(3));
    apply(&mut state, Pick::Pixel([280.0, 180.0]), Pick::Pixel([360.0, 184.0]));
    let before = buffers(&state);
    // Too short to gape, found out by CI after MC has changed the mesh.
    let face = state.mesh_and_bvh().0.anchor(crate::mesh::NodeId(3));
    let (outcome, why) = cut(&mut state, Pick::Face(face, 0.3, 0.3), Pick::Face(face, 0.3001, 0.3));
    assert_eq!((outcome, why.split(':').next()), (Outcome::Rejected, Some("too-short-to-open")));
    assert_eq!(buffers(&state), before);
    assert_sound(&state);
}

#[test]
fn taking_back_and_doing_again_gives_the_same_bits() {
    let mut state = state(&sphere(3));
    let (mut states, mut patches) = (vec![buffers(&state)], Vec::new());
    for i in 0..6 {
        let i = f64::from(i);
        let event = match i as u32 {
            3 => WoundEvent::Subdivide { at: [310.0, 170.0], into: 6 },
            _ => WoundEvent::Cut {
                from: Pick::Pixel([280.0 + 5.0 * i, 150.0 + 9.0 * i]),
                to: Pick::Pixel([350.0 - 12.0 * i, 200.0 - 4.0 * i]),
            },
        };
        let Start::Run(mut work) = Wound::start(&mut state, &event, 0) else { panic!("{event:?}") };
        super::kit::applied(&mut state, &mut work, &event);
        patches.push(Wound::commit(&mut state, &mut work));
        states.push(buffers(&state));
    }
    for (patch, then) in patches.iter().zip(&states).rev() {
        Wound::revert(&mut state, patch);
        assert!(buffers(&state) == *then, "taking back changed something else");
        assert_sound(&state);
    }
    for (patch, then) in patches.iter().zip(&states[1..]) {
        Wound::apply(&mut state, patch);
        assert!(buffers(&state) == *then, "doing again did something else");
    }
    assert_sound(&state);
    // Picks see what is there, not what was.
    let again = run(
        &mut state,
        &WoundEvent::Cut { from: Pick::Pixel([300.0, 180.0]), to: Pick::Pixel([340.0, 160.0]) },
    );
    assert_eq!(again.0, Outcome::Applied, "{}", again.1);
}

#[test]
fn a_mesh_without_texture_coordinates_is_cut_as_well() {
    let bare = IndexedMesh { uvs: Vec::new(), face_uvs: Vec::new(), ..sphere(3) };
    let mut state = state(&bare);
    apply(&mut state, Pick::Pixel([280.0, 180.0]), Pick::Pixel([360.0, 184.0]));
}
