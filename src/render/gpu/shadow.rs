//! Shadow maps: what each light sees (Lam 2016, B.1.2.2), as depth in the layers of one texture. A layer is drawn again only if its light, the
//! mesh or its size is no longer what it was.

use glam::DVec3;
use wgpu::{BufferUsages, ShaderStages, TextureUsages};

use super::bindings::{Bound, group, layout, pipeline_layout};
use super::device::Device;
use super::lens::Lens;
use super::mesh::Surface;
use super::pipelines::{DEPTH, Drawing, far};
use super::record::{Words, bytes, record};
use super::store::Store;
use super::timing::Recorder;
use crate::canvas::RenderError;
use crate::canvas::frame::{FrameJob, Light};

record! {
    /// What a light sees with.
    Caster {
        clip: [[f32; 4]; 4],
    }
}

/// The most texels of all maps: 1 GB.
const MOST_TEXELS: u64 = 1 << 28;

/// Draws shadow maps.
#[derive(Debug)]
pub(crate) struct ShadowPass {
    layout: wgpu::BindGroupLayout,
    pipeline: wgpu::RenderPipeline,
}

impl ShadowPass {
    /// Compiles it.
    pub(crate) fn new(device: &Device) -> Result<Self, RenderError> {
        let bound = [Bound::Uniform(4 * Caster::COUNT as u64)];
        let layout = layout(device, "shadow", ShaderStages::VERTEX, &bound)?;
        let pipeline = Drawing {
            label: "shadow",
            layout: &pipeline_layout(device, "shadow", &[&layout])?,
            module: &device.shader("shadow")?,
            vertex: "project",
            fragment: None,
            targets: &[],
            constants: &[],
            attributes: &wgpu::vertex_attr_array![0 => Float32x3],
            nearest: true,
        }
        .make(device)?;
        Ok(Self { layout, pipeline })
    }
}

/// What a map depends on beside its size.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Key {
    light: Light,
    origin: DVec3,
    revision: u64,
}

/// A light's layer.
#[derive(Debug)]
struct Layer {
    view: wgpu::TextureView,
    caster: Store,
    /// What was drawn into it.
    key: Option<Key>,
}

/// The shadow maps of a scene.
#[derive(Debug)]
pub(crate) struct ShadowMaps {
    texture: wgpu::Texture,
    layers: Vec<Layer>,
}

impl ShadowMaps {
    /// With room for none but one texel: something has to be bound.
    pub(crate) fn new(device: &Device) -> Result<Self, RenderError> {
        Ok(Self { texture: texture(device, 1, 1)?, layers: Vec::new() })
    }

    /// All layers.
    pub(crate) fn view(&self) -> wgpu::TextureView {
        self.texture.create_view(&wgpu::TextureViewDescriptor {
            label: Some("shadow maps"),
            dimension: Some(wgpu::TextureViewDimension::D2Array),
            ..wgpu::TextureViewDescriptor::default()
        })
    }

    /// Makes room for so many maps. What was drawn is lost if there is not enough, or if their size is another.
    pub(crate) fn fit(&mut self, device: &Device, side: u32, count: usize) -> Result<(), RenderError> {
        if self.texture.width() == side && self.layers.len() >= count {
            return Ok(());
        }
        let layers = count.max(1) as u32;
        if u64::from(side) * u64::from(side) * u64::from(layers) > MOST_TEXELS {
            return Err(RenderError::TooLarge(format!("{count} shadow maps of {side} x {side}")));
        }
        self.layers.clear();
        self.texture = texture(device, side, layers)?;
        let layer = |layer| Layer {
            view: self.texture.create_view(&wgpu::TextureViewDescriptor {
                label: Some("shadow map"),
                dimension: Some(wgpu::TextureViewDimension::D2),
                base_array_layer: layer,
                array_layer_count: Some(1),
                ..wgpu::TextureViewDescriptor::default()
            }),
            caster: Store::new("caster", BufferUsages::UNIFORM),
            key: None,
        };
        self.layers = (0..layers).map(layer).collect();
        Ok(())
    }

    /// Draws a light's map into a layer, unless it is there already and nothing is to be skipped.
    pub(crate) fn draw(
        &mut self,
        recorder: &mut Recorder<'_>,
        pass: &ShadowPass,
        (id, light, layer): (String, &Light, usize),
        surface: &Surface,
        job: &FrameJob<'_>,
    ) -> Result<(), RenderError> {
        let key = Key { light: *light, origin: job.origin, revision: surface.revision() };
        let layer = &mut self.layers[layer];
        if layer.key == Some(key) && !job.everything {
            recorder.skip(id, "neither the light nor the mesh has changed");
            return Ok(());
        }
        layer.key = None;
        let caster = Caster { clip: Lens::of_light(light, job.origin).clip() };
        let caster = layer.caster.put(recorder.device(), &bytes(&[caster]))?;
        let bound = group(recorder.device(), "shadow", &pass.layout, &[caster.as_entire_binding()])?;
        let view = layer.view.clone();
        recorder.pass(id, |encoder, stamps| {
            let mut drawing = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some("shadow map"),
                depth_stencil_attachment: Some(far(&view)),
                timestamp_writes: stamps.render(true, true),
                ..wgpu::RenderPassDescriptor::default()
            });
            drawing.set_pipeline(&pass.pipeline);
            drawing.set_bind_group(0, &bound, &[]);
            surface.draw(&mut drawing);
        })?;
        layer.key = Some(key);
        Ok(())
    }

    /// Forgets what was drawn: it may never have been.
    pub(crate) fn forget(&mut self) {
        self.layers.iter_mut().for_each(|layer| layer.key = None);
    }
}

fn texture(device: &Device, side: u32, layers: u32) -> Result<wgpu::Texture, RenderError> {
    let usage = TextureUsages::RENDER_ATTACHMENT | TextureUsages::TEXTURE_BINDING;
    device.layers("shadow maps", [side; 2], layers, DEPTH, usage)
}
