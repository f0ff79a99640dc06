//! FLIP: how different two pictures look when one flips between them (Andersson et al. 2020, "FLIP: A Difference Evaluator for Alternating Images").
//!
//! All parts of the paper for pictures of low dynamic range, in f64:
//! - **colour** (§4.1): both pictures in YCxCz are filtered by the eye's contrast sensitivity, one filter for each of the three, clamped to what a screen can
//!   show, and compared in L*a*b* after Hunt's adjustment by the HyAB distance, whose large values are compressed;
//! - **features** (§4.2): edges and points of the achromatic channel, as first and second derivatives of a Gaussian;
//! - **both** (§4.3): ΔE = ΔE_colour^(1 − ΔE_feature), from 0 to 1; the mean over the picture.
//!
//! The filters are those of a screen seen at `PIXELS_PER_DEGREE`, the paper's default: 0.7 m away, 3840 pixels on 0.7 m. Beyond the border the
//! outermost pixels go on. Not here: the maps' colours, and the pooling by weighted histograms.

use std::f64::consts::PI;

use crate::render::srgb;

/// The paper's default.
const PIXELS_PER_DEGREE: f64 = 67.020_643_276_582_26;
/// The contrast sensitivity's Gaussians: two heights and widths each for the achromatic, the red-green and the blue-yellow channel (Table 1).
const SENSITIVITY: [[f64; 4]; 3] =
    [[1.0, 0.0047, 0.0, 1e-5], [1.0, 0.0053, 0.0, 1e-5], [34.1, 0.04, 13.5, 0.025]];
/// How colour differences are compressed: the exponent, and the knee.
const EXPONENT: f64 = 0.7;
const KNEE: [f64; 2] = [0.4, 0.95];
/// Width of a feature, degrees, and the exponent of its difference.
const FEATURE_WIDTH: f64 = 0.082;
const FEATURE_EXPONENT: f64 = 0.5;
/// The white of sRGB in XYZ.
const WHITE: [f64; 3] = [0.950_428_545_4, 1.0, 1.088_900_371_0];
/// From linear sRGB to XYZ.
const TO_XYZ: [[f64; 3]; 3] = [
    [0.412_390_799_3, 0.357_584_339_4, 0.180_480_788_4],
    [0.212_639_005_9, 0.715_168_678_8, 0.072_192_315_4],
    [0.019_330_818_7, 0.119_194_779_8, 0.950_532_152_2],
];
/// And back.
const FROM_XYZ: [[f64; 3]; 3] = [
    [3.240_969_941_9, -1.537_383_177_6, -0.498_610_760_3],
    [-0.969_243_636_3, 1.875_967_501_5, 0.041_555_057_4],
    [0.055_630_079_7, -0.203_976_958_9, 1.056_971_514_2],
];

type Color = [f64; 3];

/// The mean FLIP of two pictures of a size, row by row, sRGB from 0 to 1.
pub fn mean(size: [u32; 2], reference: &[Color], test: &[Color]) -> f64 {
    let size = size.map(|side| side as usize);
    let [a, b] = [reference, test].map(|picture| Seen::new(size, picture));
    let differences = (0..reference.len()).map(|at| {
        let off = |k: usize| (a.features[k][at] - b.features[k][at]).abs();
        let feature = libm::pow(off(0).max(off(1)) * std::f64::consts::FRAC_1_SQRT_2, FEATURE_EXPONENT);
        libm::pow(compressed(&a.colours[at], &b.colours[at]), 1.0 - feature.min(1.0))
    });
    differences.sum::<f64>() / reference.len().max(1) as f64
}

/// sRGB of linear light, clamped.
pub fn encode(light: f64) -> f64 {
    let light = if light > 0.0 { light.min(1.0) } else { 0.0 };
    if light <= 0.003_130_8 { 12.92 * light } else { 1.055 * libm::pow(light, 1.0 / 2.4) - 0.055 }
}

/// A picture as the eye has it.
struct Seen {
    /// Filtered, in L*a*b* with Hunt's adjustment.
    colours: Vec<Color>,
    /// How strong edges and points are, unfiltered.
    features: [Vec<f64>; 2],
}

impl Seen {
    fn new(size: [usize; 2], picture: &[Color]) -> Self {
        let opponent: Vec<Color> = picture.iter().map(|c| to_opponent(c.map(srgb::decode))).collect();
        let planes =
            [0, 1, 2].map(|c| Plane { size, values: opponent.iter().map(|color| color[c]).collect() });
        let [y, cx, cz] = [0, 1, 2].map(|c| sensed(&planes[c], SENSITIVITY[c]));
        let filtered = (0..picture.len()).map(|at| [y.values[at], cx.values[at], cz.values[at]]);
        let colours = filtered.map(|color| hunt(to_lab(from_opponent(color)))).collect();
        let lightness = planes[0].values.iter().map(|y| (y + 16.0) / 116.0).collect();
        Self { colours, features: features(&Plane { size, values: lightness }) }
    }
}

fn times(m: &[[f64; 3]; 3], v: Color) -> Color {
    m.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
}

fn to_xyz(rgb: Color) -> Color {
    let xyz = times(&TO_XYZ, rgb);
    [0, 1, 2].map(|i| xyz[i] / WHITE[i])
}

/// YCxCz of linear sRGB.
fn to_opponent(rgb: Color) -> Color {
    let [x, y, z] = to_xyz(rgb);
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

/// Linear sRGB, clamped to what a screen can show.
fn from_opponent([lightness, cx, cz]: Color) -> Color {
    let y = (lightness + 16.0) / 116.0;
    let xyz = [y + cx / 500.0, y, y - cz / 200.0];
    times(&FROM_XYZ, [0, 1, 2].map(|i| xyz[i] * WHITE[i])).map(|v| v.clamp(0.0, 1.0))
}

fn to_lab(rgb: Color) -> Color {
    let edge = 6.0 / 29.0;
    let f =
        |t: f64| if t > edge * edge * edge { libm::cbrt(t) } else { t / (3.0 * edge * edge) + 4.0 / 29.0 };
    let [x, y, z] = to_xyz(rgb).map(f);
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

/// Colours are the weaker the darker they are.
fn hunt([l, a, b]: Color) -> Color {
    [l, 0.01 * l * a, 0.01 * l * b]
}

fn hyab(a: &Color, b: &Color) -> f64 {
    (a[0] - b[0]).abs() + libm::hypot(a[1] - b[1], a[2] - b[2])
}

/// The colour difference from 0 to 1: green against blue, the farthest there is, is 1.
fn compressed(a: &Color, b: &Color) -> f64 {
    let [green, blue] = [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|rgb| hunt(to_lab(rgb)));
    let most = libm::pow(hyab(&green, &blue), EXPONENT);
    let (off, knee) = (libm::pow(hyab(a, b), EXPONENT), KNEE[0] * most);
    if off < knee { KNEE[1] / knee * off } else { KNEE[1] + (off - knee) / (most - knee) * (1.0 - KNEE[1]) }
}

/// One value a pixel, row by row.
struct Plane {
    size: [usize; 2],
    values: Vec<f64>,
}

impl Plane {
    /// Weighted across, then down; the weights are around the pixel itself.
    fn filtered(&self, across: &[f64], down: &[f64]) -> Self {
        self.across_and_turned(across).across_and_turned(down)
    }

    fn across_and_turned(&self, weights: &[f64]) -> Self {
        let ([width, height], reach) = (self.size, weights.len() / 2);
        let mut values = vec![0.0; self.values.len()];
        for (y, row) in self.values.chunks(width.max(1)).enumerate() {
            for x in 0..width {
                let at = |i: usize| row[(x + i).saturating_sub(reach).min(width - 1)];
                values[x * height + y] = weights.iter().enumerate().map(|(i, w)| w * at(i)).sum();
            }
        }
        Self { size: [height, width], values }
    }
}

/// Filtered by a sum of two Gaussians, each separable, that together sum to 1.
fn sensed(plane: &Plane, [a1, b1, a2, b2]: [f64; 4]) -> Plane {
    let widest = SENSITIVITY.iter().flat_map(|s| [s[1], s[3]]).fold(0.0, f64::max);
    let reach = libm::ceil(3.0 * (widest / (2.0 * PI * PI)).sqrt() * PIXELS_PER_DEGREE) as i32;
    let gaussian = |b: f64| {
        let at = |i: i32| f64::from(i) / PIXELS_PER_DEGREE;
        (-reach..=reach).map(|i| libm::exp(-PI * PI * at(i) * at(i) / b)).collect::<Vec<f64>>()
    };
    let parts = [(a1, b1), (a2, b2)].map(|(a, b)| (a * (PI / b).sqrt(), gaussian(b)));
    let total = |(height, weights): &(f64, Vec<f64>)| {
        let sum: f64 = weights.iter().sum();
        height * sum * sum
    };
    let whole: f64 = parts.iter().map(total).sum();
    let mut values = vec![0.0; plane.values.len()];
    for (height, weights) in &parts {
        let part = plane.filtered(weights, weights);
        values.iter_mut().zip(part.values).for_each(|(sum, v)| *sum += height / whole * v);
    }
    Plane { size: plane.size, values }
}

/// How strong edges and points are: first and second derivatives of a Gaussian, across and down.
fn features(lightness: &Plane) -> [Vec<f64>; 2] {
    let deviation = 0.5 * FEATURE_WIDTH * PIXELS_PER_DEGREE;
    let reach = libm::ceil(3.0 * deviation) as i32;
    let gauss = |x: f64| libm::exp(-x * x / (2.0 * deviation * deviation));
    let all = |of: &dyn Fn(f64) -> f64| (-reach..=reach).map(|i| of(f64::from(i))).collect::<Vec<f64>>();
    let mut gaussian = all(&gauss);
    let sum: f64 = gaussian.iter().sum();
    gaussian.iter_mut().for_each(|v| *v /= sum);
    let edge = balanced(all(&|x| -x * gauss(x)));
    let point = balanced(all(&|x| (x * x / (deviation * deviation) - 1.0) * gauss(x)));
    [edge, point].map(|weights| {
        let (across, down) =
            (lightness.filtered(&weights, &gaussian), lightness.filtered(&gaussian, &weights));
        across.values.iter().zip(&down.values).map(|(a, b)| libm::hypot(*a, *b)).collect()
    })
}

/// Scaled so that what is positive sums to 1, and what is negative to −1.
fn balanced(weights: Vec<f64>) -> Vec<f64> {
    let up: f64 = weights.iter().filter(|w| **w > 0.0).sum();
    let down: f64 = -weights.iter().filter(|w| **w < 0.0).sum::<f64>();
    weights.into_iter().map(|w| if w > 0.0 { w / up } else { w / down }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: [u32; 2] = [24, 20];

    fn even(color: Color) -> Vec<Color> {
        vec![color; 24 * 20]
    }

    #[test]
    fn equal_pictures_are_nought_apart_and_green_and_blue_one() {
        let green = even([0.0, 1.0, 0.0]);
        assert_eq!(mean(SIZE, &green, &green), 0.0);
        let far = mean(SIZE, &green, &even([0.0, 0.0, 1.0]));
        assert!((far - 1.0).abs() < 1e-6, "{far}");
    }

    #[test]
    fn what_looks_more_different_is_farther() {
        let grey = even([0.5; 3]);
        let off = |by: f64| mean(SIZE, &grey, &even([0.5 + by; 3]));
        assert!(0.0 < off(0.01) && off(0.01) < off(0.1) && off(0.1) < off(0.4) && off(0.4) < 1.0);
        // The eye hardly sees a fine checkerboard of colour, but one of grey.
        let checker = |on: Color| {
            let texel = |i: usize| if (i % 24 + i / 24).is_multiple_of(2) { on } else { [0.5; 3] };
            (0..24 * 20).map(texel).collect::<Vec<_>>()
        };
        let [blue, light] = [[0.5, 0.5, 0.7], [0.7; 3]].map(|on| mean(SIZE, &grey, &checker(on)));
        assert!(blue < light, "{blue} {light}");
    }

    #[test]
    fn colours_come_back_from_the_eyes_space() {
        for rgb in [[0.2, 0.5, 0.9], [1.0, 0.0, 0.0], [0.0; 3]] {
            let back = from_opponent(to_opponent(rgb));
            assert!((0..3).all(|i| (back[i] - rgb[i]).abs() < 1e-8), "{rgb:?} {back:?}");
        }
        assert!((encode(crate::render::srgb::decode(0.6)) - 0.6).abs() < 1e-12);
    }
}
