//! Coverage, silhouettes, and attributes in perspective.

use glam::{DVec3, Vec2};

use super::kit::{self, Stage};
use crate::assets::builtin::builtin;
use crate::canvas::frame::View;
use crate::mesh::{IndexedMesh, Mesh, Surface};
use crate::render::reference::lens::Lens;
use crate::render::reference::raster::{BAND, Drawing};
use crate::render::reference::surface::Facet;

/// Every pixel that is drawn, with its triangle.
fn drawn(mesh: &Mesh, view: &View) -> Vec<(usize, u32)> {
    let drawing = Drawing::new(mesh, &Lens::of_view(view));
    let band = view.size[0] as usize * BAND;
    let mut plotted = Vec::new();
    for i in 0..(view.size[1] as usize).div_ceil(BAND) {
        drawing.draw(i, |at, triangle, _| plotted.push((i * band + at, triangle)));
    }
    plotted
}

/// Numbers that look random, from 0 to below n.
fn random(seed: &mut u64, n: u64) -> f64 {
    *seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
    ((*seed >> 33) % n) as f64
}

/// A net of n x n places, moved at random by whole parts of a pixel, that covers the whole picture: half pixels let many
/// corners and sides meet centres.
fn net(view: &View, n: usize, part: f64, seed: &mut u64) -> Mesh {
    let [w, h] = view.size.map(f64::from);
    let focal = h / (2.0 * libm::tan(view.fov_y * 0.5));
    let mut indexed = IndexedMesh::default();
    for (i, j) in (0..n * n).map(|k| (k % n, k / n)) {
        let step = [(w + 8.0) / (n - 1) as f64, (h + 8.0) / (n - 1) as f64];
        let jitter =
            [0, 1].map(|axis| (random(seed, (0.4 * step[axis] / part) as u64 + 1) * part).floor_to(part));
        let x = (i as f64 * step[0] - 4.0).floor_to(part) + jitter[0] - 0.5 * w;
        let y = (j as f64 * step[1] - 4.0).floor_to(part) + jitter[1] - 0.5 * h;
        indexed.positions.push(view.eye + DVec3::new(x, -y, -focal));
    }
    for (i, j) in (0..(n - 1) * (n - 1)).map(|k| (k % (n - 1), k / (n - 1))) {
        let [a, b, c, d] = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)].map(|(i, j)| (j * n + i) as u32);
        indexed.faces.extend(if (i + j) % 2 == 0 { [[a, c, b], [a, d, c]] } else { [[a, d, b], [b, d, c]] });
    }
    Mesh::build(&indexed).expect("a net is a manifold")
}

trait FloorTo {
    fn floor_to(self, part: f64) -> f64;
}

impl FloorTo for f64 {
    fn floor_to(self, part: f64) -> f64 {
        (self / part).floor() * part
    }
}

#[test]
fn triangles_that_share_sides_cover_each_pixel_once() {
    let mut seed = 1;
    for part in [0.5, 0.25, 1.0 / 256.0, 1.0 / 1000.0] {
        for size in [[40, 30], [37, 17], [1, 1]] {
            let view = kit::view(size, 0.0);
            let mut view = View { far: 1e6, ..view };
            view.near = 1e-3;
            let mut times = vec![0; (size[0] * size[1]) as usize];
            drawn(&net(&view, 9, part, &mut seed), &view).iter().for_each(|(at, _)| times[*at] += 1);
            assert!(times.iter().all(|n| *n == 1), "{size:?}, {part}: {times:?}");
        }
    }
}

#[test]
fn a_wall_through_the_eye_covers_what_lies_before_it_once() {
    // From far behind the eye to far before it, and so wide that corners have to be clipped on all sides.
    let far = DVec3::new(-1e7, -1.0, 1e7);
    let mesh = kit::sheets(&[[far, DVec3::X * 2e7, DVec3::NEG_Z * 2e7]], Surface::Skin);
    let stage = Stage::new(mesh);
    let view = View { eye: DVec3::ZERO, far: 1e9, near: 1e-3, ..stage.view };
    let mut times = vec![0; 64 * 48];
    drawn(&stage.mesh, &view).iter().for_each(|(at, _)| times[*at] += 1);
    assert!(times[..64 * 24].iter().all(|n| *n == 0), "the sky");
    assert!(times[64 * 24..].iter().all(|n| *n == 1), "the ground: {:?}", &times[64 * 24..]);
}

#[test]
fn a_face_begins_where_it_is_near_enough() {
    // A path on the ground, one unit below the eye, 77.6 / y away y pixels below the middle: nothing nearer than 4.8 is seen.
    let path = [DVec3::new(-1.0, -1.0, -1.0), DVec3::X * 2.0, DVec3::NEG_Z * 40.0];
    let mesh = kit::sheets(&[path], Surface::Skin);
    let view = View { near: 4.8, ..kit::view([64, 48], 0.0) };
    let rows = || drawn(&mesh, &view).into_iter().map(|(at, _)| at / 64);
    assert_eq!([rows().min(), rows().max()], [Some(26), Some(39)]);
    assert_eq!(rows().filter(|row| *row == 39).count(), 31, "at 5.0 the path is 31 pixels wide");
}

#[test]
fn a_sphere_has_a_round_silhouette() {
    let mesh = Mesh::build(&builtin("sphere:2000").expect("it is there").mesh).expect("it is a mesh");
    let [lo, hi] = mesh.bounds();
    let (centre, r) = (0.5 * (lo + hi), 0.5 * (hi.y - lo.y));
    let mut stage = Stage::new(mesh);
    let d = 4.0 * r;
    stage.view =
        View { eye: centre + DVec3::Z * d, near: 0.1 * r, far: 10.0 * r, ..kit::view([150, 120], 0.0) };
    let focal = 60.0 / libm::tan(0.3);
    let radius = focal * r / (d * d - r * r).sqrt();
    let depth = stage.layers().depth;
    let mut covered = 0.0;
    for (at, depth) in depth.iter().enumerate() {
        let (x, y) = ((at % 150) as f64 + 0.5 - 75.0, (at / 150) as f64 + 0.5 - 60.0);
        let off = libm::hypot(x, y) - radius;
        covered += f64::from(u8::from(depth.is_finite()));
        // It has corners, so it is a little smaller than the sphere, and never larger.
        assert!(!depth.is_finite() || off < 0.01, "{off} pixels outside");
        assert!(depth.is_finite() || off > -0.02 * radius, "a hole {off} pixels inside");
    }
    assert!((covered / (std::f64::consts::PI * radius * radius) - 1.0).abs() < 0.02);
}

#[test]
fn attributes_are_perspective_correct() {
    let corner = DVec3::new(-2.0, -1.5, 3.0);
    let (u, v) = (DVec3::new(4.5, 0.5, -40.0), DVec3::new(0.3, 3.0, -1.0));
    let stage = Stage::new(kit::sheets(&[[corner, u, v]], Surface::Skin));
    let lens = Lens::of_view(&stage.view);
    let drawing = Drawing::new(&stage.mesh, &lens);
    let plotted = drawn(&stage.mesh, &stage.view);
    assert!(plotted.len() > 500);
    for (at, triangle) in plotted {
        let (x, y) = (at % 64, at / 64);
        let (ray, normal) = (stage.ray(x, y), u.cross(v));
        let t = (corner - stage.view.eye).dot(normal) / ray.dot(normal);
        let expected = stage.view.eye + ray * t;
        let point = Facet::new(&stage.mesh, drawing.triangle(triangle), &lens).meet(lens.ray(x, y));
        // Pixels that only the rounded corners cover have what is at the border.
        let slack = 1e-9 + 0.01 * t;
        assert!(
            (stage.view.eye + point.position - expected).length() < slack,
            "{point:?} {expected}",
            point = point.position
        );
        let (from, uu, vv, uv) = (expected - corner, u.dot(u), v.dot(v), u.dot(v));
        let det = uu * vv - uv * uv;
        let found = Vec2::new(point.uv[0] as f32, point.uv[1] as f32).as_dvec2();
        let exact =
            [(from.dot(u) * vv - from.dot(v) * uv) / det, (from.dot(v) * uu - from.dot(u) * uv) / det];
        assert!((found.x - exact[0]).abs() < 2e-3 && (found.y - exact[1]).abs() < 1e-2, "{found} {exact:?}");
    }
}

#[test]
fn the_nearest_surface_wins_whatever_the_order() {
    let sheets =
        [kit::square(DVec3::Z, 0.2), kit::square(DVec3::ZERO, 4.0), kit::square(DVec3::Z * -1.0, 9.0)];
    for order in [[0, 1, 2], [2, 1, 0], [1, 2, 0]] {
        let depth = Stage::new(kit::sheets(&order.map(|i| sheets[i]), Surface::Skin)).layers().depth;
        assert_eq!([depth[24 * 64 + 32], depth[0]], [4.0, 5.0]);
    }
}

#[test]
fn what_is_too_near_or_too_far_is_not_seen() {
    let mut stage = Stage::new(kit::wall());
    stage.view.far = 4.9;
    assert!(stage.layers().depth.iter().all(|d| d.is_infinite()));
    (stage.view.near, stage.view.far) = (5.1, 9.0);
    assert!(stage.layers().depth.iter().all(|d| d.is_infinite()));
}
