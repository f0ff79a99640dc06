//! The journal of the device: what each painting painted over, so that it can be taken back bit for bit.
//!
//! A map is cut into tiles of 64². Before a painting the tiles that it may change are copied from both maps into a buffer; putting them
//! back, last painting first, restores the maps. Tiles that lie side by side are copied as one [`Run`], and only so many tiles as are
//! painted at a time share a buffer. Buffers beyond the budget are dropped, oldest first, but never the newest one, which the checks look at:
//! what is older can then only be reached from the scene's own maps.

use std::sync::Arc;

use wgpu::BufferUsages;

use super::maps::Pair;
use crate::canvas::RenderError;
use crate::canvas::job::Painting;
use crate::render::gpu::device::Device;
use crate::render::gpu::readback::Region;
use crate::render::layout::{TILE, tile_window};

/// Tiles side by side on the target that triangles are drawn into.
pub(super) const ACROSS: u32 = 32;

/// Bytes of a texel.
const TEXEL: u32 = 4;

/// Tiles side by side, on the map and on the target.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Run {
    /// Its first texel on the map.
    pub(super) origin: [u32; 2],
    /// Its width and height in texels.
    pub(super) size: [u32; 2],
    /// Its first texel on the target.
    pub(super) target: [u32; 2],
    /// Where the colour map's texels are saved, bytes; the discolour map's follow.
    pub(super) at: u64,
}

impl Run {
    /// It, as a region of either map.
    pub(super) fn region(&self) -> Region {
        Region { origin: self.origin, size: self.size, texel: TEXEL }
    }

    /// Where the discolour map's texels are saved, bytes.
    pub(super) fn discolor_at(&self) -> u64 {
        self.at + self.region().padded()
    }

    /// Where the next run's are.
    fn end(&self) -> u64 {
        self.at + 2 * self.region().padded()
    }
}

/// Tiles that are painted at a time, as runs.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Block {
    /// In the order of their tiles.
    pub(super) runs: Vec<Run>,
}

impl Block {
    /// Bytes of what is saved of both maps.
    pub(super) fn bytes(&self) -> u64 {
        self.runs.last().map_or(0, Run::end)
    }

    /// Rows of tiles on the target.
    pub(super) fn rows(&self) -> u32 {
        self.runs.last().map_or(0, |run| run.target[1] / TILE + 1)
    }

    fn push(&mut self, slot: u32, index: u32, size: [u32; 2]) {
        let window = tile_window(index, size);
        let [width, height] = [0, 1].map(|k| window.to[k] - window.from[k]);
        let joins = |run: &&mut Run| {
            run.origin[1] == window.from[1]
                && run.origin[0] + run.size[0] == window.from[0]
                && !slot.is_multiple_of(ACROSS)
        };
        if let Some(run) = self.runs.last_mut().filter(joins) {
            run.size[0] += width;
            return;
        }
        let target = [slot % ACROSS * TILE, slot / ACROSS * TILE];
        self.runs.push(Run { origin: window.from, size: [width, height], target, at: self.bytes() });
    }
}

/// Tiles of a map of this size, ascending, as blocks of at most so many.
pub(super) fn blocks(tiles: &[u32], size: [u32; 2], most: usize) -> Vec<Block> {
    let whole = |tiles: &[u32]| {
        let mut block = Block::default();
        (0..).zip(tiles).for_each(|(slot, &index)| block.push(slot, index, size));
        block
    };
    tiles.chunks(most).map(whole).collect()
}

/// What a block painted over.
#[derive(Debug)]
pub(super) struct Saved {
    pub(super) block: Block,
    pub(super) texels: wgpu::Buffer,
}

impl Saved {
    /// Room for what a block will paint over.
    pub(super) fn new(device: &Device, block: Block) -> Result<Self, RenderError> {
        let usage = BufferUsages::COPY_DST | BufferUsages::COPY_SRC | BufferUsages::STORAGE;
        let texels = device.buffer("saved tiles", block.bytes(), usage)?;
        Ok(Self { block, texels })
    }

    /// Asks for the copy of what is about to be painted over.
    pub(super) fn save(&self, encoder: &mut wgpu::CommandEncoder, maps: &Pair) {
        encoder.push_debug_group("PP: save tiles");
        for run in &self.block.runs {
            run.region().copy(encoder, &maps.color, &self.texels, run.at);
            run.region().copy(encoder, &maps.discolor, &self.texels, run.discolor_at());
        }
        encoder.pop_debug_group();
    }

    /// Asks for the copy back.
    pub(super) fn restore(&self, encoder: &mut wgpu::CommandEncoder, maps: &Pair) {
        for run in &self.block.runs {
            put_back(encoder, run, &self.texels, run.at, &maps.color);
            put_back(encoder, run, &self.texels, run.discolor_at(), &maps.discolor);
        }
    }
}

fn put_back(
    encoder: &mut wgpu::CommandEncoder,
    run: &Run,
    from: &wgpu::Buffer,
    offset: u64,
    into: &wgpu::Texture,
) {
    let bytes_per_row = Some(run.region().stride());
    let layout = wgpu::TexelCopyBufferLayout { offset, bytes_per_row, rows_per_image: None };
    let ([x, y], [width, height]) = (run.origin, run.size);
    encoder.copy_buffer_to_texture(
        wgpu::TexelCopyBufferInfo { buffer: from, layout },
        wgpu::TexelCopyTextureInfo { origin: wgpu::Origin3d { x, y, z: 0 }, ..into.as_image_copy() },
        wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
    );
}

/// What a painting left beside the maps.
#[derive(Debug)]
pub(super) struct Trace {
    /// What it painted over.
    pub(super) saved: Vec<Saved>,
    /// Which texels it could not place, [`Faults`](super::paint::Faults).
    pub(super) faults: wgpu::Buffer,
}

impl Trace {
    fn bytes(&self) -> u64 {
        self.saved.iter().map(|saved| saved.block.bytes()).sum()
    }
}

/// A painting that is on the maps.
#[derive(Debug)]
struct Applied {
    painting: Arc<Painting>,
    /// `None` once it was dropped.
    trace: Option<Trace>,
}

/// The paintings that are on the maps, and how to take them back.
#[derive(Debug)]
pub(super) struct Journal {
    applied: Vec<Applied>,
    /// Bytes that it may keep.
    budget: u64,
    /// Bytes that it keeps.
    kept: u64,
}

impl Journal {
    pub(super) fn new(budget: u64) -> Self {
        Self { applied: Vec::new(), budget, kept: 0 }
    }

    /// Notes a painting, and drops what is too much.
    pub(super) fn push(&mut self, painting: Arc<Painting>, trace: Trace) {
        self.kept += trace.bytes();
        for older in &mut self.applied {
            if self.kept > self.budget {
                self.kept -= older.trace.take().map_or(0, |trace| trace.bytes());
            }
        }
        self.applied.push(Applied { painting, trace: Some(trace) });
    }

    /// The painting that came last, and what it left.
    pub(super) fn last(&self) -> Option<(&Painting, &Trace)> {
        let last = self.applied.last()?;
        Some((&last.painting, last.trace.as_ref()?))
    }

    /// How many paintings at the beginning are the same as these.
    pub(super) fn common(&self, paintings: &[Arc<Painting>]) -> usize {
        let same = |(applied, wanted): &(&Applied, &Arc<Painting>)| {
            Arc::ptr_eq(&applied.painting, wanted) || applied.painting == **wanted
        };
        self.applied.iter().zip(paintings).take_while(same).count()
    }

    /// What must be put back so that only so many paintings are left, in this order; `None` if something of it was dropped.
    pub(super) fn back_to(&self, count: usize) -> Option<Vec<&Saved>> {
        let later = self.applied[count..].iter().rev().map(|applied| applied.trace.as_ref());
        let all: Vec<&Trace> = later.collect::<Option<_>>()?;
        Some(all.into_iter().flat_map(|trace| &trace.saved).collect())
    }

    /// Forgets all but the first so many.
    pub(super) fn truncate(&mut self, count: usize) {
        self.applied.truncate(count);
        self.kept = self.applied.iter().flat_map(|applied| &applied.trace).map(Trace::bytes).sum();
    }
}
