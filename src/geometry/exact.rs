//! The exact sign of a polynomial in floating-point numbers.
//!
//! A [`Formula`] is written once, over any [`Number`]. [`sign`] evaluates it first with [`Approx`], a float that carries a bound of
//! its own error, and only where that bound does not decide with [`Dyadic`], an integer times a power of two, which
//! represents every finite float and every sum and product of them. The filter decides nearly always; the integers
//! always do. There is no range of exponents in which this fails.

use std::cmp::Ordering;

use num_bigint::BigInt;

use super::double::{Double, DoubleVec};

/// What a formula is evaluated over.
pub trait Number: Clone {
    /// The number of a float, which must be finite.
    fn of(value: f64) -> Self;
    /// Sum.
    fn add(&self, other: &Self) -> Self;
    /// Difference.
    fn sub(&self, other: &Self) -> Self;
    /// Product.
    fn mul(&self, other: &Self) -> Self;
}

/// A polynomial whose sign is wanted.
pub trait Formula {
    /// Its value.
    fn evaluate<N: Number>(&self) -> N;
}

/// The exact sign of a formula: `Less` for negative, `Equal` for zero, `Greater` for positive.
#[inline]
pub fn sign(formula: &impl Formula) -> Ordering {
    match formula.evaluate::<Approx>().sign() {
        Some(sign) => sign,
        None => formula.evaluate::<Dyadic>().sign(),
    }
}

/// A float and a bound of how far it is from the true value.
#[derive(Clone, Copy, Debug)]
pub struct Approx {
    value: f64,
    error: f64,
}

/// Half an ulp of 1, and enough over it to cover the rounding of the bound itself.
const ROUNDING: f64 = f64::EPSILON * 0.5 * (1.0 + 16.0 * f64::EPSILON);
/// Covers what a product loses by underflow.
const UNDERFLOW: f64 = f64::MIN_POSITIVE;
/// The bound's own sums are rounded too.
const GROWTH: f64 = 1.0 + 8.0 * f64::EPSILON;

/// Bounds of a value that is not known at all.
pub(super) const EVERYWHERE: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

impl Approx {
    fn rounded(value: f64, inherited: f64) -> Self {
        Self { value, error: (inherited + value.abs() * ROUNDING + UNDERFLOW) * GROWTH }
    }

    /// Between which floats the true value lies; anywhere, where that is lost.
    pub(super) fn bounds(self) -> [f64; 2] {
        let [low, high] = [self.value - self.error, self.value + self.error];
        // The bounds are rounded as well.
        if low.is_finite() && high.is_finite() { [low.next_down(), high.next_up()] } else { EVERYWHERE }
    }

    fn sign(self) -> Option<Ordering> {
        // A NaN or an infinity compares false, and so is left to the integers.
        if self.error < self.value.abs() && self.value.is_finite() {
            self.value.partial_cmp(&0.0)
        } else {
            None
        }
    }
}

impl Number for Approx {
    #[inline]
    fn of(value: f64) -> Self {
        Self { value, error: 0.0 }
    }

    #[inline]
    fn add(&self, other: &Self) -> Self {
        Self::rounded(self.value + other.value, self.error + other.error)
    }

    #[inline]
    fn sub(&self, other: &Self) -> Self {
        Self::rounded(self.value - other.value, self.error + other.error)
    }

    #[inline]
    fn mul(&self, other: &Self) -> Self {
        let (a, b) = (self.value.abs(), other.value.abs());
        Self::rounded(self.value * other.value, a * other.error + b * self.error + self.error * other.error)
    }
}

/// `mantissa · 2^exponent`, exactly.
#[derive(Clone, Debug)]
pub struct Dyadic {
    mantissa: BigInt,
    exponent: i64,
}

impl Dyadic {
    fn sign(&self) -> Ordering {
        self.mantissa.cmp(&BigInt::ZERO)
    }

    /// The first 106 binary digits, times 2^`scale`.
    fn doubled(&self, scale: i64) -> Double {
        let beyond = self.mantissa.bits().saturating_sub(106);
        let digits = u128::try_from(self.mantissa.magnitude() >> beyond).unwrap_or(u128::MAX);
        // What is scaled to less than a float can hold is nothing beside the largest.
        let exponent = (self.exponent + beyond as i64 + scale).clamp(-2000, 2000) as i32;
        let sign = if self.sign() == Ordering::Less { -1.0 } else { 1.0 };
        let part = |digits: u128, exponent| libm::ldexp(sign * digits as f64, exponent);
        Double::sum(part(digits >> 53, exponent + 53), part(digits & ((1 << 53) - 1), exponent))
    }

    /// How many binary digits there are before the point.
    fn magnitude(&self) -> i64 {
        self.mantissa.bits() as i64 + self.exponent
    }

    /// Both mantissas over the smaller exponent.
    fn aligned(&self, other: &Self) -> (BigInt, BigInt, i64) {
        let exponent = self.exponent.min(other.exponent);
        let shift = |n: &Self| n.mantissa.clone() << (n.exponent - exponent) as u64;
        (shift(self), shift(other), exponent)
    }
}

impl Number for Dyadic {
    fn of(value: f64) -> Self {
        let bits = value.to_bits();
        let (biased, fraction) = ((bits >> 52 & 0x7ff) as i64, (bits & ((1 << 52) - 1)) as i64);
        let (magnitude, exponent) =
            if biased == 0 { (fraction, -1074) } else { (fraction | 1 << 52, biased - 1075) };
        let zeros = if magnitude == 0 { 0 } else { magnitude.trailing_zeros() };
        let magnitude = magnitude >> zeros;
        let mantissa = BigInt::from(if value.is_sign_negative() { -magnitude } else { magnitude });
        Self { mantissa, exponent: if magnitude == 0 { 0 } else { exponent + zeros as i64 } }
    }

    fn add(&self, other: &Self) -> Self {
        if self.mantissa == BigInt::ZERO {
            return other.clone();
        }
        if other.mantissa == BigInt::ZERO {
            return self.clone();
        }
        let (a, b, exponent) = self.aligned(other);
        Self { mantissa: a + b, exponent }
    }

    fn sub(&self, other: &Self) -> Self {
        self.add(&Self { mantissa: -other.mantissa.clone(), exponent: other.exponent })
    }

    fn mul(&self, other: &Self) -> Self {
        Self { mantissa: &self.mantissa * &other.mantissa, exponent: self.exponent + other.exponent }
    }
}

/// A vector of numbers.
pub type Vector<N> = [N; 3];

/// The difference of two points.
pub fn difference<N: Number>(a: glam::DVec3, b: glam::DVec3) -> Vector<N> {
    let d = |a: f64, b: f64| N::of(a).sub(&N::of(b));
    [d(a.x, b.x), d(a.y, b.y), d(a.z, b.z)]
}

/// The cross product.
pub fn cross<N: Number>(a: &Vector<N>, b: &Vector<N>) -> Vector<N> {
    let minor = |i: usize, j: usize| a[i].mul(&b[j]).sub(&a[j].mul(&b[i]));
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}

/// A vector's direction with doubled digits: the vector times the power of two that puts its largest component between a half and one.
pub fn direction(v: &Vector<Dyadic>) -> DoubleVec {
    let others_than_zero = v.iter().filter(|x| x.sign() != Ordering::Equal);
    let largest = others_than_zero.map(Dyadic::magnitude).max().unwrap_or(0);
    [0, 1, 2].map(|i| v[i].doubled(-largest))
}

/// The dot product.
pub fn dot<N: Number>(a: &Vector<N>, b: &Vector<N>) -> N {
    a[0].mul(&b[0]).add(&a[1].mul(&b[1])).add(&a[2].mul(&b[2]))
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Sum<'a>(&'a [f64]);

    impl Formula for Sum<'_> {
        fn evaluate<N: Number>(&self) -> N {
            self.0.iter().fold(N::of(0.0), |sum, &v| sum.add(&N::of(v)))
        }
    }

    struct Product<'a>(&'a [f64], &'a [f64]);

    impl Formula for Product<'_> {
        fn evaluate<N: Number>(&self) -> N {
            let product = |v: &[f64]| v.iter().fold(N::of(1.0), |p, &v| p.mul(&N::of(v)));
            product(self.0).sub(&product(self.1))
        }
    }

    #[test]
    fn a_direction_has_all_its_digits_however_small_the_vector() {
        use crate::geometry::double;
        let tiny = libm::ldexp(1.0, -600);
        let v = [1.0, -3.0, 0.0].map(|x| Dyadic::of(x * tiny));
        let v = v.map(|x| x.mul(&Dyadic::of(1.0 + f64::EPSILON)).mul(&Dyadic::of(tiny)));
        let found = direction(&v);
        assert_eq!(double::rounded(found).to_array(), [0.25, -0.75, 0.0].map(|x| x * (1.0 + f64::EPSILON)));
        // Half of it, and a last digit that one float alone would lose.
        let long = Dyadic::of(1.0).add(&Dyadic::of(libm::ldexp(1.0, -100)));
        let [half, ..] = direction(&[long, Dyadic::of(0.0), Dyadic::of(0.0)]);
        let [one, less, none] = [1.0, -0.5, 0.0].map(|x| Double::sum(x, 0.0));
        assert_eq!(double::dot([half, one, none], [one, less, none]).value(), libm::ldexp(1.0, -101));
        assert_eq!(direction(&[0.0; 3].map(Dyadic::of)).map(Double::value), [0.0; 3]);
    }

    #[test]
    fn what_rounding_swallows_still_has_a_sign() {
        assert_eq!(sign(&Sum(&[1e300, 1e-300, -1e300])), Ordering::Greater);
        assert_eq!(sign(&Sum(&[1e300, -5e-324, -1e300])), Ordering::Less);
        assert_eq!(sign(&Sum(&[0.1, 0.2, -0.3])), Ordering::Greater);
        assert_eq!(sign(&Sum(&[0.5, 0.25, -0.75])), Ordering::Equal);
    }

    #[test]
    fn overflow_and_underflow_are_left_to_the_integers() {
        assert_eq!(sign(&Product(&[1e200, 1e200], &[1e200, 1.0000000000000002e200])), Ordering::Less);
        assert_eq!(sign(&Product(&[1e-200, 1e-200], &[1e-200, 1e-200])), Ordering::Equal);
        assert_eq!(sign(&Product(&[5e-324, 5e-324], &[0.0])), Ordering::Greater);
        assert_eq!(sign(&Product(&[f64::MAX, -f64::MAX], &[1.0])), Ordering::Less);
    }
}
