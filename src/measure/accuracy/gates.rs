//! What a comparison of pictures costs, and the smallest defect that it catches.
//!
//! A frame of the bust is its own golden. Defects of every size are planted in it, the smallest first: a hole (pixels along its side), a crack (its
//! length), a tone shift (levels) and a shift to the right (parts of a pixel). **What stands against time** is the smallest that one measure alone,
//! or several together, catch by the gate of all known adapters, as a share of the defect that every golden has to catch. One that lets all pass
//! catches it `never`.
//!
//! The time is that of looking at a picture in which one pixel in eight is a level off, as a device's picture may be: nothing is beyond, so all that
//! is to be done is done. Tile, outliers, tone and displacement come of one sweep, and cost the same alone.

use super::Ask;
use super::curve::{Curve, Measure, Planted, Row};
use super::frames::{Pose, bust};
use super::turns::{Task, Timing, in_turns, timed};
use crate::canvas::image::Image;
use crate::measure::{MeasureError, Random};
use crate::verify::{Defect, Distance, Metric, Probe};

/// What is looked at.
const RULES: [(&str, &[Metric]); 7] = [
    ("tile", &[Metric::Tile]),
    ("outliers", &[Metric::Outliers]),
    ("tone", &[Metric::Tone]),
    ("displacement", &[Metric::Displacement]),
    ("structure", &[Metric::Structure]),
    ("all of the sweep", &[Metric::Tile, Metric::Outliers, Metric::Tone, Metric::Displacement]),
    ("all", &Metric::ALL),
];
const DEFECTS: [(Defect, &str); 4] = [
    (Defect::Hole, "hole"),
    (Defect::Crack, "crack"),
    (Defect::Tone, "tone shift"),
    (Defect::Shift, "shift"),
];
/// The frame, and that of a quick run.
const SIZE: [u32; 2] = [640, 360];
const QUICK: [u32; 2] = [320, 180];

/// Measures it.
pub fn run(ask: &Ask<'_>) -> Result<Vec<Curve>, MeasureError> {
    let size = if ask.quick { QUICK } else { SIZE };
    let (golden, background) = bust(Pose { size, distance: 42.0, off: &[] }, ask.studio)?;
    let gates = Probe::gates(ask.recordings).map_err(MeasureError::Rejected)?;
    Ok(vec![measure(&Probe::new(golden, background, &gates), ask.rounds)?])
}

fn measure(probe: &Probe, rounds: usize) -> Result<Curve, MeasureError> {
    let noisy = noisy(probe.golden());
    let task = |by: &'static [Metric]| -> Task<'_> {
        let noisy = &noisy;
        Box::new(move || Ok(timed(|| probe.caught(noisy, by)).1))
    };
    let mut tasks: Vec<Task<'_>> = RULES.iter().map(|(_, by)| task(by)).collect();
    let timings = in_turns(rounds, &mut tasks)?;
    let mut rows = Vec::new();
    for (defect, name) in DEFECTS {
        let sizes = sizes(probe, defect);
        let row = |((setting, by), timing): (&(&str, &[Metric]), &Timing)| {
            Row::new(name, *setting, *timing, smallest(probe, &sizes, by), Vec::new())
        };
        rows.extend(RULES.iter().zip(&timings).map(row));
    }
    let [width, height] = probe.golden().size;
    Ok(Curve {
        name: "gates".into(),
        title: "The smallest defect of a picture that its gates catch".into(),
        time_of: format!("comparing {width} x {height} pixels"),
        error: Measure::new("smallest defect caught", "shares of the usual one"),
        others: Vec::new(),
        rows,
        planted: planted(probe),
    }
    .with_front())
}

/// Pictures with a defect, the smallest first; each with its size as a share of the usual one.
fn sizes(probe: &Probe, defect: Defect) -> Vec<(f64, Image)> {
    let usual = probe.usual(defect);
    let sizes: Vec<f64> = match defect {
        Defect::Shift => (1..=20).map(|i| 0.05 * f64::from(i)).collect(),
        _ => (1..=2 * usual as u32).map(f64::from).collect(),
    };
    sizes.into_iter().filter_map(|size| Some((size / usual, probe.planted(defect, size)?))).collect()
}

/// The smallest of some defects that is caught.
fn smallest(probe: &Probe, pictures: &[(f64, Image)], by: &[Metric]) -> Option<f64> {
    pictures.iter().find(|(_, picture)| probe.caught(picture, by).is_some()).map(|(share, _)| *share)
}

/// One pixel in eight, drawn by lot, a level off, up or down.
fn noisy(image: &Image) -> Image {
    let (mut noisy, mut random) = (image.clone(), Random::of(0, 0, "noise"));
    for texel in &mut noisy.texels {
        if random.once_in(8) {
            let up = random.once_in(2);
            let off = |v: u8| if up { v.saturating_add(1) } else { v.saturating_sub(1) };
            (0..3).for_each(|c| texel[c] = off(texel[c]));
        }
    }
    noisy
}

/// A gate of 24 outliers: the smallest hole that it catches has 5 x 5 pixels.
fn planted(probe: &Probe) -> Planted {
    let any = f64::INFINITY;
    let most = Distance { tile: any, outliers: 24, tone: any, displacement: any, structure: any };
    let probe = probe.clone().with_gate(most);
    let usual = probe.usual(Defect::Hole);
    let measured = smallest(&probe, &sizes(&probe, Defect::Hole), &[Metric::Outliers]);
    let what = "a gate of 24 outliers, and holes".into();
    Planted { what, value: 5.0 / usual, measured: measured.unwrap_or(f64::NAN) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verify::GatesFile;

    /// The gate of no known adapter: for tests.
    fn probe() -> Probe {
        let gradient = |i: u32| [120 + (i % 96) as u8, 90 + (i / 96 % 96) as u8, 100, 255];
        let golden = Image { size: [96, 96], texels: (0..96 * 96).map(gradient).collect() };
        Probe::new(golden, [1, 2, 3, 255], &GatesFile::default())
    }

    #[test]
    fn the_planted_defect_is_the_smallest_that_is_caught() {
        let planted = planted(&probe());
        assert_eq!(planted.measured, planted.value, "{planted:?}");
    }

    #[test]
    fn together_they_catch_what_each_of_them_does() {
        let probe = probe();
        let curve = measure(&probe, 1).expect("they are compared");
        for rows in curve.rows.chunks(RULES.len()) {
            let caught = |i: usize| rows[i].error.unwrap_or(f64::INFINITY);
            let best = (0..5).map(caught).fold(f64::INFINITY, f64::min);
            assert_eq!(caught(6), best, "{}", rows[0].series);
            assert!(caught(6) <= 1.0, "{}: what every golden has to catch", rows[0].series);
        }
        // On an even picture like this one structure sees any noise.
        assert_eq!(probe.caught(&noisy(probe.golden()), &Metric::ALL[..4]), None);
    }
}
