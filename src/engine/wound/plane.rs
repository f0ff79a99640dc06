//! The cutting plane: the eye and a point on each pick's ray, and nothing else (exact once they are rounded).
//!
//! Lam 2016, §4.1.2 cuts with a quadrilateral between the near and far plane; here it is the whole plane, and what bounds the line is
//! the surface. Which side of the plane a node is on is an exact sign. Its normal is computed exactly, once for each cut, since of three points
//! that lie nearly on a line doubled digits may leave nothing; heights over it have doubled digits, so that a crossing is rounded once.

use std::cmp::Ordering;

use glam::DVec3;
use rustc_hash::FxHashSet;

use crate::geometry::double::{self, Double, DoubleVec};
use crate::geometry::exact;
use crate::geometry::predicates::{Sign, collinear, orient3d};
use crate::mesh::{Mesh, NodeId};

/// The plane of one cut.
#[derive(Clone, Debug)]
pub struct CutPlane {
    /// The three points that span it: the eye, and a point on each ray.
    pub points: [DVec3; 3],
    normal: DoubleVec,
    unit: DVec3,
    /// Nodes that rounding put onto the plane: see [`super::form`].
    snapped: FxHashSet<NodeId>,
}

impl CutPlane {
    /// The plane through three points; `None` if they lie on one line.
    pub fn through(points: [DVec3; 3]) -> Option<Self> {
        let [eye, a, b] = points;
        if collinear(eye, a, b) {
            return None;
        }
        let normal = exact::direction(&exact::cross(&exact::difference(a, eye), &exact::difference(b, eye)));
        let rounded = double::rounded(normal);
        let unit = (rounded / rounded.abs().max_element()).try_normalize()?;
        Some(Self { points, normal, unit, snapped: FxHashSet::default() })
    }

    /// Unit normal, rounded.
    pub fn unit(&self) -> DVec3 {
        self.unit
    }

    /// On which side a point lies, exactly.
    #[inline]
    pub fn side(&self, point: DVec3) -> Sign {
        let [eye, a, b] = self.points;
        orient3d(eye, a, b, point)
    }

    /// On which side a node lies: exactly, but for the nodes that an end of the line was moved to.
    #[inline]
    pub fn side_of(&self, mesh: &Mesh, node: NodeId) -> Sign {
        if !self.snapped.is_empty() && self.snapped.contains(&node) {
            return Ordering::Equal;
        }
        self.side(mesh.position(node))
    }

    /// Counts a node as lying on the plane from now on; false if it did already.
    pub fn snap(&mut self, node: NodeId) -> bool {
        self.snapped.insert(node)
    }

    /// How many nodes were snapped.
    pub fn snapped(&self) -> usize {
        self.snapped.len()
    }

    fn height(&self, point: DVec3) -> Double {
        double::dot(self.normal, double::difference(point, self.points[1]))
    }

    /// Distance to the plane, model units.
    pub fn distance(&self, point: DVec3) -> f64 {
        self.height(point).value().abs() / double::rounded(self.normal).length()
    }

    /// Where a segment whose ends lie on different sides meets the plane: its parameter and position, within an ulp or two.
    pub fn crossing(&self, a: DVec3, b: DVec3) -> (f64, DVec3) {
        let (ha, hb) = (self.height(a).value(), self.height(b).value());
        let t = (ha / (ha - hb)).clamp(0.0, 1.0);
        let position = if t <= 0.5 {
            double::blend(a, [(b, t)])
        } else {
            double::blend(b, [(a, (hb / (hb - ha)).clamp(0.0, 1.0))])
        };
        (t, position.clamp(a.min(b), a.max(b)))
    }
}
