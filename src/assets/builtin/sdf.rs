//! Signed distances of the simple solids that the bust is modelled from, and smooth ways to join them.
//!
//! A solid is the set where its function is negative. The functions are bounds of the distance, not the distance: an ellipsoid
//! uses the first-order estimate `k (k − 1) / |∇k|`, which is exact to first order at its surface. The smooth minimum is the
//! cubic polynomial one: `min(a, b) − h³ w / 6` with `h = max(w − |a − b|, 0) / w`, twice differentiable, and equal to the plain
//! minimum where the two are more than `w` apart. Only `+ − × ÷ √` are used, so the values are the same on every machine.

use glam::DVec3;

/// An ellipsoid with half axes `radii`.
pub(super) fn ellipsoid(p: DVec3, centre: DVec3, radii: DVec3) -> f64 {
    let q = (p - centre) / radii;
    let (k, slope) = (q.length(), (q / radii).length());
    if slope > 0.0 { k * (k - 1.0) / slope } else { -radii.min_element() }
}

/// A sphere.
pub(super) fn sphere(p: DVec3, centre: DVec3, radius: f64) -> f64 {
    (p - centre).length() - radius
}

/// The segment from `a` to `b` with a thickness that runs linearly from `ra` to `rb`.
pub(super) fn bar(p: DVec3, (a, ra): (DVec3, f64), (b, rb): (DVec3, f64)) -> f64 {
    let (ap, ab) = (p - a, b - a);
    let t = (ap.dot(ab) / ab.length_squared()).clamp(0.0, 1.0);
    (ap - ab * t).length() - (ra + (rb - ra) * t)
}

/// Joins two solids; `w` is how far the fillet reaches.
pub(super) fn join(a: f64, b: f64, w: f64) -> f64 {
    let h = (w - (a - b).abs()).max(0.0) / w;
    a.min(b) - h * h * h * w / 6.0
}

/// Takes `b` out of `a`, with a rounded edge.
pub(super) fn carve(a: f64, b: f64, w: f64) -> f64 {
    -join(-a, b, w)
}

/// What two solids have in common, with a rounded edge.
pub(super) fn common(a: f64, b: f64, w: f64) -> f64 {
    -join(-a, -b, w)
}
