//! Geometry on the plane of (s, d), onto which [`surface`](super::surface) unrolls the skin: the line is the segment from (0, 0) to (L, 0).

use glam::{DVec2, DVec3};

/// A triangle or another row of corners on the plane.
pub type Flat = [DVec2; 3];

/// Distance from a point to the line.
pub fn to_line(p: DVec2, length: f64) -> f64 {
    to_line_squared(p, length).sqrt()
}

/// Distance from the segment between two points to the line; 0 where they cross.
pub fn side_to_line(a: DVec2, b: DVec2, length: f64) -> f64 {
    if crosses(a, b, length) {
        return 0.0;
    }
    let ends = [DVec2::ZERO, DVec2::new(length, 0.0)].map(|end| to_segment_squared(end, a, b));
    let corners = [a, b].map(|corner| to_line_squared(corner, length));
    ends[0].min(ends[1]).min(corners[0]).min(corners[1]).sqrt()
}

/// Distances from a triangle's sides to the line, from each corner to the next.
pub fn sides_to_line(&[a, b, c]: &Flat, length: f64) -> [f64; 3] {
    [side_to_line(a, b, length), side_to_line(b, c, length), side_to_line(c, a, length)]
}

/// Distance from a triangle to the line, given those of its sides; 0 where they meet. Its orientation does not matter.
pub fn triangle_to_line(corners: &Flat, sides: [f64; 3]) -> f64 {
    if contains(corners, DVec2::ZERO) { 0.0 } else { sides[0].min(sides[1]).min(sides[2]) }
}

/// Where the third corner c of a triangle in space lies on the plane, when a lies at `at[0]` and b at `at[1]`.
///
/// The triangle keeps its shape. Should the known side be longer or shorter than in space, its middle is what counts. `None` where
/// the side has no direction.
pub fn unfold([a, b, c]: [DVec3; 3], at: [DVec2; 2]) -> Option<DVec2> {
    let along = (at[1] - at[0]).try_normalize()?;
    let side = b - a;
    let length = side.length();
    let from_middle = c - (a + b) * 0.5;
    let (across, height) = (from_middle.dot(side) / length, side.cross(c - a).length() / length);
    let place = (at[0] + at[1]) * 0.5 + along * across + along.perp() * height;
    place.is_finite().then_some(place)
}

fn crosses(a: DVec2, b: DVec2, length: f64) -> bool {
    if (a.y > 0.0) == (b.y > 0.0) && a.y != 0.0 && b.y != 0.0 {
        return false;
    }
    let rise = b.y - a.y;
    let x = if rise == 0.0 { a.x } else { a.x + (b.x - a.x) * (-a.y / rise) };
    (0.0..=length).contains(&x)
}

fn to_line_squared(p: DVec2, length: f64) -> f64 {
    let beyond = (-p.x).max(p.x - length).max(0.0);
    DVec2::new(beyond, p.y).length_squared()
}

fn to_segment_squared(p: DVec2, a: DVec2, b: DVec2) -> f64 {
    let ab = b - a;
    let t = ((p - a).dot(ab) / ab.length_squared()).clamp(0.0, 1.0);
    p.distance_squared(if t.is_nan() { a } else { a + ab * t })
}

fn contains(&[a, b, c]: &Flat, p: DVec2) -> bool {
    let turns = [(a, b), (b, c), (c, a)].map(|(from, to)| (to - from).perp_dot(p - from));
    // In a triangle without area everything on its line turns neither way, and only its sides say what is in it.
    let [left, right] = [turns.iter().any(|&t| t > 0.0), turns.iter().any(|&t| t < 0.0)];
    left != right
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(x: f64, y: f64) -> DVec2 {
        DVec2::new(x, y)
    }

    #[test]
    fn distances_to_the_line_are_those_of_the_nearest_points() {
        assert_eq!(to_line(at(2.0, -3.0), 5.0), 3.0);
        assert_eq!(to_line(at(-3.0, 4.0), 5.0), 5.0);
        assert_eq!(to_line(at(8.0, 4.0), 5.0), 5.0);
        assert_eq!(side_to_line(at(1.0, 1.0), at(3.0, -1.0), 5.0), 0.0);
        assert_eq!(side_to_line(at(-2.0, 1.0), at(-2.0, -1.0), 5.0), 2.0);
        // The nearest point of the line is its end, that of the segment neither of its ends.
        assert!((side_to_line(at(6.0, -1.0), at(8.0, 1.0), 5.0) - 2f64.sqrt()).abs() < 1e-15);
    }

    #[test]
    fn a_triangle_around_the_whole_line_or_across_it_is_at_no_distance() {
        let triangle_to_line =
            |corners: &Flat, length| triangle_to_line(corners, sides_to_line(corners, length));
        assert_eq!(triangle_to_line(&[at(-9.0, -9.0), at(9.0, -9.0), at(0.0, 9.0)], 1.0), 0.0);
        assert_eq!(triangle_to_line(&[at(2.0, -1.0), at(3.0, -1.0), at(2.5, 1.0)], 5.0), 0.0);
        assert_eq!(triangle_to_line(&[at(2.0, 1.0), at(3.0, 1.5), at(2.5, 4.0)], 5.0), 1.0);
        assert_eq!(triangle_to_line(&[at(7.0, 0.0), at(6.0, 0.0), at(7.0, 0.0)], 5.0), 1.0, "without area");
    }

    #[test]
    fn unfolding_keeps_shape_and_orientation_and_anchors_in_the_middle() {
        let space = [DVec3::ZERO, DVec3::new(0.0, 2.0, 0.0), DVec3::new(0.0, 0.5, 3.0)];
        let c = unfold(space, [at(1.0, 1.0), at(3.0, 1.0)]).unwrap();
        assert!(c.distance(at(1.5, 4.0)) < 1e-15, "{c}");
        let stretched = unfold(space, [at(0.0, 1.0), at(4.0, 1.0)]).unwrap();
        assert!(stretched.distance(c) < 1e-15, "{stretched}");
        assert_eq!(unfold(space, [at(1.0, 1.0); 2]), None);
    }
}
