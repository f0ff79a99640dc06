//! Ambient occlusion: how much of the sky over a place is open, weighted by the cosine.
//!
//! Rays go out from every node along the directions of a Fibonacci sphere that look away from its surface, the same for all nodes, so that
//! neighbours agree. What a ray meets closer than [`REACH_CM`] counts the more, the closer it is. Between nodes it is interpolated.

use glam::{DVec3, dvec3};
use rayon::prelude::*;

use super::texels::Site;
use crate::geometry::bvh::{Aabb, Bvh, Ray};
use crate::mesh::{FaceId, Mesh, NodeId};

const DIRECTIONS: u32 = 48;
const REACH_CM: f64 = 7.0;
/// How far off the surface rays begin: the faces around a hollow node stand in front of it.
const LIFT_CM: f64 = 0.03;

/// How open the surface is at its nodes, 0 to 1.
pub(super) struct Openness<'a> {
    mesh: &'a Mesh,
    nodes: Vec<f64>,
}

impl<'a> Openness<'a> {
    pub(super) fn new(mesh: &'a Mesh) -> Self {
        let bounds = |f: u32| Aabb::around(&mesh.triangle(FaceId(f)));
        let tree = Bvh::build(mesh.face_count(), &bounds);
        let directions: Vec<DVec3> = (0..DIRECTIONS).map(fibonacci).collect();
        let normals = normals(mesh);
        let open = |node: usize| {
            let origin = mesh.position(NodeId::of(node)) + normals[node] * LIFT_CM;
            open_share(mesh, &tree, origin, normals[node], &directions)
        };
        let nodes = (0..mesh.node_count()).into_par_iter().map(open).collect();
        Self { mesh, nodes }
    }

    /// How open it is at a site.
    pub(super) fn at(&self, site: &Site) -> f64 {
        let nodes = self.mesh.face(site.face).nodes;
        let sum: f64 = nodes.iter().zip(site.weights).map(|(n, w)| self.nodes[n.at()] * w).sum();
        sum.clamp(0.0, 1.0)
    }
}

fn normals(mesh: &Mesh) -> Vec<DVec3> {
    let mut normals = vec![DVec3::Y; mesh.node_count()];
    for face in mesh.faces() {
        for (node, vertex) in face.nodes.iter().zip(face.vertices) {
            normals[node.at()] = mesh.vertex(vertex).normal.as_dvec3();
        }
    }
    normals
}

/// Points spread evenly over a sphere along a spiral.
fn fibonacci(k: u32) -> DVec3 {
    const GOLDEN_ANGLE: f64 = 2.399_963_229_728_653;
    let y = 1.0 - (2.0 * f64::from(k) + 1.0) / f64::from(DIRECTIONS);
    let (sin, cos) = libm::sincos(GOLDEN_ANGLE * f64::from(k));
    let flat = (1.0 - y * y).sqrt();
    dvec3(flat * cos, y, flat * sin)
}

fn open_share(mesh: &Mesh, tree: &Bvh, origin: DVec3, normal: DVec3, directions: &[DVec3]) -> f64 {
    let (mut open, mut all) = (0.0, 0.0);
    for &direction in directions {
        let cosine = normal.dot(direction);
        if cosine > 0.0 {
            let met = nearest(mesh, tree, Ray { origin, direction }) / REACH_CM;
            open += cosine * met * met;
            all += cosine;
        }
    }
    open / all
}

/// How far a ray gets, at most [`REACH_CM`].
fn nearest(mesh: &Mesh, tree: &Bvh, ray: Ray) -> f64 {
    let mut limit = REACH_CM;
    tree.along(ray, REACH_CM, |face| {
        limit = limit.min(meets(mesh.triangle(FaceId(face)), ray).unwrap_or(limit));
        limit
    });
    limit
}

/// Where a ray meets a triangle (Möller and Trumbore 1997).
fn meets([a, b, c]: [DVec3; 3], ray: Ray) -> Option<f64> {
    let (ab, ac) = (b - a, c - a);
    let p = ray.direction.cross(ac);
    let det = ab.dot(p);
    let s = ray.origin - a;
    let q = s.cross(ab);
    let [u, v, t] = [s.dot(p), ray.direction.dot(q), ac.dot(q)].map(|x| x / det);
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t >= 0.0).then_some(t)
}
