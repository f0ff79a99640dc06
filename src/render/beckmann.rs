//! Beckmann's distribution as a table over n · h and m (Lam 2016, B.1.1).
//!
//! D = exp(−t)/(m² cos⁴α), with cos α = n · h and t = tan²α/m². As 1/cos⁴α = (1 + m² t)², m² D = exp(−t)(1 + m² t)² depends on t and on m² only,
//! smoothly. The table holds m² D over u = 1/(1 + t) = c² m²/(c² m² + 1 − c²), c = n · h, which lies from 0 to 1 and needs no
//! transcendental function, and over m². A lookup is bilinear between u (WIDTH − 1) and m² (HEIGHT − 1), divided by m².
//!
//! So the lobe of a smooth surface, which is a thousandth wide in n · h, has as many texels as that of a rough one. A lookup's error
//! is below [`ERROR`] of 1/m², the lobe's height at n = h. We depart from the thesis, which kept 8 bits in a plain grid over n · h and m.

use std::sync::LazyLock;

use super::sat;

/// Texels along u.
pub const WIDTH: usize = 256;
/// Texels along m².
pub const HEIGHT: usize = 64;
/// A smaller roughness counts as this.
pub const LEAST_ROUGHNESS: f32 = 0.05;
/// The most that m² D is off.
pub const ERROR: f64 = 2e-4;

/// The table of m² D, row by row; row j is m² = j/(HEIGHT − 1), texel i is u = i/(WIDTH − 1).
pub fn table() -> &'static [f32] {
    static TABLE: LazyLock<Vec<f32>> = LazyLock::new(|| {
        let row = |j: usize| {
            (0..WIDTH).map(move |i| texel(i as f64 / (WIDTH - 1) as f64, j as f64 / (HEIGHT - 1) as f64))
        };
        (0..HEIGHT).flat_map(row).collect()
    });
    &TABLE
}

/// m² D at u and m².
fn texel(u: f64, m2: f64) -> f32 {
    if u == 0.0 {
        return 0.0;
    }
    let t = 1.0 / u - 1.0;
    let height = 1.0 + m2 * t;
    (libm::exp(-t) * height * height) as f32
}

/// D at a positive n · h and a roughness, by the table; a roughness outside of [`LEAST_ROUGHNESS`] to 1 counts as the nearest.
#[inline]
pub fn lookup(table: &[f32], cos: f32, roughness: f32) -> f32 {
    let (m, c) = (sat(roughness).max(LEAST_ROUGHNESS), sat(cos));
    let (m2, c2) = (m * m, c * c);
    let (x, y) = (c2 * m2 / (c2 * m2 + 1.0 - c2) * (WIDTH - 1) as f32, m2 * (HEIGHT - 1) as f32);
    let (i, j) = ((x as usize).min(WIDTH - 2), (y as usize).min(HEIGHT - 2));
    let (fx, fy) = (x - i as f32, y - j as f32);
    let at = |j: usize| {
        let row = &table[j * WIDTH + i..][..2];
        row[0] + fx * (row[1] - row[0])
    };
    let (low, high) = (at(j), at(j + 1));
    (low + fy * (high - low)) / m2
}

#[cfg(test)]
mod tests {
    use super::*;

    fn closed(c: f64, m: f64) -> f64 {
        let c2 = c * c;
        libm::exp(-(1.0 - c2) / (c2 * m * m)) / (m * m * c2 * c2)
    }

    #[test]
    fn the_table_is_the_closed_form() {
        let mut worst = 0.0_f64;
        for m in (0..=190).map(|i| 0.05 + 0.005 * f64::from(i)) {
            // Even in the angle, so that a narrow lobe is looked at too.
            for cos in (0..1571).map(|i| libm::cos(f64::from(i) / 1000.0)) {
                // What the table is asked for, rounding included.
                let (cos, m) = (cos as f32, m as f32);
                let exact = closed(cos.into(), f64::from(m));
                let found = f64::from(lookup(table(), cos, m));
                worst = worst.max((found - exact).abs() * f64::from(m) * f64::from(m));
            }
        }
        assert!(worst < ERROR, "{worst:e}");
    }

    #[test]
    fn no_surface_is_too_smooth_or_too_rough() {
        assert_eq!(lookup(table(), 0.999, 0.0), lookup(table(), 0.999, LEAST_ROUGHNESS));
        assert_eq!(lookup(table(), 0.5, 3.0), lookup(table(), 0.5, 1.0));
        let wild = [0.0, f32::NAN, 1e-30, 1.0, 2.0]
            .map(|c| [0.0, f32::NAN, 0.3, 1.0].map(|m| lookup(table(), c, m)));
        assert!(wild.as_flattened().iter().all(|d| d.is_finite() && *d >= 0.0), "{wild:?}");
    }
}
