//! GP: the wound patch (Lam 2016, §5.3.1), as [`canvas::job`](crate::canvas::job) defines it.
//!
//! What depends on x alone is worked out once for each column: how far the layers reach, and the colours at their edges, which the
//! fades take up. Rows are made side by side, a few columns at once.

use std::array::from_fn;

use rayon::prelude::*;

use super::noise::{fbm, perlin};
use crate::canvas::image::Image;
use crate::canvas::job::PatchJob;

/// Over which distance the layers fade.
const FADE: f32 = 0.05;

/// The inner layer ends so far from the middle.
const INNER_HALF: f32 = 0.475;

type Color = [f32; 3];

/// Makes a patch.
pub fn patch(job: &PatchJob) -> Image {
    let [w, h] = job.size;
    let columns: Vec<Column> = (0..w).map(|i| Column::new(job, place(i, w))).collect();
    let mut image = Image::filled(job.size, [0; 4]);
    image
        .texels
        .par_chunks_mut((w as usize).max(1))
        .zip(0u32..h)
        .for_each(|(texels, j)| row(job, &columns, j, texels));
    image
}

/// Columns whose noise is looked up at once.
const LANES: usize = 8;

/// Makes a row.
fn row(job: &PatchJob, columns: &[Column], j: u32, texels: &mut [[u8; 4]]) {
    let y = place(j, job.size[1]);
    let distance = (y - 0.5).abs();
    for (texels, columns) in texels.chunks_mut(LANES).zip(columns.chunks(LANES)) {
        let seen = columns.iter().any(|column| distance < column.outer);
        let at = |k: usize| [columns[k.min(columns.len() - 1)].x, y];
        let outer = if seen { outer(job, from_fn::<_, LANES, _>(at)) } else { [[0.0; 3]; LANES] };
        for ((texel, column), outer) in texels.iter_mut().zip(columns).zip(outer) {
            *texel = bytes(column.color(job.palette[0], y, outer));
        }
    }
}

/// A colour with the alpha multiplied in.
fn bytes((color, alpha): (Color, f32)) -> [u8; 4] {
    let [r, g, b] = color.map(|c| byte(c * alpha));
    [r, g, b, byte(alpha)]
}

/// Where the k-th of n texels stands.
fn place(k: u32, n: u32) -> f32 {
    k as f32 / (n as f32 - 1.0)
}

/// The nearest of 0 … 255.
#[inline]
pub(super) fn byte(unit: f32) -> u8 {
    // The cast keeps to the type's bounds, and a NaN is 0.
    (unit * 255.0 + 0.5) as u8
}

fn mix(a: Color, b: Color, t: f32) -> Color {
    [0, 1, 2].map(|k| a[k] + (b[k] - a[k]) * t)
}

/// c: the outer layer's colour at some places.
fn outer<const N: usize>(job: &PatchJob, at: [[f32; 2]; N]) -> [Color; N] {
    let noises = fbm(at.map(|[x, y]| [x + job.offset[0], y + job.offset[1]]), &job.noise);
    noises.map(|noise| mix(job.palette[1], job.palette[2], (0.5 + noise).clamp(0.0, 1.0)))
}

/// A column of the patch.
struct Column {
    x: f32,
    /// How far the inner layer reaches, and to where it fades; nothing beyond its ends.
    inner: Option<[f32; 2]>,
    /// How far the outer one does.
    outer: f32,
    /// The colours where the inner layer has faded, above and below.
    inner_edge: [Color; 2],
    /// And where the outer one begins to.
    outer_edge: [Color; 2],
}

impl Column {
    fn new(job: &PatchJob, x: f32) -> Self {
        let across = 2.0 * x - 1.0;
        let square = across * across;
        let [frequency, height] = job.edge;
        let noise = perlin([(x + job.offset[0]) * frequency, 0.5]);
        let range = (height * noise).max(0.05) * (0.45 - 0.5 * square);
        let faded = (range + FADE) * (1.0 - square);
        let reach = 0.25 - 0.3 * (square * square);
        let edges = [0.5 - faded, 0.5 + faded, 0.5 - reach, 0.5 + reach];
        let [inner_above, inner_below, above, below] = outer(job, edges.map(|y| [x, y]));
        Self {
            x,
            inner: ((x - 0.5).abs() < INNER_HALF).then_some([range, faded]),
            outer: reach,
            inner_edge: [inner_above, inner_below],
            outer_edge: [above, below],
        }
    }

    /// The colour at a height, and its alpha; `outer` is the outer layer's there.
    fn color(&self, inner: Color, y: f32, outer: Color) -> (Color, f32) {
        let distance = (y - 0.5).abs();
        let side = usize::from(y > 0.5);
        if let Some([range, faded]) = self.inner {
            if distance < range {
                return (inner, 1.0);
            }
            if distance < faded {
                let t = (distance - range) / (faded - range);
                return (mix(inner, self.inner_edge[side], t), 1.0);
            }
        }
        if distance < self.outer {
            return (outer, 1.0);
        }
        if distance < self.outer + FADE {
            return (self.outer_edge[side], 1.0 - (distance - self.outer) / FADE);
        }
        ([0.0; 3], 0.0)
    }
}
