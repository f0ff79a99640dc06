//! FC: which way the line goes, and why it does not.

use super::kit::{cut, formed, mode, plate, sphere, state};
use crate::engine::wound::chain::At;
use crate::engine::wound::{CameraChange, Mode, Pick, WoundEvent};
use crate::mesh::{FaceId, IndexedMesh, NodeId};
use crate::report::Outcome;

/// The node of a plate of n x n squares at column i and row j of its front.
fn at(n: u32, i: u32, j: u32) -> NodeId {
    NodeId(j * (n + 1) + i)
}

#[test]
fn along_a_row_of_exact_coordinates_the_line_runs_on_nodes_and_edges_alone() {
    let mut state = state(&plate(8));
    let chain = formed(&mut state, Pick::Node(at(8, 1, 4)), Pick::Node(at(8, 6, 4)));
    assert_eq!(chain.links.len(), 5);
    assert!((0..5).all(|i| chain.configuration(i) == "NN" && chain.is_along_edge(&state.mesh, i)));
    let nodes: Vec<At> = (1..=6).map(|i| At::Node(at(8, i, 4))).collect();
    assert_eq!(chain.points.iter().map(|p| p.at).collect::<Vec<_>>(), nodes);
}

#[test]
fn across_the_diagonals_the_line_alternates_between_nodes_and_edges() {
    let mut state = state(&plate(8));
    let chain = formed(&mut state, Pick::Node(at(8, 2, 6)), Pick::Node(at(8, 6, 2)));
    let letters: String = (0..chain.links.len()).map(|i| chain.configuration(i)).collect();
    assert_eq!(letters, "NEEN".repeat(4));
}

#[test]
fn of_two_ways_round_the_shorter_is_taken() {
    let mut state = state(&sphere(3));
    let chain = formed(&mut state, Pick::Pixel([300.0, 180.0]), Pick::Pixel([345.0, 190.0]));
    assert!(chain.length() < 20.0, "{}", chain.length());
    assert!(chain.points.iter().all(|p| p.position.z > 0.0), "it went round the back");
}

#[test]
fn two_picks_in_one_face_and_next_to_each_other_are_a_line() {
    let mut state = state(&sphere(2));
    let face = FaceId(3);
    let chain = formed(&mut state, Pick::Face(face, 0.3, 0.3), Pick::Face(face, 0.31, 0.29));
    assert_eq!((chain.links.len(), chain.configuration(0)), (1, "FF".into()));
    let [a, b, _] = state.mesh.face(face).nodes;
    let chain = formed(&mut state, Pick::Node(a), Pick::Node(b));
    assert_eq!((chain.links.len(), chain.configuration(0)), (1, "NN".into()));
}

#[test]
fn what_cannot_be_cut_says_why() {
    let reason = |mesh: &IndexedMesh, from, to| {
        let (outcome, why) = cut(&mut state(mesh), from, to);
        assert_eq!(outcome, Outcome::Rejected);
        why.split(':').next().unwrap_or("").to_owned()
    };
    let sphere = sphere(2);
    assert_eq!(reason(&sphere, Pick::Pixel([1.0, 1.0]), Pick::Pixel([320.0, 180.0])), "miss");
    assert_eq!(reason(&sphere, Pick::Pixel([320.0, 180.0]), Pick::Pixel([320.0, 180.0])), "degenerate-plane");
    assert_eq!(reason(&sphere, Pick::Node(NodeId(99_999)), Pick::Pixel([320.0, 180.0])), "no-such-element");
    let mut two = sphere.clone();
    two.positions.extend(sphere.positions.iter().map(|p| *p + glam::DVec3::new(25.0, 0.0, 0.0)));
    let n = sphere.positions.len() as u32;
    two.faces.extend(sphere.faces.iter().map(|f| f.map(|i| i + n)));
    two.face_uvs.clone_from(&two.faces);
    two.uvs.extend_from_within(..);
    assert_eq!(reason(&two, Pick::Pixel([240.0, 180.0]), Pick::Pixel([400.0, 181.0])), "other-component");
}

#[test]
fn an_open_mesh_is_cut_up_to_its_boundary_and_not_across_it() {
    // A horseshoe: the front of a plate without the lower part of its middle.
    let whole = plate(6);
    let keep = |f: &&[u32; 3]| f.iter().all(|&i| whole.positions[i as usize].z == 0.0);
    let sum = |f: &[u32; 3], axis: usize| f.iter().map(|&i| whole.positions[i as usize][axis]).sum::<f64>();
    let gap = |f: &&[u32; 3]| sum(f, 0).abs() > 6.0 || sum(f, 1) > 6.0;
    let faces: Vec<[u32; 3]> = whole.faces.iter().filter(keep).filter(gap).copied().collect();
    let mut mesh = IndexedMesh { positions: whole.positions.clone(), faces, ..IndexedMesh::default() };
    let used: Vec<bool> =
        (0..mesh.positions.len() as u32).map(|i| mesh.faces.iter().flatten().any(|&j| j == i)).collect();
    let renamed: Vec<u32> = used
        .iter()
        .scan(0, |n, &u| {
            let i = *n;
            *n += u32::from(u);
            Some(i)
        })
        .collect();
    mesh.faces.iter_mut().flatten().for_each(|i| *i = renamed[*i as usize]);
    let mut kept = used.iter();
    mesh.positions.retain(|_| kept.next() == Some(&true));
    let mut state = state(&mesh);
    mode(&mut state, Mode::Merge);
    let far = cut(&mut state, Pick::Pixel([240.0, 230.0]), Pick::Pixel([400.0, 231.0]));
    assert_eq!((far.0, far.1.split(':').next()), (Outcome::Rejected, Some("boundary")));
    mode(&mut state, Mode::Carve);
    let edge = (0..state.mesh.edge_count()).map(crate::mesh::EdgeId::of).find(|&e| {
        let nodes = state.mesh.edge(e).nodes.map(|n| state.mesh.position(n));
        state.mesh.edge(e).is_boundary() && nodes.iter().all(|p| p.x == -6.0)
    });
    let (outcome, why) = cut(&mut state, Pick::Edge(edge.unwrap(), 0.3), Pick::Pixel([250.0, 240.0]));
    assert_eq!(outcome, Outcome::Applied, "{why}");
}

#[test]
fn the_camera_says_what_a_pixel_is() {
    let mut state = state(&sphere(2));
    let before = formed(&mut state, Pick::Pixel([300.0, 150.0]), Pick::Pixel([340.0, 200.0]));
    super::kit::run(
        &mut state,
        &WoundEvent::Camera(CameraChange { azimuth: Some(1.0), zenith: None, distance: None }),
    );
    let after = formed(&mut state, Pick::Pixel([300.0, 150.0]), Pick::Pixel([340.0, 200.0]));
    assert!(before.points[0].position.distance(after.points[0].position) > 5.0);
}
