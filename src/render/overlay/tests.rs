//! What is drawn over a frame: hidden where it is behind something, as wide as promised, and never a panic.

use glam::{DVec3, Vec2};

use super::*;
use crate::mesh::{FaceId, IndexedMesh};

const BLANK: [u8; 4] = [10, 10, 10, 255];

/// Two squares that face the eye, the smaller one 2 units nearer. On the map each has a half: the left one, and the right one.
fn mesh() -> Mesh {
    let square = |z: f64, r: f64| [(-r, -r), (r, -r), (r, r), (-r, r)].map(|(x, y)| DVec3::new(x, y, z));
    let half = |x: f32| [(0.0, 0.0), (0.5, 0.0), (0.5, 1.0), (0.0, 1.0)].map(|(u, v)| Vec2::new(u + x, v));
    let faces = vec![[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]];
    Mesh::build(&IndexedMesh {
        positions: [square(0.0, 2.0), square(2.0, 0.5)].concat(),
        face_uvs: faces.clone(),
        uvs: [half(0.0), half(0.5)].concat(),
        faces,
        ..IndexedMesh::default()
    })
    .expect("a mesh")
}

fn view() -> View {
    View {
        eye: DVec3::new(0.0, 0.0, 10.0),
        basis: [DVec3::X, DVec3::Y, DVec3::NEG_Z],
        fov_y: 0.5,
        size: [80, 60],
        near: 1.0,
        far: 20.0,
    }
}

fn drawn(drawings: &[Drawing<'_>]) -> Image {
    let mut image = Image::filled([80, 60], BLANK);
    draw(&mut image, &view(), &mesh(), drawings);
    image
}

fn mapped(drawings: &[Drawing<'_>]) -> Image {
    let mut image = Image::filled([32, 16], BLANK);
    draw_uv(&mut image, &mesh(), drawings);
    image
}

fn ids(names: &[&str]) -> Vec<String> {
    names.iter().map(|name| name.to_string()).collect()
}

fn changed(image: &Image) -> usize {
    image.texels.iter().filter(|texel| **texel != BLANK).count()
}

#[test]
fn a_line_is_hidden_where_something_is_before_it() {
    let line = Overlay::Line { name: "line".into(), points: vec![[-1.9, 0.0, 0.0], [1.9, 0.0, 0.0]] };
    let image = drawn(&[Drawing::Shown(&line)]);
    let row: Vec<bool> = (0..80).map(|x| image.at(x, 30)[..3] == LINE).collect();
    assert!(row[25] && row[55], "beside the nearer square it is seen");
    assert!(!row[40], "behind it it is not");
    assert!(!row[5] && !row[75], "it ends where it ends");
}

#[test]
fn a_line_is_as_wide_as_what_will_be_shown_as_one_pixel() {
    let line = Overlay::Line { name: "line".into(), points: vec![[-1.9, 0.0, 0.0], [1.9, 0.0, 0.0]] };
    let rows = |factor: u32| {
        let mut image = Image::filled([80, 60], BLANK);
        draw_supersampled(&mut image, &view(), &mesh(), &[Drawing::Shown(&line)], factor);
        (0..60).filter(|y| image.at(25, *y)[..3] == LINE).count()
    };
    assert_eq!([rows(0), rows(1), rows(3), rows(5)], [1, 1, 3, 5]);
}

#[test]
fn faces_are_tinted_where_they_are_nearest() {
    let faces = Overlay::Faces { name: "back".into(), faces: vec![0, 1, 77] };
    let image = drawn(&[Drawing::Shown(&faces)]);
    assert_ne!(image.at(25, 30), BLANK);
    assert_eq!(image.at(40, 30), BLANK);
    assert_eq!(image.at(2, 2), BLANK);
}

#[test]
fn nothing_far_out_or_behind_the_eye_is_drawn_and_nothing_panics() {
    let far = [[1e300, -1e300, 0.0], [-1e300, 1e300, 5.0], [0.0, 0.0, 11.0], [f64::NAN, 0.0, 0.0]];
    let line = Overlay::Line { name: "line".into(), points: far.to_vec() };
    let points = Overlay::Points { name: "picks".into(), points: far.to_vec() };
    let image = drawn(&[Drawing::Shown(&points)]);
    assert_eq!(changed(&image), 0);
    let marks = ids(&["f0", "e0", "n0", "v0"]);
    let all = [Drawing::Wire, Drawing::Charts, Drawing::Marked(&marks), Drawing::Shown(&line)];
    for size in [[0, 0], [1, 1], [1, 40]] {
        let mut image = Image::filled(size, BLANK);
        draw_supersampled(&mut image, &View { size, ..view() }, &mesh(), &all, 3);
        draw_uv(&mut image, &mesh(), &all);
    }
}

#[test]
fn wires_are_the_edges() {
    let image = drawn(&[Drawing::Wire]);
    assert!((100..600).contains(&changed(&image)), "{} pixels", changed(&image));
    assert_eq!(image.at(30, 29), BLANK, "not the inside of a face");
}

#[test]
fn charts_that_touch_have_different_colours() {
    let image = drawn(&[Drawing::Charts]);
    assert_eq!(image.at(2, 2), BLANK);
    assert_ne!(image.at(40, 30), image.at(25, 30));
    // Nine triangles in a ring round a point, none of which shares a vertex with the next, and a tenth that touches nothing: the ninth
    // would have the first one's colour by its number.
    let turn = |i: u32| libm::sincos(f64::from(i) * std::f64::consts::TAU / 9.0);
    let rim = (0..9).map(turn).map(|(s, c)| DVec3::new(c, s, 0.0));
    let away = [5.0, 6.0, 7.0].map(|x| DVec3::new(x, x * x, 0.0));
    let faces: Vec<[u32; 3]> = (0..9).map(|i| [0, i + 1, (i + 1) % 9 + 1]).chain([[10, 11, 12]]).collect();
    let uvs: Vec<Vec2> = (0..30).map(|i| Vec2::new(i as f32, (i * i) as f32)).collect();
    let fan = IndexedMesh {
        positions: [DVec3::ZERO].into_iter().chain(rim).chain(away).collect(),
        face_uvs: (0..10).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect(),
        faces,
        uvs,
        ..IndexedMesh::default()
    };
    let fan = Mesh::build(&fan).expect("a fan");
    let colours = chart_colours(&fan);
    let pairs = fan.edges().iter().filter(|e| !e.is_boundary()).map(|e| e.faces);
    assert_eq!(pairs.clone().count(), 9);
    assert!(pairs.into_iter().all(|[a, b]| colours[a.at()] != colours[b.at()]));
}

#[test]
fn a_marked_face_is_found_even_behind_another() {
    let marks = ids(&["f0", "f1"]);
    let image = drawn(&[Drawing::Marked(&marks)]);
    let strength = |x: u32, y: u32| i32::from(image.at(x, y)[0]) - i32::from(BLANK[0]);
    assert!(strength(25, 30) > 100, "in sight: {}", strength(25, 30));
    assert!((20..90).contains(&strength(40, 30)), "behind the nearer square: {}", strength(40, 30));
    assert_eq!(strength(2, 2), 0);
    assert!((0..80).any(|x| image.at(x, 30)[..3] == MARK), "it has an outline");
    assert_ne!(image.at(35, 25)[..3], MARK, "but none between two marked faces");
}

#[test]
fn marked_edges_and_nodes_are_found_even_behind_a_face() {
    let diagonal = mesh().edges().iter().position(|edge| edge.nodes.iter().all(|n| [0, 2].contains(&n.0)));
    let marks = ids(&[&format!("e{}", diagonal.expect("the larger square's diagonal"))]);
    let image = drawn(&[Drawing::Marked(&marks)]);
    assert!((28..32).any(|x| image.at(x, 40)[..3] == MARK));
    let behind: Vec<_> = (35..45).map(|x| image.at(x, 30)).filter(|texel| *texel != BLANK).collect();
    assert!(!behind.is_empty() && behind.iter().all(|texel| texel[..3] != MARK), "{behind:?}");
    let [node, vertex] = ["n1", "v1"].map(|id| drawn(&[Drawing::Marked(&ids(&[id]))]));
    assert!(changed(&node) > 9);
    assert_eq!(node, vertex, "a vertex is where its node is");
}

#[test]
fn what_is_no_element_is_left_out() {
    let wrong =
        ["f4", "n8", "v8", "e10", "", "f", "f-", "f-1", "f+1", "x1", "f99999999999999", "é1", "f1 ", "F1"];
    assert_eq!(Marked::of(&mesh(), &ids(&wrong)), Marked::default());
    assert_eq!(changed(&drawn(&[Drawing::Marked(&ids(&wrong))])), 0);
    assert!(changed(&drawn(&[Drawing::Marked(&ids(&["t3,4", "f3"]))])) > 0);
}

#[test]
fn the_face_at_a_pixel_is_the_one_that_is_seen_there() {
    let (mesh, view) = (mesh(), view());
    let scene = Scene::new(&view, &mesh, 1);
    for (x, y) in (0..60).flat_map(|y| (0..80).map(move |x| (x, y))) {
        let at = [x as f64 + 0.5, y as f64 + 0.5];
        assert_eq!(face_at(&view, &mesh, at), scene.face([x, y]), "{at:?}");
    }
    for beside in [[-0.1, 5.0], [80.0, 5.0], [5.0, f64::NAN], [5.0, 60.5], [f64::INFINITY, 1.0]] {
        assert_eq!(face_at(&view, &mesh, beside), None);
    }
    let close = View { near: 9.0, ..view };
    assert_eq!(face_at(&close, &mesh, [44.5, 31.5]), Some(FaceId(0)), "what is too near is not seen");
}

#[test]
fn on_a_map_v_goes_up_and_seams_are_stronger() {
    let lower = mapped(&[Drawing::Marked(&ids(&["f0"]))]);
    assert!(lower.at(12, 12) != BLANK && lower.at(3, 3) == BLANK, "f0 lies below the diagonal");
    assert!((18..31).all(|x| (0..16).all(|y| lower.at(x, y) == BLANK)), "and on the left half");
    let wire = mapped(&[Drawing::Wire]);
    let darkness = |x: u32, y: u32| wire.at(x, y)[2];
    assert!(darkness(8, 0) > darkness(8, 7).max(darkness(8, 8)), "the border of a chart, and its diagonal");
    assert_eq!(darkness(3, 3), BLANK[2]);
}

#[test]
fn on_a_map_faces_and_charts_are_tinted_and_nodes_marked() {
    let faces = Overlay::Faces { name: "right".into(), faces: vec![2, 3, 99] };
    let image = mapped(&[Drawing::Shown(&faces)]);
    assert!((0..16).all(|y| (0..32).all(|x| (image.at(x, y) != BLANK) == (x >= 16))));
    let charts = mapped(&[Drawing::Charts]);
    assert!(charts.at(3, 3) != charts.at(30, 3) && changed(&charts) == 32 * 16);
    let [node, vertex] = ["n6", "v6"].map(|id| mapped(&[Drawing::Marked(&ids(&[id]))]));
    assert_eq!(node.at(1, 0)[..3], MARK, "maps repeat");
    assert_eq!(node, vertex);
}

#[test]
fn the_face_at_texture_coordinates_is_the_one_that_is_tinted_there() {
    let mesh = mesh();
    let sets: Vec<Image> = (0..4)
        .map(|face| mapped(&[Drawing::Shown(&Overlay::Faces { name: "one".into(), faces: vec![face] })]))
        .collect();
    for (x, y) in (0..32).flat_map(|x| (0..16).map(move |y| (x, y))) {
        // Beside the middle of the texel, where no two faces meet.
        let at = [(f64::from(x) + 0.52) / 32.0, 1.0 - (f64::from(y) + 0.51) / 16.0];
        let tinted = sets.iter().position(|image| image.at(x, y) != BLANK).map(FaceId::of);
        assert_eq!(face_at_uv(&mesh, at), tinted, "{x} {y}");
        assert_eq!(face_at_uv(&mesh, [at[0] + 3.0, at[1] - 2.0]), tinted, "maps repeat");
    }
    assert_eq!(face_at_uv(&mesh, [f64::NAN, 0.5]), None);
}

#[test]
fn a_face_in_several_sets_has_the_colour_of_the_last() {
    let set = |name: &str, faces: &[u32]| Overlay::Faces { name: name.into(), faces: faces.into() };
    let sets = [set("all", &[0, 1, 2, 3]), set("none", &[]), set("front", &[2, 3])];
    let drawings: Vec<Drawing<'_>> = sets.iter().map(Drawing::Shown).collect();
    assert_eq!(legend(&drawings), [("all", FACES[0]), ("front", FACES[2])]);
    let [all, both] = [&drawings[..1], &drawings].map(drawn);
    assert_eq!(all.at(25, 30), both.at(25, 30), "at the back");
    let mut front = BLANK;
    ink::blend(&mut front, FACES[2], share::FACE);
    assert_eq!(both.at(40, 30), front, "nothing of the colour below");
    assert_eq!(mapped(&drawings).at(20, 8), front);
}
