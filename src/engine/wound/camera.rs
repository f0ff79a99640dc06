//! The camera: three angles and lengths, and the rays that pixels stand for (Lam 2016, §4.1.1.1, §6.1).
//!
//! eye = target + distance (sin z sin a, cos z, sin z cos a), right-handed, y up; the basis comes from the angles, so the poles need no
//! special case. A ray is the eye and one more point, both f64: from there on the cut is exact.

use glam::DVec3;

use super::event::CameraChange;

/// Where one looks from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// What is looked at, model units.
    pub target: DVec3,
    /// Angle around the vertical axis, radians.
    pub azimuth: f64,
    /// Angle from straight up, radians.
    pub zenith: f64,
    /// Eye to target, model units.
    pub distance: f64,
    /// Vertical field of view, radians.
    pub fov_y: f64,
    /// Width and height in pixels.
    pub viewport: [u32; 2],
}

impl Camera {
    /// The distance from which a sphere of radius `r` around the target fills the smaller side of the view, with a tenth to spare.
    pub fn fitting_distance(r: f64, fov_y: f64, viewport: [u32; 2]) -> f64 {
        let aspect = viewport[0] as f64 / viewport[1] as f64;
        let half = fov_y * 0.5;
        let half_x = libm::atan(aspect * libm::tan(half));
        1.1 * r / libm::sin(half.min(half_x))
    }

    /// Applies what an event says; the rest stays.
    pub fn change(&mut self, change: &CameraChange) {
        self.azimuth = change.azimuth.unwrap_or(self.azimuth);
        self.zenith = change.zenith.unwrap_or(self.zenith);
        self.distance = change.distance.unwrap_or(self.distance);
    }

    /// Where the eye is.
    pub fn eye(&self) -> DVec3 {
        self.target - self.forward() * self.distance
    }

    fn forward(&self) -> DVec3 {
        let ((sa, ca), (sz, cz)) = (libm::sincos(self.azimuth), libm::sincos(self.zenith));
        -DVec3::new(sz * sa, cz, sz * ca)
    }

    /// Right, up and forward, each of length 1.
    pub fn basis(&self) -> [DVec3; 3] {
        let (sa, ca) = libm::sincos(self.azimuth);
        let (right, forward) = (DVec3::new(ca, 0.0, -sa), self.forward());
        [right, right.cross(forward), forward]
    }

    /// A point on the ray through a pixel position, about as far from the eye as the target; `None` outside of the viewport.
    pub fn through(&self, [x, y]: [f64; 2]) -> Option<DVec3> {
        let [width, height] = self.viewport.map(f64::from);
        if !(0.0..=width).contains(&x) || !(0.0..=height).contains(&y) {
            return None;
        }
        let [right, up, forward] = self.basis();
        let tan = libm::tan(self.fov_y * 0.5);
        let (sx, sy) = ((2.0 * x - width) / height * tan, (1.0 - 2.0 * y / height) * tan);
        Some(self.eye() + (forward + right * sx + up * sy) * self.distance)
    }

    /// The pixel position of a point in front of the eye.
    pub fn project(&self, point: DVec3) -> Option<[f64; 2]> {
        let [right, up, forward] = self.basis();
        let d = point - self.eye();
        let depth = d.dot(forward);
        if depth <= 0.0 {
            return None;
        }
        let [width, height] = self.viewport.map(f64::from);
        let scale = height * 0.5 / (libm::tan(self.fov_y * 0.5) * depth);
        Some([width * 0.5 + d.dot(right) * scale, height * 0.5 - d.dot(up) * scale])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn camera(azimuth: f64, zenith: f64) -> Camera {
        Camera {
            target: DVec3::new(1.0, 2.0, 3.0),
            azimuth,
            zenith,
            distance: 10.0,
            fov_y: 0.6,
            viewport: [640, 360],
        }
    }

    #[test]
    fn the_default_view_looks_along_minus_z_with_y_up() {
        let c = camera(0.0, std::f64::consts::FRAC_PI_2);
        assert!((c.eye() - DVec3::new(1.0, 2.0, 13.0)).length() < 1e-14);
        let [right, up, _] = c.basis();
        assert!((right - DVec3::X).length() < 1e-15 && (up - DVec3::Y).length() < 1e-15);
        assert!((c.through([320.0, 180.0]).unwrap() - c.target).length() < 1e-14);
        let upper_left = c.through([0.0, 0.0]).unwrap() - c.target;
        assert!(upper_left.x < 0.0 && upper_left.y > 0.0);
    }

    #[test]
    fn a_projected_point_lies_under_its_pixel_from_everywhere_poles_included() {
        for (a, z) in [(0.3, 1.4), (4.0, 0.0), (-2.0, std::f64::consts::PI)] {
            let c = camera(a, z);
            let at = [123.5, 67.25];
            let back = c.project(c.through(at).unwrap()).unwrap();
            assert!((back[0] - at[0]).abs() < 1e-9 && (back[1] - at[1]).abs() < 1e-9, "{back:?}");
        }
    }

    #[test]
    fn outside_of_the_viewport_there_is_no_ray() {
        assert_eq!(camera(0.0, 1.0).through([640.1, 3.0]), None);
        assert_eq!(camera(0.0, 1.0).through([f64::NAN, 3.0]), None);
    }
}
