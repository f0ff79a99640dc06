//! Where on the bust is what: masks over space, 1 within a feature, 0 away from it, smooth between. Lengths are centimetres.
//!
//! The places are those of the solid of `sculpt`; the two sides are the same, so masks look at |x| alone.

use glam::{DVec3, dvec3};

use super::super::sculpt;

/// A point as the masks see it: on the side of +x.
pub(super) fn folded(p: DVec3) -> DVec3 {
    dvec3(p.x.abs(), p.y, p.z)
}

/// From 0 at `low` to 1 at `high`, or the other way round.
pub(super) fn step(low: f64, high: f64, v: f64) -> f64 {
    let t = ((v - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// 1 in the middle of an ellipsoid, 0 from its border on.
fn spot(p: DVec3, centre: DVec3, radii: DVec3) -> f64 {
    let t = 1.0 - ((p - centre) / radii).length_squared().min(1.0);
    t * t
}

pub(super) fn lips(p: DVec3) -> f64 {
    if p.z < 5.0 || p.y > -4.0 || p.y < -7.5 || p.x.abs() > 3.5 {
        return 0.0;
    }
    step(0.17, 0.03, sculpt::lips(p))
}

/// The line where the lips meet.
pub(super) fn lip_line(p: DVec3) -> f64 {
    let q = folded(p);
    if q.z < 5.0 { 0.0 } else { step(0.16, 0.0, (q.y + 5.58 - 0.01 * q.x * q.x).abs()) * step(2.7, 2.3, q.x) }
}

pub(super) fn brow(p: DVec3) -> f64 {
    let q = folded(p);
    if q.z < 3.5 || !(1.5..4.0).contains(&q.y) {
        return 0.0;
    }
    let along = (q.x - 0.95) / 4.0;
    let middle = 2.45 + 1.5 * along * (1.2 - along);
    let half = 0.42 - 0.26 * along;
    let ends = step(-0.06, 0.1, along) * step(1.05, 0.85, along);
    ends * step(half, 0.45 * half, (q.y - middle).abs())
}

/// Both lids and what shows between them.
pub(super) fn lids(p: DVec3) -> f64 {
    spot(folded(p), dvec3(3.1, 0.7, 7.5), dvec3(2.0, 1.35, 2.0))
}

/// The line where the lids meet.
pub(super) fn lashes(p: DVec3) -> f64 {
    let q = folded(p);
    if q.z < 5.0 {
        return 0.0;
    }
    let along = (q.x - 3.1) / 1.45;
    let line = 0.45 - 0.25 * (1.0 - along * along) + 0.08 * along;
    step(1.05, 0.9, along.abs()) * step(0.13, 0.04, (q.y - line).abs())
}

pub(super) fn cheek(p: DVec3) -> f64 {
    spot(folded(p), dvec3(4.3, -2.1, 6.4), dvec3(3.6, 3.3, 4.0))
}

pub(super) fn nose(p: DVec3) -> f64 {
    spot(folded(p), dvec3(0.0, -2.3, 9.6), dvec3(1.9, 1.6, 2.0))
}

pub(super) fn ear(p: DVec3) -> f64 {
    spot(folded(p), dvec3(8.4, -0.4, -1.8), dvec3(2.4, 4.6, 3.6)).sqrt()
}

pub(super) fn forehead(p: DVec3) -> f64 {
    if p.z < 0.0 { 0.0 } else { spot(folded(p), dvec3(0.0, 5.6, 7.4), dvec3(5.6, 3.0, 5.0)) }
}

/// Forehead, bridge of the nose, chin: where skin is oily.
pub(super) fn oily(p: DVec3) -> f64 {
    let bridge = spot(folded(p), dvec3(0.0, 0.5, 9.2), dvec3(1.3, 4.0, 2.5));
    let chin = spot(folded(p), dvec3(0.0, -8.6, 8.2), dvec3(1.8, 1.4, 2.5));
    (forehead(p) + nose(p) + bridge + chin).min(1.0)
}

/// Chin, jaw and upper lip, where a beard would be.
pub(super) fn beard(p: DVec3) -> f64 {
    let q = folded(p);
    let jaw = spot(q, dvec3(2.6, -8.0, 5.6), dvec3(4.2, 2.6, 5.2));
    let chin = spot(q, dvec3(0.0, -8.4, 7.6), dvec3(3.0, 2.4, 3.5));
    let moustache = spot(q, dvec3(1.0, -4.3, 8.8), dvec3(2.4, 1.0, 2.0));
    (jaw + chin + moustache).min(1.0) * (1.0 - lips(p))
}

pub(super) fn neck(p: DVec3) -> f64 {
    step(-9.0, -11.0, p.y) * step(2.5, 0.5, p.z - 0.3 * (p.y + 12.0))
}
