//! Which tiles of the screen hold skin, and which of them discoloration: listed on the device, so that the scattering is drawn over them
//! alone.

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
    /// Draws of the plain and of the localized tiles.
    pub(crate) draws: wgpu::Buffer,
    /// Tiles with skin and no discoloration.
    pub(crate) plain: wgpu::Buffer,
    /// Tiles with discoloration.
    pub(crate) localized: wgpu::Buffer,
    /// How many tiles there are.
    pub(crate) count: u32,
}

impl Lists {
    /// Bytes of both draws.
    pub(crate) const DRAWS: u64 = 2 * Self::DRAW;

    /// Bytes of one: where the localized tiles' begins.
    pub(crate) const DRAW: u64 = 4 * Draw::COUNT as u64;

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
            plain: list("plain tiles")?,
            localized: list("localized tiles")?,
            count,
        })
    }

    /// How long both lists are, from what was read back.
    pub(crate) fn lengths(read: &[u8]) -> [u32; 2] {
        let word = |at: usize| read.get(at..at + 4).map_or(0, bytemuck::pod_read_unaligned);
        [word(4), word(4 + Self::DRAW as usize)]
    }
}

/// Lists tiles.
#[derive(Debug)]
pub(crate) struct TilesPass {
    layout: wgpu::BindGroupLayout,
    /// By what is in the frame: `[discoloration][everything]`.
    pipelines: [[wgpu::ComputePipeline; 2]; 2],
}

/// What it works with in a frame.
#[derive(Debug)]
pub(crate) struct TilesStep<'a> {
    pipeline: &'a wgpu::ComputePipeline,
    group: wgpu::BindGroup,
    tiles: [u32; 2],
}

impl TilesPass {
    /// Compiles it.
    pub(crate) fn new(device: &Device) -> Result<Self, RenderError> {
        let least = Bound::Uniform(4 * Screen::COUNT as u64);
        let bound = [least, Bound::Texture, Bound::Texture, Bound::Write, Bound::Write, Bound::Write];
        let layout = layout(device, "tiles", ShaderStages::COMPUTE, &bound)?;
        let whole = pipeline_layout(device, "tiles", &[&layout])?;
        let module = device.shader("tiles")?;
        let make = |discoloration: f64, everything: f64| {
            let constants = [("DISCOLORATION", discoloration), ("EVERYTHING", everything)];
            device.guarded("tiles", || {
                device.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                    label: Some("tiles"),
                    layout: Some(&whole),
                    module: &module,
                    entry_point: Some("list"),
                    compilation_options: wgpu::PipelineCompilationOptions {
                        constants: &constants,
                        ..Default::default()
                    },
                    cache: None,
                })
            })
        };
        let pair = |discoloration: f64| Ok([make(discoloration, 0.0)?, make(discoloration, 1.0)?]);
        Ok(Self { layout, pipelines: [pair(0.0)?, pair(1.0)?] })
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
        device.write(&targets.lists.draws, 0, &bytes(&[draw, draw]))?;
        let (diffuse, lists) = (view(&targets.diffuse), &targets.lists);
        let resources = [
            screen.as_entire_binding(),
            wgpu::BindingResource::TextureView(&diffuse),
            wgpu::BindingResource::TextureView(&targets.discolor),
            lists.draws.as_entire_binding(),
            lists.plain.as_entire_binding(),
            lists.localized.as_entire_binding(),
        ];
        let group = group(device, "tiles", &self.layout, &resources)?;
        let pipeline = &self.pipelines[usize::from(job.switches.discoloration)][usize::from(job.everything)];
        Ok(TilesStep { pipeline, group, tiles })
    }
}

impl TilesStep<'_> {
    /// Lists the tiles of the frame.
    pub(crate) fn record(&self, encoder: &mut wgpu::CommandEncoder, stamps: Stamps<'_>) {
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some("list tiles"),
            timestamp_writes: stamps.first(),
        });
        pass.set_pipeline(self.pipeline);
        pass.set_bind_group(0, &self.group, &[]);
        pass.dispatch_workgroups(self.tiles[0], self.tiles[1], 1);
    }
}
