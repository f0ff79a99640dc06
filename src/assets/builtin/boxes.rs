//! Closed boxes with a regular grid on each side, six charts, and solids that a box is bent to.
//!
//! The nodes of a side are the grid's own, so with a step that is a small dyadic number every coordinate is exact, and rows of nodes,
//! of edges and of diagonals lie exactly in line. Nodes are shared over the box's edges, texture coordinates are not.

use std::collections::BTreeMap;

use glam::{DVec2, DVec3, dvec2};

use super::atlas::Atlas;
use crate::mesh::IndexedMesh;

/// A box around the origin.
#[derive(Clone, Copy)]
pub(super) struct Block {
    /// Cells along x, y and z.
    pub cells: [u32; 3],
    /// Size of a cell.
    pub step: DVec3,
}

/// A side: the axes of its grid, so that `across × up` points outwards, and whether it lies at the far end of the third axis.
const SIDES: [(usize, usize, usize, bool); 6] =
    [(0, 1, 2, true), (1, 0, 2, false), (1, 2, 0, true), (2, 1, 0, false), (2, 0, 1, true), (0, 2, 1, false)];

/// The surface of some boxes, each bent by a map of its own; six charts a box in one atlas.
pub(super) fn boxes<Bend: Fn(DVec3) -> DVec3>(blocks: &[(Block, Bend)]) -> IndexedMesh {
    let sides = |b: &Block| SIDES.map(|(across, up, ..)| b.size(across, up));
    let sizes: Vec<DVec2> = blocks.iter().flat_map(|(b, _)| sides(b)).collect();
    let atlas = Atlas::pack(&sizes);
    let mut mesh = IndexedMesh::default();
    for (k, (block, bend)) in blocks.iter().enumerate() {
        let mut nodes = BTreeMap::new();
        for (side, &axes) in SIDES.iter().enumerate() {
            let chart = k * SIDES.len() + side;
            add_side(&mut mesh, &mut nodes, block, bend, axes, |p| atlas.uv(chart, p));
        }
    }
    mesh
}

impl Block {
    fn size(&self, across: usize, up: usize) -> DVec2 {
        let length = |axis: usize| f64::from(self.cells[axis]) * self.step[axis];
        dvec2(length(across), length(up))
    }

    fn place(&self, at: [u32; 3]) -> DVec3 {
        let along = |axis: usize| (f64::from(at[axis]) - 0.5 * f64::from(self.cells[axis])) * self.step[axis];
        DVec3::new(along(0), along(1), along(2))
    }
}

fn add_side(
    mesh: &mut IndexedMesh,
    nodes: &mut BTreeMap<[u32; 3], u32>,
    block: &Block,
    bend: &impl Fn(DVec3) -> DVec3,
    (across, up, out, far): (usize, usize, usize, bool),
    uv: impl Fn(DVec2) -> glam::Vec2,
) {
    let (w, h) = (block.cells[across], block.cells[up]);
    let first_uv = mesh.uvs.len() as u32;
    let mut grid = Vec::new();
    for (j, i) in (0..=h).flat_map(|j| (0..=w).map(move |i| (j, i))) {
        let mut at = [0; 3];
        (at[across], at[up], at[out]) = (i, j, if far { block.cells[out] } else { 0 });
        grid.push(*nodes.entry(at).or_insert_with(|| {
            mesh.positions.push(bend(block.place(at)));
            mesh.positions.len() as u32 - 1
        }));
        mesh.uvs.push(uv(dvec2(f64::from(i) * block.step[across], f64::from(j) * block.step[up])));
    }
    for (j, i) in (0..h).flat_map(|j| (0..w).map(move |i| (j, i))) {
        let corner = j * (w + 1) + i;
        for face in [[corner, corner + 1, corner + w + 2], [corner, corner + w + 2, corner + w + 1]] {
            mesh.faces.push(face.map(|k| grid[k as usize]));
            mesh.face_uvs.push(face.map(|k| first_uv + k));
        }
    }
}

/// A thin plate, 10 x 10 x 0.3 cm.
pub(super) fn slab() -> IndexedMesh {
    let block = Block { cells: [40, 40, 2], step: DVec3::new(0.25, 0.25, 0.15) };
    boxes(&[(block, |p| p)])
}

/// A box of 8 x 8 x 1 with a step of 1/4: every coordinate is a multiple of 1/4.
pub(super) fn grid() -> IndexedMesh {
    let block = Block { cells: [32, 32, 4], step: DVec3::splat(0.25) };
    boxes(&[(block, |p| p)])
}

/// Two upright fingers side by side, 1.5 cm thick and 7 cm long, 0.4 cm apart.
pub(super) fn two_fingers() -> IndexedMesh {
    const RADIUS_CM: f64 = 0.75;
    const APART_CM: f64 = 1.9;
    let block = Block { cells: [8, 36, 8], step: DVec3::new(1.5 / 8.0, 7.0 / 36.0, 1.5 / 8.0) };
    let finger = |x: f64| move |p: DVec3| capsule(p, 3.5, RADIUS_CM) + DVec3::X * x;
    boxes(&[(block, finger(-0.5 * APART_CM)), (block, finger(0.5 * APART_CM))])
}

/// Bends the surface of a box around the y axis, twice `half` high and twice `radius` wide, to a capsule: away from the middle of
/// the nearest cap, or from the axis. The tangent spaces the nodes evenly over an angle.
fn capsule(p: DVec3, half: f64, radius: f64) -> DVec3 {
    let core = DVec3::Y * p.y.clamp(radius - half, half - radius);
    let q = (p - core) / radius;
    let even = |c: f64| libm::tan(c * std::f64::consts::FRAC_PI_4);
    core + DVec3::new(even(q.x), even(q.y), even(q.z)).normalize() * radius
}
