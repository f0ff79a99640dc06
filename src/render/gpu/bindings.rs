//! What a pass reads and writes, in the order of its bindings.

use std::num::NonZero;

use wgpu::{BindingResource, BindingType, BufferBindingType, ShaderStages};

use super::device::Device;
use crate::canvas::RenderError;

/// A kind of binding.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Bound {
    /// A uniform of at least so many bytes.
    Uniform(u64),
    /// A storage buffer that is read.
    Read,
    /// A storage buffer that is written too.
    Write,
    /// A texture whose texels are loaded.
    Texture,
    /// A texture of whole numbers.
    Faces,
    /// Layers of depth, whose texels are loaded.
    Depths,
}

impl Bound {
    fn kind(self) -> BindingType {
        let buffer = |ty, least| BindingType::Buffer {
            ty,
            has_dynamic_offset: false,
            min_binding_size: NonZero::new(least),
        };
        let texture = |sample_type, view_dimension| BindingType::Texture {
            sample_type,
            view_dimension,
            multisampled: false,
        };
        match self {
            Self::Uniform(least) => buffer(BufferBindingType::Uniform, least),
            Self::Read => buffer(BufferBindingType::Storage { read_only: true }, 0),
            Self::Write => buffer(BufferBindingType::Storage { read_only: false }, 0),
            Self::Texture => {
                let plain = wgpu::TextureSampleType::Float { filterable: false };
                texture(plain, wgpu::TextureViewDimension::D2)
            }
            Self::Faces => texture(wgpu::TextureSampleType::Uint, wgpu::TextureViewDimension::D2),
            Self::Depths => texture(wgpu::TextureSampleType::Depth, wgpu::TextureViewDimension::D2Array),
        }
    }
}

/// A group of bindings, numbered from 0.
pub(crate) fn layout(
    device: &Device,
    label: &str,
    visibility: ShaderStages,
    bound: &[Bound],
) -> Result<wgpu::BindGroupLayout, RenderError> {
    let entry = |(binding, bound): (u32, &Bound)| wgpu::BindGroupLayoutEntry {
        binding,
        visibility,
        ty: bound.kind(),
        count: None,
    };
    let entries: Vec<_> = (0..).zip(bound).map(entry).collect();
    let descriptor = wgpu::BindGroupLayoutDescriptor { label: Some(label), entries: &entries };
    device.guarded(label, || device.device.create_bind_group_layout(&descriptor))
}

/// What is bound, in the order of the layout.
pub(crate) fn group(
    device: &Device,
    label: &str,
    layout: &wgpu::BindGroupLayout,
    resources: &[BindingResource<'_>],
) -> Result<wgpu::BindGroup, RenderError> {
    let numbered = (0..).zip(resources.iter().cloned());
    let entries: Vec<_> =
        numbered.map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource }).collect();
    let descriptor = wgpu::BindGroupDescriptor { label: Some(label), layout, entries: &entries };
    device.guarded(label, || device.device.create_bind_group(&descriptor))
}

/// The layout of a pipeline with these groups.
pub(crate) fn pipeline_layout(
    device: &Device,
    label: &str,
    groups: &[&wgpu::BindGroupLayout],
) -> Result<wgpu::PipelineLayout, RenderError> {
    let groups: Vec<_> = groups.iter().map(|group| Some(*group)).collect();
    let descriptor =
        wgpu::PipelineLayoutDescriptor { label: Some(label), bind_group_layouts: &groups, immediate_size: 0 };
    device.guarded(label, || device.device.create_pipeline_layout(&descriptor))
}

/// A view of all of a texture.
pub(crate) fn view(texture: &wgpu::Texture) -> wgpu::TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}
