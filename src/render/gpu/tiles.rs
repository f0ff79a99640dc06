//! Which tiles of the screen hold any surface, which of them skin, and which of these discoloration: listed on the device, so that what follows is
//! drawn over them alone.

use wgpu::{BufferUsages, ShaderStages};

use super::bindings::{Bound, group, layout, pipeline_layout, view};
use super::device::Device;
use super::record::{Words, bytes, record};
use super::store::Store;
use super::targets::Targets;
use super::timing::Stamps;
use crate::canvas::RenderError;
use crate::canvas::frame::FrameJob;

record! {
    /// The frame that is looked at.
    Screen {
        size: [u32; 2],
        across: u32,
        unused: u32,
    }
}

record! {
    /// What draws a list.
    Draw {
        vertex_count: u32,
        instance_count: u32,
        first_vertex: u32,
        first_instance: u32,
    }
}

/// Pixels along the side of a tile.
pub(crate) const TILE: u32 = 16;

/// How many tiles a frame has across and down.
pub(crate) fn tiles(size: [u32; 2]) -> [u32; 2] {
    size.map(|side| side.div_ceil(TILE))
}

/// The lists of a frame's tiles.
#[derive(Debug)]
pub(crate) struct Lists {
    /// What draws each of them.
    pub(crate) draws: wgpu::Buffer,
    /// Tiles with any surface.
    pub(crate) seen: wgpu::Buffer,
    /// Tiles with skin and no discoloration.
    pub(crate) plain: wgpu::Buffer,
    /// Tiles with discoloured skin.
    pub(crate) localized: wgpu::Buffer,
    /// How many tiles there are.
    pub(crate) count: u32,
}

/// Bytes of what draws a list.
const DRAW: u64 = 4 * Draw::COUNT as u64;

impl Lists {
    /// Where the draw of the tiles that hold any surface begins.
    pub(crate) const SEEN: u64 = 0;
    /// The same of the plain ones.
    pub(crate) const PLAIN: u64 = DRAW;
    /// The same of the localized ones.
    pub(crate) const LOCALIZED: u64 = 2 * DRAW;
    /// Bytes of all.
    pub(crate) const DRAWS: u64 = 3 * DRAW;

    /// With room for every tile of a frame.
    pub(crate) fn new(device: &Device, size: [u32; 2]) -> Result<Self, RenderError> {
        let [across, down] = tiles(size);
        let most = device.limits().max_compute_workgroups_per_dimension;
        if across.max(down) > most {
            return Err(RenderError::TooLarge(format!("{across} x {down} tiles, of {most} a side at most")));
        }
        let count = across * down;
        let list = |label| device.buffer(label, 4 * u64::from(count), BufferUsages::STORAGE);
        let usage =
            BufferUsages::STORAGE | BufferUsages::INDIRECT | BufferUsages::COPY_DST | BufferUsages::COPY_SRC;
        Ok(Self {
            draws: device.buffer("draws of tiles", Self::DRAWS, usage)?,
            seen: list("tiles with surface")?,
            plain: list("plain tiles")?,
            localized: list("localized tiles")?,
            count,
        })
    }

    /// How long all of them are, from what was read back: with surface, plain, localized.
    pub(crate) fn lengths(read: &[u8]) -> [u32; 3] {
        // The count is the second word of a draw.
        [Self::SEEN, Self::PLAIN, Self::LOCALIZED].map(|draw| {
            let at = draw as usize + 4;
            read.get(at..at + 4).map_or(0, bytemuck::pod_read_unaligned)
        })
    }
}

/// Lists tiles.
#[derive(Debug)]
pub(crate) struct TilesPass {
    layout: wgpu::BindGroupLayout,
    /// By whether every tile is listed.
    seen: [wgpu::ComputePipeline; 2],
    /// By what else is in the frame: `[discoloration][every tile]`.
    skin: [[wgpu::ComputePipeline; 2]; 2],
}

/// What it works with in a frame.
#[derive(Debug)]
pub(crate) struct TilesStep<'a> {
    seen: &'a wgpu::ComputePipeline,
    skin: &'a wgpu::ComputePipeline,
    group: wgpu::BindGroup,
    tiles: [u32; 2],
}

impl TilesPass {
    /// Compiles it.
    pub(crate) fn new(device: &Device) -> Result<Self, RenderError> {
        let (texture, list) = (Bound::Texture, Bound::Write);
        let least = Bound::Uniform(4 * Screen::COUNT as u64);
        let bound = [least, texture, texture, list, list, list, Bound::Faces, list];
        let layout = layout(device, "tiles", ShaderStages::COMPUTE, &bound)?;
        let whole = pipeline_layout(device, "tiles", &[&layout])?;
        let module = device.shader("tiles")?;
        let make = |entry: &str, discoloration: f64, everything: f64| {
            let constants = [("DISCOLORATION", discoloration), ("EVERYTHING", everything)];
            device.guarded("tiles", || {
                device.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                    label: Some(entry),
                    layout: Some(&whole),
                    module: &module,
                    entry_point: Some(entry),
                    compilation_options: wgpu::PipelineCompilationOptions {
                        constants: &constants,
                        ..Default::default()
                    },
                    cache: None,
                })
            })
        };
        let pair = |entry: &str, discoloration: f64| {
            Ok([make(entry, discoloration, 0.0)?, make(entry, discoloration, 1.0)?])
        };
        let skin = [pair("list_skin", 0.0)?, pair("list_skin", 1.0)?];
        Ok(Self { layout, seen: pair("list_seen", 0.0)?, skin })
    }

    /// Gets ready for a frame.
    pub(crate) fn prepare(
        &self,
        device: &Device,
        screen: &mut Store,
        targets: &Targets,
        job: &FrameJob<'_>,
    ) -> Result<TilesStep<'_>, RenderError> {
        let tiles = tiles(targets.size);
        let record = Screen { size: targets.size, across: tiles[0], unused: 0 };
        let screen = screen.put(device, &bytes(&[record]))?;
        let draw = Draw { vertex_count: 6, ..Draw::default() };
        device.write(&targets.lists.draws, 0, &bytes(&[draw; 3]))?;
        let (diffuse, lists) = (view(&targets.diffuse), &targets.lists);
        let resources = [
            screen.as_entire_binding(),
            wgpu::BindingResource::TextureView(&diffuse),
            wgpu::BindingResource::TextureView(&targets.discolor),
            lists.draws.as_entire_binding(),
            lists.plain.as_entire_binding(),
            lists.localized.as_entire_binding(),
            wgpu::BindingResource::TextureView(&targets.faces),
            lists.seen.as_entire_binding(),
        ];
        let group = group(device, "tiles", &self.layout, &resources)?;
        let every = usize::from(job.everything);
        let skin = &self.skin[usize::from(job.switches.discoloration)][every];
        Ok(TilesStep { seen: &self.seen[every], skin, group, tiles })
    }
}

impl TilesStep<'_> {
    /// Lists the tiles that hold any surface, at the end of a pass.
    pub(crate) fn list_seen(&self, encoder: &mut wgpu::CommandEncoder, stamps: Stamps<'_>) {
        self.list(encoder, self.seen, stamps.compute(false));
    }

    /// Lists the tiles that hold skin, at the beginning of a pass.
    pub(crate) fn list_skin(&self, encoder: &mut wgpu::CommandEncoder, stamps: Stamps<'_>) {
        self.list(encoder, self.skin, stamps.compute(true));
    }

    fn list(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        pipeline: &wgpu::ComputePipeline,
        timestamp_writes: Option<wgpu::ComputePassTimestampWrites<'_>>,
    ) {
        let mut pass = encoder
            .begin_compute_pass(&wgpu::ComputePassDescriptor { label: Some("list tiles"), timestamp_writes });
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, &self.group, &[]);
        pass.dispatch_workgroups(self.tiles[0], self.tiles[1], 1);
    }
}
