//! The picture: diffuse and specular light together, clamped, as sRGB bytes, over the tiles that hold any surface; the rest is the background.

use wgpu::{BindingResource, ShaderStages};

use super::bindings::{Bound, group, layout, pipeline_layout, view};
use super::device::Device;
use super::pipelines::{Cache, Drawing, filled};
use super::record::{Words, bytes, record};
use super::store::Store;
use super::targets::{BYTES, Targets};
use super::tiles::{Lists, tiles};
use super::timing::Recorder;
use crate::canvas::RenderError;
use crate::canvas::frame::FrameJob;
use crate::canvas::look::Background;
use crate::render::sat;

record! {
    /// What is behind the model.
    Backdrop {
        color: [f32; 4],
        size: [u32; 2],
        across: u32,
        unused: u32,
    }
}

/// Composes pictures.
#[derive(Debug)]
pub(crate) struct ComposePass {
    layout: wgpu::BindGroupLayout,
    list: wgpu::BindGroupLayout,
    whole: wgpu::PipelineLayout,
    module: wgpu::ShaderModule,
    /// By whether there is specular light.
    pipelines: Cache<bool>,
}

impl ComposePass {
    /// Compiles it.
    pub(crate) fn new(device: &Device) -> Result<Self, RenderError> {
        let least = Bound::Uniform(4 * Backdrop::COUNT as u64);
        let bound = [least, Bound::Texture, Bound::Texture, Bound::Texture];
        let frame = layout(device, "compose", ShaderStages::VERTEX_FRAGMENT, &bound)?;
        let list = layout(device, "tiles to compose", ShaderStages::VERTEX, &[Bound::Read])?;
        let whole = pipeline_layout(device, "compose", &[&frame, &list])?;
        Ok(Self { layout: frame, list, whole, module: device.shader("compose")?, pipelines: Cache::new() })
    }

    /// Composes a picture.
    pub(crate) fn draw(
        &self,
        recorder: &mut Recorder<'_>,
        backdrop: &mut Store,
        targets: &Targets,
        job: &FrameJob<'_>,
    ) -> Result<(), RenderError> {
        let device = recorder.device();
        let color = background(job.look.background).map(|byte| f32::from(byte) / 255.0);
        let (size, across) = (targets.size, tiles(targets.size)[0]);
        let backdrop = backdrop.put(device, &bytes(&[Backdrop { color, size, across, unused: 0 }]))?;
        let (diffuse, picture) = (view(&targets.diffuse), view(&targets.picture));
        let resources = [
            backdrop.as_entire_binding(),
            BindingResource::TextureView(&diffuse),
            BindingResource::TextureView(&targets.specular),
            BindingResource::TextureView(&targets.distance),
        ];
        let frame = group(device, "compose", &self.layout, &resources)?;
        let seen = [targets.lists.seen.as_entire_binding()];
        let list = group(device, "tiles to compose", &self.list, &seen)?;
        let pipeline = self.pipelines.get(job.switches.specular, |specular| self.make(device, *specular))?;
        recorder.pass("compose", |encoder, stamps| {
            let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some("compose"),
                color_attachments: &[Some(filled(&picture, color.map(f64::from)))],
                timestamp_writes: stamps.render(true, true),
                ..wgpu::RenderPassDescriptor::default()
            });
            pass.set_pipeline(&pipeline);
            pass.set_bind_group(0, &frame, &[]);
            pass.set_bind_group(1, &list, &[]);
            pass.draw_indirect(&targets.lists.draws, Lists::SEEN);
        })
    }

    fn make(&self, device: &Device, specular: bool) -> Result<wgpu::RenderPipeline, RenderError> {
        Drawing {
            label: "compose",
            layout: &self.whole,
            module: &self.module,
            vertex: "cover",
            fragment: Some("compose"),
            targets: &[Some(BYTES)],
            constants: &[("SPECULAR", f64::from(u8::from(specular)))],
            attributes: &[],
            nearest: false,
        }
        .make(device)
    }
}

/// The texel behind the model.
pub(crate) fn background(Background([r, g, b]): Background) -> [u8; 4] {
    let byte = |channel: f32| (255.0 * sat(channel) + 0.5) as u8;
    [byte(r), byte(g), byte(b), 255]
}
