//! From a pick to a point of the surface, exactly (Lam 2016, §4.1.1).
//!
//! The ray from the eye e through a second point a meets a face (n₀, n₁, n₂) where the three signs of orient3d(e, a, nᵢ, nᵢ₊₁) agree.
//! One zero among them puts the hit on an edge, two on a node; three mean that the face is seen edge-on, and its neighbours have the
//! hit. So there is no gap between faces through which a ray could slip, and no hit that two faces claim with different words. Hits
//! are ordered along the ray by an exact comparison; equal ones by the lower face id.
//!
//! The thesis tests every face with rounded arithmetic; this walks a hierarchy and is exact.

use std::cmp::Ordering;

use glam::DVec3;

use super::chain::{At, Point};
use super::event::Pick;
use super::{State, camera::Camera};
use crate::geometry::bvh::{Bvh, Ray};
use crate::geometry::double;
use crate::geometry::exact::{self, Dyadic};
use crate::geometry::predicates::{Sign, nearer, orient3d, parameter};
use crate::mesh::{FaceId, Mesh, NodeId};
use crate::report::Rejection;

/// A pick that met the surface: a point on its ray, and what it met.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Picked {
    /// The exact datum: a point on the ray, or the node itself.
    pub through: DVec3,
    /// What was met.
    pub point: Point,
}

/// Turns a pick into a point of the surface.
pub fn resolve(state: &mut State, pick: Pick) -> Result<Picked, Rejection> {
    match pick {
        Pick::Pixel(at) => resolve_pixel(state, at),
        Pick::Node(node) => resolve_node(&state.mesh, node),
        Pick::Edge(edge, t) => {
            if !state.mesh.has_edge(edge) {
                return Err(unknown(edge));
            }
            let nodes = state.mesh.edge(edge).nodes;
            if t == 0.0 || t == 1.0 {
                return resolve_node(&state.mesh, nodes[usize::from(t == 1.0)]);
            }
            let [a, b] = nodes.map(|n| state.mesh.position(n));
            let position = double::blend(a, [(b, t)]);
            Ok(Picked {
                through: position,
                point: Point { at: At::Edge(edge), position, weights: [1.0 - t, t, 0.0] },
            })
        }
        Pick::Face(face, u, v) => resolve_face(state, face, u, v),
    }
}

fn unknown(id: impl std::fmt::Display) -> Rejection {
    Rejection::new("no-such-element", format!("{id} does not exist"))
}

fn resolve_node(mesh: &Mesh, node: NodeId) -> Result<Picked, Rejection> {
    if !mesh.has_node(node) {
        return Err(unknown(node));
    }
    Ok(Picked { through: mesh.position(node), point: Point::node(mesh, node) })
}

/// A point in a face, which becomes one on an edge or a node where weights are zero.
fn resolve_face(state: &mut State, face: FaceId, u: f64, v: f64) -> Result<Picked, Rejection> {
    if !state.mesh.has_face(face) {
        return Err(unknown(face));
    }
    let weights = [1.0 - u - v, u, v];
    let f = *state.mesh.face(face);
    if let Some(corner) = (0..3).find(|&k| weights[k] >= 1.0) {
        return resolve_node(&state.mesh, f.nodes[corner]);
    }
    if let Some(corner) = (0..3).find(|&k| weights[k] <= 0.0) {
        let side = (corner + 1) % 3;
        let edge = f.edges[side];
        let along = state.mesh.edge(edge).nodes[0] == f.nodes[side];
        let t = weights[(side + 1) % 3];
        return resolve(state, Pick::Edge(edge, if along { t } else { 1.0 - t }));
    }
    let [a, b, c] = state.mesh.triangle(face);
    let position = double::blend(a, [(b, u), (c, v)]);
    Ok(Picked { through: position, point: Point { at: At::Face(face), position, weights } })
}

fn resolve_pixel(state: &mut State, at: [f64; 2]) -> Result<Picked, Rejection> {
    let miss = || Rejection::new("miss", format!("there is no surface under pixel ({}, {})", at[0], at[1]));
    let (camera, snap_px) = (state.control.camera, state.snap_px());
    let through = camera.through(at).ok_or_else(miss)?;
    let eye = camera.eye();
    let (mesh, bvh) = state.mesh_and_bvh();
    let hit = cast(mesh, bvh, eye, through).ok_or_else(miss)?;
    match snap_target(mesh, &camera, hit.face, at, snap_px) {
        Some(node) => resolve_node(mesh, node),
        None => Ok(Picked { through, point: hit.point(mesh, eye, through) }),
    }
}

/// The corner of the hit face that is nearest to the pixel, if it is near enough.
fn snap_target(mesh: &Mesh, camera: &Camera, face: FaceId, at: [f64; 2], snap_px: f64) -> Option<NodeId> {
    if snap_px <= 0.0 {
        return None;
    }
    let distance = |n: NodeId| {
        let p = camera.project(mesh.position(n))?;
        Some(((p[0] - at[0]) * (p[0] - at[0]) + (p[1] - at[1]) * (p[1] - at[1])).sqrt())
    };
    let near = mesh.face(face).nodes.into_iter().filter_map(|n| Some((distance(n)?, n)));
    near.filter(|(d, _)| *d <= snap_px).min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1))).map(|(_, n)| n)
}

/// A face that a ray meets.
#[derive(Clone, Copy, Debug)]
pub struct Hit {
    /// The face; of several at the same place the one with the lowest id.
    pub face: FaceId,
    /// Bounds of the parameter along the ray, in lengths from the eye to the second point.
    reach: [f64; 2],
    /// The signs of orient3d(eye, through, nᵢ, nᵢ₊₁).
    signs: [Sign; 3],
}

/// The first face that the ray from `eye` through `through` meets in front of the eye.
pub fn cast(mesh: &Mesh, bvh: &Bvh, eye: DVec3, through: DVec3) -> Option<Hit> {
    let mut best: Option<Hit> = None;
    bvh.along(Ray { origin: eye, direction: through - eye }, f64::INFINITY, |item| {
        if let Some(hit) = meet(mesh, FaceId(item), eye, through) {
            best = Some(best.map_or(hit, |b| first(mesh, eye, through, b, hit)));
        }
        // What is equally near enters its box before that, whatever rounding did.
        best.map_or(f64::INFINITY, |b| b.reach[1])
    });
    best
}

/// How a ray meets a face in front of the eye, if it does.
fn meet(mesh: &Mesh, face: FaceId, eye: DVec3, through: DVec3) -> Option<Hit> {
    let t = mesh.triangle(face);
    let signs = crossing_signs(eye, through, t)?;
    let fall = if signs.contains(&Ordering::Greater) { Ordering::Greater } else { Ordering::Less };
    // n · (a − e) and n · d agree in front of the eye; the first is the negative of orient3d(a, b, c, e).
    if orient3d(t[0], t[1], t[2], eye) != fall.reverse() {
        return None;
    }
    Some(Hit { face, reach: parameter(eye, through, t), signs })
}

/// The three signs of a line and a triangle's sides, if the line meets the triangle and is not in its plane.
pub fn crossing_signs(eye: DVec3, through: DVec3, t: [DVec3; 3]) -> Option<[Sign; 3]> {
    let signs = [0, 1, 2].map(|i| orient3d(eye, through, t[i], t[(i + 1) % 3]));
    let (greater, less) = (signs.contains(&Ordering::Greater), signs.contains(&Ordering::Less));
    (greater != less).then_some(signs)
}

/// The nearer of two hits; the lower face id where they are equal.
fn first(mesh: &Mesh, eye: DVec3, through: DVec3, a: Hit, b: Hit) -> Hit {
    let order = if a.reach[1] < b.reach[0] {
        Ordering::Less
    } else if b.reach[1] < a.reach[0] {
        Ordering::Greater
    } else {
        nearer(eye, through, mesh.triangle(a.face), mesh.triangle(b.face)).then(a.face.cmp(&b.face))
    };
    if order == Ordering::Greater { b } else { a }
}

impl Hit {
    /// The point that was met: classified by its signs, and its position.
    pub fn point(&self, mesh: &Mesh, eye: DVec3, through: DVec3) -> Point {
        let face = mesh.face(self.face);
        let on: Vec<usize> = (0..3).filter(|&i| self.signs[i] == Ordering::Equal).collect();
        match on[..] {
            // Two sides meet in one corner: side i begins at corner i.
            [i, j] => Point::node(mesh, face.nodes[if (i + 1) % 3 == j { j } else { i }]),
            [side] => self.on_edge(mesh, side, eye, through),
            _ => in_face(mesh, self.face, eye, through),
        }
    }

    fn on_edge(&self, mesh: &Mesh, side: usize, eye: DVec3, through: DVec3) -> Point {
        let edge = mesh.face(self.face).edges[side];
        let [a, b] = mesh.edge(edge).nodes.map(|n| mesh.position(n));
        let t = along_edge(a, b, eye, through);
        let position = double::blend(a, [(b, t)]).clamp(a.min(b), a.max(b));
        Point { at: At::Edge(edge), position, weights: [1.0 - t, t, 0.0] }
    }
}

/// Where on the segment from `a` to `b` a ray passes that meets it.
fn along_edge(a: DVec3, b: DVec3, eye: DVec3, through: DVec3) -> f64 {
    // The two areas that the ray spans with the ends, seen along the normal of the plane of ray and segment.
    let d = double::difference(through, eye);
    let (na, nb) =
        (double::cross(d, double::difference(a, eye)), double::cross(d, double::difference(b, eye)));
    let (na, nb) = (double::rounded(na), double::rounded(nb));
    let axis = nb - na;
    let (ha, hb) = (-na.dot(axis), nb.dot(axis));
    let t = ha / (ha + hb);
    if t.is_finite() { t.clamp(0.0, 1.0) } else { 0.5 }
}

/// The point inside a face that a ray meets.
pub fn in_face(mesh: &Mesh, face: FaceId, eye: DVec3, through: DVec3) -> Point {
    let corners = mesh.triangle(face);
    let volumes = volumes(corners, eye, through);
    let weights = (volumes / volumes.element_sum()).to_array();
    let [a, b, c] = corners;
    let position = double::blend(a, [(b, weights[1]), (c, weights[2])]);
    let [lo, hi] = [a.min(b).min(c), a.max(b).max(c)];
    Point { at: At::Face(face), position: position.clamp(lo, hi), weights }
}

/// Below this part of the terms that they are made of, the volumes' sum may have lost digits that the weights need: half of the 106.
const LOST: f64 = 1e-13;

/// Volumes that are to each other as the corners' weights: of the ray's piece and the side across from a corner.
fn volumes(corners: [DVec3; 3], eye: DVec3, through: DVec3) -> DVec3 {
    let d = double::difference(through, eye);
    let from_eye = corners.map(|c| double::difference(c, eye));
    let volume = |i: usize| double::dot(d, double::cross(from_eye[i], from_eye[(i + 1) % 3])).value();
    let volumes = DVec3::new(volume(1), volume(2), volume(0));
    let size = |v: DVec3| v.abs().max_element();
    let farthest = from_eye.map(|v| size(double::rounded(v))).into_iter().fold(0.0, f64::max);
    if volumes.element_sum().abs() > LOST * size(double::rounded(d)) * farthest * farthest {
        return volumes;
    }
    let d = exact::difference::<Dyadic>(through, eye);
    let from_eye = corners.map(|c| exact::difference(c, eye));
    let volume = |i: usize| exact::dot(&d, &exact::cross(&from_eye[i], &from_eye[(i + 1) % 3]));
    double::rounded(exact::direction(&[volume(1), volume(2), volume(0)]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::wound::merge::face_box;
    use crate::mesh::IndexedMesh;

    /// A face a thousand million times as long as high, whose parameter along the ray is wrong from the sixth digit when it is computed in floats,
    /// and a face that the ray meets between the true place and that.
    #[test]
    fn a_sliver_is_met_where_it_is_and_not_where_rounding_puts_it() {
        let eye = DVec3::new(-0.616, 0.26, 3.0);
        let through = DVec3::new(0.6049999999666666, -1.1649999999666667, -0.17049999996666668);
        let behind = -0.1705021550851944;
        let positions = vec![
            DVec3::new(0.117, -0.713, -0.626),
            DVec3::new(1.093, -1.617, 0.285),
            DVec3::new(0.6049999999, -1.1649999999, -0.1704999999),
            DVec3::new(-9.0, -9.0, behind),
            DVec3::new(9.0, -9.0, behind),
            DVec3::new(0.0, 9.0, behind),
        ];
        let faces = vec![[0, 1, 2], [3, 4, 5]];
        let mesh =
            Mesh::build(&IndexedMesh { positions, faces, ..IndexedMesh::default() }).expect("two faces");
        let bvh = Bvh::build(2, &|face| face_box(&mesh, face));
        let both = [0, 1].map(|face| meet(&mesh, FaceId(face), eye, through).is_some());
        assert_eq!((both, cast(&mesh, &bvh, eye, through).map(|hit| hit.face)), ([true; 2], Some(FaceId(0))));
    }
}
