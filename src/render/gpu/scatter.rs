//! Separable scattering of the diffuse light (Jimenez et al. 2012; Lam 2016, B.2.1.2 and §5.4): across, then down, over the tiles that
//! [`tiles`](super::tiles) listed. Tiles with discoloration have a pipeline of their own in the second pass.
//!
//! Light goes from `diffuse` to `across` and back, so that what is no skin need only be copied once, and the picture reads one texture.

use wgpu::{BindingResource, BufferUsages, ShaderStages, TextureView};

use super::bindings::{Bound, group, layout, pipeline_layout, view};
use super::device::Device;
use super::pipelines::{Drawing, kept};
use super::record::{Words, bytes, record};
use super::store::Store;
use super::targets::{LIGHT, Targets};
use super::tiles::{Lists, tiles};
use super::timing::Stamps;
use crate::canvas::RenderError;
use crate::canvas::frame::FrameJob;
use crate::render::kernel::{MOST_SAMPLES, kernel};

record! {
    /// How far the kernel reaches.
    Reach {
        size: [u32; 2],
        across: u32,
        count: u32,
        pixels: f32,
        width: f32,
        unused: [u32; 2],
    }
}

/// Words of the kernel: three weights and an offset a tap.
const TAPS: usize = 4 * MOST_SAMPLES as usize;

/// Scatters light.
#[derive(Debug)]
pub(crate) struct ScatterPass {
    frame: wgpu::BindGroupLayout,
    list: wgpu::BindGroupLayout,
    across: wgpu::RenderPipeline,
    down: wgpu::RenderPipeline,
    localized: wgpu::RenderPipeline,
}

/// What it keeps on the device for a scene.
#[derive(Debug)]
pub(crate) struct ScatterState {
    reach: Store,
    taps: Store,
}

impl ScatterState {
    /// With nothing in it.
    pub(crate) fn new() -> Self {
        let uniform = |label| Store::new(label, BufferUsages::UNIFORM);
        Self { reach: uniform("reach"), taps: uniform("kernel") }
    }
}

/// What it works with in a frame.
#[derive(Debug)]
pub(crate) struct ScatterStep<'a> {
    pass: &'a ScatterPass,
    targets: &'a Targets,
    diffuse: TextureView,
    across: TextureView,
    from_diffuse: wgpu::BindGroup,
    from_across: wgpu::BindGroup,
    plain: wgpu::BindGroup,
    localized: wgpu::BindGroup,
}

impl ScatterPass {
    /// Compiles it.
    pub(crate) fn new(device: &Device) -> Result<Self, RenderError> {
        let stages = ShaderStages::VERTEX_FRAGMENT;
        let uniforms = [Reach::COUNT, TAPS].map(|words| Bound::Uniform(4 * words as u64));
        let bound = [uniforms[0], Bound::Texture, Bound::Texture, Bound::Texture, uniforms[1]];
        let frame = layout(device, "scatter", stages, &bound)?;
        let list = layout(device, "tiles to scatter", ShaderStages::VERTEX, &[Bound::Read])?;
        let whole = pipeline_layout(device, "scatter", &[&frame, &list])?;
        let module = device.shader("scatter")?;
        let make = |label: &str, down: f64, localized: f64| {
            Drawing {
                label,
                layout: &whole,
                module: &module,
                vertex: "cover",
                fragment: Some("scatter"),
                targets: &[Some(LIGHT)],
                constants: &[("DOWN", down), ("LOCALIZED", localized)],
                attributes: &[],
                nearest: false,
            }
            .make(device)
        };
        Ok(Self {
            across: make("scatter across", 0.0, 0.0)?,
            down: make("scatter down", 1.0, 0.0)?,
            localized: make("scatter down, localized", 1.0, 1.0)?,
            frame,
            list,
        })
    }

    /// Gets ready for a frame.
    pub(crate) fn prepare<'a>(
        &'a self,
        device: &Device,
        state: &mut ScatterState,
        targets: &'a Targets,
        job: &FrameJob<'_>,
    ) -> Result<ScatterStep<'a>, RenderError> {
        let taps = kernel(&job.look.scattering);
        let reach = state.reach.put(device, &bytes(&[reach(job, taps.len())]))?;
        let mut words: Vec<_> =
            taps.iter().map(|tap| [tap.weight[0], tap.weight[1], tap.weight[2], tap.offset]).collect();
        words.resize(TAPS / 4, [0.0; 4]);
        let taps = state.taps.put(device, bytemuck::cast_slice(&words))?;
        let (diffuse, across) = (view(&targets.diffuse), view(&targets.across));
        let from = |light: &TextureView| {
            let resources = [
                reach.as_entire_binding(),
                BindingResource::TextureView(light),
                BindingResource::TextureView(&targets.distance),
                BindingResource::TextureView(&targets.discolor),
                taps.as_entire_binding(),
            ];
            group(device, "scatter", &self.frame, &resources)
        };
        let list =
            |list: &wgpu::Buffer| group(device, "tiles to scatter", &self.list, &[list.as_entire_binding()]);
        Ok(ScatterStep {
            pass: self,
            from_diffuse: from(&diffuse)?,
            from_across: from(&across)?,
            plain: list(&targets.lists.plain)?,
            localized: list(&targets.lists.localized)?,
            targets,
            diffuse,
            across,
        })
    }
}

impl ScatterStep<'_> {
    /// Both passes, over the tiles that were listed.
    pub(crate) fn record(&self, encoder: &mut wgpu::CommandEncoder, stamps: Stamps<'_>) {
        let Targets { diffuse, across, .. } = self.targets;
        encoder.copy_texture_to_texture(diffuse.as_image_copy(), across.as_image_copy(), diffuse.size());
        let ScatterPass { across, down, localized, .. } = self.pass;
        let begin = Stamps::none();
        self.draw(encoder, ("scatter across", begin), (&self.from_diffuse, &self.across), [across, across]);
        let end = ("scatter down", stamps);
        self.draw(encoder, end, (&self.from_across, &self.diffuse), [down, localized]);
    }

    fn draw(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        (label, stamps): (&str, Stamps<'_>),
        (from, into): (&wgpu::BindGroup, &TextureView),
        pipelines: [&wgpu::RenderPipeline; 2],
    ) {
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some(label),
            color_attachments: &[Some(kept(into))],
            timestamp_writes: stamps.render(false, true),
            ..wgpu::RenderPassDescriptor::default()
        });
        pass.set_bind_group(0, from, &[]);
        let lists = [(&self.plain, Lists::PLAIN), (&self.localized, Lists::LOCALIZED)];
        for (pipeline, (list, at)) in pipelines.into_iter().zip(lists) {
            pass.set_pipeline(pipeline);
            pass.set_bind_group(1, list, &[]);
            pass.draw_indirect(&self.targets.lists.draws, at);
        }
    }
}

fn reach(job: &FrameJob<'_>, count: usize) -> Reach {
    let width = f64::from(job.look.scattering.width_cm) / job.unit_cm;
    let focal = f64::from(job.view.size[1]) / (2.0 * libm::tan(job.view.fov_y * 0.5));
    Reach {
        size: job.view.size,
        across: tiles(job.view.size)[0],
        count: count as u32,
        pixels: (width * focal) as f32,
        width: width as f32,
        unused: [0; 2],
    }
}
