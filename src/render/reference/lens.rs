//! What sees a picture: an eye or a light, as a pinhole.
//!
//! Seen from it, a point is (X, Y, Z): Z its depth along forward, X/Z and Y/Z pixels right of and below the picture's centre. Projection is a
//! division, and everything linear in space is linear in (X, Y, Z).

use glam::DVec3;

use crate::canvas::frame::{Light, View};

/// A pinhole and its picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Lens {
    eye: DVec3,
    /// Right and down, as long as the picture is away in pixels; and forward, of length 1.
    axes: [DVec3; 3],
    /// The distance of the picture, in pixels.
    pub(crate) focal: f64,
    /// Width and height in pixels.
    pub(crate) size: [u32; 2],
    /// Depths between which it sees.
    pub(crate) near: f64,
    /// The farther of them.
    pub(crate) far: f64,
}

impl Lens {
    /// The lens of a view.
    pub(crate) fn of_view(view: &View) -> Self {
        let focal = f64::from(view.size[1]) / (2.0 * libm::tan(view.fov_y * 0.5));
        Self::new(view.eye, view.basis, focal, view.size, [view.near, view.far])
    }

    /// The lens of a light's shadow map.
    pub(crate) fn of_light(light: &Light, size: u32) -> Self {
        let focal = f64::from(size) / (2.0 * light.tan_half);
        Self::new(light.position, light.basis, focal, [size; 2], [light.near, light.far])
    }

    fn new(
        eye: DVec3,
        [right, up, forward]: [DVec3; 3],
        focal: f64,
        size: [u32; 2],
        [near, far]: [f64; 2],
    ) -> Self {
        // 1/near has to be a number of f32.
        Self { eye, axes: [right * focal, up * -focal, forward], focal, size, near: near.max(1e-30), far }
    }

    /// The same for points that are given relative to a place.
    #[must_use]
    pub(crate) fn around(&self, place: DVec3) -> Self {
        Self { eye: self.eye - place, ..*self }
    }

    /// A point, relative to the eye.
    #[inline]
    pub(crate) fn relative(&self, point: DVec3) -> DVec3 {
        point - self.eye
    }

    /// A point as it is seen.
    #[inline]
    pub(crate) fn see(&self, point: DVec3) -> DVec3 {
        let d = point - self.eye;
        DVec3::new(d.dot(self.axes[0]), d.dot(self.axes[1]), d.dot(self.axes[2]))
    }

    /// Where it looks, unit length.
    pub(crate) fn forward(&self) -> DVec3 {
        self.axes[2]
    }

    /// The middle of the picture, pixels from its upper left.
    #[inline]
    pub(crate) fn centre(&self) -> [f64; 2] {
        self.size.map(|side| 0.5 * f64::from(side))
    }

    /// Where in the picture a seen point is; `None` if it is not in front.
    #[inline]
    pub(crate) fn place(&self, seen: DVec3) -> Option<[f64; 2]> {
        let [cx, cy] = self.centre();
        (seen.z > 0.0).then(|| [cx + seen.x / seen.z, cy + seen.y / seen.z])
    }

    /// What is seen at depth 1 through a pixel's centre.
    #[inline]
    pub(crate) fn ray(&self, x: usize, y: usize) -> DVec3 {
        let [cx, cy] = self.centre();
        DVec3::new(x as f64 + 0.5 - cx, y as f64 + 0.5 - cy, 1.0)
    }
}
