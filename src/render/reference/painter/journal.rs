//! What maps were before each painting, so that it can be taken back: the tiles that it changed, newest first, within a budget of bytes.
//!
//! The oldest are dropped when there is no more room; the newest is kept whatever it takes, for the checks look at it.

use std::collections::VecDeque;

use crate::canvas::image::Image;
use crate::render::layout::tile_window;

/// Bytes that saved tiles may take.
pub(super) const BUDGET: usize = 64 << 20;

/// A tile of the two maps that are painted on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Tile {
    pub index: u32,
    pub color: Vec<[u8; 4]>,
    pub discolor: Vec<[u8; 4]>,
}

impl Tile {
    /// A tile as it is.
    pub(super) fn read(index: u32, color: &Image, discolor: &Image) -> Self {
        let read = |map: &Image| {
            let rows: Vec<&[[u8; 4]]> = rows(index, map.size).map(|row| &map.texels[row]).collect();
            rows.concat()
        };
        Self { index, color: read(color), discolor: read(discolor) }
    }

    /// Puts the tile in place, and keeps what was there.
    pub(super) fn swap(&mut self, color: &mut Image, discolor: &mut Image) {
        for (map, texels) in [(color, &mut self.color), (discolor, &mut self.discolor)] {
            let mut rest = texels.as_mut_slice();
            for row in rows(self.index, map.size) {
                let (first, after) = rest.split_at_mut(row.len());
                map.texels[row].swap_with_slice(first);
                rest = after;
            }
        }
    }

    /// The texels that differ from what is there now.
    pub(super) fn differing(&self, color: &Image, discolor: &Image) -> Vec<[u32; 2]> {
        let now = Self::read(self.index, color, discolor);
        let window = tile_window(self.index, color.size);
        let width = (window.to[0] - window.from[0]) as usize;
        let differs = |k: &usize| self.color[*k] != now.color[*k] || self.discolor[*k] != now.discolor[*k];
        let place = |k: usize| [window.from[0] + (k % width) as u32, window.from[1] + (k / width) as u32];
        (0..self.color.len()).filter(differs).map(place).collect()
    }

    fn bytes(&self) -> usize {
        size_of::<Self>() + (self.color.capacity() + self.discolor.capacity()) * size_of::<[u8; 4]>()
    }
}

/// Where a tile's rows lie in a map.
fn rows(index: u32, size: [u32; 2]) -> impl Iterator<Item = std::ops::Range<usize>> {
    let window = tile_window(index, size);
    let at = move |x: u32, y: u32| y as usize * size[0] as usize + x as usize;
    (window.from[1]..window.to[1]).map(move |y| at(window.from[0], y)..at(window.to[0], y))
}

/// The paintings that can be taken back.
#[derive(Debug)]
pub(super) struct Journal {
    entries: VecDeque<Vec<Tile>>,
    bytes: usize,
    budget: usize,
}

impl Journal {
    pub(super) fn new(budget: usize) -> Self {
        Self { entries: VecDeque::new(), bytes: 0, budget }
    }

    /// How many paintings can be taken back.
    pub(super) fn len(&self) -> usize {
        self.entries.len()
    }

    /// Keeps what the tiles were that a painting changed.
    pub(super) fn push(&mut self, tiles: Vec<Tile>) {
        self.bytes += bytes(&tiles);
        self.entries.push_back(tiles);
        while self.bytes > self.budget && self.entries.len() > 1 {
            self.bytes -= self.entries.pop_front().as_deref().map_or(0, bytes);
        }
    }

    /// Hands the newest out.
    pub(super) fn pop(&mut self) -> Option<Vec<Tile>> {
        let tiles = self.entries.pop_back()?;
        self.bytes -= bytes(&tiles);
        Some(tiles)
    }

    /// The newest.
    pub(super) fn last(&self) -> Option<&[Tile]> {
        self.entries.back().map(Vec::as_slice)
    }

    pub(super) fn clear(&mut self) {
        *self = Self::new(self.budget);
    }
}

fn bytes(tiles: &[Tile]) -> usize {
    tiles.iter().map(Tile::bytes).sum()
}
