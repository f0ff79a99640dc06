//! Integers of one unit, vectors of them, and points over a common denominator.
//!
//! A float is m · 2^e. With 2^unit the smallest e that occurs, every coordinate is an integer; sums and products stay integers, and a quotient is
//! kept as its two parts. Only what leaves for people, a distance or a rounded position, becomes a float again, and only at the end.

use glam::DVec3;
use num_bigint::{BigInt, Sign};

/// A vector of integers.
pub(super) type Vector = [BigInt; 3];

/// What one is worth: 2^unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Unit(i64);

/// Mantissa and exponent of a finite float; the mantissa is odd, or zero.
fn parts(value: f64) -> (i64, i64) {
    let bits = value.to_bits();
    let (biased, fraction) = ((bits >> 52 & 0x7ff) as i64, (bits & ((1 << 52) - 1)) as i64);
    let (mantissa, exponent) =
        if biased == 0 { (fraction, -1074) } else { (fraction | 1 << 52, biased - 1075) };
    if mantissa == 0 {
        return (0, 0);
    }
    let zeros = i64::from(mantissa.trailing_zeros());
    let mantissa = mantissa >> zeros;
    (if value.is_sign_negative() { -mantissa } else { mantissa }, exponent + zeros)
}

impl Unit {
    /// The largest unit of which all these coordinates are whole numbers.
    pub(super) fn of(points: impl Iterator<Item = DVec3>) -> Self {
        let exponents = points.flat_map(|p| p.to_array()).map(parts).filter(|p| p.0 != 0).map(|p| p.1);
        Self(exponents.min().unwrap_or(0))
    }

    /// A point of which the unit was made.
    pub(super) fn vector(self, point: DVec3) -> Vector {
        point.to_array().map(|value| {
            let (mantissa, exponent) = parts(value);
            if mantissa == 0 { BigInt::ZERO } else { BigInt::from(mantissa) << (exponent - self.0) as u64 }
        })
    }

    /// A vector of this unit as a point.
    pub(super) fn point(self, over: BigInt, x: Vector) -> ExactPoint {
        let turned = over.sign() == Sign::Minus;
        let (x, over) = if turned { (x.map(|v| -v), -over) } else { (x, over) };
        ExactPoint { x, over, unit: self }
    }

    /// numerator / denominator of this unit, as a float.
    pub(super) fn ratio(self, numerator: &BigInt, denominator: &BigInt) -> f64 {
        ratio(numerator, denominator, self.0)
    }
}

/// A point that was computed: three integers over a fourth, in a unit.
#[derive(Clone, Debug)]
pub struct ExactPoint {
    pub(super) x: Vector,
    /// Positive.
    pub(super) over: BigInt,
    unit: Unit,
}

impl PartialEq for ExactPoint {
    /// Of one unit: points of one question.
    fn eq(&self, other: &Self) -> bool {
        (0..3).all(|k| &self.x[k] * &other.over == &other.x[k] * &self.over)
    }
}

impl ExactPoint {
    /// The position, rounded.
    pub fn rounded(&self) -> DVec3 {
        DVec3::from(self.x.each_ref().map(|x| self.unit.ratio(x, &self.over)))
    }

    /// How far a position is from here. Only the answer is rounded, not what is subtracted.
    pub fn distance(&self, position: DVec3) -> f64 {
        let (d, unit) = self.offset(position);
        length(&d, &self.over, unit)
    }

    /// The offset of a position from here as integers over `over`, and their unit.
    pub(super) fn offset(&self, position: DVec3) -> (Vector, Unit) {
        // The position may have finer digits than the unit.
        let unit = Unit(Unit::of([position].into_iter()).0.min(self.unit.0));
        let finer = (self.unit.0 - unit.0) as u64;
        let p = unit.vector(position);
        ([0, 1, 2].map(|k| &p[k] * &self.over - (&self.x[k] << finer)), unit)
    }
}

/// |v| / denominator, in a unit.
fn length(v: &Vector, denominator: &BigInt, unit: Unit) -> f64 {
    let largest = v.iter().map(BigInt::bits).max().unwrap_or(0);
    if largest == 0 {
        return 0.0;
    }
    // Enough digits for the root to be right in a float.
    let more = 128u64.saturating_sub(largest);
    let root = (dot(v, v) << (2 * more)).sqrt();
    ratio(&root, denominator, unit.0 - more as i64)
}

/// numerator / denominator · 2^exponent, to within an ulp.
pub(super) fn ratio(numerator: &BigInt, denominator: &BigInt, exponent: i64) -> f64 {
    if numerator.sign() == Sign::NoSign {
        return 0.0;
    }
    // A quotient of 62 or 63 bits.
    let shift = 62 + denominator.bits() as i64 - numerator.bits() as i64;
    let (n, d) = (numerator.magnitude(), denominator.magnitude());
    let quotient = if shift >= 0 { (n << shift as u64) / d } else { n / (d << shift.unsigned_abs()) };
    let value = u64::try_from(&quotient).unwrap_or(u64::MAX) as f64;
    let scaled = libm::scalbn(value, (exponent - shift).clamp(-3000, 3000) as i32);
    if numerator.sign() == denominator.sign() { scaled } else { -scaled }
}

pub(super) fn sub(a: &Vector, b: &Vector) -> Vector {
    [0, 1, 2].map(|k| &a[k] - &b[k])
}

pub(super) fn cross(a: &Vector, b: &Vector) -> Vector {
    let minor = |i: usize, j: usize| &a[i] * &b[j] - &a[j] * &b[i];
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}

pub(super) fn dot(a: &Vector, b: &Vector) -> BigInt {
    &a[0] * &b[0] + &a[1] * &b[1] + &a[2] * &b[2]
}

/// (a · wa + b · wb).
pub(super) fn combine(a: &Vector, wa: &BigInt, b: &Vector, wb: &BigInt) -> Vector {
    [0, 1, 2].map(|k| &a[k] * wa + &b[k] * wb)
}

pub(super) fn is_zero(a: &Vector) -> bool {
    a.iter().all(|v| v.sign() == Sign::NoSign)
}
