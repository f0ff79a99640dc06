//! How far a picture is from another, by four measures, because no single one tells noise from a defect.
//!
//! - **tile**: the mean absolute difference in the worst 16 × 16 tile, in its worst channel: a hole or a crack, wherever it is;
//! - **outliers**: how many pixels are off by more than 8 in any channel: what is small and wrong at once. Noise has none;
//! - **tone**: the mean signed difference over the skin, in the worst channel: noise cancels out, a wrong constant does not. Of a few pixels
//!   it would be noise again, so there the sum is divided by more than there are;
//! - **displacement**: by how many pixels the golden has to be moved to come nearest, across or down, by one step of least squares (Lucas and Kanade
//!   1981): −Σ (b − a) ∂a / Σ (∂a)², a the golden's grey values and ∂a their central differences. Noise has no direction and cancels out, so
//!   this tells a picture that is off by a pixel even where it is smooth, and a shifted one differs by no more than noise does;
//! - **structure**: 1 − the hybrid score of image-compare (structural similarity of the luma in 8 × 8 windows, and the chroma's RMS).
//!   It tells a picture that is blurred or warped as a whole.
//!
//! The hybrid score rather than the MSSIM: both hardly see a hole or a crack (1e-4), but harmless noise of ±2 costs the hybrid a
//! quarter of what it costs the MSSIM, and a tone shift costs it ten times as much. So its gate can be narrower.
//!
//! All but structure take one sweep; structure takes ten times as long, and is left for last.

use std::fmt;

use image_compare::prelude::RgbImage;
use image_compare::rgb_hybrid_compare;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::skin::Skin;
use crate::canvas::image::Image;

/// Pixels along a tile.
const TILE: u32 = 16;
/// Pixels of skin that have a tone: a hole's worth.
const TONED: u32 = 144;
/// Steepness, in squares of doubled differences of three channels, below which a picture is too flat to say where it is: some three hundred
/// pixels with a slope of one.
const FLAT: f64 = 1e4;
/// A pixel that is off by more than this in a channel is an outlier.
const OUTLYING: u8 = 8;

/// One of the measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Metric {
    /// The worst tile's mean absolute difference.
    Tile,
    /// Pixels that are off by more than 8.
    Outliers,
    /// The mean signed difference over the skin.
    Tone,
    /// By how many pixels it is moved.
    Displacement,
    /// 1 − the hybrid score.
    Structure,
}

impl Metric {
    /// All, the cheap ones first.
    pub const ALL: [Self; 5] = [Self::Tile, Self::Outliers, Self::Tone, Self::Displacement, Self::Structure];
}

impl fmt::Display for Metric {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Tile => "tile",
            Self::Outliers => "outliers",
            Self::Tone => "tone",
            Self::Displacement => "displacement",
            Self::Structure => "structure",
        })
    }
}

/// How far two pictures of one size are apart; or how far they may be.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Distance {
    /// The mean absolute difference in the worst tile, 0 to 255.
    pub tile: f64,
    /// How many pixels are off by more than 8 in any channel.
    pub outliers: u32,
    /// The mean signed difference over the skin in the worst channel, without its sign.
    pub tone: f64,
    /// By how many pixels it is moved, across or down.
    pub displacement: f64,
    /// 1 − the hybrid score, 0 to 1.
    pub structure: f64,
}

impl Distance {
    /// One of the measures.
    pub fn get(&self, metric: Metric) -> f64 {
        match metric {
            Metric::Tile => self.tile,
            Metric::Outliers => f64::from(self.outliers),
            Metric::Tone => self.tone,
            Metric::Displacement => self.displacement,
            Metric::Structure => self.structure,
        }
    }

    /// The larger of each measure.
    #[must_use]
    pub fn max(&self, other: &Self) -> Self {
        Self {
            tile: self.tile.max(other.tile),
            outliers: self.outliers.max(other.outliers),
            tone: self.tone.max(other.tone),
            displacement: self.displacement.max(other.displacement),
            structure: self.structure.max(other.structure),
        }
    }

    /// The first measure in which this is more than another allows. A NaN is not allowed by anything.
    pub fn beyond(&self, gate: &Self) -> Option<Metric> {
        let within = |metric: &Metric| self.get(*metric) <= gate.get(*metric);
        Metric::ALL.into_iter().find(|metric| !within(metric))
    }
}

impl fmt::Display for Distance {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { tile, outliers, tone, displacement, structure } = self;
        write!(f, "tile {tile:.3}, outliers {outliers}, tone {tone:.3}, ")?;
        write!(f, "displacement {displacement:.4}, structure {structure:.5}")
    }
}

/// A distance, and where the worst of it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Measured {
    pub(crate) distance: Distance,
    /// The worst tile's top left pixel.
    pub(crate) worst_tile: [u32; 2],
}

/// Measures a picture of the golden's size.
pub(crate) fn measure(golden: &Image, found: &Image, skin: &Skin) -> Measured {
    let mut measured = sweep(golden, found, skin);
    measured.distance.structure = structure(golden, found);
    measured
}

/// The first measure by which a picture is farther from the golden than a gate allows; the cheap ones decide first.
pub(super) fn first_beyond(golden: &Image, found: &Image, skin: &Skin, gate: &Distance) -> Option<Metric> {
    let cheap = sweep(golden, found, skin).distance.beyond(gate);
    cheap.or_else(|| {
        let structure = structure(golden, found);
        Distance { structure, ..Distance::default() }.beyond(gate)
    })
}

/// All measures but structure.
pub(super) fn sweep(golden: &Image, found: &Image, skin: &Skin) -> Measured {
    let mut sums = Sums::new(golden.size);
    let width = golden.size[0].max(1) as usize;
    for (at, (a, b)) in golden.texels.iter().zip(&found.texels).enumerate() {
        if a != b {
            let place = [at % width, at / width];
            sums.add(place, *a, *b, skin.holds(*a));
            sums.lean(slope(golden, place), *a, *b);
        }
    }
    sums.measured(golden, skin)
}

struct Sums {
    columns: usize,
    /// By tile, row by row, and channel: the sum of absolute differences.
    tiles: Vec<[u32; 4]>,
    outliers: u32,
    /// By channel: the sum of signed differences over the skin.
    tone: [i64; 3],
    /// Across and down: the sum of differences times the golden's slope.
    along: [i64; 2],
}

impl Sums {
    fn new(size: [u32; 2]) -> Self {
        let [columns, rows] = size.map(|side| side.div_ceil(TILE) as usize);
        Self { columns, tiles: vec![[0; 4]; columns * rows], outliers: 0, tone: [0; 3], along: [0; 2] }
    }

    fn add(&mut self, [x, y]: [usize; 2], a: [u8; 4], b: [u8; 4], skin: bool) {
        let tile = &mut self.tiles[y / TILE as usize * self.columns + x / TILE as usize];
        let mut worst = 0;
        for channel in 0..4 {
            let off = a[channel].abs_diff(b[channel]);
            tile[channel] += u32::from(off);
            worst = worst.max(off);
        }
        self.outliers += u32::from(worst > OUTLYING);
        if skin {
            (0..3).for_each(|c| self.tone[c] += i64::from(b[c]) - i64::from(a[c]));
        }
    }

    fn lean(&mut self, slope: [i64; 2], a: [u8; 4], b: [u8; 4]) {
        let difference = grey(b) - grey(a);
        (0..2).for_each(|axis| self.along[axis] += difference * slope[axis]);
    }

    fn measured(&self, golden: &Image, skin: &Skin) -> Measured {
        let (tile, worst_tile) = self.worst_tile(golden.size);
        let shift = self.tone.iter().map(|sum| sum.unsigned_abs()).max().unwrap_or(0);
        let tone = shift as f64 / f64::from(skin.pixels.max(TONED));
        let moved = |axis: usize| 2.0 * self.along[axis].abs() as f64 / (skin.steepness[axis] as f64 + FLAT);
        let displacement = moved(0).max(moved(1));
        let distance = Distance { tile, outliers: self.outliers, tone, displacement, structure: 0.0 };
        Measured { distance, worst_tile }
    }

    /// The mean of the worst tile, and where it begins. Tiles at the border may be smaller.
    fn worst_tile(&self, size: [u32; 2]) -> (f64, [u32; 2]) {
        let mut worst = (0.0, [0; 2]);
        for (at, tile) in self.tiles.iter().enumerate() {
            let corner = [at % self.columns, at / self.columns].map(|along| along as u32 * TILE);
            let area = (size[0] - corner[0]).min(TILE) * (size[1] - corner[1]).min(TILE);
            let mean = f64::from(tile.iter().copied().max().unwrap_or(0)) / f64::from(area);
            if mean > worst.0 {
                worst = (mean, corner);
            }
        }
        worst
    }
}

fn grey([r, g, b, _]: [u8; 4]) -> i64 {
    i64::from(r) + i64::from(g) + i64::from(b)
}

/// Twice the slope of the grey values at a pixel, across and down; none at the border.
pub(super) fn slope(image: &Image, [x, y]: [usize; 2]) -> [i64; 2] {
    let [width, height] = image.size.map(|side| side as usize);
    let at = |x: usize, y: usize| grey(image.texels[y * width + x]);
    let inside = |along: usize, side: usize| along > 0 && along + 1 < side;
    [
        if inside(x, width) { at(x + 1, y) - at(x - 1, y) } else { 0 },
        if inside(y, height) { at(x, y + 1) - at(x, y - 1) } else { 0 },
    ]
}

pub(super) fn structure(golden: &Image, found: &Image) -> f64 {
    let score = rgb(golden).zip(rgb(found)).and_then(|(a, b)| rgb_hybrid_compare(&a, &b).ok());
    score.map_or(1.0, |similarity| (1.0 - similarity.score).clamp(0.0, 1.0))
}

/// None where there is no pixel.
fn rgb(image: &Image) -> Option<RgbImage> {
    let [width, height] = image.size;
    let bytes = image.texels.iter().flat_map(|[r, g, b, _]| [*r, *g, *b]).collect();
    RgbImage::from_raw(width, height, bytes).filter(|_| width > 0 && height > 0)
}
