//! Points, signs and boxes. Knows nothing of meshes, files or engines.
//!
//! - [`exact`]: the sign of a polynomial in coordinates, exactly: a floating-point filter first, integers where it is not sure;
//! - [`predicates`]: the signs that decide topology, by name;
//! - [`double`]: arithmetic with twice the digits, for positions that are rounded once;
//! - [`crossing`]: whether two triangles cross;
//! - [`bvh`]: a bounding volume hierarchy that follows every edit.

pub mod bvh;
pub mod crossing;
pub mod double;
pub mod exact;
pub mod predicates;

use glam::DVec3;

/// The distance from `magnitude` to the next larger float: what a coordinate of that size can resolve.
pub fn ulp(magnitude: f64) -> f64 {
    let magnitude = magnitude.abs().max(f64::MIN_POSITIVE);
    f64::from_bits(magnitude.to_bits() + 1) - magnitude
}

/// Distance from a point to the segment from `a` to `b`.
pub fn distance_to_segment(p: DVec3, a: DVec3, b: DVec3) -> f64 {
    let ab = b - a;
    let t = ((p - a).dot(ab) / ab.length_squared()).clamp(0.0, 1.0);
    p.distance(if t.is_nan() { a } else { a + ab * t })
}

/// Distance from a point to a triangle's plane; to its nearest corner where the triangle has no area.
///
/// With doubled digits: in floats alone the normal of a sliver would be off by more than what is measured.
pub fn distance_to_plane(p: DVec3, [a, b, c]: [DVec3; 3]) -> f64 {
    let normal = double::cross(double::difference(b, a), double::difference(c, a));
    let rounded = double::rounded(normal);
    // Scaled first: the square of a tiny normal would underflow.
    let largest = rounded.abs().max_element();
    if largest > 0.0 {
        (double::dot(normal, double::difference(p, a)).value() / largest / (rounded / largest).length()).abs()
    } else {
        p.distance(a).min(p.distance(b)).min(p.distance(c))
    }
}
