//! Lines that can be told without computing, and distances that were planted.

use glam::DVec3;

use crate::engine::wound::chain::At;
use crate::measure::exact::{Agreement, Datum, Disagreement, Line, Question, Refusal, Section, errors, line};
use crate::mesh::{EdgeId, FaceId, IndexedMesh, Mesh, NodeId};

/// An open sheet of n x n squares over the integers, each cut along its diagonal, at given heights.
pub(super) fn sheet(n: u32, height: impl Fn(u32, u32) -> f64) -> IndexedMesh {
    let at = |i: u32, j: u32| j * (n + 1) + i;
    let nodes = (0..=n).flat_map(|j| (0..=n).map(move |i| (i, j)));
    let positions = nodes.map(|(i, j)| DVec3::new(f64::from(i), f64::from(j), height(i, j))).collect();
    let squares = (0..n).flat_map(|j| (0..n).map(move |i| (i, j)));
    let faces = squares.flat_map(|(i, j)| {
        let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        [[a, b, c], [a, c, d]]
    });
    IndexedMesh { positions, faces: faces.collect(), ..IndexedMesh::default() }
}

fn flat(n: u32) -> Mesh {
    Mesh::build(&sheet(n, |_, _| 0.0)).expect("a sheet")
}

fn node(mesh: &Mesh, n: u32) -> Datum {
    Datum { through: mesh.position(NodeId(n)), at: At::Node(NodeId(n)) }
}

fn between(mesh: &Mesh, eye: DVec3, a: u32, b: u32) -> Result<Line, Refusal> {
    line(mesh, &Question { eye, picks: [node(mesh, a), node(mesh, b)] })
}

/// N, E and F of the places of a line.
fn letters(line: &Line) -> String {
    line.places.iter().map(|place| place.at.letter()).collect()
}

const ABOVE: DVec3 = DVec3::new(0.5, 0.25, 8.0);

#[test]
fn along_a_row_it_runs_over_nodes() {
    let mesh = flat(4);
    let line = between(&mesh, DVec3::new(2.0, 2.0, 8.0), 10, 14).expect("a line");
    assert_eq!(letters(&line), "NNNNN");
    let nodes: Vec<At> = (10..=14).map(|n| At::Node(NodeId(n))).collect();
    assert_eq!(line.places.iter().map(|place| place.at).collect::<Vec<_>>(), nodes);
}

#[test]
fn across_the_diagonals_nodes_and_edges_take_turns() {
    let mesh = flat(4);
    // From (0, 4) to (4, 0), against the diagonals of the squares.
    let line = between(&mesh, DVec3::new(2.0, 2.0, 8.0), 20, 4).expect("a line");
    assert_eq!(letters(&line), "NENENENEN");
    for place in line.places {
        let p = place.point.rounded();
        assert_eq!((p.x + p.y, p.z), (4.0, 0.0));
    }
}

#[test]
fn a_crossing_at_a_third_is_a_third() {
    let mesh = flat(1);
    // A wall at x = 1/3 through (1/3, …) cannot be spanned by floats; one through (0, 1) and (1/2, 0) meets the diagonal at a third.
    let bottom = EdgeId(0);
    assert_eq!(mesh.edge(bottom).nodes, [NodeId(0), NodeId(1)]);
    let picks = [node(&mesh, 2), Datum { through: DVec3::new(0.5, 0.0, 0.0), at: At::Edge(bottom) }];
    let question = Question { eye: DVec3::new(0.5, 0.0, 3.0), picks };
    let line = line(&mesh, &question).expect("a line");
    assert_eq!(letters(&line), "NEE");
    let third = line.places[1].point.rounded();
    assert_eq!(third, DVec3::new(1.0 / 3.0, 1.0 / 3.0, 0.0));
    let error = line.places[1].point.distance(third) / f64::EPSILON;
    assert!(
        (error - 2f64.sqrt() / 12.0).abs() < 1e-12,
        "a third is rounded by a twelfth of epsilon, twice: {error}"
    );
}

#[test]
fn a_planted_error_is_measured_in_full() {
    let mesh = flat(4);
    let question = Question { eye: DVec3::new(2.0, 2.0, 8.0), picks: [node(&mesh, 20), node(&mesh, 4)] };
    let line = line(&mesh, &question).expect("a line");
    let ulp = 4.0 * f64::EPSILON;
    let plant = |i: usize, by: DVec3| {
        let points = line.places.iter().enumerate();
        let planted = points.map(|(k, p)| (p.at, p.point.rounded() + if k == i { by } else { DVec3::ZERO }));
        errors(&mesh, &question, planted).expect("a section")
    };
    assert_eq!(plant(0, DVec3::ZERO).max_ulps, 0.0);
    let up = plant(3, DVec3::Z * 3.0 * ulp);
    assert_eq!((up.max_ulps, up.off_plane_ulps, up.off_element_ulps), (3.0, 0.0, 3.0));
    let along = plant(3, DVec3::new(5.0, -5.0, 0.0) * ulp);
    let reach = 5.0 * 2f64.sqrt();
    assert!((along.max_ulps - reach).abs() < 1e-12 && (along.mean_ulps - reach / 9.0).abs() < 1e-12);
    assert!(along.off_plane_ulps == 0.0 && (along.off_element_ulps - reach).abs() < 1e-12);
    let elsewhere = errors(&mesh, &question, [(At::Edge(EdgeId(0)), DVec3::ZERO)]).expect("a section");
    assert_eq!((elsewhere.points, elsewhere.misplaced), (1, 1));
}

#[test]
fn coplanar_faces_are_passed_along_their_border() {
    // A plateau of one height amid slopes; the plane is the plateau's own.
    let inner = |i: u32| (1..=3).contains(&i);
    let mesh = Mesh::build(&sheet(4, |i, j| if inner(i) && inner(j) { 1.0 } else { 0.0 })).expect("a sheet");
    let line = between(&mesh, DVec3::new(2.0, -9.0, 1.0), 6, 18).expect("a line");
    assert_eq!(letters(&line), "NNNNN");
    assert!(line.places.iter().all(|place| place.at != At::Node(NodeId(12))), "not over the middle");
    let inside = Datum { through: DVec3::new(1.75, 1.25, 1.0), at: At::Face(FaceId(10)) };
    let question = Question { eye: DVec3::new(2.0, -9.0, 1.0), picks: [inside, node(&mesh, 18)] };
    assert_eq!(letters(&self::line(&mesh, &question).expect("a line")), "FNNNN");
}

#[test]
fn the_boundary_ends_a_line_and_may_be_gone_along() {
    let mesh = flat(2);
    assert_eq!(
        between(&mesh, DVec3::new(1.0, 0.0, 5.0), 0, 2).expect("along it").faces,
        [FaceId(0), FaceId(2)]
    );
    // Two sheets that share no node.
    let mut two = sheet(1, |_, _| 0.0);
    two.positions.extend(two.positions.clone().iter().map(|p| *p + DVec3::X * 4.0));
    two.faces.extend(two.faces.clone().iter().map(|f| f.map(|n| n + 4)));
    let two = Mesh::build(&two).expect("two sheets");
    assert_eq!(between(&two, ABOVE, 0, 5), Err(Refusal::OtherComponent));
    // A horseshoe without the square between its ends.
    let mut horseshoe = sheet(3, |_, _| 0.0);
    horseshoe.faces.retain(|f| !f.iter().all(|n| [1, 2, 5, 6].contains(n)));
    let horseshoe = Mesh::build(&horseshoe).expect("a horseshoe");
    let ends = [[0.75, 0.5, 0.0], [2.75, 0.5, 0.0]].map(DVec3::from);
    let faces = [FaceId(0), FaceId(2)].map(At::Face);
    let picks = [0, 1].map(|i| Datum { through: ends[i], at: faces[i] });
    let eye = DVec3::new(1.5, 0.5, 9.0);
    assert_eq!(line(&horseshoe, &Question { eye, picks }), Err(Refusal::Boundary));
}

#[test]
fn what_is_no_question_is_told() {
    let mesh = flat(2);
    let question = |a: Datum, b: Datum| Question { eye: ABOVE, picks: [a, b] };
    let behind = Datum { through: (ABOVE + mesh.position(NodeId(0))) * 0.5, ..node(&mesh, 0) };
    assert_eq!(line(&mesh, &question(behind, node(&mesh, 0))), Err(Refusal::DegeneratePlane));
    let beside = Datum { through: DVec3::new(0.5, 0.75, 0.0), at: At::Face(FaceId(0)) };
    let refusal = line(&mesh, &question(node(&mesh, 8), beside));
    assert_eq!(refusal, Err(Refusal::NotPosed(At::Face(FaceId(0)))));
}

#[test]
fn a_wrong_way_is_told_from_the_right_one_and_from_one_as_long() {
    let mesh = flat(4);
    let question = Question { eye: DVec3::new(2.0, 2.0, 8.0), picks: [node(&mesh, 20), node(&mesh, 4)] };
    let section = Section::of(&mesh, &question).expect("a section");
    let line = section.line().expect("a line");
    let way: Vec<At> = line.places.iter().map(|place| place.at).collect();
    assert_eq!(section.compare_way(&line, &way, &line.faces), Ok(Agreement::Same));
    let jump = [way[..3].to_vec(), way[4..].to_vec()].concat();
    let faces = [line.faces[..3].to_vec(), line.faces[4..].to_vec()].concat();
    assert!(matches!(section.compare_way(&line, &jump, &faces), Err(Disagreement::NoArc { link: 2, .. })));
    let mut elsewhere = line.faces.clone();
    elsewhere[0] = FaceId(0);
    assert!(matches!(
        section.compare_way(&line, &way, &elsewhere),
        Err(Disagreement::Face { link: 0, found: FaceId(0), .. })
    ));
    assert!(matches!(
        section.compare_way(&line, &way[..5], &line.faces[..4]),
        Err(Disagreement::Ends { .. })
    ));
    // Round a plateau there are two ways.
    let inner = |i: u32| (1..=3).contains(&i);
    let plateau = Mesh::build(&sheet(4, |i, j| if inner(i) && inner(j) { 1.0 } else { 0.0 })).expect("it");
    let eye = DVec3::new(2.0, -9.0, 1.0);
    let question = Question { eye, picks: [node(&plateau, 6), node(&plateau, 18)] };
    let section = Section::of(&plateau, &question).expect("a section");
    let line = section.line().expect("a line");
    let round = |nodes: [u32; 5]| {
        let way = nodes.map(|n| At::Node(NodeId(n)));
        let faces =
            way.windows(2).map(|w| section.arcs(w[0]).iter().find(|a| a.to == w[1]).expect("it").face);
        section.compare_way(&line, &way, &faces.collect::<Vec<_>>())
    };
    let mut kinds = [round([6, 7, 8, 13, 18]), round([6, 11, 16, 17, 18])].map(|r| r.expect("as long"));
    kinds.sort();
    assert_eq!(kinds, [Agreement::Same, Agreement::EquallyLong]);
    let picks = [node(&plateau, 6), node(&plateau, 8)];
    let section = Section::of(&plateau, &Question { eye, picks }).expect("a section");
    let line = section.line().expect("a line");
    let way = [6, 11, 16, 17, 18, 13, 8].map(|n| At::Node(NodeId(n)));
    let faces = way.windows(2).map(|w| section.arcs(w[0]).iter().find(|a| a.to == w[1]).expect("it").face);
    let longer = section.compare_way(&line, &way, &faces.collect::<Vec<_>>());
    assert!(matches!(longer, Err(Disagreement::Longer { by: 4.0, .. })), "{longer:?}");
}
