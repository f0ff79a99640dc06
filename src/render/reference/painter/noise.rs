//! Perlin's and simplex noise in two dimensions, without tables (Gustavson and McEwan 2012), and fractional Brownian motion.
//!
//! Every lattice point has a hash h, made from its coordinates by the polynomial π(i) = (34 i + 1) i mod 289, and by the hash a gradient:
//! x = 2 fract(h/41) − 1 gives the point (x − ⌊x + ½⌋, |x| − ½) of a diamond, which is made about unit length.
//!
//! - **Perlin**: the gradients of a cell's four corners, each times the way from its corner, mixed by the quintic
//!   6 t⁵ − 15 t⁴ + 10 t³; the hash is π(π(column) + row).
//! - **Simplex**: the same of a triangle's three corners, each weighted by max(0, ½ − r²)⁴; the hash is π(π(row) + column).
//!
//! Many places are asked for at once: arrays of them are worked through in the processor's wide registers, with the same bits as one by one.
//!
//! The remainder is taken half a step off the integers, so no rounding of 1/289 can make 289 of 0: on any device a lattice point
//! has the same hash.

use crate::canvas::look::Fbm;

/// Octaves beyond this are left out: no scene may ask for more.
const MOST_OCTAVES: u32 = 16;

/// What simplex lattices are skewed by, (√3 − 1)/2.
const SKEW: f32 = 0.366_025_42;

/// And what they are skewed back by, (3 − √3)/6.
const UNSKEW: f32 = 0.211_324_87;

/// Near this there are only integers, so adding and subtracting it rounds.
const ROUNDER: f32 = 12_582_912.0;

/// Without the call that `f32::floor` is where the processor's least instruction set has no such thing.
#[inline]
fn floor(x: f32) -> f32 {
    let near = (x + ROUNDER) - ROUNDER;
    let below = if near > x { near - 1.0 } else { near };
    // Beyond, no lattice is fine enough to matter.
    if x.abs() < 0.25 * ROUNDER { below } else { x }
}

#[inline]
fn fract(x: f32) -> f32 {
    x - floor(x)
}

/// An integer's remainder by 289.
#[inline]
fn rest(x: f32) -> f32 {
    x - floor((x + 0.5) * (1.0 / 289.0)) * 289.0
}

#[inline]
fn permute(x: f32) -> f32 {
    rest((34.0 * x + 1.0) * x)
}

/// The gradient of a hash, times the way from its lattice point.
#[inline]
fn slope(hash: f32, [x, y]: [f32; 2]) -> f32 {
    let place = 2.0 * fract(hash / 41.0) - 1.0;
    let gx = place - floor(place + 0.5);
    let gy = place.abs() - 0.5;
    // One step of Newton's for 1/√r, near the diamond's middle radius.
    let unit = 1.792_842_9 - 0.853_734_73 * (gx * gx + gy * gy);
    unit * (gx * x + gy * y)
}

#[inline]
fn mix(a: f32, b: f32, t: f32) -> f32 {
    a + (b - a) * t
}

/// Perlin's noise, within −1 … 1.
pub(super) fn perlin([x, y]: [f32; 2]) -> f32 {
    let (column, row) = (floor(x), floor(y));
    let (dx, dy) = (x - column, y - row);
    let fade = |t: f32| t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
    let (left, right) = (permute(rest(column)), permute(rest(column + 1.0)));
    let (top, bottom) = (rest(row), rest(row + 1.0));
    let corner = |across: f32, down: f32, way: [f32; 2]| slope(permute(across + down), way);
    let upper = mix(corner(left, top, [dx, dy]), corner(right, top, [dx - 1.0, dy]), fade(dx));
    let lower =
        mix(corner(left, bottom, [dx, dy - 1.0]), corner(right, bottom, [dx - 1.0, dy - 1.0]), fade(dx));
    2.3 * mix(upper, lower, fade(dy))
}

/// Simplex noise, within −1 … 1.
#[inline(always)] // Or the places of an array are worked through one by one.
pub(super) fn simplex([x, y]: [f32; 2]) -> f32 {
    let skew = (x + y) * SKEW;
    let (column, row) = (floor(x + skew), floor(y + skew));
    let back = (column + row) * UNSKEW;
    let first = [x - column + back, y - row + back];
    // The second corner lies across in the lower triangle of the cell, up in the other.
    let [across, up] = if first[0] > first[1] { [1.0, 0.0] } else { [0.0, 1.0] };
    let second = [first[0] - across + UNSKEW, first[1] - up + UNSKEW];
    let third = [first[0] - 1.0 + 2.0 * UNSKEW, first[1] - 1.0 + 2.0 * UNSKEW];
    let (column, row) = (rest(column), rest(row));
    let corner = |right: f32, above: f32, way: [f32; 2]| {
        let weight = (0.5 - (way[0] * way[0] + way[1] * way[1])).max(0.0);
        let square = weight * weight;
        square * square * slope(permute(permute(row + above) + column + right), way)
    };
    130.0 * (corner(0.0, 0.0, first) + corner(across, up, second) + corner(1.0, 1.0, third))
}

/// Noises of rising frequency and falling height, added (Lam 2016, Snippet 5.2).
pub(super) fn fbm<const N: usize>(at: [[f32; 2]; N], noise: &Fbm) -> [f32; N] {
    let (mut sums, mut frequency, mut amplitude) = ([0.0; N], noise.frequency, noise.amplitude);
    for _ in 0..noise.octaves.min(MOST_OCTAVES) {
        sums.iter_mut().zip(at).for_each(|(sum, p)| *sum += amplitude * simplex(p.map(|v| v * frequency)));
        frequency *= noise.lacunarity;
        amplitude *= noise.persistence;
    }
    sums
}

#[cfg(test)]
mod tests;
