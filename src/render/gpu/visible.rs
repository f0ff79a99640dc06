//! Which face is nearest at each pixel: all that the surface is drawn for, but for its shadows. What is seen is shaded afterwards, each pixel
//! once, however small its face is and whatever lies behind it (a visibility buffer: Burns and Hunt 2013).

use wgpu::ShaderStages;

use super::bindings::{Bound, group, layout, pipeline_layout};
use super::device::Device;
use super::lens::Lens;
use super::mesh::Surface;
use super::pipelines::{Drawing, cleared, far};
use super::record::{Words, bytes, record};
use super::store::Store;
use super::targets::{FACES, Targets};
use super::tiles::TilesStep;
use super::timing::Recorder;
use crate::canvas::RenderError;
use crate::canvas::frame::FrameJob;

record! {
    /// What sees the surface.
    Viewer {
        clip: [[f32; 4]; 4],
    }
}

/// No face.
const NOTHING: u32 = u32::MAX;

/// Finds what is visible.
#[derive(Debug)]
pub(crate) struct VisiblePass {
    layout: wgpu::BindGroupLayout,
    pipeline: wgpu::RenderPipeline,
}

impl VisiblePass {
    /// Compiles it.
    pub(crate) fn new(device: &Device) -> Result<Self, RenderError> {
        let bound = [Bound::Uniform(4 * Viewer::COUNT as u64), Bound::Read, Bound::Read];
        let layout = layout(device, "visible", ShaderStages::VERTEX, &bound)?;
        let pipeline = Drawing {
            label: "visible",
            layout: &pipeline_layout(device, "visible", &[&layout])?,
            module: &device.shader("visible")?,
            vertex: "project",
            fragment: Some("name"),
            targets: &[Some(FACES)],
            constants: &[],
            attributes: &[],
            nearest: true,
        }
        .make(device)?;
        Ok(Self { layout, pipeline })
    }

    /// Finds the nearest face of each pixel, and lists the tiles that hold any.
    pub(crate) fn draw(
        &self,
        recorder: &mut Recorder<'_>,
        viewer: &mut Store,
        (targets, tiles): (&Targets, &TilesStep<'_>),
        surface: &Surface,
        job: &FrameJob<'_>,
    ) -> Result<(), RenderError> {
        let device = recorder.device();
        let clip = Lens::of_view(&job.view, job.origin).clip();
        let viewer = viewer.put(device, &bytes(&[Viewer { clip }]))?;
        let [vertices, corners] = surface.buffers()?;
        let all = [&viewer, vertices, corners].map(|buffer| buffer.as_entire_binding());
        let bound = group(device, "visible", &self.layout, &all)?;
        recorder.pass("visible", |encoder, stamps| {
            let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some("visible"),
                color_attachments: &[Some(cleared(&targets.faces, NOTHING.into()))],
                depth_stencil_attachment: Some(far(&targets.nearest)),
                timestamp_writes: stamps.render(true, false),
                ..wgpu::RenderPassDescriptor::default()
            });
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, &bound, &[]);
            pass.draw(0..surface.corner_count(), 0..1);
            drop(pass);
            tiles.list_seen(encoder, stamps);
        })
    }
}
