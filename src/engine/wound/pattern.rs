//! How a face falls into triangles: the nine configurations of the thesis (Lam 2016, §4.2.1) and the subdivisions (§6.3).
//!
//! A face has corners 0, 1, 2 and new points 3, 4, … on its sides and inside. Which triangles they make is a finite table:
//!
//! | on sides | inside | children | for |
//! | --- | --- | --- | --- |
//! | 1 | 0 | 2 | N–E, E–N; the neighbour of a split edge |
//! | 2 | 0 | 3 | E–E: a corner triangle and a quadrilateral, cut along the diagonal that gives the better triangles |
//! | 2, one side | 0 | 3 | both picks on one edge |
//! | 0 | 1 | 3 | N–F, F–N; the 3-split |
//! | 1 | 1 | 4 | E–F, F–E |
//! | 0 | 2 | 5 | F–F, which the thesis discards |
//! | 3 | 0 | 4 | the 4-split |
//! | 3 | 1 | 6 | the 6-split |

use std::cmp::Ordering;

use glam::DVec3;

use crate::geometry::predicates::{Axis, orient2d};

/// A triangle of local indices, counter-clockwise as the face.
pub type Child = [u8; 3];

/// A face to be divided.
#[derive(Clone, Debug)]
pub struct Shape {
    /// Positions of the corners, then of the new points.
    pub at: Vec<DVec3>,
    /// The points on each side, from corner `s` to corner `s + 1`.
    pub sides: [Vec<u8>; 3],
    /// The points inside.
    pub inner: Vec<u8>,
}

impl Shape {
    fn axis(&self) -> Axis {
        Axis::of_largest_area(self.corners())
    }

    /// The face's own corners.
    pub fn corners(&self) -> [DVec3; 3] {
        [self.at[0], self.at[1], self.at[2]]
    }

    /// The corners of a child.
    pub fn child(&self, child: Child) -> [DVec3; 3] {
        child.map(|i| self.at[i as usize])
    }

    /// Whether a child has area and faces as its parent does, exactly, looking along the parent's main axis.
    pub fn is_sound(&self, child: Child) -> bool {
        let axis = self.axis();
        let turn = |[a, b, c]: [DVec3; 3]| orient2d(axis, a, b, c);
        turn(self.corners()) != Ordering::Equal && turn(self.child(child)) == turn(self.corners())
    }

    /// The children; `None` for a pattern that no cut makes.
    pub fn divide(&self) -> Option<Vec<Child>> {
        let on: [usize; 3] = [0, 1, 2].map(|s| self.sides[s].len());
        match (on.iter().sum::<usize>(), self.inner[..].len()) {
            (0, 0) => Some(vec![[0, 1, 2]]),
            (1, 0) => Some(self.one_side()),
            (2, 0) if on.contains(&2) => Some(self.twice_on_one_side()),
            (2, 0) => Some(self.two_sides()),
            (3, 0) if on == [1; 3] => Some(self.three_sides()),
            (n, 1) if on.iter().all(|&k| k <= 1) && n <= 3 => Some(self.around(self.inner[0])),
            (0, 2) => self.two_inside(),
            _ => None,
        }
    }

    fn one_side(&self) -> Vec<Child> {
        let (s, p) = self.first_side();
        vec![[s, p, previous(s)], [p, next(s), previous(s)]]
    }

    fn twice_on_one_side(&self) -> Vec<Child> {
        let (s, p) = self.first_side();
        let q = self.sides[s as usize][1];
        vec![[s, p, previous(s)], [p, q, previous(s)], [q, next(s), previous(s)]]
    }

    /// A corner triangle and a quadrilateral.
    fn two_sides(&self) -> Vec<Child> {
        // The corner between the two sides: side `s` ends at it, side `s + 1` begins there.
        let s = (0..3u8).find(|&s| self.sides[previous(s) as usize].is_empty()).unwrap_or(0);
        let (p, q) = (self.sides[s as usize][0], self.sides[next(s) as usize][0]);
        let (corner, far, near) = (next(s), previous(s), s);
        let one = [[p, q, far], [p, far, near]];
        let other = [[p, q, near], [q, far, near]];
        let worst = |pair: &[Child; 2]| pair.iter().map(|&c| self.quality(c)).fold(f64::INFINITY, f64::min);
        let quad = if worst(&other) > worst(&one) { other } else { one };
        vec![[p, corner, q], quad[0], quad[1]]
    }

    fn three_sides(&self) -> Vec<Child> {
        let [a, b, c] = [0, 1, 2].map(|s: usize| self.sides[s][0]);
        vec![[0, a, c], [a, 1, b], [c, b, 2], [a, b, c]]
    }

    /// The border, fanned out from a point inside.
    fn around(&self, center: u8) -> Vec<Child> {
        let border: Vec<u8> =
            (0..3u8).flat_map(|s| std::iter::once(s).chain(self.sides[s as usize].clone())).collect();
        (0..border.len()).map(|i| [border[i], border[(i + 1) % border.len()], center]).collect()
    }

    /// A 3-split at the first point, and the second put into the child, or onto the edge, in which it lies.
    fn two_inside(&self) -> Option<Vec<Child>> {
        let [p, q] = [self.inner[0], self.inner[1]];
        let axis = self.axis();
        let positive = orient2d(axis, self.at[0], self.at[1], self.at[2]);
        // On which side of the spoke from corner k to p the point q lies: `Greater` is towards the next corner.
        let side = [0, 1, 2].map(|k: usize| {
            let turn = orient2d(axis, self.at[k], self.at[p as usize], self.at[q as usize]);
            if positive == Ordering::Greater { turn.reverse() } else { turn }
        });
        let spoke = (0..3u8).find(|&k| {
            side[k as usize] == Ordering::Equal
                && side[next(k) as usize] == Ordering::Less
                && side[previous(k) as usize] == Ordering::Greater
        });
        if let Some(k) = spoke {
            let (n, o) = (next(k), previous(k));
            return Some(vec![[k, n, q], [q, n, p], [o, k, q], [o, q, p], [n, o, p]]);
        }
        let k = (0..3u8)
            .find(|&k| side[k as usize] == Ordering::Greater && side[next(k) as usize] == Ordering::Less)?;
        let (n, o) = (next(k), previous(k));
        Some(vec![[n, o, p], [o, k, p], [k, n, q], [n, p, q], [p, k, q]])
    }

    fn first_side(&self) -> (u8, u8) {
        let s = (0..3).find(|&s| !self.sides[s].is_empty()).unwrap_or(0);
        (s as u8, self.sides[s][0])
    }

    /// Area over the square of the longest side: large for well-shaped triangles.
    fn quality(&self, child: Child) -> f64 {
        let [a, b, c] = self.child(child);
        (b - a).cross(c - a).length() / longest_squared([a, b, c])
    }
}

fn longest_squared([a, b, c]: [DVec3; 3]) -> f64 {
    a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a))
}

/// The smallest of a triangle's three heights.
pub fn altitude([a, b, c]: [DVec3; 3]) -> f64 {
    let longest = longest_squared([a, b, c]).sqrt();
    if longest > 0.0 { (b - a).cross(c - a).length() / longest } else { 0.0 }
}

fn next(corner: u8) -> u8 {
    (corner + 1) % 3
}

fn previous(corner: u8) -> u8 {
    (corner + 2) % 3
}
