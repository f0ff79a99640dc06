//! Polygons into triangles.
//!
//! A strictly convex polygon becomes the fan of its first corner. Any other is cut up by ear clipping (Meisters 1975) in the
//! plane of the two axes in which it is largest, by Newell's normal. An ear is a corner that turns left, strictly, with no
//! other corner in its closed triangle; the sides are exact. The rule is fixed: the search starts at the first corner, and after each
//! ear it goes on with the corner after the next, which spreads the triangles. Every corner stays a corner, also those in line
//! with their neighbours (dropping them, as crates for drawing do, would tear the mesh there).
//!
//! A polygon that crosses itself may run out of ears: what is left of it becomes a fan, and [`Triangulator::run`] says so.

use std::cmp::Ordering;

use glam::{DVec2, DVec3};

use super::exact;

/// Clipping a concave polygon of n corners looks at n² times this many corners at most, and at `FREE_TESTS` more: twenty times
/// what a comb or a spiral takes, and a second for the largest.
const TESTS_PER_CORNER_PAIR: usize = 16;
const FREE_TESTS: usize = 1 << 20;
/// A concave polygon with more corners is refused.
const MOST_CONCAVE_CORNERS: usize = 10_000;

/// The polygon would take too long.
#[derive(Debug)]
pub(super) struct TooComplex;

/// Cuts up polygons, one after the other, in the same memory.
#[derive(Debug, Default)]
pub(super) struct Triangulator {
    /// The triangles of the last polygon: corners by their place in it.
    pub(super) triangles: Vec<[u32; 3]>,
    points: Vec<DVec2>,
    outline: Vec<DVec3>,
    previous: Vec<u32>,
    next: Vec<u32>,
}

impl Triangulator {
    /// Cuts up a polygon of three corners or more; says whether there were ears enough.
    pub(super) fn run(&mut self, outline: impl ExactSizeIterator<Item = DVec3>) -> Result<bool, TooComplex> {
        self.triangles.clear();
        if outline.len() == 3 {
            self.triangles.push([0, 1, 2]);
            return Ok(true);
        }
        self.outline.clear();
        self.outline.extend(outline);
        self.project();
        if self.is_convex() {
            self.triangles.extend((2..self.points.len() as u32).map(|i| [0, i - 1, i]));
            return Ok(true);
        }
        self.clip()
    }

    /// Drops the axis along which Newell's normal is longest, the first of equals, so that the polygon runs to the left.
    fn project(&mut self) {
        let mut normal = DVec3::ZERO;
        let ends = self.outline.iter().zip(self.outline.iter().cycle().skip(1));
        for (p, q) in ends {
            normal +=
                DVec3::new((p.y - q.y) * (p.z + q.z), (p.z - q.z) * (p.x + q.x), (p.x - q.x) * (p.y + q.y));
        }
        let size = normal.abs();
        let flat: fn(&DVec3) -> DVec2 = if size.x >= size.y && size.x >= size.z {
            if normal.x < 0.0 { |p| DVec2::new(p.z, p.y) } else { |p| DVec2::new(p.y, p.z) }
        } else if size.y >= size.z {
            if normal.y < 0.0 { |p| DVec2::new(p.x, p.z) } else { |p| DVec2::new(p.z, p.x) }
        } else if normal.z < 0.0 {
            |p| DVec2::new(p.y, p.x)
        } else {
            |p| DVec2::new(p.x, p.y)
        };
        self.points.clear();
        self.points.extend(self.outline.iter().map(flat));
    }

    fn turn(&self, [a, b, c]: [u32; 3]) -> Ordering {
        exact::side(self.points[a as usize], self.points[b as usize], self.points[c as usize])
    }

    fn is_convex(&self) -> bool {
        let n = self.points.len() as u32;
        (0..n).all(|i| self.turn([(i + n - 1) % n, i, (i + 1) % n]).is_gt())
    }

    fn clip(&mut self) -> Result<bool, TooComplex> {
        let n = self.points.len();
        if n > MOST_CONCAVE_CORNERS {
            return Err(TooComplex);
        }
        self.link(n as u32);
        let mut budget = TESTS_PER_CORNER_PAIR * n * n + FREE_TESTS;
        let (mut left, mut misses, mut at) = (n, 0, 0);
        while left > 3 && misses < left {
            if budget == 0 {
                return Err(TooComplex);
            }
            let [before, after] = [self.previous[at as usize], self.next[at as usize]];
            if self.is_ear([before, at, after], &mut budget) {
                self.triangles.push([before, at, after]);
                self.next[before as usize] = after;
                self.previous[after as usize] = before;
                (left, misses) = (left - 1, 0);
                at = self.next[after as usize];
            } else {
                (misses, at) = (misses + 1, after);
            }
        }
        self.fan(at, left);
        Ok(left == 3)
    }

    fn link(&mut self, n: u32) {
        self.previous.clear();
        self.previous.extend((0..n).map(|i| (i + n - 1) % n));
        self.next.clear();
        self.next.extend((0..n).map(|i| (i + 1) % n));
    }

    /// Each corner looked at is taken from the budget.
    fn is_ear(&self, ear: [u32; 3], budget: &mut usize) -> bool {
        if !self.turn(ear).is_gt() {
            return false;
        }
        let [a, b, c] = ear.map(|i| self.points[i as usize]);
        let (low, high) = (a.min(b).min(c), a.max(b).max(c));
        let mut other = self.next[ear[2] as usize];
        while other != ear[0] {
            *budget = budget.saturating_sub(1);
            let p = self.points[other as usize];
            let near = p.cmpge(low).all() && p.cmple(high).all() && p != a && p != b && p != c;
            if near && [(a, b), (b, c), (c, a)].into_iter().all(|(s, t)| exact::side(s, t, p).is_ge()) {
                return false;
            }
            other = self.next[other as usize];
        }
        true
    }

    /// What is left, as a fan.
    fn fan(&mut self, apex: u32, left: usize) {
        let mut second = self.next[apex as usize];
        for _ in 2..left {
            let third = self.next[second as usize];
            self.triangles.push([apex, second, third]);
            second = third;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cut(points: &[(f64, f64)], lift: fn(f64, f64) -> DVec3) -> (Vec<[u32; 3]>, bool) {
        let mut t = Triangulator::default();
        let simple = t.run(points.iter().map(|&(x, y)| lift(x, y))).expect("small");
        (t.triangles, simple)
    }

    /// Twice the signed area of each triangle.
    fn areas(points: &[(f64, f64)], triangles: &[[u32; 3]]) -> Vec<f64> {
        let p = |i: u32| DVec2::from(points[i as usize]);
        triangles.iter().map(|&[a, b, c]| (p(b) - p(a)).perp_dot(p(c) - p(a))).collect()
    }

    const ARROW: [(f64, f64); 4] = [(0.0, 0.0), (2.0, 2.0), (0.0, 1.0), (-2.0, 2.0)];
    /// A comb with teeth, and corners in line.
    const COMB: [(f64, f64); 12] = [
        (0.0, 0.0),
        (2.0, 0.0),
        (4.0, 0.0),
        (6.0, 0.0),
        (6.0, 3.0),
        (5.0, 1.0),
        (4.0, 3.0),
        (3.0, 1.0),
        (2.0, 3.0),
        (1.0, 1.0),
        (0.0, 3.0),
        (0.0, 1.5),
    ];

    #[test]
    fn concave_polygons_are_covered_once_in_every_plane() {
        let lifts: [fn(f64, f64) -> DVec3; 4] = [
            |x, y| DVec3::new(x, y, 3.0),
            |x, y| DVec3::new(3.0, x, y),
            |x, y| DVec3::new(y, 3.0, x),
            |x, y| DVec3::new(x, y, 0.25 * x - 0.5 * y),
        ];
        for lift in lifts {
            for polygon in [&ARROW[..], &COMB[..]] {
                let (triangles, simple) = cut(polygon, lift);
                let areas = areas(polygon, &triangles);
                let whole: f64 = (0..polygon.len())
                    .map(|i| DVec2::from(polygon[i]).perp_dot(polygon[(i + 1) % polygon.len()].into()))
                    .sum();
                assert!(simple && triangles.len() == polygon.len() - 2);
                assert!(areas.iter().all(|a| *a > 0.0), "{triangles:?}");
                assert_eq!(areas.iter().sum::<f64>(), whole);
            }
        }
    }

    #[test]
    fn a_clockwise_polygon_stays_clockwise() {
        let turned: Vec<_> = COMB.iter().rev().copied().collect();
        let (triangles, simple) = cut(&turned, |x, y| DVec3::new(x, y, 0.0));
        assert!(simple && areas(&turned, &triangles).iter().all(|a| *a < 0.0));
    }

    #[test]
    fn a_convex_polygon_is_the_fan_of_its_first_corner() {
        let square = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
        assert_eq!(cut(&square, |x, y| DVec3::new(x, y, 0.0)), (vec![[0, 1, 2], [0, 2, 3]], true));
    }

    #[test]
    fn a_bow_tie_or_a_flat_polygon_gives_its_triangles_and_says_so() {
        let bow = [(0.0, 0.0), (1.0, 1.0), (1.0, 0.0), (0.0, 1.0)];
        let flat = [(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (3.0, 0.0), (1.5, 0.0)];
        for polygon in [&bow[..], &flat[..]] {
            assert_eq!(cut(polygon, |x, y| DVec3::new(x, y, 0.0)).0.len(), polygon.len() - 2);
        }
        assert!(!cut(&flat, |x, y| DVec3::new(x, y, 0.0)).1);
    }

    #[test]
    fn a_huge_concave_polygon_is_refused() {
        let zigzag = (0..MOST_CONCAVE_CORNERS + 1).map(|i| DVec3::new(i as f64, (i % 2) as f64, 0.0));
        assert!(Triangulator::default().run(zigzag).is_err());
    }

    #[test]
    fn a_large_comb_is_cut_up() {
        let teeth =
            (0..=3000).rev().map(|i| DVec3::new(f64::from(i), if i % 2 == 0 { 1.0 } else { 10.0 }, 0.0));
        let comb: Vec<DVec3> = [DVec3::ZERO, DVec3::new(3000.0, 0.0, 0.0)].into_iter().chain(teeth).collect();
        let mut triangulator = Triangulator::default();
        assert!(triangulator.run(comb.into_iter()).expect("simple"));
        assert_eq!(triangulator.triangles.len(), 3001);
    }
}
