//! The signs that decide topology. Every one is exact for all finite coordinates.
//!
//! Notation: `Sign` is the sign of a determinant; `Greater` is positive.

use std::cmp::Ordering;

use glam::DVec3;

use super::exact::{Approx, EVERYWHERE, Formula, Number, cross, difference, dot, sign};

/// The sign of a determinant.
pub type Sign = Ordering;

/// Shewchuk's bound for the determinant of [`orient3d`] as it is evaluated here: (7 + 56 ε) ε with ε half an ulp of 1.
const ORIENT3D_BOUND: f64 = (7.0 + 56.0 * 1.110_223_024_625_156_5e-16) * 1.110_223_024_625_156_5e-16;
/// The same for [`orient2d`]: (3 + 16 ε) ε.
const ORIENT2D_BOUND: f64 = (3.0 + 16.0 * 1.110_223_024_625_156_5e-16) * 1.110_223_024_625_156_5e-16;
/// Below this a product may have lost digits to underflow, and the bounds above do not hold.
const SMALLEST_SURE: f64 = 1e-250;

/// On which side of the plane through `a`, `b`, `c` the point `d` lies: the sign of ((b − a) × (c − a)) · (d − a).
/// Positive where the three turn counter-clockwise as seen from `d`.
#[inline]
pub fn orient3d(a: DVec3, b: DVec3, c: DVec3, d: DVec3) -> Sign {
    let (u, v, w) = (a - d, b - d, c - d);
    let (m0, m1, m2) = ((u.y * v.z, u.z * v.y), (u.z * v.x, u.x * v.z), (u.x * v.y, u.y * v.x));
    let det = (m0.0 - m0.1) * w.x + (m1.0 - m1.1) * w.y + (m2.0 - m2.1) * w.z;
    let size = |m: (f64, f64), w: f64| (m.0.abs() + m.1.abs()) * w.abs();
    let bound = ORIENT3D_BOUND * (size(m0, w.x) + size(m1, w.y) + size(m2, w.z));
    if det.abs() > bound && det.abs() > SMALLEST_SURE && det.is_finite() {
        // (a − d) × (b − d) · (c − d) has the opposite sign of ((b − a) × (c − a)) · (d − a).
        return if det < 0.0 { Ordering::Greater } else { Ordering::Less };
    }
    // Common, and exact: a point is tested against a plane that goes through it.
    if d == a || d == b || d == c {
        return Ordering::Equal;
    }
    sign(&Orient3d(a, b, c, d))
}

struct Orient3d(DVec3, DVec3, DVec3, DVec3);

impl Formula for Orient3d {
    fn evaluate<N: Number>(&self) -> N {
        let [b, c, d] = [self.1, self.2, self.3].map(|p| difference::<N>(p, self.0));
        dot(&cross(&b, &c), &d)
    }
}

/// How three points turn, seen along a coordinate axis: the sign of that component of (b − a) × (c − a).
#[inline]
pub fn orient2d(axis: Axis, a: DVec3, b: DVec3, c: DVec3) -> Sign {
    let (i, j) = axis.plane();
    let (left, right) = ((b[i] - a[i]) * (c[j] - a[j]), (b[j] - a[j]) * (c[i] - a[i]));
    let det = left - right;
    if det.abs() > ORIENT2D_BOUND * (left.abs() + right.abs()) && det.abs() > SMALLEST_SURE && det.is_finite()
    {
        return if det > 0.0 { Ordering::Greater } else { Ordering::Less };
    }
    sign(&Orient2d { plane: (i, j), a, b, c })
}

struct Orient2d {
    plane: (usize, usize),
    a: DVec3,
    b: DVec3,
    c: DVec3,
}

impl Formula for Orient2d {
    fn evaluate<N: Number>(&self) -> N {
        let (i, j) = self.plane;
        let d = |p: DVec3, k: usize| N::of(p[k]).sub(&N::of(self.a[k]));
        d(self.b, i).mul(&d(self.c, j)).sub(&d(self.b, j).mul(&d(self.c, i)))
    }
}

/// A coordinate axis along which a triangle is looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Axis(usize);

impl Axis {
    /// The axis along which a triangle shows the largest area.
    pub fn of_largest_area([a, b, c]: [DVec3; 3]) -> Self {
        let n = (b - a).cross(c - a).abs();
        Self(if n.x >= n.y && n.x >= n.z {
            0
        } else if n.y >= n.z {
            1
        } else {
            2
        })
    }

    /// The two coordinates that are seen, in right-handed order.
    fn plane(self) -> (usize, usize) {
        [(1, 2), (2, 0), (0, 1)][self.0]
    }
}

/// Whether two triangles face the same way: the sign of the dot product of their normals.
pub fn facing(a: [DVec3; 3], b: [DVec3; 3]) -> Sign {
    let sides = |t: [DVec3; 3]| (t[1] - t[0], t[2] - t[0]);
    let ((u, v), (w, x)) = (sides(a), sides(b));
    let dot = u.cross(v).dot(w.cross(x));
    // Twelve products of two differences each, summed: far fewer roundings than this allows.
    let size = [u, v, w, x].iter().map(|d| d.abs().element_sum()).product::<f64>();
    if dot.abs() > 32.0 * f64::EPSILON * size && dot.abs() > SMALLEST_SURE && dot.is_finite() {
        return if dot > 0.0 { Ordering::Greater } else { Ordering::Less };
    }
    sign(&Facing(a, b))
}

struct Facing([DVec3; 3], [DVec3; 3]);

impl Formula for Facing {
    fn evaluate<N: Number>(&self) -> N {
        let normal = |t: &[DVec3; 3]| cross(&difference::<N>(t[1], t[0]), &difference::<N>(t[2], t[0]));
        dot(&normal(&self.0), &normal(&self.1))
    }
}

/// Whether three points lie on one line.
pub fn collinear(a: DVec3, b: DVec3, c: DVec3) -> bool {
    (0..3).all(|axis| orient2d(Axis(axis), a, b, c) == Ordering::Equal)
}

/// Which of two triangles a ray from `origin` through `through` meets first: compares the parameters at which it meets their planes.
/// The ray must cross both planes.
pub fn nearer(origin: DVec3, through: DVec3, a: [DVec3; 3], b: [DVec3; 3]) -> Sign {
    let fall = |t: [DVec3; 3]| sign(&Fall { origin, through, t });
    let order = sign(&Nearer { origin, through, a, b });
    // The parameters are fractions: each denominator's sign turns the comparison of the cross products around.
    if fall(a) == fall(b) { order } else { order.reverse() }
}

/// Bounds of the parameter at which a ray from `origin` through `through` meets a triangle's plane, in lengths from the one to the other.
/// They are as near as the rounding of a few products allows: for a sliver seen edge-on that may be anywhere.
pub fn parameter(origin: DVec3, through: DVec3, t: [DVec3; 3]) -> [f64; 2] {
    let (numerator, denominator) = fraction::<Approx>(origin, through, t);
    let (n, d) = (numerator.bounds(), denominator.bounds());
    if d[0] <= 0.0 && d[1] >= 0.0 {
        return EVERYWHERE;
    }
    let quotients = [n[0] / d[0], n[0] / d[1], n[1] / d[0], n[1] / d[1]];
    let low = quotients.into_iter().fold(f64::INFINITY, f64::min);
    let high = quotients.into_iter().fold(f64::NEG_INFINITY, f64::max);
    [low.next_down(), high.next_up()]
}

/// The ray's direction along a triangle's normal: the denominator of its parameter.
struct Fall {
    origin: DVec3,
    through: DVec3,
    t: [DVec3; 3],
}

impl Formula for Fall {
    fn evaluate<N: Number>(&self) -> N {
        fraction::<N>(self.origin, self.through, self.t).1
    }
}

struct Nearer {
    origin: DVec3,
    through: DVec3,
    a: [DVec3; 3],
    b: [DVec3; 3],
}

impl Formula for Nearer {
    fn evaluate<N: Number>(&self) -> N {
        let (na, da) = fraction::<N>(self.origin, self.through, self.a);
        let (nb, db) = fraction::<N>(self.origin, self.through, self.b);
        na.mul(&db).sub(&nb.mul(&da))
    }
}

/// Numerator and denominator of the parameter at which a ray meets a triangle's plane.
fn fraction<N: Number>(origin: DVec3, through: DVec3, t: [DVec3; 3]) -> (N, N) {
    let normal = cross(&difference::<N>(t[1], t[0]), &difference::<N>(t[2], t[0]));
    (dot(&normal, &difference(t[0], origin)), dot(&normal, &difference(through, origin)))
}

#[cfg(test)]
mod tests {
    use super::*;

    const O: DVec3 = DVec3::ZERO;

    #[test]
    fn a_point_above_a_counter_clockwise_triangle_is_positive() {
        assert_eq!(orient3d(O, DVec3::X, DVec3::Y, DVec3::Z), Ordering::Greater);
        assert_eq!(orient3d(O, DVec3::X, DVec3::Y, -DVec3::Z), Ordering::Less);
        assert_eq!(orient3d(O, DVec3::X, DVec3::Y, DVec3::new(3.0, 7.0, 0.0)), Ordering::Equal);
    }

    #[test]
    fn one_ulp_off_a_plane_is_off_it() {
        let [a, b, c] = [DVec3::new(0.1, 0.7, 0.3), DVec3::new(9.3, 0.2, 0.3), DVec3::new(2.2, 8.1, 0.3)];
        let on = DVec3::new(3.1, 2.9, 0.3);
        let above = DVec3::new(3.1, 2.9, 0.3f64.next_up());
        assert_eq!(orient3d(a, b, c, on), Ordering::Equal);
        assert_eq!(orient3d(a, b, c, above), Ordering::Greater);
        for p in [on, above] {
            assert_eq!(orient3d(a, b, c, p), orient3d(b, c, a, p));
            assert_eq!(orient3d(a, b, c, p), orient3d(b, a, c, p).reverse());
        }
    }

    #[test]
    fn extreme_exponents_keep_their_signs() {
        for scale in [1e-300, 1e-150, 1.0, 1e100, 1e300] {
            let [a, b, c, d] = [O, DVec3::X, DVec3::Y, DVec3::Z].map(|p| p * scale);
            assert_eq!(orient3d(a, b, c, d), Ordering::Greater, "{scale:e}");
            assert_eq!(orient2d(Axis(2), a, b, c), Ordering::Greater, "{scale:e}");
        }
    }

    #[test]
    fn a_parameter_lies_within_its_bounds_and_a_sliver_edge_on_has_wide_ones() {
        let t = [DVec3::new(0.0, 0.0, 0.3), DVec3::new(1.0, 0.0, 0.3), DVec3::new(0.0, 1.0, 0.3)];
        let (eye, through) = (DVec3::new(0.2, 0.2, 1.3), DVec3::new(0.2, 0.2, 0.8));
        let [low, high] = parameter(eye, through, t);
        assert!(low < 2.0 && 2.0 < high && high - low < 1e-13, "{low} {high}");
        let sliver =
            [DVec3::new(0.1, 0.2, 0.3), DVec3::new(1.1, 0.9, 1.7), DVec3::new(0.6, 0.55, 1.0 + 1e-15)];
        let [low, high] = parameter(eye, through, sliver);
        assert!(high - low > 1e-6, "{low} {high}");
        assert_eq!(parameter(eye, eye + DVec3::X, t), EVERYWHERE);
    }

    #[test]
    fn equal_depths_are_equal_and_one_ulp_is_nearer() {
        let at = |z: f64| [DVec3::new(0.0, 0.0, z), DVec3::new(1.0, 0.0, z), DVec3::new(0.0, 1.0, z)];
        let (eye, through) = (DVec3::new(0.2, 0.2, 10.0), DVec3::new(0.2, 0.2, 9.0));
        assert_eq!(nearer(eye, through, at(0.3), at(0.3)), Ordering::Equal);
        assert_eq!(nearer(eye, through, at(0.3f64.next_up()), at(0.3)), Ordering::Less);
        let flipped = |[a, b, c]: [DVec3; 3]| [a, c, b];
        assert_eq!(nearer(eye, through, flipped(at(0.3f64.next_up())), at(0.3)), Ordering::Less);
    }
}
