//! Pipelines: what all of them have in common, and those that were specialised for what is switched off.

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

use wgpu::{ColorTargetState, PipelineCompilationOptions, TextureFormat, VertexBufferLayout};

use super::device::Device;
use super::mesh::WORDS;
use crate::canvas::RenderError;

/// Depth in maps and frames.
pub(crate) const DEPTH: TextureFormat = TextureFormat::Depth32Float;

/// Pipelines by what they were specialised for.
#[derive(Debug)]
pub(crate) struct Cache<K>(Mutex<BTreeMap<K, wgpu::RenderPipeline>>);

impl<K: Ord> Cache<K> {
    /// With none yet.
    pub(crate) const fn new() -> Self {
        Self(Mutex::new(BTreeMap::new()))
    }

    /// The one for a key, made if there is none.
    pub(crate) fn get(
        &self,
        key: K,
        make: impl FnOnce(&K) -> Result<wgpu::RenderPipeline, RenderError>,
    ) -> Result<wgpu::RenderPipeline, RenderError> {
        let mut made = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(pipeline) = made.get(&key) {
            return Ok(pipeline.clone());
        }
        let pipeline = make(&key)?;
        made.insert(key, pipeline.clone());
        Ok(pipeline)
    }
}

/// A render pipeline, as far as they differ.
#[derive(Debug)]
pub(crate) struct Drawing<'a> {
    /// Its name, and its shader's.
    pub(crate) label: &'a str,
    /// Its groups.
    pub(crate) layout: &'a wgpu::PipelineLayout,
    /// Its shader.
    pub(crate) module: &'a wgpu::ShaderModule,
    /// Where vertices begin.
    pub(crate) vertex: &'a str,
    /// Where fragments do; none where depth alone is drawn.
    pub(crate) fragment: Option<&'a str>,
    /// What is drawn into.
    pub(crate) targets: &'a [Option<TextureFormat>],
    /// The shader's constants.
    pub(crate) constants: &'a [(&'a str, f64)],
    /// Attributes of the surface's vertices; none where the shader looks them up, or needs none.
    pub(crate) attributes: &'a [wgpu::VertexAttribute],
    /// Whether the nearest wins; else all are as near.
    pub(crate) nearest: bool,
}

impl Drawing<'_> {
    /// Makes the pipeline.
    pub(crate) fn make(&self, device: &Device) -> Result<wgpu::RenderPipeline, RenderError> {
        let options = || PipelineCompilationOptions { constants: self.constants, ..Default::default() };
        let target = |format: &Option<TextureFormat>| format.map(ColorTargetState::from);
        let targets: Vec<_> = self.targets.iter().map(target).collect();
        let vertices = Some(VertexBufferLayout {
            array_stride: 4 * WORDS as u64,
            step_mode: wgpu::VertexStepMode::Vertex,
            attributes: self.attributes,
        });
        let fetched = !self.attributes.is_empty();
        let fragment = self.fragment.map(|entry| wgpu::FragmentState {
            module: self.module,
            entry_point: Some(entry),
            compilation_options: options(),
            targets: &targets,
        });
        device.guarded(self.label, || {
            device.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
                label: Some(self.label),
                layout: Some(self.layout),
                vertex: wgpu::VertexState {
                    module: self.module,
                    entry_point: Some(self.vertex),
                    compilation_options: options(),
                    buffers: if fetched { std::slice::from_ref(&vertices) } else { &[] },
                },
                // Both sides of a face are seen.
                primitive: wgpu::PrimitiveState::default(),
                depth_stencil: self.nearest.then(nearest),
                multisample: wgpu::MultisampleState::default(),
                fragment,
                multiview_mask: None,
                cache: None,
            })
        })
    }
}

/// The nearest surface wins; depth grows towards the eye, where floats are dense at the far end.
fn nearest() -> wgpu::DepthStencilState {
    wgpu::DepthStencilState {
        format: DEPTH,
        depth_write_enabled: Some(true),
        depth_compare: Some(wgpu::CompareFunction::Greater),
        stencil: wgpu::StencilState::default(),
        bias: wgpu::DepthBiasState::default(),
    }
}

/// A depth attachment that begins far.
pub(crate) fn far(view: &wgpu::TextureView) -> wgpu::RenderPassDepthStencilAttachment<'_> {
    wgpu::RenderPassDepthStencilAttachment {
        view,
        depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(0.0), store: wgpu::StoreOp::Store }),
        stencil_ops: None,
    }
}

/// A colour attachment that begins with one value in its first channel, and nothing in the others.
pub(crate) fn cleared(view: &wgpu::TextureView, first: f64) -> wgpu::RenderPassColorAttachment<'_> {
    filled(view, [first, 0.0, 0.0, 0.0])
}

/// A colour attachment that begins with a colour.
pub(crate) fn filled(
    view: &wgpu::TextureView,
    [r, g, b, a]: [f64; 4],
) -> wgpu::RenderPassColorAttachment<'_> {
    attachment(view, wgpu::LoadOp::Clear(wgpu::Color { r, g, b, a }))
}

/// A colour attachment that is drawn over.
pub(crate) fn kept(view: &wgpu::TextureView) -> wgpu::RenderPassColorAttachment<'_> {
    attachment(view, wgpu::LoadOp::Load)
}

fn attachment(
    view: &wgpu::TextureView,
    load: wgpu::LoadOp<wgpu::Color>,
) -> wgpu::RenderPassColorAttachment<'_> {
    wgpu::RenderPassColorAttachment {
        view,
        depth_slice: None,
        resolve_target: None,
        ops: wgpu::Operations { load, store: wgpu::StoreOp::Store },
    }
}
