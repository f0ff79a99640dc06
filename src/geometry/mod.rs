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

/// The same within a part of an ulp of the distance, where [`distance_to_segment`] is within some ulps of the coordinates: for distances of that size.
pub fn fine_distance_to_segment(p: DVec3, a: DVec3, b: DVec3) -> f64 {
    let along = b - a;
    let t = (p - a).dot(along) / along.length_squared();
    if !(0.0..=1.0).contains(&t) {
        return p.distance(a).min(p.distance(b));
    }
    let across = double::rounded(double::cross(double::difference(p, a), double::difference(b, a)));
    // Scaled first: the square of a tiny product would underflow.
    let largest = across.abs().max_element();
    if largest > 0.0 { largest / along.length() * (across / largest).length() } else { 0.0 }
}

/// Below this part of the product of two sides their cross product has lost too many digits to be a direction.
const LOST: f64 = 1e-6;

/// Unit normal of a triangle, within some 1e-10; `None` only where it has no area at all, or is not finite.
pub fn unit_normal([a, b, c]: [DVec3; 3]) -> Option<DVec3> {
    let (u, v) = (b - a, c - a);
    let normal = u.cross(v);
    let largest = |v: DVec3| v.abs().max_element();
    let normal = match largest(normal) > LOST * largest(u) * largest(v) {
        true => normal,
        false if !normal.is_finite() => return None,
        false => double::rounded(exact::direction(&exact::cross(
            &exact::difference(b, a),
            &exact::difference(c, a),
        ))),
    };
    // Scaled first: the square of a tiny normal would underflow.
    (normal / largest(normal)).try_normalize()
}

/// Below this part of the product of two sides even doubled digits have lost too many.
const LOST_DOUBLED: f64 = 1e-14;

/// Distance from a point to a triangle's plane, within a part of an ulp of the coordinates; to its nearest corner where the triangle has no area.
///
/// With doubled digits, or exactly: in floats alone the normal of a sliver would be off by more than what is measured.
pub fn distance_to_plane(p: DVec3, [a, b, c]: [DVec3; 3]) -> f64 {
    let largest = |v: DVec3| v.abs().max_element();
    let mut normal = double::cross(double::difference(b, a), double::difference(c, a));
    if largest(double::rounded(normal)) <= LOST_DOUBLED * largest(b - a) * largest(c - a) {
        normal = exact::direction(&exact::cross(&exact::difference(b, a), &exact::difference(c, a)));
    }
    let rounded = double::rounded(normal);
    // Scaled first: the square of a tiny normal would underflow.
    let size = largest(rounded);
    if size > 0.0 {
        (double::dot(normal, double::difference(p, a)).value() / size / (rounded / size).length()).abs()
    } else {
        p.distance(a).min(p.distance(b)).min(p.distance(c))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_plane_of_a_triangle_thinner_than_doubled_digits_is_its_plane() {
        // 1e-25 high over a side of length 2, and as little tilted: a point beside the side is as far as it is out of the plane.
        let tall = 1e-25;
        let triangle = [DVec3::new(-1.0, 0.1, 0.0), DVec3::new(1.0, -0.1, 0.0), DVec3::new(0.5, -0.05, tall)];
        let p = DVec3::new(0.7, -0.07 + 1e-12, 0.0);
        let expected = 1e-12 * 2.0 / DVec3::new(2.0, -0.2, 0.0).length();
        let found = distance_to_plane(p, triangle);
        assert!((found - expected).abs() < 1e-3 * expected, "{found} {expected}");
        assert!(distance_to_plane(triangle[2], triangle) < 1e-30);
    }
}
