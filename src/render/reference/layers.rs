//! What the passes hand on to each other, pixel by pixel; kept from frame to frame.

use super::raster::BAND;

/// The side of a tile: what a pass works through or leaves alone.
pub(crate) const TILE: usize = BAND;

/// A pixel at which no triangle is seen.
pub(crate) const NOTHING: u32 = u32::MAX;

/// What is in a tile.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Tile {
    /// Any surface.
    pub(crate) surface: bool,
    /// Skin in which light scatters.
    pub(crate) scatters: bool,
    /// Such skin that is discoloured.
    pub(crate) discolored: bool,
}

/// The layers of a frame, row by row.
#[derive(Clone, Debug, Default)]
pub(crate) struct Layers {
    /// Width and height.
    pub(crate) size: [usize; 2],
    /// The triangle that is seen, and 1/Z.
    pub(crate) visible: Vec<(u32, f32)>,
    /// Diffuse light, and the scattering strength a.
    pub(crate) diffuse: Vec<[f32; 4]>,
    /// The same, scattered across.
    pub(crate) across: Vec<[f32; 4]>,
    /// Specular light.
    pub(crate) specular: Vec<[f32; 3]>,
    /// Depth along forward; infinite where nothing is seen.
    pub(crate) depth: Vec<f32>,
    /// c and α of the discoloration.
    pub(crate) discolor: Vec<[f32; 4]>,
    /// The tiles, row by row.
    pub(crate) tiles: Vec<Tile>,
}

impl Layers {
    /// Makes them those of a picture of this size.
    pub(crate) fn resize(&mut self, size: [u32; 2]) {
        let size = size.map(|side| side as usize);
        if self.size == size {
            return;
        }
        let pixels = size[0] * size[1];
        *self = Self {
            size,
            visible: vec![(NOTHING, 0.0); pixels],
            diffuse: vec![[0.0; 4]; pixels],
            across: vec![[0.0; 4]; pixels],
            specular: vec![[0.0; 3]; pixels],
            depth: vec![f32::INFINITY; pixels],
            discolor: vec![[0.0; 4]; pixels],
            tiles: vec![Tile::default(); size[0].div_ceil(TILE) * size[1].div_ceil(TILE)],
        };
    }

    /// How many pixels a band has; at least one, to cut slices by.
    pub(crate) fn band(&self) -> usize {
        (self.size[0] * BAND).max(1)
    }

    /// How many tiles lie side by side; at least one, to cut slices by.
    pub(crate) fn tiles_across(&self) -> usize {
        self.size[0].div_ceil(TILE).max(1)
    }
}
