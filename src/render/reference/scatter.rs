//! Separable scattering: two passes over the diffuse light, across, then down (Jimenez et al. 2012; Lam 2016, B.2.1.2 and §5.4).
//!
//! A pixel's kernel is as wide as the surface is near there, and as its scattering strength a says. Samples are bilinear in colour, and
//! mixed towards the pixel's own colour as far as their depth differs. In the second pass the discoloration dims the centre's weight; the
//! thesis does so in both, where it compounds.
//!
//! Light in `across` and `diffuse` has a beside it, which no pass changes.

use rayon::prelude::*;

use super::layers::{Layers, TILE, Tile};
use super::lens::Lens;
use crate::canvas::look::Scattering;
use crate::render::{kernel, sat};

/// What both passes know.
pub(crate) struct Scatter {
    /// Offsets as a part of the width, and weights; nothing of a.
    taps: Vec<(f32, [f32; 4])>,
    /// The look's width on the surface, model units.
    width: f32,
    /// Pixels in a model unit at depth 1.
    focal: f32,
    size: [usize; 2],
    /// Every tile is worked through.
    everything: bool,
}

/// What a pass reads.
#[derive(Clone, Copy)]
struct Source<'a> {
    light: &'a [[f32; 4]],
    depth: &'a [f32],
    discolor: &'a [[f32; 4]],
}

impl Scatter {
    /// For a frame.
    pub(crate) fn new(scattering: &Scattering, unit_cm: f64, lens: &Lens, everything: bool) -> Self {
        let taps = kernel::kernel(scattering).into_iter();
        Self {
            taps: taps.map(|tap| (tap.offset, [tap.weight[0], tap.weight[1], tap.weight[2], 0.0])).collect(),
            width: (f64::from(scattering.width_cm) / unit_cm) as f32,
            focal: lens.focal as f32,
            size: lens.size.map(|side| side as usize),
            everything,
        }
    }

    /// Both passes, over the diffuse light.
    pub(crate) fn run(&self, layers: &mut Layers) {
        let Layers { diffuse, across, depth, discolor, tiles, .. } = layers;
        self.pass::<false>(Source { light: diffuse, depth, discolor }, across, tiles);
        self.pass::<true>(Source { light: across, depth, discolor }, diffuse, tiles);
    }

    /// The pass across, or the one down.
    fn pass<const DOWN: bool>(&self, source: Source<'_>, out: &mut [[f32; 4]], tiles: &[Tile]) {
        let width = self.size[0];
        // At least one, to cut slices by.
        let (band, across) = ((width * TILE).max(1), width.div_ceil(TILE).max(1));
        out.par_chunks_mut(band).zip(tiles.par_chunks(across)).enumerate().for_each(
            |(band, (out, tiles))| {
                for (i, row) in out.chunks_exact_mut(width).enumerate() {
                    let y = band * TILE + i;
                    for (i, (out, tile)) in row.chunks_mut(TILE).zip(tiles).enumerate() {
                        self.part::<DOWN>(source, [i * TILE, y], *tile, out);
                    }
                }
            },
        );
    }

    /// A row of a tile.
    fn part<const DOWN: bool>(
        &self,
        source: Source<'_>,
        [x, y]: [usize; 2],
        tile: Tile,
        out: &mut [[f32; 4]],
    ) {
        if self.everything || (DOWN && tile.discolored) {
            (x..).zip(out).for_each(|(x, out)| *out = self.pixel::<DOWN, DOWN>(source, x, y));
        } else if tile.scatters {
            (x..).zip(out).for_each(|(x, out)| *out = self.pixel::<DOWN, false>(source, x, y));
        } else {
            out.copy_from_slice(&source.light[y * self.size[0] + x..][..out.len()]);
        }
    }

    /// The light at a pixel after a pass; `LOCAL` minds the discoloration.
    #[inline]
    fn pixel<const DOWN: bool, const LOCAL: bool>(&self, source: Source<'_>, x: usize, y: usize) -> [f32; 4] {
        let [width, height] = self.size;
        let at = y * width + x;
        let (own, depth) = (source.light[at], source.depth[at]);
        if own[3] == 0.0 {
            return own;
        }
        // Along the pass: the pixel's place, the last one, the first one's index, and how far apart they lie.
        let (place, last, start, stride) =
            if DOWN { (y, height - 1, x, width) } else { (x, width - 1, y * width, 1) };
        // Bounded, so that its product with the centre's offset is 0.
        let step = (own[3] * self.width * self.focal / depth).min(1e9);
        let centre = if LOCAL { self.centre(own, source.discolor[at]) } else { own };
        let mut sum = [0.0, 0.0, 0.0, own[3]];
        for (i, (offset, weight)) in self.taps.iter().enumerate() {
            if i == self.taps.len() / 2 {
                sum = add(sum, *weight, centre);
                continue;
            }
            let tap = (place as f32 + offset * step).clamp(0.0, last as f32);
            let (first, nearest) = (tap as usize, (tap + 0.5) as usize);
            let (a, b) =
                (source.light[start + first * stride], source.light[start + (first + 1).min(last) * stride]);
            let apart = sat((depth - source.depth[start + nearest * stride]).abs() / self.width);
            sum = add(sum, *weight, mix(mix(a, b, tap - first as f32), own, apart));
        }
        sum
    }

    /// The centre's light, dimmed by the discoloration: times 1 + α(2 c − 1).
    fn centre(&self, own: [f32; 4], [r, g, b, alpha]: [f32; 4]) -> [f32; 4] {
        let kept = |c: f32| 1.0 + alpha * (2.0 * c - 1.0);
        [own[0] * kept(r), own[1] * kept(g), own[2] * kept(b), own[3]]
    }
}

#[inline]
fn mix(a: [f32; 4], b: [f32; 4], part: f32) -> [f32; 4] {
    std::array::from_fn(|c| a[c] + part * (b[c] - a[c]))
}

#[inline]
fn add(sum: [f32; 4], weight: [f32; 4], light: [f32; 4]) -> [f32; 4] {
    std::array::from_fn(|c| sum[c] + weight[c] * light[c])
}
