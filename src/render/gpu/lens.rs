//! What sees: the matrix of an eye or of a light, and whether a box is in its sight.
//!
//! Worked out in f64, and relative to the job's origin, so that f32 is enough for the device.

use glam::DVec3;

use crate::canvas::frame::{Light, View};

/// A pinhole: rows of a matrix from positions to clip space, x, y, z, w, each with its constant last.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Lens([[f64; 4]; 4]);

impl Lens {
    /// The eye of a view.
    pub(crate) fn of_view(view: &View, origin: DVec3) -> Self {
        let scale = 1.0 / libm::tan(view.fov_y * 0.5);
        let aspect = f64::from(view.size[0]) / f64::from(view.size[1]);
        Self::new(view.eye - origin, view.basis, [scale / aspect, scale], [view.near, view.far])
    }

    /// A light, for its shadow map.
    pub(crate) fn of_light(light: &Light, origin: DVec3) -> Self {
        let scale = 1.0 / light.tan_half;
        Self::new(light.position - origin, light.basis, [scale; 2], [light.near, light.far])
    }

    fn new(eye: DVec3, [right, up, forward]: [DVec3; 3], scale: [f64; 2], [near, far]: [f64; 2]) -> Self {
        // Depth before the division is near (far − z)/(far − near): after it, 1 at near and 0 at far.
        let slope = near / (far - near);
        let row = |axis: DVec3, moved: f64| [axis.x, axis.y, axis.z, moved - axis.dot(eye)];
        Self([
            row(right * scale[0], 0.0),
            row(up * scale[1], 0.0),
            row(forward * -slope, slope * far),
            row(forward, 0.0),
        ])
    }

    /// The matrix, by columns.
    pub(crate) fn clip(&self) -> [[f32; 4]; 4] {
        std::array::from_fn(|column| self.0.map(|row| row[column] as f32))
    }

    /// The ray through the centre of the first pixel of a picture, as long as it is at depth 1, and what a pixel to the right or down adds.
    pub(crate) fn rays(view: &View) -> [[f32; 3]; 3] {
        let [right, up, forward] = view.basis;
        let pixel = 2.0 * libm::tan(view.fov_y * 0.5) / f64::from(view.size[1]);
        let [x, y] = view.size.map(|side| 0.5 * (1.0 - f64::from(side)) * pixel);
        [forward + right * x - up * y, right * pixel, -up * pixel].map(|ray| ray.as_vec3().to_array())
    }

    /// The last row: depth along the axis.
    pub(crate) fn depth(&self) -> [f32; 4] {
        self.0[3].map(|x| x as f32)
    }

    /// Whether a box, relative to the origin, may be in sight: not all of it lies beyond one side of what is seen.
    pub(crate) fn may_see(&self, [low, high]: [DVec3; 2]) -> bool {
        let corners: [[f64; 4]; 8] = std::array::from_fn(|i| {
            let pick = |bit: usize| if i >> bit & 1 == 1 { high } else { low };
            self.see(DVec3::new(pick(0).x, pick(1).y, pick(2).z))
        });
        // A little more than what is seen, for what is rounded; what is no number is not beyond anything.
        let beyond = |out: fn(&[f64; 4]) -> bool| corners.iter().all(out);
        !(beyond(|[x, _, _, w]| *x > w * 1.01)
            || beyond(|[x, _, _, w]| -*x > w * 1.01)
            || beyond(|[_, y, _, w]| *y > w * 1.01)
            || beyond(|[_, y, _, w]| -*y > w * 1.01)
            || beyond(|[_, _, z, _]| *z < 0.0)
            || beyond(|[_, _, _, w]| *w <= 0.0))
    }

    fn see(&self, p: DVec3) -> [f64; 4] {
        self.0.map(|[x, y, z, moved]| x * p.x + y * p.y + z * p.z + moved)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn view() -> View {
        View {
            eye: DVec3::new(1.0, 2.0, 13.0),
            basis: [DVec3::X, DVec3::Y, DVec3::NEG_Z],
            fov_y: 0.6,
            size: [320, 180],
            near: 5.0,
            far: 15.0,
        }
    }

    #[test]
    fn depth_is_one_near_and_nought_far() {
        let lens = Lens::of_view(&view(), DVec3::ZERO);
        for (z, depth) in [(8.0, 1.0), (-2.0, 0.0)] {
            let [_, _, clip, w] = lens.see(DVec3::new(0.3, 0.2, z));
            assert!((clip / w - depth).abs() < 1e-12, "{clip} {w}");
            assert!((w - (13.0 - z)).abs() < 1e-12);
        }
    }

    #[test]
    fn the_picture_is_as_high_as_the_field_of_view() {
        let lens = Lens::of_view(&view(), DVec3::ZERO);
        let height = 10.0 * libm::tan(0.3);
        let [x, y, _, w] = lens.see(DVec3::new(1.0 + height * 320.0 / 180.0, 2.0 + height, 3.0));
        assert!((x / w - 1.0).abs() < 1e-12 && (y / w - 1.0).abs() < 1e-12, "{x} {y} {w}");
    }

    #[test]
    fn a_pixel_s_ray_is_seen_at_its_centre() {
        let (view, [first, across, down]) =
            (view(), Lens::rays(&view()).map(|ray| DVec3::from(ray.map(f64::from))));
        let lens = Lens::of_view(&view, DVec3::ZERO);
        for [i, j] in [[0.0, 0.0], [319.0, 179.0], [17.0, 120.0]] {
            let [x, y, _, w] = lens.see(view.eye + (first + across * i + down * j) * 7.0);
            let place = [(x / w + 1.0) * 160.0, (1.0 - y / w) * 90.0];
            assert!((place[0] - i - 0.5).abs() < 1e-4 && (place[1] - j - 0.5).abs() < 1e-4, "{place:?}");
        }
    }

    #[test]
    fn a_box_aside_behind_or_too_far_is_out_of_sight() {
        let lens = Lens::of_view(&view(), DVec3::new(1.0, 2.0, 3.0));
        let at = |x: f64, y: f64, z: f64| [DVec3::new(x, y, z) - 0.5, DVec3::new(x, y, z) + 0.5];
        assert!(lens.may_see(at(0.0, 0.0, 0.0)) && lens.may_see([DVec3::splat(-9e9), DVec3::splat(9e9)]));
        for [x, y, z] in [
            [9.0, 0.0, 0.0],
            [-9.0, 0.0, 0.0],
            [0.0, 9.0, 0.0],
            [0.0, -9.0, 0.0],
            [0.0, 0.0, -9.0],
            [0.0, 0.0, 14.0],
        ] {
            assert!(!lens.may_see(at(x, y, z)), "{x} {y} {z}");
        }
    }
}
