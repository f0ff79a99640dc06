//! The passes of all painters on a device: each is compiled when it is first needed, once.
//!
//! How many octaves a noise has is compiled in, so that its loop is unrolled: a loop of unknown length costs a software device
//! more than three octaves do.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use wgpu::BindingResource;

use super::paint::PaintPass;
use super::patch::PatchPass;
use super::place::PlacePass;
use crate::canvas::RenderError;
use crate::canvas::look::Fbm;
use crate::render::gpu::device::Device;

/// Octaves beyond this are left out: no scene may ask for more.
const MOST_OCTAVES: u32 = 16;

/// The passes, as far as they were needed. They belong to one device.
#[derive(Debug, Default)]
pub struct Passes {
    patch: Compiled<PatchPass>,
    place: Compiled<PlacePass>,
    paint: Compiled<PaintPass>,
}

impl Passes {
    /// GP with a noise.
    pub(super) fn patch(&self, device: &Device, noise: &Fbm) -> Result<Arc<PatchPass>, RenderError> {
        self.patch.get(noise.octaves.min(MOST_OCTAVES), |octaves| PatchPass::new(device, octaves))
    }

    /// PP's first half.
    pub(super) fn place(&self, device: &Device) -> Result<Arc<PlacePass>, RenderError> {
        self.place.get(0, |_| PlacePass::new(device))
    }

    /// PP's second half, with a noise.
    pub(super) fn paint(&self, device: &Device, noise: &Fbm) -> Result<Arc<PaintPass>, RenderError> {
        self.paint.get(noise.octaves.min(MOST_OCTAVES), |octaves| PaintPass::new(device, octaves))
    }
}

/// A pass by its noise's octaves.
#[derive(Debug)]
struct Compiled<P>(Mutex<BTreeMap<u32, Arc<P>>>);

impl<P> Default for Compiled<P> {
    fn default() -> Self {
        Self(Mutex::default())
    }
}

impl<P> Compiled<P> {
    fn get(
        &self,
        octaves: u32,
        compile: impl FnOnce(u32) -> Result<P, RenderError>,
    ) -> Result<Arc<P>, RenderError> {
        let mut compiled = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(pass) = compiled.get(&octaves) {
            return Ok(pass.clone());
        }
        let pass = Arc::new(compile(octaves)?);
        compiled.insert(octaves, pass.clone());
        Ok(pass)
    }
}

/// A compute pipeline of the shader of this name, with a noise of so many octaves.
pub(super) fn compute_pipeline(
    device: &Device,
    name: &str,
    octaves: u32,
) -> Result<wgpu::ComputePipeline, RenderError> {
    let shader = device.shader(name)?;
    let constants = &[("OCTAVES", f64::from(octaves))];
    device.guarded(name, || {
        device.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(name),
            layout: None,
            module: &shader,
            entry_point: Some("compute"),
            compilation_options: wgpu::PipelineCompilationOptions { constants, ..Default::default() },
            cache: None,
        })
    })
}

/// Binds what a pass works on, each by its number.
pub(super) fn bound<const N: usize>(
    device: &Device,
    name: &str,
    layout: &wgpu::BindGroupLayout,
    entries: [(u32, BindingResource<'_>); N],
) -> Result<wgpu::BindGroup, RenderError> {
    let entries = entries.map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource });
    device.guarded(name, || {
        device.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(name),
            layout,
            entries: &entries,
        })
    })
}
