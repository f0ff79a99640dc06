//! PP's second half on the device: the patch and the discoloration over the tiles that may change (`shaders/paint.wgsl`; Lam 2016,
//! §5.3.2.2 and §5.4).
//!
//! The shader reads the texels below from what was just saved for the journal, so that it may write the maps themselves.

use wgpu::BufferUsages;

use super::journal::{Run, Saved};
use super::maps::Pair;
use super::passes::{bound, compute_pipeline};
use super::patch::Fbm;
use super::record::{Words, bytes, record};
use crate::canvas::RenderError;
use crate::canvas::job::Painting;
use crate::render::gpu::device::Device;
use crate::render::layout::TILE;

/// Texels along the side of a workgroup.
const GROUP: u32 = 16;

record! {
    /// What the shader is told.
    Paint {
        length: f32,
        height: f32,
        noise_scale: f32,
        unused: u32,
        offset: [f32; 2],
        patch_size: [u32; 2],
        factor: [f32; 4],
        noise: Fbm,
    }
}

record! {
    /// A tile, on the map, on the target and in what was saved.
    Tile {
        map_origin: [u32; 2],
        target_origin: [u32; 2],
        size: [u32; 2],
        saved_color: u32,
        saved_discolor: u32,
        stride: u32,
        unused: u32,
    }
}

/// How many texels without a place are told.
const FAULTS: usize = 16;

record! {
    /// A texel whose (s, d) are no numbers.
    Fault {
        texel: [u32; 2],
        place: [f32; 2],
    }
}

record! {
    /// How many there are, and the first of them.
    Faults {
        count: u32,
        unused: u32,
        first: [Fault; FAULTS],
    }
}

impl Faults {
    /// A buffer that tells of none.
    pub(super) fn none(device: &Device) -> Result<wgpu::Buffer, RenderError> {
        let usage = BufferUsages::STORAGE | BufferUsages::COPY_SRC;
        device.buffer("texels without a place", 4 * Self::COUNT as u64, usage)
    }

    /// Those that a buffer tells of.
    pub(super) fn read(device: &Device, buffer: &wgpu::Buffer) -> Result<Vec<Fault>, RenderError> {
        let bytes = device.read_buffer(buffer, 0..4 * Self::COUNT as u64)?;
        let words: Vec<u32> = bytes.as_chunks().0.iter().map(|word| u32::from_le_bytes(*word)).collect();
        let told = words[0].min(FAULTS as u32) as usize;
        let faults = words[2..].as_chunks::<{ Fault::COUNT }>().0.iter().take(told);
        let fault = |&[x, y, s, d]: &[u32; 4]| Fault { texel: [x, y], place: [s, d].map(f32::from_bits) };
        Ok(faults.map(fault).collect())
    }
}

impl From<&Painting> for Paint {
    fn from(painting: &Painting) -> Self {
        let (job, [r, g, b]) = (&painting.paint, painting.paint.factor);
        Self {
            length: job.length,
            height: job.height,
            noise_scale: job.noise_scale,
            offset: job.offset,
            patch_size: painting.patch.size,
            factor: [r, g, b, 0.0],
            noise: job.noise.into(),
            ..Self::default()
        }
    }
}

/// The tiles of a run.
fn tiles(run: &Run) -> impl Iterator<Item = Tile> + '_ {
    // A block's saved texels are few enough that u32 counts their words.
    let words = |bytes: u64| (bytes / 4) as u32;
    (0..run.size[0]).step_by(TILE as usize).map(move |x| Tile {
        map_origin: [run.origin[0] + x, run.origin[1]],
        target_origin: [run.target[0] + x, run.target[1]],
        size: [TILE.min(run.size[0] - x), run.size[1]],
        saved_color: words(run.at) + x,
        saved_discolor: words(run.discolor_at()) + x,
        stride: run.region().stride() / 4,
        unused: 0,
    })
}

/// What all blocks of a painting are painted with.
#[derive(Debug)]
pub(super) struct Told<'a> {
    pub(super) job: &'a wgpu::Buffer,
    pub(super) triangles: &'a wgpu::Buffer,
    /// The wound patch.
    pub(super) wound: &'a wgpu::Buffer,
    /// The target that triangles were drawn into.
    pub(super) placed: &'a wgpu::TextureView,
    /// The faults are told in here.
    pub(super) faults: &'a wgpu::Buffer,
}

/// What a block is painted with.
#[derive(Debug)]
pub(super) struct Prepared {
    bound: wgpu::BindGroup,
    tiles: u32,
}

/// The pass.
#[derive(Debug)]
pub(super) struct PaintPass(wgpu::ComputePipeline);

impl PaintPass {
    pub(super) fn new(device: &Device, octaves: u32) -> Result<Self, RenderError> {
        compute_pipeline(device, "paint", octaves).map(Self)
    }

    /// What the shader is told of a painting.
    pub(super) fn job(device: &Device, painting: &Painting) -> Result<wgpu::Buffer, RenderError> {
        device.filled("paint job", &bytes(&[Paint::from(painting)]), BufferUsages::UNIFORM)
    }

    /// Prepares the painting of a block.
    pub(super) fn prepare(
        &self,
        device: &Device,
        saved: &Saved,
        told: &Told<'_>,
        maps: &Pair,
    ) -> Result<Prepared, RenderError> {
        let tiles: Vec<Tile> = saved.block.runs.iter().flat_map(tiles).collect();
        let listed = device.filled("tiles", &bytes(&tiles), BufferUsages::STORAGE)?;
        let view = |map: &wgpu::Texture| map.create_view(&wgpu::TextureViewDescriptor::default());
        let [color, discolor] = [&maps.color, &maps.discolor].map(view);
        let entries = [
            (0, told.triangles.as_entire_binding()),
            (3, told.job.as_entire_binding()),
            (4, listed.as_entire_binding()),
            (5, told.wound.as_entire_binding()),
            (6, saved.texels.as_entire_binding()),
            (7, wgpu::BindingResource::TextureView(told.placed)),
            (8, wgpu::BindingResource::TextureView(&color)),
            (9, wgpu::BindingResource::TextureView(&discolor)),
            (10, told.faults.as_entire_binding()),
        ];
        let bound = bound(device, "paint", &self.0.get_bind_group_layout(0), entries)?;
        Ok(Prepared { bound, tiles: tiles.len() as u32 })
    }

    /// Asks for it.
    pub(super) fn record(&self, encoder: &mut wgpu::CommandEncoder, prepared: &Prepared) {
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some("PP: paint"),
            timestamp_writes: None,
        });
        pass.set_pipeline(&self.0);
        pass.set_bind_group(0, &prepared.bound, &[]);
        pass.dispatch_workgroups(TILE / GROUP, TILE / GROUP, prepared.tiles);
    }
}
