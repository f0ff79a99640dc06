//! Each row of the table of repairs, and what is refused.

use glam::{DVec3, Vec2};

use super::*;
use crate::assets::error::Place;
use crate::assets::soup::{NO_UV, Polygons, Unit};

/// Faces of a cube with corners 0 to 7 (bits x, y, z), outside out.
const CUBE: [[u32; 4]; 6] =
    [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];

fn corner(i: u32, shift: f64) -> DVec3 {
    DVec3::new(f64::from(i & 1) + shift, f64::from(i >> 1 & 1), f64::from(i >> 2))
}

fn soup(positions: Vec<DVec3>, faces: &[&[u32]]) -> Soup {
    let mut polygons = Polygons::default();
    for (number, face) in faces.iter().enumerate() {
        polygons.corners.extend(face.iter().map(|&n| [n, NO_UV]));
        polygons.close(number as u32);
    }
    Soup::new(positions, Vec::new(), &polygons, Unit::Face).expect("valid indices")
}

fn cube() -> Vec<DVec3> {
    (0..8).map(|i| corner(i, 0.0)).collect()
}

fn built(positions: Vec<DVec3>, faces: &[&[u32]], rule: Rule) -> (Mesh, Vec<(String, usize)>) {
    let (mesh, notes) = build(soup(positions, faces), rule).expect("a mesh");
    (mesh, notes.into_iter().map(|n| (n.what, n.count)).collect())
}

fn volume(mesh: &Mesh) -> f64 {
    crate::assets::inspect(mesh).volume.expect("closed")
}

fn noted(notes: &[(String, usize)]) -> Vec<(&str, usize)> {
    notes.iter().map(|(what, count)| (what.as_str(), *count)).collect()
}

fn quads() -> Vec<&'static [u32]> {
    CUBE.iter().map(|f| f.as_slice()).collect()
}

#[test]
fn a_good_mesh_is_left_alone() {
    let (mesh, notes) = built(cube(), &quads(), Rule::Own);
    assert_eq!((mesh.face_count(), mesh.node_count(), noted(&notes)), (12, 8, vec![]));
    assert_eq!(volume(&mesh), 1.0);
}

#[test]
fn what_has_no_area_and_what_is_double_or_unused_is_dropped() {
    let mut positions = cube();
    positions.extend([DVec3::new(0.5, 0.0, 0.0), DVec3::splat(f64::NAN)]);
    let mut faces = quads();
    faces.extend([&[0, 0, 1][..], &[0, 1, 8], &[3, 1, 0], &[0, 2, 3]]);
    let (mesh, notes) = built(positions, &faces, Rule::Own);
    let expected =
        [("face-repeats-node", 1), ("face-without-area", 1), ("node-unused", 2), ("face-duplicate", 2)];
    assert_eq!((mesh.face_count(), mesh.node_count(), noted(&notes)), (12, 8, expected.to_vec()));
}

#[test]
fn faces_that_disagree_are_turned_to_enclose_a_positive_volume() {
    for turned in [1, 2, 4, 5] {
        let mut faces: Vec<Vec<u32>> = CUBE.iter().map(|f| f.to_vec()).collect();
        faces[..turned].iter_mut().for_each(|f| f.reverse());
        let faces: Vec<&[u32]> = faces.iter().map(Vec::as_slice).collect();
        let (mesh, notes) = built(cube(), &faces, Rule::Own);
        assert_eq!((volume(&mesh), noted(&notes)), (1.0, vec![("face-turned", 2 * turned)]));
    }
}

#[test]
fn an_open_part_goes_with_the_majority() {
    let mut faces: Vec<Vec<u32>> = CUBE[1..].iter().map(|f| f.to_vec()).collect();
    faces[0].reverse();
    let faces: Vec<&[u32]> = faces.iter().map(Vec::as_slice).collect();
    let (mesh, notes) = built(cube(), &faces, Rule::Own);
    assert_eq!(noted(&notes), [("face-turned", 2)]);
    assert_eq!(
        mesh.face(crate::mesh::FaceId(0)).nodes.map(|n| n.0),
        [6, 5, 7],
        "turned back, texture and all"
    );
}

#[test]
fn texture_coordinates_turn_with_their_face() {
    let mut soup = soup(cube(), &[&[0, 1, 3], &[0, 2, 3], &[2, 6, 3]]);
    soup.mesh.uvs = (0..8).map(|i| Vec2::new(i as f32, 0.0)).collect();
    soup.mesh.face_uvs = soup.mesh.faces.clone();
    let (mesh, _) = build(soup, Rule::Own).expect("a mesh");
    let x = |v: crate::mesh::VertexId| mesh.vertex(v).uv.x as u32;
    for face in mesh.faces() {
        let places = face.nodes.map(|n| mesh.position(n));
        assert_eq!(places, face.vertices.map(|v| corner(x(v), 0.0)));
    }
}

#[test]
fn a_closed_mesh_inside_out_is_turned() {
    let faces: Vec<Vec<u32>> = CUBE.iter().map(|f| f.iter().rev().copied().collect()).collect();
    let faces: Vec<&[u32]> = faces.iter().map(Vec::as_slice).collect();
    let (mesh, notes) = built(cube(), &faces, Rule::Own);
    assert_eq!((volume(&mesh), noted(&notes)), (1.0, vec![("inside-out", 12)]));
}

#[test]
fn a_node_with_two_fans_becomes_two() {
    let mut positions = cube();
    positions.extend((1..8).map(|i| -corner(i, 0.0)));
    let mirrored = |n: u32| if n == 0 { 0 } else { n + 7 };
    let other: Vec<Vec<u32>> = CUBE.iter().map(|f| f.iter().rev().map(|&n| mirrored(n)).collect()).collect();
    let mut faces = quads();
    faces.extend(other.iter().map(Vec::as_slice));
    let (mesh, notes) = built(positions, &faces, Rule::Own);
    assert_eq!((mesh.node_count(), noted(&notes)), (16, vec![("node-split", 1)]));
    assert_eq!((crate::assets::inspect(&mesh).components, volume(&mesh)), (2, 2.0));
}

#[test]
fn three_faces_at_an_edge_are_refused_by_name() {
    let positions = vec![DVec3::ZERO, DVec3::X, DVec3::Y, -DVec3::Y, DVec3::Z];
    let fault =
        build(soup(positions, &[&[0, 1, 2], &[1, 0, 3], &[0, 1, 4]]), Rule::Own).expect_err("crowded");
    assert_eq!((fault.kind, fault.place), (FaultKind::NotManifold, Place::Face(2)));
    assert!(fault.detail.contains("face 0, face 1, face 2"), "{}", fault.detail);
}

#[test]
fn a_moebius_strip_is_refused() {
    let positions: Vec<DVec3> = (0..10)
        .map(|k| {
            let (angle, side) = (f64::from(k / 2) * std::f64::consts::TAU / 5.0, f64::from(k % 2) - 0.5);
            let ((s, c), (sh, ch)) = (libm::sincos(angle), libm::sincos(angle / 2.0));
            DVec3::new((2.0 + side * ch) * c, (2.0 + side * ch) * s, side * sh)
        })
        .collect();
    let strip: Vec<[u32; 4]> = (0..5u32)
        .map(|k| if k < 4 { [2 * k, 2 * k + 1, 2 * k + 3, 2 * k + 2] } else { [8, 9, 0, 1] })
        .collect();
    let faces: Vec<&[u32]> = strip.iter().map(|f| f.as_slice()).collect();
    let fault = build(soup(positions, &faces), Rule::Own).expect_err("one side");
    assert_eq!(fault.kind, FaultKind::NotOrientable);
    assert!(matches!(fault.place, Place::Face(_)));
}

#[test]
fn a_coordinate_that_is_not_finite_is_refused_where_it_is_used() {
    let mut positions = cube();
    positions[6].y = f64::INFINITY;
    let fault = build(soup(positions, &quads()), Rule::Own).expect_err("infinite");
    assert_eq!((fault.kind, fault.place), (FaultKind::NotFinite, Place::Face(1)));
}

/// A cube with four nodes of its own for every face, moved along x.
fn loose_cube(shift: f64, positions: &mut Vec<DVec3>, faces: &mut Vec<Vec<u32>>) {
    for face in CUBE {
        let first = positions.len() as u32;
        positions.extend(face.map(|n| corner(n, shift)));
        faces.push((first..first + 4).collect());
    }
}

#[test]
fn loose_faces_are_welded_under_both_rules() {
    let (mut positions, mut faces) = (Vec::new(), Vec::new());
    loose_cube(0.0, &mut positions, &mut faces);
    let faces: Vec<&[u32]> = faces.iter().map(Vec::as_slice).collect();
    for rule in [Rule::Own, Rule::Position] {
        let (mesh, notes) = built(positions.clone(), &faces, rule);
        assert_eq!((mesh.node_count(), noted(&notes)), (8, vec![("welded", 16)]), "{rule:?}");
        assert_eq!(volume(&mesh), 1.0);
    }
}

#[test]
fn cubes_that_touch_stay_two() {
    // They share the edge x = 1, z = 1 in space, which would have four faces.
    let (mut positions, mut faces) = (Vec::new(), Vec::new());
    loose_cube(0.0, &mut positions, &mut faces);
    let second = positions.len();
    loose_cube(1.0, &mut positions, &mut faces);
    positions[second..].iter_mut().for_each(|p| p.z += 1.0);
    let faces: Vec<&[u32]> = faces.iter().map(Vec::as_slice).collect();
    for rule in [Rule::Own, Rule::Position] {
        let (mesh, notes) = built(positions.clone(), &faces, rule);
        assert_eq!((mesh.node_count(), noted(&notes)), (16, vec![("welded", 32)]), "{rule:?}");
        assert_eq!(crate::assets::inspect(&mesh).components, 2);
    }
}

#[test]
fn welding_that_would_crowd_an_edge_is_left_undone() {
    // Two flat squares back to back (file: two closed pillows), equal positions throughout.
    let positions: Vec<DVec3> = (0..8).map(|i| corner(i % 4, 0.0)).collect();
    let faces: [&[u32]; 4] = [&[0, 1, 3, 2], &[2, 3, 1, 0], &[4, 5, 7, 6], &[6, 7, 5, 4]];
    for rule in [Rule::Own, Rule::Position] {
        let (mesh, notes) = built(positions.clone(), &faces, rule);
        assert_eq!((mesh.node_count(), noted(&notes)), (8, vec![]), "{rule:?}");
    }
}

#[test]
fn a_stitch_that_closes_a_crowded_edge_is_undone() {
    // As two cubes that touch in an edge, but they share a node of a third face at both of its ends, so that stitching each cube
    // makes the ends one.
    let (mut positions, mut faces) = (Vec::new(), Vec::new());
    loose_cube(0.0, &mut positions, &mut faces);
    let second = positions.len();
    loose_cube(1.0, &mut positions, &mut faces);
    positions[second..].iter_mut().for_each(|p| p.z += 1.0);
    for (face, corner, shared) in [(8, 0, 10), (9, 0, 14)] {
        assert_eq!(positions[faces[face][corner] as usize], positions[shared]);
        faces[face][corner] = shared as u32;
    }
    let faces: Vec<&[u32]> = faces.iter().map(Vec::as_slice).collect();
    for rule in [Rule::Own, Rule::Position] {
        let (mesh, _) = built(positions.clone(), &faces, rule);
        assert_eq!((mesh.face_count(), crate::assets::inspect(&mesh).components), (24, 2), "{rule:?}");
    }
}

#[test]
fn under_their_own_rule_nodes_that_only_touch_stay_apart() {
    let mut positions: Vec<DVec3> = [[0., 0., 0.], [1., 0., 0.], [0., 1., 0.]].map(DVec3::from).to_vec();
    positions.extend([[0., 0., 0.], [-1., 0., 0.], [0., -1., 0.]].map(DVec3::from));
    let faces: [&[u32]; 2] = [&[0, 1, 2], &[3, 4, 5]];
    let (mesh, notes) = built(positions.clone(), &faces, Rule::Own);
    assert_eq!((mesh.node_count(), noted(&notes)), (6, vec![]));
    // Under the other they are welded, and split again as a node with two fans.
    let (mesh, _) = built(positions, &faces, Rule::Position);
    assert_eq!(mesh.node_count(), 6);
}
