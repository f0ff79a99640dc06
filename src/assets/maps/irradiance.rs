//! From a picture of the surroundings to the ambient light's irradiance (Ramamoorthi and Hanrahan 2001).
//!
//! The picture is equirectangular: rows from straight up to straight down, columns once around. It is as the default camera sees it: the
//! middle of the picture lies behind the model, towards −z, and what is right of it towards +x.
//!
//! With L the radiance from a direction d and Y_i = K_i b_i the real spherical harmonics of degree l, the irradiance over π at a normal n is
//! Σ (A_l/π) K_i² b_i(n) ∫ L b_i dω, A = π, 2π/3, π/4. What stands before b_i(n) is the coefficient of
//! [`Ambient::irradiance`](crate::canvas::look::Ambient::irradiance). The integral is a sum over texels, each with the exact solid angle of its row and its direction at
//! its centre; rows are summed in parallel and added in order.

use std::f64::consts::{PI, TAU};

use rayon::prelude::*;

use crate::canvas::image::Image;

/// Of every coefficient: (A_l/π) K_i².
const FACTORS: [f64; 9] = [
    1.0 / (4.0 * PI),
    1.0 / (2.0 * PI),
    1.0 / (2.0 * PI),
    1.0 / (2.0 * PI),
    15.0 / (16.0 * PI),
    15.0 / (16.0 * PI),
    5.0 / (64.0 * PI),
    15.0 / (16.0 * PI),
    15.0 / (64.0 * PI),
];

/// b_i: 1, y, z, x, xy, yz, 3z² − 1, xz, x² − y².
fn basis([x, y, z]: [f64; 3]) -> [f64; 9] {
    [1.0, y, z, x, x * y, y * z, 3.0 * z * z - 1.0, x * z, x * x - y * y]
}

type Sums = [[f64; 3]; 9];

/// The nine coefficients a channel of a picture in sRGB.
pub(super) fn irradiance(picture: &Image) -> [[f32; 3]; 9] {
    let [width, height] = picture.size;
    let linear: Vec<f64> = (0..=255).map(|v| to_linear(f64::from(v) / 255.0)).collect();
    let turns: Vec<(f64, f64)> = (0..width).map(|i| libm::sincos(azimuth(i, width))).collect();
    let rows: Vec<Sums> = (0..height).into_par_iter().map(|j| row(picture, j, &linear, &turns)).collect();
    let mut total = [[0.0; 3]; 9];
    rows.iter().for_each(|row| add(&mut total, row, 1.0));
    std::array::from_fn(|i| total[i].map(|sum| (sum * FACTORS[i]) as f32))
}

/// The angle from −z towards +x at the centre of a column.
fn azimuth(column: u32, width: u32) -> f64 {
    ((f64::from(column) + 0.5) / f64::from(width) - 0.5) * TAU
}

/// The integral over a row of texels.
fn row(picture: &Image, j: u32, linear: &[f64], turns: &[(f64, f64)]) -> Sums {
    let [width, height] = picture.size;
    let edge = |j: u32| libm::cos(PI * f64::from(j) / f64::from(height));
    let solid_angle = (edge(j) - edge(j + 1)) * TAU / f64::from(width);
    let (sin, cos) = libm::sincos(PI * (f64::from(j) + 0.5) / f64::from(height));
    let mut sums = [[0.0; 3]; 9];
    for (i, (right, ahead)) in (0..width).zip(turns) {
        let [r, g, b, _] = picture.at(i, j).map(|v| linear[v as usize]);
        let light = basis([sin * right, cos, -sin * ahead]).map(|b_i| [r * b_i, g * b_i, b * b_i]);
        add(&mut sums, &light, solid_angle);
    }
    sums
}

fn add(sums: &mut Sums, more: &Sums, times: f64) {
    for (sum, more) in sums.iter_mut().flatten().zip(more.iter().flatten()) {
        *sum += more * times;
    }
}

fn to_linear(v: f64) -> f64 {
    if v <= 0.04045 { v / 12.92 } else { libm::pow((v + 0.055) / 1.055, 2.4) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A picture whose every texel is lit by what is seen in its direction, linear.
    fn surroundings(size: [u32; 2], light: impl Fn([f64; 3]) -> f64) -> Image {
        let mut image = Image::filled(size, [0; 4]);
        let [width, height] = size;
        for (k, texel) in image.texels.iter_mut().enumerate() {
            let (i, j) = (k as u32 % width, k as u32 / width);
            let (sin, cos) = libm::sincos(PI * (f64::from(j) + 0.5) / f64::from(height));
            let (right, ahead) = libm::sincos(azimuth(i, width));
            let v = light([sin * right, cos, -sin * ahead]);
            let encoded = if v <= 0.003_130_8 { v * 12.92 } else { 1.055 * libm::pow(v, 1.0 / 2.4) - 0.055 };
            *texel = [(encoded * 255.0).round() as u8, 255, 0, 255];
        }
        image
    }

    /// What a white surface with this normal reflects, in the first channel.
    fn reflected(coefficients: &[[f32; 3]; 9], normal: [f64; 3]) -> f64 {
        basis(normal).iter().zip(coefficients).map(|(b, c)| b * f64::from(c[0])).sum()
    }

    #[test]
    fn light_from_everywhere_is_reflected_whole_whichever_way_one_looks() {
        let found = irradiance(&surroundings([16, 8], |_| 1.0));
        assert!((found[0][0] - 1.0).abs() < 1e-6 && found[0][1] == found[0][0] && found[0][2] == 0.0);
        // The directions at the middles of coarse rows are not quite the average ones.
        assert!(found[1..].iter().flatten().all(|c| c.abs() < 0.01), "{found:?}");
    }

    /// A cosine lobe around an axis has the coefficients ¼, ⅓ and 5/64 of the zonal harmonics 1, cos and 3 cos² − 1.
    #[test]
    fn a_lobe_gives_its_known_coefficients_around_its_own_axis() {
        for axis in [[0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.6, -0.8]] {
            let dot = |a: [f64; 3]| a.iter().zip(axis).map(|(a, b)| a * b).sum::<f64>();
            let found = irradiance(&surroundings([128, 64], |d| dot(d).max(0.0)));
            for normal in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.48, -0.6, 0.64], axis] {
                let c = dot(normal);
                let expected = 0.25 + c / 3.0 + 5.0 / 64.0 * (3.0 * c * c - 1.0) / 2.0;
                let reflected = reflected(&found, normal);
                assert!((reflected - expected).abs() < 0.004, "{axis:?} {normal:?}: {reflected} {expected}");
            }
        }
    }

    /// The picture's middle lies behind the model, its right towards +x, its top upwards.
    #[test]
    fn the_picture_is_as_the_camera_sees_it() {
        let bright = |at: [u32; 2]| {
            let mut picture = Image::filled([16, 8], [0, 0, 0, 255]);
            picture.texels[(at[1] * 16 + at[0]) as usize] = [255; 4];
            let found = irradiance(&picture);
            [3, 1, 2].map(|i| f64::from(found[i][0]) / f64::from(found[0][0]))
        };
        let [x, y, z] = bright([8, 3]);
        assert!(z < -1.5 && x > 0.0 && x < 0.5 && y > 0.0 && y < 0.5, "{x} {y} {z}");
        let [x, ..] = bright([11, 3]);
        assert!(x > 1.5);
        let [_, y, _] = bright([0, 0]);
        assert!(y > 1.5);
    }
}
