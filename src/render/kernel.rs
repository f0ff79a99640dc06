//! The scattering kernel and the skin's diffusion profile (Lam 2016, Table B.1 and B.2.1.2; after Jimenez et al. 2012).
//!
//! n samples lie closer at the middle: x_u = −r + 2 r i/(n − 1), x = r sign(x_u)(x_u/r)², with r = 2 up to 19 samples, else 3. The profile
//! p(x) = Σ w G(v, x/(f + 0.001)), G(v, r) = exp(−r²/2v)/2πv, takes Table B.1's red weights for every channel, and leaves the first
//! Gaussian out (light that hardly scatters). A weight is p(x) times half the distance to both neighbours, normalised to the
//! sum 1, times the strength t; 1 − t more at the centre. A look's width is that of two units, however far the kernel reaches: with more samples
//! the same look scatters as far.
//!
//! Computed in f64 with libm, given in f32. We depart from the thesis where it contradicts itself: five weights stand beside five
//! variances, and the centre is counted once.

use crate::canvas::look::Scattering;

/// A Gaussian of the diffusion profile of skin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gaussian {
    /// Its variance, mm².
    pub variance: f64,
    /// How much of each channel it makes up.
    pub weights: [f64; 3],
}

/// The sum of six Gaussians for three-layered skin (Lam 2016, Table B.1).
pub const PROFILE: [Gaussian; 6] = [
    Gaussian { variance: 0.0064, weights: [0.233, 0.455, 0.649] },
    Gaussian { variance: 0.0484, weights: [0.100, 0.336, 0.344] },
    Gaussian { variance: 0.1870, weights: [0.118, 0.198, 0.000] },
    Gaussian { variance: 0.5670, weights: [0.113, 0.007, 0.007] },
    Gaussian { variance: 1.9900, weights: [0.358, 0.004, 0.000] },
    Gaussian { variance: 7.4100, weights: [0.078, 0.000, 0.000] },
];

/// The most samples that a kernel has.
pub const MOST_SAMPLES: u32 = 41;

/// Offsets that a look's width is as wide as.
const WIDTH: f64 = 2.0;

/// A sample of the kernel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tap {
    /// Where, as a part of the look's width: x/2, from −1 to 1, or from −1.5 to 1.5.
    pub offset: f32,
    /// How much of each channel.
    pub weight: [f32; 3],
}

/// The kernel's samples, from one end to the other; the one at the centre is in the middle. An even number of samples counts
/// as one more, and a number outside of 3 to [`MOST_SAMPLES`] as the nearest.
pub fn kernel(scattering: &Scattering) -> Vec<Tap> {
    let offsets = offsets(scattering.samples);
    let weights = [0, 1, 2].map(|c| weights(&offsets, scattering.falloff[c], scattering.strength[c]));
    let tap =
        |(i, x): (usize, &f64)| Tap { offset: (x / WIDTH) as f32, weight: [0, 1, 2].map(|c| weights[c][i]) };
    offsets.iter().enumerate().map(tap).collect()
}

/// The offsets x, in the units of the profile.
fn offsets(samples: u32) -> Vec<f64> {
    let last = i64::from(samples.clamp(3, MOST_SAMPLES) | 1) - 1;
    let range = if last < 19 { 2.0 } else { 3.0 };
    let offset = |i: i64| {
        let part = (2 * i - last) as f64 / last as f64;
        range * part * part.abs()
    };
    (0..=last).map(offset).collect()
}

/// One channel's weights, with its falloff f and its strength t.
fn weights(offsets: &[f64], falloff: f32, strength: f32) -> Vec<f32> {
    let width = f64::from(falloff).max(0.0) + 0.001;
    let area = |i: usize| {
        let (before, after) = (offsets[i.saturating_sub(1)], offsets[(i + 1).min(offsets.len() - 1)]);
        0.5 * (after - before)
    };
    let parts: Vec<f64> = (0..offsets.len()).map(|i| profile(offsets[i] / width) * area(i)).collect();
    let (sum, strength) = (parts.iter().sum::<f64>(), f64::from(strength));
    let rest = |i: usize| if i == offsets.len() / 2 { 1.0 - strength } else { 0.0 };
    parts.iter().enumerate().map(|(i, part)| (part / sum * strength + rest(i)) as f32).collect()
}

/// p(x), for a falloff of 1.
fn profile(x: f64) -> f64 {
    let gaussian = |g: &Gaussian| {
        let spread = 2.0 * g.variance;
        g.weights[0] * libm::exp(-x * x / spread) / (std::f64::consts::PI * spread)
    };
    PROFILE[1..].iter().map(gaussian).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(samples: u32) -> Scattering {
        Scattering { samples, ..Scattering::default() }
    }

    #[test]
    fn nine_samples_lie_where_the_thesis_says() {
        assert_eq!(offsets(9), [-2.0, -1.125, -0.5, -0.125, 0.0, 0.125, 0.5, 1.125, 2.0]);
        let taps: Vec<f32> = kernel(&of(9)).iter().map(|tap| 2.0 * tap.offset).collect();
        assert_eq!(taps, [-2.0, -1.125, -0.5, -0.125, 0.0, 0.125, 0.5, 1.125, 2.0]);
    }

    #[test]
    fn more_samples_reach_further() {
        assert_eq!([offsets(19)[18], offsets(21)[20], offsets(41)[40]], [2.0, 3.0, 3.0]);
        let ends = [19, 21, 41].map(|samples| kernel(&of(samples))[0].offset);
        assert_eq!(ends, [-1.0, -1.5, -1.5]);
    }

    #[test]
    fn the_number_of_samples_is_odd_and_within_bounds() {
        assert_eq!(
            [0, 2, 3, 4, 40, 41, 42, u32::MAX].map(|n| kernel(&of(n)).len()),
            [3, 3, 3, 5, 41, 41, 41, 41]
        );
    }

    #[test]
    fn weights_sum_to_one_and_are_symmetric() {
        for samples in (3..=MOST_SAMPLES).step_by(2) {
            for falloff in [[0.0; 3], [0.57, 0.13, 0.08], [1.0; 3]] {
                let taps = kernel(&Scattering { falloff, ..of(samples) });
                for c in 0..3 {
                    let sum: f64 = taps.iter().map(|tap| f64::from(tap.weight[c])).sum();
                    assert!((sum - 1.0).abs() < 1e-6, "{samples} samples, channel {c}: {sum}");
                    let mirrored = taps.iter().rev().map(|tap| (-tap.offset, tap.weight[c]));
                    assert!(taps.iter().map(|tap| (tap.offset, tap.weight[c])).eq(mirrored));
                }
            }
        }
    }

    /// Worked out apart from the code, for three samples: x = −2, 0, 2 and areas 1, 2, 1.
    #[test]
    fn three_samples_have_the_weights_of_the_formula() {
        let profile = |x: f64| {
            [(0.1, 0.0484), (0.118, 0.187), (0.113, 0.567), (0.358, 1.99), (0.078, 7.41)]
                .iter()
                .map(|(w, v)| w * libm::exp(-x * x / (2.0 * v)) / (2.0 * std::f64::consts::PI * v))
                .sum::<f64>()
        };
        let (end, middle) = (profile(2.0 / 0.571), 2.0 * profile(0.0));
        let strength = f64::from(0.78_f32);
        let expected = strength * end / (2.0 * end + middle);
        let taps = kernel(&of(3));
        assert!((f64::from(taps[0].weight[0]) - expected).abs() < 1e-9, "{} {expected}", taps[0].weight[0]);
        assert!((f64::from(taps[1].weight[0]) - (1.0 - 2.0 * expected)).abs() < 1e-7);
    }

    #[test]
    fn strength_nought_leaves_light_where_it_is() {
        let taps = kernel(&Scattering { strength: [0.0; 3], ..of(9) });
        assert!(taps.iter().all(|tap| tap.weight == if tap.offset == 0.0 { [1.0; 3] } else { [0.0; 3] }));
    }
}
