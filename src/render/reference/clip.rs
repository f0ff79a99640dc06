//! Clipping of triangles as a [lens](super::lens) sees them, before the division that projects them (Sutherland and Hodgman 1974).
//!
//! Against the near plane, since nothing behind the eye can be divided; and far outside of the picture, so that corners fit the
//! rasterizer's whole numbers. A new corner is computed from the inner end of a side to the outer one, so that two triangles with a common
//! side get the same corner on it, whichever way they run through it.

use glam::DVec3;

/// How far from its middle a picture's corners may lie, in pixels: 2¹⁷. In 1/256 of a pixel, products of two differences stay below 2⁵³.
pub(super) const GUARD: f64 = 131_072.0;

/// The corners of a convex polygon: a triangle clipped by five planes has at most eight.
#[derive(Clone, Copy)]
pub(super) struct Polygon {
    corners: [DVec3; 8],
    len: usize,
}

impl Polygon {
    /// The part of a triangle that is not nearer than `near`, and within the guard.
    pub(super) fn clipped(triangle: [DVec3; 3], near: f64) -> Self {
        let mut polygon = Self::new(&triangle);
        if !triangle.iter().all(|p| p.z >= near) {
            polygon = polygon.clip(near, |p| p.z - near);
        }
        if !triangle.iter().all(|p| p.z >= near && p.x.abs().max(p.y.abs()) <= GUARD * p.z) {
            polygon = polygon.clip(near, |p| GUARD * p.z - p.x).clip(near, |p| GUARD * p.z + p.x);
            polygon = polygon.clip(near, |p| GUARD * p.z - p.y).clip(near, |p| GUARD * p.z + p.y);
        }
        polygon
    }

    fn new(corners: &[DVec3]) -> Self {
        let mut polygon = Self { corners: [DVec3::ZERO; 8], len: 0 };
        corners.iter().for_each(|p| polygon.push(*p));
        polygon
    }

    /// Its corners, in order.
    pub(super) fn corners(&self) -> &[DVec3] {
        &self.corners[..self.len]
    }

    fn push(&mut self, corner: DVec3) {
        // Rounding can cut a sliver in more pieces than a convex polygon has: what is left out there is no pixel wide.
        if let Some(free) = self.corners.get_mut(self.len) {
            *free = corner;
            self.len += 1;
        }
    }

    /// The part where the distance is not negative. No new corner is nearer than `near`, however it is rounded.
    fn clip(&self, near: f64, distance: impl Fn(DVec3) -> f64) -> Self {
        let mut kept = Self::new(&[]);
        let corners = self.corners();
        for (i, &a) in corners.iter().enumerate() {
            let b = corners[(i + 1) % corners.len()];
            let (from, to) = (distance(a), distance(b));
            if from >= 0.0 {
                kept.push(a);
            }
            if (from >= 0.0) != (to >= 0.0) {
                let new = if from >= 0.0 { crossing(a, b, from, to) } else { crossing(b, a, to, from) };
                kept.push(DVec3 { z: new.z.max(near), ..new });
            }
        }
        kept
    }
}

/// Where the side from `a`, inside, to `b`, outside, crosses the plane.
fn crossing(a: DVec3, b: DVec3, inside: f64, outside: f64) -> DVec3 {
    a + (b - a) * (inside / (inside - outside))
}
