//! What skin looks like: its colour, how it scatters, how it shines. All of it a function of the place on the bust.
//!
//! Colours are sRGB, mixed as sRGB values.

use glam::{DVec3, dvec3};

use super::features::{self, step};
use super::noise::{noise, stretched};

/// Skin without any feature, as the default look has it.
const BASE: DVec3 = dvec3(0.80, 0.62, 0.53);
const LIPS: DVec3 = dvec3(0.66, 0.37, 0.35);
const LIP_LINE: DVec3 = dvec3(0.40, 0.17, 0.16);
const LIDS: DVec3 = dvec3(0.71, 0.50, 0.45);
const HAIR: DVec3 = dvec3(0.22, 0.15, 0.11);
const STUBBLE: DVec3 = dvec3(0.60, 0.51, 0.48);
const FRECKLE: DVec3 = dvec3(0.50, 0.32, 0.25);
/// What blood close below the surface adds.
const FLUSH: DVec3 = dvec3(0.02, -0.075, -0.06);

/// Plain skin: hue wanders over centimetres, redness over one, brightness over millimetres.
pub(super) fn tone(p: DVec3) -> DVec3 {
    let hue = noise(p, 4.3, 1).value;
    let mottle = noise(p, 1.3, 2).value + 0.6 * noise(p, 0.55, 3).value;
    let grain = noise(p, 0.24, 4).value;
    BASE + dvec3(0.022, 0.020, 0.006) * hue
        + dvec3(0.004, -0.020, -0.018) * mottle
        + DVec3::splat(0.014 * grain)
}

/// The bust's colour, and how far light scatters below it.
pub(super) fn color(p: DVec3) -> [u8; 4] {
    let fine = noise(p, 0.3, 5).value;
    let patchy = 0.75 + 0.35 * noise(p, 0.8, 6).value;
    let flush =
        0.9 * features::cheek(p) + 0.8 * features::nose(p) + 0.9 * features::ear(p) + 0.3 * features::lids(p);
    let mut color = tone(p) + FLUSH * flush.min(1.2) * patchy;
    color = color.lerp(STUBBLE, features::beard(p) * (0.30 + 0.14 * fine));
    color = color.lerp(LIDS, 0.7 * features::lids(p));
    color = color.lerp(FRECKLE, 0.35 * freckles(p));
    let lips = features::lips(p);
    color = color.lerp(LIPS + 0.03 * patchy * fine, 0.85 * lips);
    color = color.lerp(LIP_LINE, 0.65 * features::lip_line(p));
    color = color.lerp(HAIR, 0.7 * features::lashes(p));
    let brow = features::brow(p);
    if brow > 0.0 {
        color = color.lerp(HAIR, brow * (0.35 + 0.60 * strokes(p)));
    }
    let scattering = (1.0 - 0.35 * lips) * (1.0 - step(0.05, 0.6, brow));
    let [r, g, b] = color.to_array().map(to_byte);
    [r, g, b, to_byte(scattering)]
}

/// Plain skin's colour; scatters in full.
pub(super) fn plain(p: DVec3) -> [u8; 4] {
    let [r, g, b] = tone(p).to_array().map(to_byte);
    [r, g, b, 255]
}

/// What lies between the charts.
pub(super) fn blank() -> [u8; 4] {
    let [r, g, b] = BASE.to_array().map(to_byte);
    [r, g, b, 255]
}

/// Freckles, a few.
fn freckles(p: DVec3) -> f64 {
    step(0.84, 0.95, noise(p, 0.5, 7).value)
}

/// Hairs that lean outwards and up, 0 between them.
fn strokes(p: DVec3) -> f64 {
    let q = features::folded(p);
    // Hairs fan out: upright by the nose, along the brow at its end.
    let lean = 0.5 + 0.45 * (q.x - 1.0);
    let across = q.x - lean * (q.y - 2.4);
    let hairs = stretched(dvec3(across, q.y, p.x.signum()), dvec3(0.13, 0.55, 1.0), 8).value;
    step(-0.35, 0.25, hairs)
}

/// Specular intensity and roughness.
pub(super) fn specular(p: DVec3) -> [u8; 4] {
    let (oily, lips) = (features::oily(p), features::lips(p));
    let wet = features::lids(p);
    let patchy = 0.05 * noise(p, 0.7, 9).value + 0.04 * noise(p, 0.25, 10).value;
    let mut intensity = 0.50 + 0.22 * oily - 0.06 * features::cheek(p) + 0.12 * wet + patchy;
    let mut roughness = 0.38 - 0.08 * oily + 0.06 * features::cheek(p) - 0.06 * wet - 0.5 * patchy;
    intensity += (0.78 - intensity) * lips;
    roughness += (0.25 - roughness) * lips;
    let brow = features::brow(p);
    intensity *= 1.0 - 0.6 * brow;
    roughness += 0.15 * brow;
    [to_byte(intensity), to_byte(roughness), 0, 255]
}

pub(super) fn to_byte(v: f64) -> u8 {
    (v.clamp(0.0, 1.0) * 255.0 + 0.5) as u8
}
