//! GP on the device: one dispatch makes the wound patch (`shaders/patch.wgsl`; Lam 2016, §5.3.1).
//!
//! The patch is a buffer of packed texels, not a texture: it is read at four texels at a time and blended there, in the CPU's order, and a
//! patch along a line over several charts may be longer than the longest texture.

use wgpu::BufferUsages;

use super::maps::texels;
use super::passes::{bound, compute_pipeline};
use super::record::{bytes, record};
use crate::canvas::RenderError;
use crate::canvas::image::Image;
use crate::canvas::job::PatchJob;
use crate::canvas::look;
use crate::render::gpu::device::Device;

/// Texels along the side of a workgroup.
const GROUP: u32 = 8;

record! {
    /// Fractional Brownian motion.
    Fbm {
        frequency: f32,
        amplitude: f32,
        lacunarity: f32,
        persistence: f32,
    }
}

record! {
    /// What the shader is told.
    Patch {
        size: [u32; 2],
        offset: [f32; 2],
        inner: [f32; 4],
        dark: [f32; 4],
        light: [f32; 4],
        edge: [f32; 2],
        unused: [u32; 2],
        noise: Fbm,
    }
}

impl From<look::Fbm> for Fbm {
    fn from(noise: look::Fbm) -> Self {
        let look::Fbm { frequency, amplitude, lacunarity, persistence, .. } = noise;
        Self { frequency, amplitude, lacunarity, persistence }
    }
}

impl From<&PatchJob> for Patch {
    fn from(job: &PatchJob) -> Self {
        let [inner, dark, light] = job.palette.map(|[r, g, b]| [r, g, b, 1.0]);
        let (noise, edge) = (job.noise.into(), job.edge);
        Self { size: job.size, offset: job.offset, inner, dark, light, edge, noise, ..Self::default() }
    }
}

/// A patch on the device, or about to be there.
#[derive(Clone, Debug)]
pub(super) struct Made {
    pub(super) job: PatchJob,
    pub(super) texels: wgpu::Buffer,
}

impl Made {
    /// Its texels.
    pub(super) fn read(&self, device: &Device) -> Result<Image, RenderError> {
        let read = device.read_buffer(&self.texels, 0..bytes_of(self.job.size))?;
        Ok(Image { size: self.job.size, texels: texels(&read) })
    }
}

/// Bytes of a patch.
fn bytes_of([width, height]: [u32; 2]) -> u64 {
    (u64::from(width) * u64::from(height)).saturating_mul(4)
}

/// The pass.
#[derive(Debug)]
pub(super) struct PatchPass(wgpu::ComputePipeline);

impl PatchPass {
    pub(super) fn new(device: &Device, octaves: u32) -> Result<Self, RenderError> {
        compute_pipeline(device, "patch", octaves).map(Self)
    }

    /// Prepares a patch: what [`PatchPass::record`] will fill, and with what it does.
    pub(super) fn prepare(
        &self,
        device: &Device,
        job: &PatchJob,
    ) -> Result<(Made, wgpu::BindGroup), RenderError> {
        let usage = BufferUsages::STORAGE | BufferUsages::COPY_SRC;
        let texels = device.buffer("wound patch", bytes_of(job.size), usage)?;
        let told = device.filled("patch job", &bytes(&[Patch::from(job)]), BufferUsages::UNIFORM)?;
        let entries = [(0, told.as_entire_binding()), (1, texels.as_entire_binding())];
        let bound = bound(device, "patch", &self.0.get_bind_group_layout(0), entries)?;
        Ok((Made { job: job.clone(), texels }, bound))
    }

    /// Asks for it.
    pub(super) fn record(&self, encoder: &mut wgpu::CommandEncoder, made: &Made, bound: &wgpu::BindGroup) {
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some("GP: wound patch"),
            timestamp_writes: None,
        });
        pass.set_pipeline(&self.0);
        pass.set_bind_group(0, bound, &[]);
        let [across, down] = made.job.size.map(|side| side.div_ceil(GROUP));
        pass.dispatch_workgroups(across, down, 1);
    }
}
