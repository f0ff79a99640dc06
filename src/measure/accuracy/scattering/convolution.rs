//! The full convolution in two dimensions with a sum of Gaussians, in f64.
//!
//! A Gaussian of two dimensions is the product of two of one, so each is convolved across, then down, and nothing is lost: it is the sum of six that is not
//! separable. What a pixel gets of another is the Gaussian's integral over its width, by the error function, so that one narrower than a pixel is not missed.
//! Beyond the border the outermost pixels go on, as in the pass that is measured.

use crate::render::kernel::PROFILE;

/// Light, row by row.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Width and height.
    pub size: [u32; 2],
    /// Red, green and blue, linear.
    pub texels: Vec<[f64; 3]>,
}

/// Standard deviations after which a Gaussian is nothing: what is left out is 1e-8 of it.
const REACH: f64 = 5.7;
/// Millimetres in a centimetre.
const MM: f64 = 10.0;

impl Picture {
    /// A picture by its places, each from 0 to 1.
    pub fn of(size: [u32; 2], light: impl Fn(f64, f64) -> [f64; 3]) -> Self {
        let [width, height] = size;
        let place = |i: u32, side: u32| (f64::from(i) + 0.5) / f64::from(side);
        let places = (0..height).flat_map(|y| (0..width).map(move |x| (place(x, width), place(y, height))));
        Self { size, texels: places.map(|(x, y)| light(x, y)).collect() }
    }
}

/// A picture after its light scattered by the profile of skin; so many pixels lie on a centimetre.
pub fn convolved(light: &Picture, pixels_per_cm: f64) -> Picture {
    let total = [0, 1, 2].map(|c| PROFILE.iter().map(|g| g.weights[c]).sum::<f64>());
    let mut sum = Picture { size: light.size, texels: vec![[0.0; 3]; light.texels.len()] };
    for gaussian in &PROFILE {
        let kernel = kernel(gaussian.variance.sqrt() * pixels_per_cm / MM);
        // Across and turned, twice, is both ways and upright again.
        let part = across_and_turned(&across_and_turned(light, &kernel), &kernel);
        for (sum, part) in sum.texels.iter_mut().zip(&part.texels) {
            (0..3).for_each(|c| sum[c] += gaussian.weights[c] / total[c] * part[c]);
        }
    }
    sum
}

/// What pixels get of one another by their distance, from 0; for a standard deviation in pixels.
fn kernel(deviation: f64) -> Vec<f64> {
    let reach = libm::ceil(REACH * deviation) as usize;
    let below = |x: f64| 0.5 * (1.0 + libm::erf(x / (deviation * std::f64::consts::SQRT_2)));
    (0..=reach).map(|i| below(i as f64 + 0.5) - below(i as f64 - 0.5)).collect()
}

/// Convolves every row, and makes columns of rows.
fn across_and_turned(picture: &Picture, kernel: &[f64]) -> Picture {
    let [width, height] = picture.size.map(|side| side as usize);
    let mut turned = vec![[0.0; 3]; picture.texels.len()];
    for (y, row) in picture.texels.chunks(width.max(1)).enumerate() {
        for x in 0..width {
            let mut sum = row[x].map(|v| v * kernel[0]);
            for (i, weight) in kernel.iter().enumerate().skip(1) {
                let (a, b) = (row[x.saturating_sub(i)], row[(x + i).min(width - 1)]);
                (0..3).for_each(|c| sum[c] += weight * (a[c] + b[c]));
            }
            turned[x * height + y] = sum;
        }
    }
    Picture { size: [picture.size[1], picture.size[0]], texels: turned }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn even_light_stays_and_no_light_is_lost() {
        let even = Picture::of([20, 12], |_, _| [0.5, 0.25, 1.0]);
        let after = convolved(&even, 20.0);
        let close = |a: f64, b: f64| (a - b).abs() < 1e-7;
        assert!(after.texels.iter().all(|t| close(t[0], 0.5) && close(t[1], 0.25) && close(t[2], 1.0)));
    }

    /// Summed apart from the code, pixel by pixel, with the Gaussians at the middles of fine cells.
    #[test]
    fn a_point_of_light_becomes_the_profile() {
        let (size, pixels_per_cm) = ([61, 61], 20.0);
        let mut point = Picture { size, texels: vec![[0.0; 3]; 61 * 61] };
        point.texels[30 * 61 + 30] = [1.0; 3];
        let after = convolved(&point, pixels_per_cm);
        let mm = 0.5;
        for (dx, dy) in [(0, 0), (2, 1), (5, 0), (7, 7)] {
            let mut expected = 0.0;
            for (i, j) in (0..40).flat_map(|i| (0..40).map(move |j| (i, j))) {
                let at = |d: i32, k: i32| (f64::from(d) + (f64::from(k) + 0.5) / 40.0 - 0.5) * mm;
                let square = at(dx, i) * at(dx, i) + at(dy, j) * at(dy, j);
                let of = |g: &crate::render::kernel::Gaussian| {
                    g.weights[0] * libm::exp(-square / (2.0 * g.variance))
                        / (2.0 * std::f64::consts::PI * g.variance)
                };
                expected += PROFILE.iter().map(of).sum::<f64>() * (mm / 40.0) * (mm / 40.0);
            }
            let found = after.texels[((30 + dy) * 61 + 30 + dx) as usize][0];
            assert!((found - expected).abs() < 2e-5, "{dx} {dy}: {found} {expected}");
        }
    }
}
