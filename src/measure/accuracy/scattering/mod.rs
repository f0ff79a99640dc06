//! The separable kernel of 3 to 41 samples, against the full convolution with the six Gaussians of skin (Lam 2016, B.2.1.2).
//!
//! **Truth.** Light scattered by the published profile, each channel with its own weights: a convolution in two dimensions, in f64 ([`convolution`]).
//! **Pictures.** On a wall of skin: an edge between light and dark that runs askew, discs as large as wounds, and the diffuse light of a frame of the
//! bust.
//!
//! **Error.** The root of the mean square of the difference in linear light, in per cent of white; the largest; and FLIP (`flip`) of
//! the two pictures as one would see them.
//!
//! **Two looks.** `shipped` has the scene's defaults. `profile` takes the published figures at their word: a unit of the kernel's offsets is a
//! millimetre, its strength is what the profile leaves besides the first Gaussian, and its falloff is the ratio of the channels' second moments to
//! red's.
//!
//! **What to expect.** The kernel is the profile's own slice, used as a factor both ways, and the product of two slices is narrower than the profile:
//! taken at their word the figures scatter too little, however many samples there are. The defaults make up for it by being wider.

pub mod convolution;

use super::Ask;
use super::curve::{Curve, Measure, Planted, Row};
use super::flip;
use super::frames::{Pose, bust};
use super::turns::{Task, in_turns, timed};
use crate::canvas::Studio;
use crate::canvas::look::Scattering;
use crate::measure::MeasureError;
use crate::render::kernel::PROFILE;
use crate::render::reference::alone::Wall;
use crate::render::srgb;
use convolution::{Picture, convolved};

/// Samples, those of a quick run first.
const SAMPLES: [u32; 11] = [5, 9, 13, 17, 25, 41, 3, 7, 11, 21, 33];
const QUICK: usize = 6;
/// Pixels along a picture.
const SIDE: u32 = 160;
/// Pixels in a centimetre of the wall.
const PIXELS_PER_CM: f64 = 40.0;
/// Per cent.
const PERCENT: f64 = 100.0;

/// Measures it.
pub fn run(ask: &Ask<'_>) -> Result<Vec<Curve>, MeasureError> {
    measure(SIDE, ask.of(&SAMPLES, QUICK), ask.rounds, ask.studio)
}

/// How light scatters with so many samples.
type Look = fn(u32) -> Scattering;

/// A picture before and after it scattered.
struct Sample {
    name: &'static str,
    light: Picture,
    truth: Picture,
}

/// A pass that is run again and again.
struct Scattered<'a> {
    sample: &'a Sample,
    samples: u32,
    wall: Wall,
}

fn measure(
    side: u32,
    samples: &[u32],
    rounds: usize,
    studio: &dyn Studio,
) -> Result<Vec<Curve>, MeasureError> {
    let mut samples = samples.to_vec();
    samples.sort_unstable();
    let lights = [("edge", edge(side)), ("discs", discs(side)), ("bust", frame(side, studio)?)];
    let pictures =
        lights.map(|(name, light)| Sample { name, truth: convolved(&light, PIXELS_PER_CM), light });
    let curve = |name: &str, look: Look| curve(name, look, &pictures, &samples, rounds);
    Ok(vec![curve("profile", profile)?, curve("shipped", shipped)?])
}

fn curve(
    name: &str,
    look: Look,
    pictures: &[Sample],
    samples: &[u32],
    rounds: usize,
) -> Result<Curve, MeasureError> {
    let new = |sample, samples| Scattered::new(sample, samples, &look(samples));
    let mut all: Vec<Scattered<'_>> =
        pictures.iter().flat_map(|sample| samples.iter().map(move |n| new(sample, *n))).collect();
    let errors: Vec<[f64; 3]> = all.iter_mut().map(Scattered::errors).collect();
    let heads: Vec<(&str, String)> =
        all.iter().map(|one| (one.sample.name, format!("{} samples", one.samples))).collect();
    let mut tasks: Vec<Task<'_>> =
        all.iter_mut().map(|one| Box::new(|| Ok(one.scatter_us())) as Task<'_>).collect();
    let timings = in_turns(rounds, &mut tasks)?;
    let rows = heads.into_iter().zip(timings).zip(errors).map(|(((series, setting), timing), errors)| {
        Row::new(series, setting, timing, Some(errors[0]), errors[1..].to_vec())
    });
    Ok(Curve {
        name: format!("scattering-{name}"),
        title: format!("Scattering of light in skin by samples of the kernel, {name} look"),
        time_of: format!("both passes over {} pixels", pictures.first().map_or(0, |p| p.light.texels.len())),
        error: Measure::new("RMS difference of light", "% of white"),
        others: vec![Measure::new("largest", "% of white"), Measure::new("mean FLIP", "")],
        rows: rows.collect(),
        planted: planted(),
    }
    .with_front())
}

impl<'a> Scattered<'a> {
    fn new(sample: &'a Sample, samples: u32, scattering: &Scattering) -> Self {
        let light: Vec<[f32; 3]> = sample.light.texels.iter().map(|t| t.map(|v| v as f32)).collect();
        let wall = Wall::new(sample.light.size, &light, PIXELS_PER_CM, scattering);
        Self { sample, samples, wall }
    }

    fn scatter_us(&mut self) -> f64 {
        self.wall.reset();
        timed(|| self.wall.scatter()).1
    }

    /// RMS, the largest, FLIP.
    fn errors(&mut self) -> [f64; 3] {
        self.scatter_us();
        let texels = self.wall.light().map(|t| t.map(f64::from)).collect();
        let found = Picture { size: self.sample.truth.size, texels };
        let [rms, largest] = apart(&found, &self.sample.truth);
        let seen = |picture: &Picture| picture.texels.iter().map(|t| t.map(flip::encode)).collect::<Vec<_>>();
        let flip = flip::mean(found.size, &seen(&self.sample.truth), &seen(&found));
        [rms, largest, flip]
    }
}

/// The scene's defaults.
fn shipped(samples: u32) -> Scattering {
    Scattering { samples, ..Scattering::default() }
}

/// The kernel at the profile's own scale.
fn profile(samples: u32) -> Scattering {
    let moment = |c: usize| {
        let sum =
            |of: fn(f64, f64) -> f64| PROFILE[1..].iter().map(|g| of(g.weights[c], g.variance)).sum::<f64>();
        (sum(|w, _| w), sum(|w, v| w * v))
    };
    let (red, red_moment) = moment(0);
    let falloff = [0, 1, 2].map(|c| {
        let (part, spread) = moment(c);
        (spread / part / (red_moment / red)).sqrt() as f32
    });
    Scattering {
        samples,
        width_cm: 0.2,
        falloff,
        strength: [0, 1, 2].map(|c| moment(c).0 as f32),
        ..shipped(samples)
    }
}

/// RMS and largest difference, per cent of white.
fn apart(found: &Picture, truth: &Picture) -> [f64; 2] {
    let all = found.texels.as_flattened().iter().zip(truth.texels.as_flattened());
    let off = all.map(|(a, b)| PERCENT * (a - b).abs());
    let (sum, largest) = off.fold((0.0, 0.0_f64), |(sum, most), off| (sum + off * off, most.max(off)));
    [(sum / (3 * found.texels.len()) as f64).sqrt(), largest]
}

/// Light to the right of a line that runs askew through the middle.
fn edge(side: u32) -> Picture {
    Picture::of([side; 2], |x, y| {
        let lit = x - 0.5 + 0.4 * (y - 0.5) > 0.0;
        if lit { [0.85, 0.70, 0.60] } else { [0.10, 0.05, 0.04] }
    })
}

/// Dark red discs on light skin, 2, 5 and 10 mm across.
fn discs(side: u32) -> Picture {
    let cm = PIXELS_PER_CM / f64::from(side);
    let discs = [([0.20, 0.25], 0.1), ([0.65, 0.25], 0.25), ([0.45, 0.70], 0.5)];
    Picture::of([side; 2], |x, y| {
        let inside = |([u, v], radius): ([f64; 2], f64)| {
            (x - u) * (x - u) + (y - v) * (y - v) < (radius * cm) * (radius * cm)
        };
        if discs.into_iter().any(inside) { [0.25, 0.02, 0.02] } else { [0.75, 0.55, 0.45] }
    })
}

/// The diffuse light of a frame of the bust, near by.
fn frame(side: u32, studio: &dyn Studio) -> Result<Picture, MeasureError> {
    let pose = Pose { size: [side; 2], distance: 15.0, off: &["scattering", "specular"] };
    let (image, _) = bust(pose, studio)?;
    let light = |t: &[u8; 4]| [0, 1, 2].map(|c| srgb::decode(f64::from(t[c]) / 255.0));
    Ok(Picture { size: image.size, texels: image.texels.iter().map(light).collect() })
}

/// A picture, and the same with a twentieth of white more.
fn planted() -> Planted {
    let value = 5.0;
    let picture = edge(32);
    let mut moved = picture.clone();
    moved.texels.as_flattened_mut().iter_mut().for_each(|v| *v += value / PERCENT);
    Planted { what: "5 % of white everywhere".into(), value, measured: apart(&moved, &picture)[0] }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::reference::Reference;

    #[test]
    fn the_planted_error_is_measured_as_such() {
        assert!((planted().measured - 5.0).abs() < 1e-9);
    }

    #[test]
    fn more_samples_come_nearer_at_the_profiles_own_scale() {
        let curves = measure(48, &[41, 5], 1, &Reference::new()).expect("they scatter");
        assert_eq!(curves.len(), 2);
        for pair in curves[0].rows.chunks(2) {
            let [few, many] = [0, 1].map(|i| pair[i].error.expect("an error"));
            assert!(many < few, "{}: {few} {many}", pair[0].series);
        }
    }

    #[test]
    fn the_profiles_own_scale_is_that_of_its_moments() {
        let Scattering { strength, falloff, .. } = profile(9);
        assert!((strength[0] - 0.767).abs() < 1e-6 && falloff[0] == 1.0);
        assert!(falloff[1] < 0.3 && falloff[2] < falloff[1]);
    }
}
