//! The sphere and the torus.
//!
//! The sphere is an icosahedron whose faces are cut into f² triangles and blown up: 20 f² faces. Its charts are five strips of
//! four faces of the icosahedron, from pole to pole. The torus is a grid of two angles, its one chart cut open along both.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use glam::{DVec2, DVec3, Vec2, dvec2, dvec3};

use super::atlas::{Atlas, GUTTER};
use crate::mesh::IndexedMesh;

/// Radius of the sphere.
const SPHERE_CM: f64 = 10.0;
/// Radii of the torus: of its middle circle and of its tube.
const TORUS_CM: [f64; 2] = [7.0, 2.5];
/// Cells of the torus around its axis and around its tube.
const TORUS_CELLS: [u32; 2] = [96, 36];

/// A sphere of about this many faces.
pub(super) fn sphere(faces: usize) -> IndexedMesh {
    let f = libm::round((faces as f64 / 20.0).sqrt()).max(1.0) as u32;
    let strip = dvec2(1.5, 1.5 * 3f64.sqrt());
    let atlas = Atlas::pack(&[strip; 5]);
    let mut ball = Ball { f, nodes: BTreeMap::new(), uvs: BTreeMap::new(), mesh: IndexedMesh::default() };
    for chart in 0..5 {
        for corners in strip_faces(chart) {
            ball.add(chart, corners, |p| atlas.uv(chart as usize, p));
        }
    }
    ball.mesh
}

/// A corner of the icosahedron, and its place in the strip.
type Corner = (u32, DVec2);

/// The four faces of a strip. Corners: 0 the upper pole, 1 to 5 the upper ring, 6 to 10 the lower, 11 the lower pole.
fn strip_faces(strip: u32) -> [[Corner; 3]; 4] {
    let row = 0.5 * 3f64.sqrt();
    let next = (strip + 1) % 5;
    let (top, bottom) = ((0, dvec2(0.5, 3.0 * row)), (11, dvec2(1.0, 0.0)));
    let (u0, u1) = ((1 + strip, dvec2(0.0, 2.0 * row)), (1 + next, dvec2(1.0, 2.0 * row)));
    let (l0, l1) = ((6 + strip, dvec2(0.5, row)), (6 + next, dvec2(1.5, row)));
    [[top, u0, u1], [u0, l0, u1], [u1, l0, l1], [l0, bottom, l1]]
}

/// Where a corner of the icosahedron lies on the unit sphere.
fn icosahedron(corner: u32) -> DVec3 {
    let (height, radius) = (1.0 / 5f64.sqrt(), 2.0 / 5f64.sqrt());
    let ring = |turn: f64, y: f64| {
        let (sin, cos) = libm::sincos(turn * TAU / 5.0);
        dvec3(radius * sin, y, radius * cos)
    };
    match corner {
        0 => DVec3::Y,
        11 => DVec3::NEG_Y,
        1..=5 => ring(f64::from(corner - 1), height),
        _ => ring(f64::from(corner - 6) + 0.5, -height),
    }
}

struct Ball {
    f: u32,
    /// Nodes by the corners of the icosahedron that they lie between and how near they are to each, in the order of the corners.
    nodes: BTreeMap<[(u32, u32); 3], u32>,
    /// Texture coordinates by chart and node.
    uvs: BTreeMap<(u32, u32), u32>,
    mesh: IndexedMesh,
}

impl Ball {
    fn add(&mut self, chart: u32, corners: [Corner; 3], uv: impl Fn(DVec2) -> Vec2) {
        let f = self.f;
        let weights = (0..=f).flat_map(|i| (0..=i).map(move |j| [f - i, i - j, j]));
        let mut grid = Vec::new();
        for weights in weights {
            let node = self.node(corners, weights);
            let mix = (0..3).map(|k| corners[k].1 * f64::from(weights[k])).sum::<DVec2>();
            grid.push((node, self.uv(chart, node, uv(mix / f64::from(f)))));
        }
        let at = |i: u32, j: u32| i * (i + 1) / 2 + j;
        for (i, j) in (0..f).flat_map(|i| (0..=i).map(move |j| (i, j))) {
            let upright = [at(i, j), at(i + 1, j), at(i + 1, j + 1)];
            let hanging = (j < i).then(|| [at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
            for face in std::iter::once(upright).chain(hanging) {
                self.mesh.faces.push(face.map(|k| grid[k as usize].0));
                self.mesh.face_uvs.push(face.map(|k| grid[k as usize].1));
            }
        }
    }

    fn uv(&mut self, chart: u32, node: u32, uv: Vec2) -> u32 {
        let uvs = &mut self.mesh.uvs;
        *self.uvs.entry((chart, node)).or_insert_with(|| {
            uvs.push(uv);
            uvs.len() as u32 - 1
        })
    }

    fn node(&mut self, corners: [Corner; 3], weights: [u32; 3]) -> u32 {
        let mut key = [0, 1, 2].map(|k| if weights[k] == 0 { (0, 0) } else { (corners[k].0, weights[k]) });
        key.sort_unstable();
        let positions = &mut self.mesh.positions;
        *self.nodes.entry(key).or_insert_with(|| {
            let p: DVec3 = key.iter().map(|&(corner, weight)| icosahedron(corner) * f64::from(weight)).sum();
            positions.push(p.normalize() * SPHERE_CM);
            positions.len() as u32 - 1
        })
    }
}

/// The torus, its axis along z.
pub(super) fn torus() -> IndexedMesh {
    let [around, tube] = TORUS_CELLS;
    let mut mesh = IndexedMesh::default();
    for (i, j) in (0..around).flat_map(|i| (0..tube).map(move |j| (i, j))) {
        mesh.positions.push(torus_point(i, j));
    }
    let height = TORUS_CM[1] / TORUS_CM[0] * (1.0 - 2.0 * GUTTER);
    for (i, j) in (0..=around).flat_map(|i| (0..=tube).map(move |j| (i, j))) {
        let share = dvec2(f64::from(i) / f64::from(around), f64::from(j) / f64::from(tube));
        let uv = share * dvec2(1.0 - 2.0 * GUTTER, height) + GUTTER;
        mesh.uvs.push(uv.as_vec2());
    }
    for (i, j) in (0..around).flat_map(|i| (0..tube).map(move |j| (i, j))) {
        let quad = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
        for face in [[quad[0], quad[1], quad[2]], [quad[0], quad[2], quad[3]]] {
            mesh.faces.push(face.map(|(i, j)| (i % around) * tube + j % tube));
            mesh.face_uvs.push(face.map(|(i, j)| i * (tube + 1) + j));
        }
    }
    mesh
}

fn torus_point(i: u32, j: u32) -> DVec3 {
    let turn = |k: u32, of: u32| libm::sincos(f64::from(k) * TAU / f64::from(of));
    let ((sin_i, cos_i), (sin_j, cos_j)) = (turn(i, TORUS_CELLS[0]), turn(j, TORUS_CELLS[1]));
    let out = TORUS_CM[0] + TORUS_CM[1] * cos_j;
    dvec3(out * cos_i, out * sin_i, TORUS_CM[1] * sin_j)
}
