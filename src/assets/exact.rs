//! Exact answers to two questions about points of a file: on which side of a line, and whether three are in line.
//!
//! A filter in f64 (Shewchuk 1997, the error bound of `orient2d`) answers nearly always; what it leaves open is computed in
//! integers. Readers must not guess: a face that is wrongly taken for flat would be lost.

use std::cmp::Ordering;

use glam::{DVec2, DVec3, Vec3Swizzles as _};
use num_bigint::BigInt;

/// (3 + 16 ε) ε with ε = 2⁻⁵³.
const BOUND: f64 = 3.330_669_073_875_471_6e-16;
/// Below this the products may have lost bits to underflow, which the bound does not know of.
const UNDERFLOW: f64 = 1e-290;

/// `Greater` if `c` lies to the left of the line from `a` to `b`, `Equal` if on it. Not finite coordinates count as on it.
pub(super) fn side(a: DVec2, b: DVec2, c: DVec2) -> Ordering {
    filtered(a, b, c).unwrap_or_else(|| exact(a, b, c))
}

/// Whether three points lie on one line, exactly; two equal ones always do.
pub(super) fn collinear(a: DVec3, b: DVec3, c: DVec3) -> bool {
    let planes = [[a.xy(), b.xy(), c.xy()], [a.yz(), b.yz(), c.yz()], [a.zx(), b.zx(), c.zx()]];
    let certain = |[a, b, c]: [DVec2; 3]| filtered(a, b, c).is_some_and(Ordering::is_ne);
    !planes.into_iter().any(certain) && planes.into_iter().all(|[a, b, c]| side(a, b, c).is_eq())
}

fn filtered(a: DVec2, b: DVec2, c: DVec2) -> Option<Ordering> {
    let (left, right) = ((b.x - a.x) * (c.y - a.y), (b.y - a.y) * (c.x - a.x));
    let det = left - right;
    let bound = BOUND * (left.abs() + right.abs()) + UNDERFLOW;
    if det > bound {
        Some(Ordering::Greater)
    } else if -det > bound {
        Some(Ordering::Less)
    } else {
        None
    }
}

fn exact(a: DVec2, b: DVec2, c: DVec2) -> Ordering {
    let parts = [a.x, a.y, b.x, b.y, c.x, c.y];
    if parts.iter().any(|v| !v.is_finite()) {
        return Ordering::Equal;
    }
    let unit = parts.iter().filter(|v| **v != 0.0).map(|v| decode(*v).1).min().unwrap_or(0);
    let [ax, ay, bx, by, cx, cy] = parts.map(|v| in_units(v, unit));
    let left = (bx - &ax) * (cy - &ay);
    let right = (by - &ay) * (cx - &ax);
    left.cmp(&right)
}

/// Mantissa and exponent: v = m 2^e.
fn decode(v: f64) -> (i64, i32) {
    let bits = v.to_bits();
    let (biased, fraction) = (((bits >> 52) & 0x7ff) as i32, (bits & ((1 << 52) - 1)) as i64);
    let mantissa = if biased == 0 { fraction } else { fraction | 1 << 52 };
    (if v < 0.0 { -mantissa } else { mantissa }, biased.max(1) - 1075)
}

fn in_units(v: f64, unit: i32) -> BigInt {
    let (mantissa, exponent) = decode(v);
    if mantissa == 0 { BigInt::ZERO } else { BigInt::from(mantissa) << (exponent - unit) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sides_are_exact_where_rounding_is_not() {
        let (a, b) = (DVec2::new(0.5, 0.5), DVec2::new(12.0, 12.0));
        let up = |v: f64| f64::from_bits(v.to_bits() + 1);
        assert_eq!(side(a, b, DVec2::new(24.0, 24.0)), Ordering::Equal);
        assert_eq!(side(a, b, DVec2::new(24.0, up(24.0))), Ordering::Greater);
        assert_eq!(side(a, b, DVec2::new(up(24.0), 24.0)), Ordering::Less);
        let tiny = f64::from_bits(1);
        assert_eq!(side(DVec2::ZERO, DVec2::new(tiny, 0.0), DVec2::new(0.0, tiny)), Ordering::Greater);
        assert_eq!(side(DVec2::ZERO, DVec2::new(1e300, 1e300), DVec2::new(-1e300, tiny)), Ordering::Greater);
        assert_eq!(side(DVec2::ZERO, DVec2::new(f64::NAN, 0.0), DVec2::ONE), Ordering::Equal);
    }

    #[test]
    fn collinear_means_exactly_in_line() {
        let (a, b) = (DVec3::new(0.1, 0.2, 0.3), DVec3::new(0.2, 0.4, 0.6));
        assert!(collinear(a, b, a * 4.0), "doubling is exact");
        assert!(collinear(a, a, b));
        let mut off = b * 2.0;
        off.z = f64::from_bits(off.z.to_bits() + 1);
        assert!(!collinear(a, b, off));
    }
}
