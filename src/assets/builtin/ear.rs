//! The ears: a disc of the head's surface, folded outwards to a thin shell.
//!
//! A place on an ear is (s, t) in [−1, 1]², s to the front and t upwards; ρ = max(|s|, |t|) counts from the middle of the concha
//! (0) to the line where the ear grows out of the head (1), and the angle goes around. From ρ = 1 inwards the surface climbs the
//! back of the ear, turns over the helix at ρ ≈ 1/2 and comes down over scapha and antihelix into the concha. [`PROFILE`] is
//! that section, the same all around but for how far the rim stands out; between its knots runs a Catmull-Rom spline.

use std::f64::consts::FRAC_1_SQRT_2;

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

/// Half axes of the root, to the front and upwards, cm.
const ROOT_CM: [f64; 2] = [1.3, 2.6];
/// The rim's distance from the middle to the front, upwards, to the back, downwards, cm.
const RIM_CM: [f64; 4] = [1.35, 3.2, 2.3, 3.2];
/// The rim's distance from the head, in the same order, cm.
const HEIGHT_CM: [f64; 4] = [0.35, 1.5, 1.9, 0.8];
/// The middle of the root seen from the middle of the head, for the ear at +x, cm.
const MIDDLE_CM: DVec3 = dvec3(7.0, -0.5, -0.9);
/// Cosine and sine of the lean to the back.
const LEAN: [f64; 2] = [0.978, 0.208];

/// A place on an ear, in terms of rings.
struct Place {
    /// Which ring.
    rho: f64,
    /// Cosine and sine of the angle around it.
    turn: [f64; 2],
    /// The same on an octagon: the root has as many corners as its block in the cage has nodes, so that the skin around it,
    /// which runs straight from node to node, fits at any number of faces.
    root: [f64; 2],
}

impl Place {
    fn new(s: f64, t: f64) -> Self {
        let rho = s.abs().max(t.abs());
        let (s, t) = if rho > 0.0 { (s / rho, t / rho) } else { (1.0, 0.0) };
        let turn = [s * (1.0 - 0.5 * t * t).sqrt(), t * (1.0 - 0.5 * s * s).sqrt()];
        let octagon = |c: f64, other: f64| {
            if c.abs() == 1.0 { c * (1.0 - other.abs() * (1.0 - FRAC_1_SQRT_2)) } else { c * FRAC_1_SQRT_2 }
        };
        Self { rho, turn, root: [octagon(s, t) * ROOT_CM[0], octagon(t, s) * ROOT_CM[1]] }
    }
}

/// From the plane of the ear to the space around the ear at +x: to the front, upwards, off the head.
fn lean(front: f64, up: f64, off: f64) -> DVec3 {
    dvec3(off, up * LEAN[0] + front * LEAN[1], front * LEAN[0] - up * LEAN[1])
}

/// The direction, seen from the middle of the head, in which the root's disc has its place (s, t). `side` is 1 at +x, −1 at −x.
pub(super) fn direction(side: f64, s: f64, t: f64) -> DVec3 {
    let Place { rho, root, .. } = Place::new(s, t);
    let d = MIDDLE_CM + lean(rho * root[0], rho * root[1], 0.0);
    dvec3(d.x * side, d.y, d.z)
}

/// How far the place (s, t) is moved off the head's surface.
pub(super) fn fold(side: f64, s: f64, t: f64) -> DVec3 {
    let Place { rho, turn: [cos, sin], root } = Place::new(s, t);
    let [out, to_root, off] = profile(rho);
    let rim = rim(cos, sin);
    let [front, up] = [0, 1].map(|k| out * (rim[k] + (root[k] - rim[k]) * to_root) - rho * root[k]);
    let d = lean(front, up, off * height(cos, sin));
    dvec3(d.x * side, d.y, d.z)
}

/// The rim: half an ellipse of its own on each side, wider above than at the lobe.
fn rim(cos: f64, sin: f64) -> [f64; 2] {
    let [front, up, back, down] = RIM_CM;
    let across = if cos > 0.0 { front } else { back * (1.0 + 0.16 * sin) };
    [cos * across, sin * if sin > 0.0 { up } else { down }]
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
