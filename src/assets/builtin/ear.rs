//! The ears: a disc of the head's surface, folded outwards to a thin shell.
//!
//! A place on an ear is (s, t) in [−1, 1]², s to the front and t upwards; ρ = max(|s|, |t|) counts from the middle of the concha
//! (0) to the line where the ear grows out of the head (1), and the angle goes around. From ρ = 1 inwards the surface climbs the
//! back of the ear, turns over the helix at ρ ≈ 1/2 and comes down over scapha and antihelix into the concha. [`PROFILE`] is
//! that section, the same all around but for how far the rim stands out; between its knots runs a Catmull-Rom spline.

use glam::{DVec3, dvec3};

/// From the middle of the concha to the root, ρ in steps of 1/8: how far out in the plane of the ear, between nothing (0) and the
/// rim (1); how far towards the root (1 is on it); how far off the head, in heights of the rim.
const PROFILE: [[f64; 3]; 9] = [
    [0.00, 0.0, 0.00],
    [0.34, 0.0, 0.10],
    [0.58, 0.0, 0.74],
    [0.77, 0.0, 0.80],
    [0.93, 0.0, 1.03],
    [1.00, 0.0, 0.90],
    [1.00, 0.4, 0.52],
    [1.00, 0.8, 0.18],
    [1.00, 1.0, 0.00],
];

/// Half axes of the root's ellipse, to the front and upwards, cm.
const ROOT_CM: [f64; 2] = [1.3, 2.6];
/// The rim's distance from the middle to the front, upwards, to the back, downwards, cm.
const RIM_CM: [f64; 4] = [1.35, 3.2, 2.3, 3.2];
/// The rim's distance from the head, in the same order, cm.
const HEIGHT_CM: [f64; 4] = [0.35, 1.5, 1.9, 0.8];
/// The middle of the root seen from the middle of the head, for the ear at +x, cm.
const MIDDLE_CM: DVec3 = dvec3(7.0, -0.5, -0.9);
/// Cosine and sine of the lean to the back.
const LEAN: [f64; 2] = [0.978, 0.208];

/// ρ, and the cosine and sine of the angle.
fn polar(s: f64, t: f64) -> (f64, f64, f64) {
    let rho = s.abs().max(t.abs());
    if rho == 0.0 {
        return (0.0, 1.0, 0.0);
    }
    let (s, t) = (s / rho, t / rho);
    (rho, s * (1.0 - 0.5 * t * t).sqrt(), t * (1.0 - 0.5 * s * s).sqrt())
}

/// From the plane of the ear to the space around the ear at +x: to the front, upwards, off the head.
fn lean(front: f64, up: f64, off: f64) -> DVec3 {
    dvec3(off, up * LEAN[0] + front * LEAN[1], front * LEAN[0] - up * LEAN[1])
}

/// The direction, seen from the middle of the head, in which the root's disc has its place (s, t). `side` is 1 at +x, −1 at −x.
pub(super) fn direction(side: f64, s: f64, t: f64) -> DVec3 {
    let (rho, cos, sin) = polar(s, t);
    let d = MIDDLE_CM + lean(ROOT_CM[0] * rho * cos, ROOT_CM[1] * rho * sin, 0.0);
    dvec3(d.x * side, d.y, d.z)
}

/// How far the place (s, t) is moved off the head's surface.
pub(super) fn fold(side: f64, s: f64, t: f64) -> DVec3 {
    let (rho, cos, sin) = polar(s, t);
    let [out, root, off] = profile(rho);
    let (rim_front, rim_up) = rim(cos, sin);
    let towards = |rim: f64, root_cm: f64| out * (rim + (root_cm - rim) * root);
    let front = towards(rim_front, ROOT_CM[0] * cos) - ROOT_CM[0] * rho * cos;
    let up = towards(rim_up, ROOT_CM[1] * sin) - ROOT_CM[1] * rho * sin;
    let d = lean(front, up, off * height(cos, sin));
    dvec3(d.x * side, d.y, d.z)
}

/// The rim: half an ellipse of its own on each side, wider above than at the lobe.
fn rim(cos: f64, sin: f64) -> (f64, f64) {
    let [front, up, back, down] = RIM_CM;
    let across = if cos > 0.0 { front } else { back * (1.0 + 0.16 * sin) };
    (cos * across, sin * if sin > 0.0 { up } else { down })
}

fn height(cos: f64, sin: f64) -> f64 {
    let [front, up, back, down] = HEIGHT_CM;
    cos * cos * if cos > 0.0 { front } else { back } + sin * sin * if sin > 0.0 { up } else { down }
}

fn profile(rho: f64) -> [f64; 3] {
    let last = PROFILE.len() - 1;
    let x = (rho * last as f64).clamp(0.0, last as f64);
    let i = (x as usize).min(last - 1);
    let knot = |k: usize| PROFILE[k.min(last)];
    let around = [knot(i.saturating_sub(1)), knot(i), knot(i + 1), knot(i + 2)];
    [0, 1, 2].map(|c| catmull_rom(around.map(|k| k[c]), x - i as f64))
}

fn catmull_rom([a, b, c, d]: [f64; 4], t: f64) -> f64 {
    b + 0.5 * t * (c - a + t * (2.0 * a - 5.0 * b + 4.0 * c - d + t * (3.0 * (b - c) + d - a)))
}
