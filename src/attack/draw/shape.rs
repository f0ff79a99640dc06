//! Small meshes with hard-rounded coordinates: fans, strips, sheets, a ring with a hole, closed solids.
//!
//! Most are seen from straight above, where the eye is exact: a line over the middle then meets nodes, edges and upright faces exactly. Their
//! coordinates are small whole numbers, so that coincidences are the rule; `blemish` takes some of that away again by last bits, slivers and
//! points that nearly coincide. Nodes are numbered and faces are turned in an order that is drawn too: each configuration comes in
//! each rotation of a face's corners.

use glam::DVec3;

use super::{Dice, blemish};
use crate::geometry::predicates::collinear;
use crate::recording::InlineMesh;

/// Eight directions in order, and the points of a square there.
const COMPASS: [[f64; 2]; 8] =
    [[1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [-1.0, 1.0], [-1.0, 0.0], [-1.0, -1.0], [0.0, -1.0], [1.0, -1.0]];

/// Positions and triangles, counter-clockwise from outside.
#[derive(Clone, Debug, Default)]
pub(in super::super) struct Shape {
    pub(in super::super) nodes: Vec<DVec3>,
    pub(in super::super) faces: Vec<[u32; 3]>,
}

/// Draws a mesh.
pub(in super::super) fn draw(dice: &mut Dice<'_>) -> InlineMesh {
    let plain = plain(dice);
    let mut shape = plain.clone();
    blemish::draw(&mut shape, dice);
    if !is_sound(&shape.nodes, &shape.faces) {
        shape = plain;
    }
    shape.renumber(dice);
    shape.inline(dice)
}

/// Whether a reader would take a mesh: no face's corners lie on one line.
pub(in super::super) fn has_area(mesh: &InlineMesh) -> bool {
    let nodes: Vec<DVec3> = mesh.nodes.iter().map(|&p| DVec3::from(p)).collect();
    is_sound(&nodes, &mesh.faces)
}

fn is_sound(nodes: &[DVec3], faces: &[[u32; 3]]) -> bool {
    let corners = |f: &[u32; 3]| f.map(|i| nodes[i as usize]);
    faces.iter().map(corners).all(|[a, b, c]| !collinear(a, b, c))
}

/// One without blemishes.
pub(in super::super) fn plain(dice: &mut Dice<'_>) -> Shape {
    match dice.below(9) {
        0 => fan(dice),
        1 | 2 => sheet(dice),
        3 | 8 => stairs(dice),
        4 => ring(dice),
        5 => plate(dice),
        6 => bipyramid(dice),
        _ => tetrahedron(dice),
    }
}

/// A point over the plane of x and z, which is seen from above with `p` to the bottom and `q` to the right.
fn over([p, q]: [f64; 2], height: f64) -> DVec3 {
    DVec3::new(q, height, p)
}

fn height(dice: &mut Dice<'_>) -> f64 {
    dice.one_of([0.0, 0.0, 1.0, -1.0, 2.0, 0.5])
}

/// Faces around a node, all or but one.
fn fan(dice: &mut Dice<'_>) -> Shape {
    let corners: &[usize] =
        dice.one_of([&[0, 3, 5], &[0, 2, 4, 6], &[1, 3, 5, 7], &[0, 1, 3, 4, 6], &[0, 1, 2, 3, 4, 5, 6, 7]]);
    let mut shape = Shape { nodes: vec![over([0.0; 2], height(dice))], faces: Vec::new() };
    shape.nodes.extend(corners.iter().map(|&c| over(COMPASS[c].map(|v| 2.0 * v), height(dice))));
    let (n, open) = (corners.len() as u32, u32::from(dice.once_in(3)));
    shape.faces.extend((0..n - open).map(|i| [0, 1 + i, 1 + (i + 1) % n]));
    shape
}

/// A sheet of rows and columns: flat, or of small whole heights.
fn sheet(dice: &mut Dice<'_>) -> Shape {
    let (rows, columns) = (1 + dice.below(4), 1 + dice.below(4));
    let flat = dice.once_in(2);
    let mut heights = Vec::new();
    heights.resize_with((rows + 1) * (columns + 1), || if flat { 0.0 } else { height(dice) });
    let at = |i: usize, j: usize| {
        let place = [2.0 * i as f64 - rows as f64, 2.0 * j as f64 - columns as f64];
        over(place, heights[i * (columns + 1) + j])
    };
    quads(rows, columns, at, dice)
}

/// A sheet with upright risers, one of them in the middle: faces that lie in a plane through the eye.
fn stairs(dice: &mut Dice<'_>) -> Shape {
    const PROFILE: [[f64; 2]; 6] = [[-4.0, 0.0], [-2.0, 0.0], [0.0, 0.0], [0.0, 2.0], [2.0, 2.0], [4.0, 2.0]];
    let rows = 1 + dice.below(3);
    let at = |i: usize, j: usize| over([2.0 * i as f64 - rows as f64, PROFILE[j][0]], PROFILE[j][1]);
    quads(rows, PROFILE.len() - 1, at, dice)
}

/// Squares of rows and columns, each cut along one of its diagonals.
fn quads(rows: usize, columns: usize, at: impl Fn(usize, usize) -> DVec3, dice: &mut Dice<'_>) -> Shape {
    let nodes = (0..=rows).flat_map(|i| (0..=columns).map(move |j| (i, j)));
    let mut shape = Shape { nodes: nodes.map(|(i, j)| at(i, j)).collect(), faces: Vec::new() };
    let id = |i: usize, j: usize| (i * (columns + 1) + j) as u32;
    for i in 0..rows {
        for j in 0..columns {
            shape.quad([id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)], dice.once_in(2));
        }
    }
    shape
}

/// A square ring: two boundaries.
fn ring(dice: &mut Dice<'_>) -> Shape {
    let step = dice.one_of([1, 2]);
    let corners: Vec<[f64; 2]> = COMPASS.into_iter().step_by(step).collect();
    let mut shape = Shape::default();
    for radius in [1.0, 3.0] {
        shape.nodes.extend(corners.iter().map(|c| over(c.map(|v| radius * v), height(dice))));
    }
    let n = corners.len() as u32;
    for i in 0..n {
        let j = (i + 1) % n;
        shape.quad([i, n + i, n + j, j], dice.once_in(2));
    }
    shape
}

/// A closed plate of n x n squares, its upper side at 1 and its lower at −1.
fn plate(dice: &mut Dice<'_>) -> Shape {
    let n = 1 + dice.below(3);
    let id = |i: usize, j: usize, lower: usize| ((lower * (n + 1) + i) * (n + 1) + j) as u32;
    let mut shape = Shape::default();
    for height in [1.0, -1.0] {
        for i in 0..=n {
            let row = (0..=n).map(|j| over([2.0 * i as f64 - n as f64, 2.0 * j as f64 - n as f64], height));
            shape.nodes.extend(row);
        }
    }
    for i in 0..n {
        for j in 0..n {
            shape.quad([id(i, j, 0), id(i + 1, j, 0), id(i + 1, j + 1, 0), id(i, j + 1, 0)], dice.once_in(2));
            shape.quad([id(i, j, 1), id(i, j + 1, 1), id(i + 1, j + 1, 1), id(i + 1, j, 1)], dice.once_in(2));
        }
        shape.quad([id(i, 0, 1), id(i + 1, 0, 1), id(i + 1, 0, 0), id(i, 0, 0)], dice.once_in(2));
        shape.quad([id(i, n, 0), id(i + 1, n, 0), id(i + 1, n, 1), id(i, n, 1)], dice.once_in(2));
        shape.quad([id(0, i, 1), id(0, i, 0), id(0, i + 1, 0), id(0, i + 1, 1)], dice.once_in(2));
        shape.quad([id(n, i, 0), id(n, i, 1), id(n, i + 1, 1), id(n, i + 1, 0)], dice.once_in(2));
    }
    shape
}

/// Two tips over and under a polygon; an octahedron at four corners.
fn bipyramid(dice: &mut Dice<'_>) -> Shape {
    let corners: &[usize] =
        dice.one_of([&[0, 2, 4, 6], &[0, 3, 5], &[1, 3, 5, 7], &[0, 1, 2, 3, 4, 5, 6, 7]]);
    let mut shape = Shape { nodes: vec![over([0.0; 2], 2.0), over([0.0; 2], -2.0)], faces: Vec::new() };
    shape.nodes.extend(corners.iter().map(|&c| over(COMPASS[c].map(|v| 2.0 * v), 0.0)));
    let n = corners.len() as u32;
    for i in 0..n {
        let (a, b) = (2 + i, 2 + (i + 1) % n);
        shape.faces.extend([[0, a, b], [1, b, a]]);
    }
    shape
}

fn tetrahedron(dice: &mut Dice<'_>) -> Shape {
    let tip = over(dice.one_of([[0.0, 0.0], [-2.0, 0.0], [0.5, 0.25]]), 2.0);
    let base = [[2.0, 0.0], [-2.0, 2.0], [-2.0, -2.0]].map(|at| over(at, -1.0));
    let nodes = std::iter::once(tip).chain(base).collect();
    Shape { nodes, faces: vec![[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]] }
}

impl Shape {
    /// A quadrilateral along one diagonal or the other.
    fn quad(&mut self, [a, b, c, d]: [u32; 4], other: bool) {
        self.faces.extend(if other { [[a, b, d], [b, c, d]] } else { [[a, b, c], [a, c, d]] });
    }

    /// Numbers the nodes, orders the faces and turns their corners in some other way.
    fn renumber(&mut self, dice: &mut Dice<'_>) {
        let mut order: Vec<usize> = (0..self.nodes.len()).collect();
        dice.shuffle(&mut order);
        let mut named = vec![0; order.len()];
        (0u32..).zip(&order).for_each(|(new, &old)| named[old] = new);
        self.nodes = order.iter().map(|&old| self.nodes[old]).collect();
        self.faces.iter_mut().flatten().for_each(|i| *i = named[*i as usize]);
        self.faces.iter_mut().for_each(|face| face.rotate_left(dice.below(3)));
        let first = dice.below(self.faces.len());
        self.faces.rotate_left(first);
    }

    /// With texture coordinates, or without.
    fn inline(self, dice: &mut Dice<'_>) -> InlineMesh {
        let uv = |p: &DVec3| [0.5 + p.x as f32 * 0.0625, 0.5 - p.z as f32 * 0.0625];
        let uv = match dice.below(4) {
            0 => Vec::new(),
            _ => self.nodes.iter().map(uv).collect(),
        };
        InlineMesh { nodes: self.nodes.iter().map(|p| p.to_array()).collect(), faces: self.faces, uv }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assets::{CacheOptions, open};
    use crate::measure::Random;
    use crate::mesh::{FaceId, Mesh, check};
    use crate::recording::SceneRef;

    fn bytes(random: &mut Random) -> Vec<u8> {
        (0..random.below(160)).map(|_| random.any() as u8).collect()
    }

    fn loaded(mesh: InlineMesh) -> Mesh {
        open(&SceneRef::Inline(mesh), "".as_ref(), &CacheOptions::off()).expect("a mesh").mesh
    }

    #[test]
    fn every_string_of_bytes_is_a_mesh() {
        let mut random = Random::of(1, 0, "shapes");
        for _ in 0..400 {
            let mesh = loaded(draw(&mut Dice::new(&bytes(&mut random))));
            assert_eq!(check::whole(&mesh), Ok(()));
        }
    }

    #[test]
    fn what_is_closed_is_closed_from_outside() {
        let (mut random, mut closed, mut open_ones) = (Random::of(2, 0, "shapes"), 0, 0);
        for _ in 0..200 {
            let bytes = bytes(&mut random);
            let mut dice = Dice::new(&bytes);
            let mesh = loaded(plain(&mut dice).inline(&mut dice));
            let is_closed = !mesh.edges().iter().any(|e| e.is_boundary());
            *(if is_closed { &mut closed } else { &mut open_ones }) += 1;
            let faces = (0..mesh.face_count()).map(FaceId::of);
            let volume: f64 = faces.map(|f| check::sixfold_volume(DVec3::ZERO, mesh.triangle(f))).sum();
            assert!(!is_closed || volume > 0.0, "inside out: {volume}");
        }
        assert!(closed > 20 && open_ones > 20, "{closed} {open_ones}");
    }
}
