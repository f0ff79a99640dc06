//! The shape of the bust, as a solid: `head(p) < 0` inside. Lengths are centimetres; y up, the face towards +z, x = 0 the plane of
//! symmetry, the origin at the middle of the head. Ears are not in it: they are folded out of the surface by `ear`.
//!
//! A head is 22 cm high, with the eyes half way up. The order follows a sculptor's: skull and jaw, neck, then brow, sockets,
//! nose, mouth, and the eyes last.

use glam::{DVec3, dvec3};

use super::sdf::{bar, carve, common, ellipsoid, join, sphere};

/// Height of the plane that the neck stands on, cm.
pub(super) const NECK_BASE_CM: f64 = -16.0;

/// The solid. Depends on |x| alone, so that both halves are the same bit for bit.
pub(super) fn head(p: DVec3) -> f64 {
    let p = dvec3(p.x.abs(), p.y, p.z);
    let mut d = join(skull(p), neck(p), 2.2);
    if p.z > 1.0 && p.y < 7.0 {
        d = brow(p, d);
        d = nose(p, d);
        d = mouth(p, d);
        d = eye(p, d);
    }
    common(d, NECK_BASE_CM - p.y, 2.0)
}

fn skull(p: DVec3) -> f64 {
    let mut d = ellipsoid(p, dvec3(0.0, 3.5, -1.3), dvec3(7.3, 8.3, 9.0));
    d = join(d, ellipsoid(p, dvec3(0.0, 4.6, 2.6), dvec3(6.1, 5.0, 5.9)), 2.0);
    d = join(d, ellipsoid(p, dvec3(0.0, -2.4, 2.4), dvec3(5.5, 7.4, 6.2)), 2.0);
    d = join(d, bar(p, (dvec3(5.3, -0.8, 0.4), 1.2), (dvec3(4.7, -5.8, 0.9), 1.1)), 2.4);
    d = join(d, bar(p, (dvec3(4.7, -5.8, 0.9), 1.1), (dvec3(1.5, -8.7, 6.4), 1.2)), 2.0);
    d = join(d, ellipsoid(p, dvec3(0.0, -8.5, 7.0), dvec3(2.0, 1.5, 1.9)), 1.6);
    join(d, ellipsoid(p, dvec3(3.7, -1.4, 4.5), dvec3(2.0, 1.4, 2.6)), 3.2)
}

fn neck(p: DVec3) -> f64 {
    let q = dvec3(p.x * 0.97, p.y, p.z);
    let d = bar(q, (dvec3(0.0, -4.0, -2.4), 4.7), (dvec3(0.0, -17.0, -3.2), 5.4));
    let muscle = bar(p, (dvec3(4.5, -2.5, -2.6), 1.0), (dvec3(1.4, -17.0, 1.9), 1.0));
    let shoulder = bar(p, (dvec3(2.0, -8.0, -3.8), 2.6), (dvec3(3.4, -19.0, -3.8), 3.8));
    let larynx = sphere(p, dvec3(0.0, -11.2, 1.7), 1.1);
    join(join(join(d, muscle, 1.6), shoulder, 2.5), larynx, 1.6)
}

fn brow(p: DVec3, mut d: f64) -> f64 {
    d = join(d, bar(p, (dvec3(0.8, 2.35, 7.95), 0.6), (dvec3(4.8, 2.4, 5.7), 0.55)), 1.5);
    carve(d, ellipsoid(p, dvec3(3.1, 0.75, 9.0), dvec3(1.75, 1.1, 1.8)), 1.3)
}

fn nose(p: DVec3, mut d: f64) -> f64 {
    d = join(d, bar(p, (dvec3(0.0, 1.6, 7.4), 0.9), (dvec3(0.0, -1.8, 8.8), 1.2)), 1.4);
    d = join(d, bar(p, (dvec3(0.0, 1.6, 8.0), 0.45), (dvec3(0.0, -2.0, 10.1), 0.6)), 0.9);
    d = join(d, ellipsoid(p, dvec3(0.0, -2.3, 10.15), dvec3(0.85, 0.75, 0.9)), 0.5);
    d = join(d, ellipsoid(p, dvec3(0.98, -2.72, 8.75), dvec3(0.7, 0.6, 1.1)), 0.6);
    carve(d, ellipsoid(p, dvec3(0.5, -3.4, 9.4), dvec3(0.27, 0.3, 0.45)), 0.35)
}

fn mouth(p: DVec3, mut d: f64) -> f64 {
    d = join(d, ellipsoid(p, dvec3(0.0, -5.3, 6.1), dvec3(3.2, 2.5, 2.5)), 1.8);
    d = carve(d, bar(p, (dvec3(0.0, -3.7, 9.35), 0.25), (dvec3(0.0, -4.6, 9.35), 0.3)), 0.6);
    let q = bent(p);
    let (upper, lower) = (upper_lip(q), lower_lip(q));
    d = join(d, upper, 0.3);
    d = join(d, lower, 0.3);
    d = carve(d, ellipsoid(q, dvec3(0.0, -5.58 + 0.01 * p.x * p.x, 9.1), dvec3(2.8, 0.17, 0.42)), 0.45);
    carve(d, ellipsoid(p, dvec3(0.0, -7.2, 9.35), dvec3(1.9, 0.5, 0.8)), 1.0)
}

/// The mouth is modelled flat and bent around the teeth.
fn bent(p: DVec3) -> DVec3 {
    dvec3(p.x, p.y, p.z + 0.1 * p.x * p.x)
}

fn upper_lip(q: DVec3) -> f64 {
    join(
        bar(q, (dvec3(0.4, -5.02, 8.65), 0.4), (dvec3(2.4, -5.55, 8.62), 0.16)),
        ellipsoid(q, dvec3(0.0, -5.2, 8.7), dvec3(0.5, 0.34, 0.4)),
        0.3,
    )
}

fn lower_lip(q: DVec3) -> f64 {
    bar(q, (dvec3(0.0, -6.15, 8.5), 0.52), (dvec3(2.3, -5.72, 8.6), 0.16))
}

/// How far a point of the face is from the lips alone: about 0 on them.
pub(super) fn lips(p: DVec3) -> f64 {
    let q = bent(dvec3(p.x.abs(), p.y, p.z));
    upper_lip(q).min(lower_lip(q))
}

/// The eyeball, and the ridges of its two lids, each bent once.
fn eye(p: DVec3, mut d: f64) -> f64 {
    let (inner, outer) = (dvec3(1.7, 0.5, 7.35), dvec3(4.5, 0.75, 6.45));
    let (top, bottom) = (dvec3(2.95, 1.25, 7.4), dvec3(3.15, 0.12, 7.36));
    d = join(d, ellipsoid(p, dvec3(3.1, 0.7, 6.4), dvec3(1.6, 1.25, 1.28)), 0.2);
    let upper = join(bar(p, (inner, 0.22), (top, 0.3)), bar(p, (top, 0.3), (outer, 0.26)), 0.6);
    let lower = join(bar(p, (inner, 0.18), (bottom, 0.22)), bar(p, (bottom, 0.22), (outer, 0.22)), 0.6);
    join(d, join(upper, lower, 0.15), 0.4)
}
