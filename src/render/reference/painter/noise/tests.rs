//! Both noises against known values, their range, their symmetries, and places that are too far out.

use super::*;
use crate::canvas::look::Fbm;

/// Places, and both noises there: the published formulas, worked out in f64 with exact remainders.
const KNOWN: [([f32; 2], f32, f32); 7] = [
    ([0.5, 0.5], -0.491533, -0.471333),
    ([3.25, 7.75], -0.065852, -0.005788),
    ([12.125, 0.5], -0.628676, 0.720905),
    ([-1.375, 2.5], -0.645030, -0.316695),
    ([100.0625, 41.9375], 0.010632, 0.215951),
    ([288.5, 289.5], 0.045748, -0.231549),
    ([405.25, -0.75], -0.362175, 0.647555),
];

#[test]
fn both_noises_are_those_of_the_formulas() {
    for (at, of_perlin, of_simplex) in KNOWN {
        let off = [perlin(at) - of_perlin, simplex(at) - of_simplex].map(f32::abs);
        assert!(off[0] < 1e-5 && off[1] < 5e-4, "{at:?}: {off:?}");
    }
}

#[test]
fn fbm_adds_octaves() {
    let noise = Fbm { octaves: 4, frequency: 4.0, amplitude: 0.5, lacunarity: 2.0, persistence: 0.5 };
    assert!((fbm([[0.3, 0.7]], &noise)[0] - 0.077694).abs() < 1e-4);
    assert!((fbm([[50.125, 17.625]], &noise)[0] + 0.320551).abs() < 1e-3);
    let one = Fbm { octaves: 1, ..noise };
    assert_eq!(fbm([[0.3, 0.7]], &one), [0.5 * simplex([1.2, 2.8])]);
}

/// Places all over, the same in every run.
fn places() -> impl Iterator<Item = [f32; 2]> {
    (0..20_000u32).map(|k| {
        let [a, b] = [k.wrapping_mul(2_654_435_761), k.wrapping_mul(2_246_822_519).rotate_left(13)];
        [a, b].map(|bits| (bits >> 8) as f32 / (1 << 14) as f32 - 300.0)
    })
}

#[test]
fn both_noises_keep_their_range_and_use_it() {
    for noise in [perlin, simplex] {
        let most = places().map(|p| noise(p).abs()).fold(0.0, f32::max);
        assert!((0.8..=1.01).contains(&most), "{most}");
        let mean = places().map(noise).sum::<f32>() / 20_000.0;
        assert!(mean.abs() < 0.02, "{mean}");
    }
}

#[test]
fn perlin_is_nothing_at_lattice_points_and_repeats_after_289() {
    for k in 0..289u16 {
        let at = [f32::from(k), f32::from(k * 7 % 289)];
        assert_eq!(perlin(at), 0.0, "{at:?}");
    }
    for [x, y] in [[0.25, 0.5], [288.75, 3.125], [17.5, 144.5]] {
        assert_eq!(perlin([x, y]), perlin([x + 289.0, y]));
        assert_eq!(perlin([x, y]), perlin([x, y - 289.0]));
    }
}

#[test]
fn neighbouring_cells_meet() {
    for noise in [perlin, simplex] {
        for [x, y] in places().map(|p| p.map(|v| v.round())) {
            let [left, right] = [-1e-4, 1e-4].map(|by| noise([x + by, y + 0.37]));
            assert!((left - right).abs() < 4e-3, "a step at {x}, {y}: {left} and {right}");
        }
    }
}

#[test]
fn places_at_once_are_as_places_one_by_one() {
    let noise = Fbm::default();
    let all: Vec<[f32; 2]> = places().take(64).collect();
    for eight in all.as_chunks::<8>().0 {
        assert_eq!(fbm(*eight, &noise), eight.map(|p| fbm([p], &noise)[0]));
    }
}

#[test]
fn nothing_is_too_far_out() {
    for v in [3e9, -3e9, 1e30, f32::MAX, f32::INFINITY, f32::NAN] {
        let wild = Fbm { octaves: u32::MAX, frequency: v, ..Fbm::default() };
        // Only that it ends, and does not panic: such a place has no noise to speak of.
        let _ = (perlin([v, 0.5]), simplex([v, v]), fbm([[0.5, v]], &wild));
    }
    assert_eq!(
        [floor(-0.5), floor(-2.0), floor(2.999), floor(-8_388_609.0)],
        [-1.0, -2.0, 2.0, -8_388_609.0]
    );
}
