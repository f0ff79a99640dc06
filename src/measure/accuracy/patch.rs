//! GP's patch by octaves and resolution, against the one that they converge to (Lam 2016, §5.3.1).
//!
//! The patch is a picture of a formula over the unit square. **Truth.** The formula with [`CONVERGED`] octaves at the middles of a grid of [`GRID`], made as a patch
//! whose texels stand just there. **Error.** At those places a patch is looked up as it is when it is painted, bilinear between its texels: the root of
//! the mean square of the difference, in levels of 255 (alpha multiplied in); and the largest.
//!
//! The octaves that a scene has by default are a look: against them, error is what more octaves would still change.

use super::Ask;
use super::curve::{Curve, Measure, Planted, Row};
use super::turns::{Task, in_turns, timed};
use crate::canvas::image::Image;
use crate::canvas::job::PatchJob;
use crate::canvas::look::{Fbm, Wound};
use crate::measure::MeasureError;
use crate::render::reference::painter::patch;

/// Octaves after which the next would change less than half a level.
const CONVERGED: u32 = 9;
/// The grid on which patches are compared: four times the largest of [`WIDTHS`].
const GRID: [u32; 2] = [4096, 968];
/// Octaves, and texels along the patch; those of a quick run first.
const OCTAVES: [u32; 5] = [1, 2, 4, 6, 8];
const WIDTHS: [u32; 4] = [128, 256, 512, 1024];
const QUICK: usize = 3;
/// Height of a patch over its width: that of 500 texels in the thesis's Figure 5.4.
const SHAPE: f64 = 121.0 / 512.0;

/// Measures it.
pub fn run(ask: &Ask<'_>) -> Result<Vec<Curve>, MeasureError> {
    let grid = if ask.quick { GRID.map(|side| side / 4) } else { GRID };
    Ok(vec![measure(ask.of(&WIDTHS, QUICK), grid, ask.rounds)?])
}

fn measure(widths: &[u32], grid: [u32; 2], rounds: usize) -> Result<Curve, MeasureError> {
    let truth = patch(&job(CONVERGED, grid));
    let settings = OCTAVES.iter().flat_map(|octaves| widths.iter().map(move |width| (*octaves, *width)));
    let settings: Vec<(u32, PatchJob)> =
        settings.map(|(octaves, width)| (octaves, job(octaves, sized(width)))).collect();
    let errors: Vec<[f64; 2]> = settings.iter().map(|(_, job)| apart(&patch(job), &truth)).collect();
    let task = |job: &PatchJob| -> Task<'static> {
        let job = job.clone();
        Box::new(move || Ok(timed(|| patch(&job)).1))
    };
    let mut tasks: Vec<Task<'_>> = settings.iter().map(|(_, job)| task(job)).collect();
    let timings = in_turns(rounds, &mut tasks)?;
    let rows = settings.iter().zip(timings).zip(&errors).map(|(((octaves, job), timing), [rms, largest])| {
        let setting = format!("{octaves} at {}", job.size[0]);
        Row::new("octaves at texels along the line", setting, timing, Some(*rms), vec![*largest])
    });
    Ok(Curve {
        name: "patch".into(),
        title: "The wound patch by octaves and resolution".into(),
        time_of: "making the patch (the reference)".into(),
        error: Measure::new("RMS difference", "levels of 255"),
        others: vec![Measure::new("largest", "levels")],
        rows: rows.collect(),
        planted: planted(),
    }
    .with_front())
}

fn sized(width: u32) -> [u32; 2] {
    [width, libm::round(f64::from(width) * SHAPE) as u32]
}

fn job(octaves: u32, size: [u32; 2]) -> PatchJob {
    let Wound { inner, dark, light, edge, noise, .. } = Wound::default();
    PatchJob {
        size,
        offset: [17.25, 64.5],
        palette: [inner, dark, light],
        edge,
        noise: Fbm { octaves, ..noise },
    }
}

/// RMS and largest difference of two patches at the texels of the second.
fn apart(found: &Image, truth: &Image) -> [f64; 2] {
    let [width, height] = truth.size;
    let (mut sum, mut largest) = (0.0, 0.0_f64);
    for (y, x) in (0..height).flat_map(|y| (0..width).map(move |x| (y, x))) {
        let part = |i: u32, side: u32| f64::from(i) / f64::from(side.max(2) - 1);
        let looked_up = bilinear(found, [part(x, width), part(y, height)]);
        for (a, b) in looked_up.into_iter().zip(truth.at(x, y)) {
            let off = (a - f64::from(b)).abs();
            sum += off * off;
            largest = largest.max(off);
        }
    }
    [(sum / (4.0 * truth.texels.len() as f64)).sqrt(), largest]
}

/// A patch between its texels, which lie on the border of the unit square and evenly between.
fn bilinear(image: &Image, at: [f64; 2]) -> [f64; 4] {
    let place = |k: usize| {
        let along = at[k] * f64::from(image.size[k] - 1);
        let first = (along as u32).min(image.size[k].saturating_sub(2));
        (first, along - f64::from(first))
    };
    let ((x, fx), (y, fy)) = (place(0), place(1));
    let texel = |dx: u32, dy: u32| image.at(x + dx, y + dy).map(f64::from);
    let [a, b, c, d] = [texel(0, 0), texel(1, 0), texel(0, 1), texel(1, 1)];
    [0, 1, 2, 3].map(|i| {
        let (above, below) = (a[i] + fx * (b[i] - a[i]), c[i] + fx * (d[i] - c[i]));
        above + fy * (below - above)
    })
}

/// A patch, and the same with every channel three levels off.
fn planted() -> Planted {
    let value = 3.0;
    let image = patch(&job(2, sized(64)));
    let mut moved = image.clone();
    let off = |v: u8| if v < 128 { v + value as u8 } else { v - value as u8 };
    moved.texels.iter_mut().for_each(|texel| *texel = texel.map(off));
    Planted { what: "every channel 3 levels off".into(), value, measured: apart(&moved, &image)[0] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_planted_error_is_measured_as_such() {
        assert!((planted().measured - 3.0).abs() < 1e-9);
    }

    #[test]
    fn more_octaves_and_more_texels_come_nearer() {
        let curve = measure(&[64, 256], [512, 121], 1).expect("they are made");
        let error = |setting: &str| {
            curve.rows.iter().find(|row| row.setting == setting).and_then(|row| row.error).expect("a row")
        };
        assert!(error("4 at 256") < error("1 at 256") && error("8 at 256") < error("8 at 64"));
    }
}
