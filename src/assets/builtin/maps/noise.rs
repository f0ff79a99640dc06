//! Value noise in space, with its gradient.
//!
//! Every point of a lattice has a value in [−1, 1] from an integer hash; between them runs 6t⁵ − 15t⁴ + 10t³, so that the noise is twice
//! differentiable. It is a function of the place in space alone: what is painted with it has no seams, whatever the charts.

use glam::{DMat3, DVec3, dvec3};

/// Turns the lattice away from the axes of the model, so that it does not show.
const TURN: DMat3 =
    DMat3::from_cols(dvec3(0.00, -0.80, -0.60), dvec3(0.80, 0.36, -0.48), dvec3(0.60, -0.48, 0.64));

/// A noise's value and its gradient per centimetre.
#[derive(Clone, Copy)]
pub(super) struct Noise {
    pub value: f64,
    pub slope: DVec3,
}

/// Noise on a lattice of this cell size, cm.
pub(super) fn noise(p: DVec3, cell: f64, seed: u32) -> Noise {
    let Noise { value, slope } = lattice(TURN * p / cell, seed);
    Noise { value, slope: TURN.transpose() * slope / cell }
}

/// Noise on a lattice along the axes, with cells of another size along each, cm.
pub(super) fn stretched(p: DVec3, cells: DVec3, seed: u32) -> Noise {
    let Noise { value, slope } = lattice(p / cells, seed);
    Noise { value, slope: slope / cells }
}

fn lattice(p: DVec3, seed: u32) -> Noise {
    let cell = p.to_array().map(floor);
    let t = p - DVec3::from(cell.map(f64::from));
    let [x, y, z] = cell.map(|c| c as u32);
    let at = |i: u32, j: u32, k: u32| hash(x.wrapping_add(i), y.wrapping_add(j), z.wrapping_add(k), seed);
    let fade = t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
    let steep = 30.0 * t * t * (t * (t - 2.0) + 1.0);
    let (a, b, c, d) = (at(0, 0, 0), at(1, 0, 0), at(0, 1, 0), at(0, 0, 1));
    let (e, f, g, h) = (at(1, 1, 0), at(1, 0, 1), at(0, 1, 1), at(1, 1, 1));
    // The trilinear mix as a polynomial: its derivatives are read off.
    let (kx, ky, kz) = (b - a, c - a, d - a);
    let (kxy, kxz, kyz) = (a - b - c + e, a - b - d + f, a - c - d + g);
    let kxyz = -a + b + c + d - e - f - g + h;
    let (u, v, w) = (fade.x, fade.y, fade.z);
    let value = a + kx * u + ky * v + kz * w + kxy * u * v + kxz * u * w + kyz * v * w + kxyz * u * v * w;
    let slope = dvec3(
        kx + kxy * v + kxz * w + kxyz * v * w,
        ky + kxy * u + kyz * w + kxyz * u * w,
        kz + kxz * u + kyz * v + kxyz * u * v,
    );
    Noise { value, slope: slope * steep }
}

/// The whole number below: places of a model are far within an i32.
fn floor(v: f64) -> i32 {
    let towards_zero = v as i32;
    towards_zero - i32::from(f64::from(towards_zero) > v)
}

/// A value in [−1, 1) for a point of the lattice (odd multipliers and the mixing steps of a 32-bit finalizer).
fn hash(x: u32, y: u32, z: u32, seed: u32) -> f64 {
    let mut h = x.wrapping_mul(0x9e37_79b1)
        ^ y.wrapping_mul(0x85eb_ca77)
        ^ z.wrapping_mul(0xc2b2_ae3d)
        ^ seed.wrapping_mul(0x27d4_eb2f);
    h = (h ^ (h >> 16)).wrapping_mul(0x7feb_352d);
    h = (h ^ (h >> 15)).wrapping_mul(0x846c_a68b);
    h ^= h >> 16;
    f64::from(h >> 8) / f64::from(1 << 23) - 1.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn places() -> impl Iterator<Item = DVec3> {
        (0..200).map(|i| {
            let i = f64::from(i);
            dvec3(i * 0.37 - 30.0, i * 0.11 - 5.0, 20.0 - i * 0.23)
        })
    }

    #[test]
    fn the_slope_is_that_of_the_value() {
        const H: f64 = 1e-5;
        for p in places() {
            for make in [|p| noise(p, 0.7, 3), |p| stretched(p, dvec3(2.0, 0.3, 1.0), 5)] {
                let here: Noise = make(p);
                for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
                    let slope = (make(p + axis * H).value - make(p - axis * H).value) / (2.0 * H);
                    assert!((slope - here.slope.dot(axis)).abs() < 1e-6, "{p}: {slope}");
                }
            }
        }
    }

    #[test]
    fn values_fill_their_range_and_average_to_nothing() {
        let values: Vec<f64> = places().map(|p| noise(p * 7.0, 1.0, 1).value).collect();
        assert!(values.iter().all(|v| v.abs() <= 1.0));
        assert!(values.iter().any(|v| *v > 0.5) && values.iter().any(|v| *v < -0.5));
        assert!((values.iter().sum::<f64>() / values.len() as f64).abs() < 0.1);
        let turned: Vec<f64> = places().map(|p| noise(p * 7.0, 1.0, 2).value).collect();
        assert_ne!(values, turned, "another seed is another noise");
    }
}
