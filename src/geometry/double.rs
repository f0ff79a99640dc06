//! Sums of two floats: about 106 bits, for positions that are to be rounded once.
//!
//! Products are split (Dekker) rather than fused, since a fused product is slow where the machine has none. Not exact, and not safe
//! beyond magnitudes of 1e150: what must be exact goes through [`super::exact`].

use glam::DVec3;

/// The unevaluated sum of two floats.
#[derive(Clone, Copy, Debug, Default)]
pub struct Double {
    high: f64,
    low: f64,
}

/// A vector of them.
pub type DoubleVec = [Double; 3];

#[inline]
fn two_sum(a: f64, b: f64) -> Double {
    let high = a + b;
    let t = high - a;
    Double { high, low: (a - (high - t)) + (b - t) }
}

#[inline]
fn quick_two_sum(a: f64, b: f64) -> Double {
    let high = a + b;
    Double { high, low: b - (high - a) }
}

#[inline]
fn split(a: f64) -> (f64, f64) {
    let t = 134_217_729.0 * a;
    let high = t - (t - a);
    (high, a - high)
}

#[inline]
fn two_product(a: f64, b: f64) -> Double {
    let high = a * b;
    let ((ah, al), (bh, bl)) = (split(a), split(b));
    Double { high, low: ((ah * bh - high) + ah * bl + al * bh) + al * bl }
}

impl Double {
    /// The nearest float.
    #[inline]
    pub fn value(self) -> f64 {
        self.high
    }

    /// The sum of two floats.
    #[inline]
    pub fn sum(a: f64, b: f64) -> Self {
        two_sum(a, b)
    }

    /// The difference of two floats.
    #[inline]
    pub fn difference(a: f64, b: f64) -> Self {
        two_sum(a, -b)
    }

    #[inline]
    fn add(self, other: Self) -> Self {
        let s = two_sum(self.high, other.high);
        quick_two_sum(s.high, s.low + self.low + other.low)
    }

    #[inline]
    fn mul(self, other: Self) -> Self {
        let p = two_product(self.high, other.high);
        quick_two_sum(p.high, p.low + self.high * other.low + self.low * other.high)
    }

    #[inline]
    fn neg(self) -> Self {
        Self { high: -self.high, low: -self.low }
    }
}

/// The difference of two points.
#[inline]
pub fn difference(a: DVec3, b: DVec3) -> DoubleVec {
    [Double::difference(a.x, b.x), Double::difference(a.y, b.y), Double::difference(a.z, b.z)]
}

/// The cross product.
#[inline]
pub fn cross(a: DoubleVec, b: DoubleVec) -> DoubleVec {
    let minor = |i: usize, j: usize| a[i].mul(b[j]).add(a[j].mul(b[i]).neg());
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}

/// The dot product.
#[inline]
pub fn dot(a: DoubleVec, b: DoubleVec) -> Double {
    a[0].mul(b[0]).add(a[1].mul(b[1])).add(a[2].mul(b[2]))
}

/// `origin` + Σ weightᵢ (pointᵢ − origin), rounded once.
pub fn blend<const N: usize>(origin: DVec3, parts: [(DVec3, f64); N]) -> DVec3 {
    let mut sum = difference(origin, DVec3::ZERO);
    for (point, weight) in parts {
        let step = difference(point, origin);
        sum = [0, 1, 2].map(|k| sum[k].add(step[k].mul(Double { high: weight, low: 0.0 })));
    }
    rounded(sum)
}

/// A vector of the nearest floats.
#[inline]
pub fn rounded(a: DoubleVec) -> DVec3 {
    DVec3::new(a[0].high, a[1].high, a[2].high)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cancelled_cross_product_keeps_its_digits() {
        // Two directions that differ in the last bits: plain floats leave noise where the true component is 2^-60.
        let tiny = 2f64.recip().powi_exact(30);
        let a = DVec3::new(1.0 + tiny, 1.0, 0.0);
        let b = DVec3::new(1.0, 1.0 - tiny, 0.0);
        let z = cross(difference(a, DVec3::ZERO), difference(b, DVec3::ZERO))[2];
        assert_eq!(z.value(), -tiny * tiny);
    }

    trait PowExact {
        fn powi_exact(self, n: u32) -> f64;
    }

    impl PowExact for f64 {
        fn powi_exact(self, n: u32) -> f64 {
            (0..n).fold(1.0, |p, _| p * self)
        }
    }
}
