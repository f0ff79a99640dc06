//! PP: laying a patch and a discoloration on the maps (Lam 2016, §5.3.2 and §5.4), as [`canvas::job`](crate::canvas::job) defines it.
//!
//! Two steps for each tile, tiles side by side: first (s, d) of every texel, each from the one triangle that has it; then what they
//! do to the texel. What a tile becomes depends on no other tile.

use std::array::from_fn;

use rayon::prelude::*;

use super::journal::Tile;
use super::noise::fbm;
use super::patch::byte;
use crate::canvas::image::Image;
use crate::canvas::job::{PaintJob, Painting};
use crate::render::layout::{Affine, Layout, TILE, corners, lay_out, tile_window, tiles_of};
use crate::render::spans::{PARTS, Window, spans};

/// x of the patch at s = 0, and what it grows by up to c_l.
const ACROSS: [f32; 2] = [0.025, 0.95];

/// What is painted on.
#[derive(Clone, Copy)]
pub(super) struct Ground<'a> {
    /// 1 where a face lies.
    pub mask: &'a [u8],
    pub color: &'a Image,
    pub discolor: &'a Image,
}

/// The tiles that a painting changes, as they are afterwards.
pub(super) fn paint(painting: &Painting, patch: &Image, ground: Ground<'_>) -> Vec<Tile> {
    let size = ground.color.size;
    let layout = lay_out(&painting.paint, size);
    let bins = bins(&layout, size);
    let brush = Brush { job: &painting.paint, patch };
    let tiles = layout.tiles.par_iter().zip(&bins).filter_map(|(index, bin)| {
        let coordinates = Coordinates::of(tile_window(*index, size), &layout, bin, ground.mask, size);
        brush.apply(*index, &coordinates, ground)
    });
    tiles.collect()
}

/// Every texel that a painting uses, with its (s, d).
pub(super) fn used(job: &PaintJob, mask: &[u8], size: [u32; 2]) -> Vec<([u32; 2], [f32; 2])> {
    let layout = lay_out(job, size);
    let bins = bins(&layout, size);
    let tiles = layout.tiles.iter().zip(&bins);
    tiles
        .flat_map(|(index, bin)| Coordinates::of(tile_window(*index, size), &layout, bin, mask, size).used())
        .collect()
}

/// For each tile the triangles whose boxes meet it, in their order.
fn bins(layout: &Layout, size: [u32; 2]) -> Vec<Vec<u32>> {
    let mut bins = vec![Vec::new(); layout.tiles.len()];
    let tiles = tiles_of(size);
    for (k, triangle) in (0u32..).zip(&layout.triangles) {
        let range = |axis: usize| {
            let all = triangle.corners.map(|corner| corner[axis]);
            let [least, most] =
                [f32::min, f32::max].map(|pick| pick(pick(all[0], all[1]), all[2]) / TILE as f32);
            // Casts end at the type's bounds.
            least as u32..=(most as u32).min(tiles[axis] - 1)
        };
        let (rows, columns) = (range(1), range(0));
        for index in rows.flat_map(|y| columns.clone().map(move |x| y * tiles[0] + x)) {
            if let Ok(slot) = layout.tiles.binary_search(&index) {
                bins[slot].push(k);
            }
        }
    }
    bins
}

/// (s, d) of a tile's texels.
struct Coordinates {
    window: Window,
    at: Vec<Option<[f32; 2]>>,
}

impl Coordinates {
    fn of(window: Window, layout: &Layout, bin: &[u32], mask: &[u8], size: [u32; 2]) -> Self {
        let [w, h] = [0, 1].map(|k| window.to[k] - window.from[k]);
        let mut coordinates = Self { window, at: vec![None; (w * h) as usize] };
        for triangle in bin.iter().map(|k| &layout.triangles[*k as usize]) {
            let corners = corners(triangle);
            let affine = Affine::new(corners, triangle.at);
            spans(corners, window, |y, columns| {
                for x in columns {
                    let free = || mask[y as usize * size[0] as usize + x as usize] == 0;
                    if !triangle.skirt || free() {
                        let centre = [x, y].map(|v| i64::from(v) * PARTS + PARTS / 2);
                        coordinates.put([x, y], affine.at(centre).map(|v| v as f32));
                    }
                }
            });
        }
        coordinates
    }

    fn put(&mut self, [x, y]: [u32; 2], at: [f32; 2]) {
        let width = self.window.to[0] - self.window.from[0];
        let index = (y - self.window.from[1]) * width + (x - self.window.from[0]);
        self.at[index as usize] = Some(at);
    }

    fn used(&self) -> Vec<([u32; 2], [f32; 2])> {
        let Window { from, to } = self.window;
        let texels = (from[1]..to[1]).flat_map(|y| (from[0]..to[0]).map(move |x| [x, y]));
        texels.zip(&self.at).filter_map(|(texel, at)| at.map(|at| (texel, at))).collect()
    }
}

/// A patch and a discoloration on their way to the maps.
struct Brush<'a> {
    job: &'a PaintJob,
    patch: &'a Image,
}

impl Brush<'_> {
    /// What a tile becomes; `None` if it stays as it is.
    fn apply(&self, index: u32, coordinates: &Coordinates, ground: Ground<'_>) -> Option<Tile> {
        let before = Tile::read(index, ground.color, ground.discolor);
        let mut tile = before.clone();
        let mut spots = Vec::with_capacity(tile.color.len());
        for (k, at) in coordinates.at.iter().enumerate() {
            let Some(at) = *at else { continue };
            tile.color[k] = self.color(at, tile.color[k]);
            spots.extend(self.spot(k, at));
        }
        spots.chunks(LANES).for_each(|spots| self.discolor(spots, &mut tile.discolor));
        (tile != before).then_some(tile)
    }

    /// The patch over a colour.
    fn color(&self, [s, d]: [f32; 2], under: [u8; 4]) -> [u8; 4] {
        let x = ACROSS[0] + ACROSS[1] * s / self.job.length;
        let y = 0.5 - d / self.job.height;
        let unit = 0.0..=1.0;
        let there = self.patch.size.iter().all(|side| *side > 1);
        if !there || !unit.contains(&x) || !unit.contains(&y) {
            return under;
        }
        let [r, g, b, a] = bilinear(self.patch, [x, y]);
        let under_rgb = [under[0], under[1], under[2]].map(f32::from);
        let over = |k: usize, patch: f32| (patch + (1.0 - a / 255.0) * under_rgb[k] + 0.5) as u8;
        [over(0, r), over(1, g), over(2, b), under[3]]
    }

    /// What the discoloration is at a texel but for its noise; `None` beyond it.
    fn spot(&self, texel: usize, [s, d]: [f32; 2]) -> Option<Spot> {
        let PaintJob { length, height, noise_scale, offset, .. } = *self.job;
        let t = 2.0 * (s / length).clamp(0.0, 1.0) - 1.0;
        let radius = 0.5 * height * (1.0 - 0.5 * t * t);
        let beyond = (-s).max(s - length).max(0.0);
        let distance = (beyond * beyond + d * d).sqrt();
        let most = 1.0 - distance / (2.0 * radius);
        let core = (1.1 - distance / radius).max(0.0);
        let noise_at = [noise_scale * s + offset[0], noise_scale * d + offset[1]];
        // A NaN is not more.
        (most > 0.0).then_some(Spot { texel, noise_at, most, core })
    }

    /// Puts a discoloration where it is stronger than what is there.
    fn discolor(&self, spots: &[Spot], texels: &mut [[u8; 4]]) {
        let at = |k: usize| spots[k.min(spots.len() - 1)].noise_at;
        let noises = fbm(from_fn::<_, LANES, _>(at), &self.job.noise);
        let [r, g, b] = self.job.factor.map(|f| byte(0.5 * f));
        for (spot, noise) in spots.iter().zip(noises) {
            let alpha = byte((noise.max(0.0).min(spot.most) + spot.core).min(1.0));
            let texel = &mut texels[spot.texel];
            if alpha > texel[3] {
                *texel = [r, g, b, alpha];
            }
        }
    }
}

/// Texels whose noise is looked up at once.
const LANES: usize = 8;

/// A texel that is discoloured.
struct Spot {
    /// Its place in the tile.
    texel: usize,
    noise_at: [f32; 2],
    /// What the noise may add to α at most.
    most: f32,
    /// α without it.
    core: f32,
}

/// The patch between its four nearest texels, in 1/255.
#[inline]
fn bilinear(patch: &Image, at: [f32; 2]) -> [f32; 4] {
    let (x, right, tx) = between(at[0], patch.size[0]);
    let (y, below, ty) = between(at[1], patch.size[1]);
    let corners = [(x, y), (right, y), (x, below), (right, below)];
    let [a, b, c, d] = corners.map(|(x, y)| patch.at(x, y).map(f32::from));
    let mix = |a: f32, b: f32, t: f32| a + (b - a) * t;
    let channel = |k: usize| mix(mix(a[k], b[k], tx), mix(c[k], d[k], tx), ty);
    [channel(0), channel(1), channel(2), channel(3)]
}

/// The texels on both sides of a place from 0 to 1 on n texels, and how far it is from the first to the second.
#[inline]
fn between(at: f32, n: u32) -> (u32, u32, f32) {
    let last = n - 1;
    let place = at * last as f32;
    let first = (place as u32).min(last);
    (first, (first + 1).min(last), place - first as f32)
}
