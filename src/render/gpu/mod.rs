//! The GPU renderer: what [`canvas`](crate::canvas) defines, in wgpu and WGSL, over Vulkan.
//!
//! One file a pass, and its shader by the same name.
//!
//! | file | what it does |
//! | --- | --- |
//! | [`painter`] | the maps: patches, paintings, and what takes them back |
//! | [`frames`] | the passes of a frame, one after the other |
//! | `visible`, `shadow`, `skin`, `tiles`, `scatter`, `compose` | the passes |
//! | `mesh`, `lens`, `uniforms` | what they are told |
//! | `targets`, `timing` | what they draw into, and how long they take |
//! | `record`, `store`, `bindings`, `pipelines` | how the device is told |
//! | [`device`], [`readback`] | the device, where everything that can fail does so as a value |
//!
//! Maps are loaded texel by texel, decoded and mixed in the shaders, in f32: hardware filters differ from device to device. Light is
//! kept in half floats between the passes, rounded in the shaders for the same reason. What is left is how precise a device's f32 is: frames
//! differ from the CPU reference's by a byte here and there, and may differ by more where a comparison is a close one, along
//! silhouettes and shadows.

mod bindings;
mod compose;
pub mod device;
pub mod frames;
mod lens;
mod mesh;
pub mod painter;
mod pipelines;
pub mod readback;
mod record;
mod scatter;
mod shaders;
mod shadow;
mod skin;
mod store;
mod targets;
#[cfg(test)]
mod tests;
mod tiles;
mod timing;
mod uniforms;
mod visible;

use std::sync::Arc;

use crate::canvas::frame::{Frame, FrameJob};
use crate::canvas::image::{Image, MapId, Maps};
use crate::canvas::job::{Painting, PatchJob};
use crate::canvas::{Adapter, RenderError, Renderer, Studio};
use crate::mesh::Mesh;
use crate::report::Check;
use device::Device;
use frames::{Frames, Passes};
use painter::Painter;

/// The studio of a GPU: one device, and pipelines that all its scenes share.
#[derive(Clone, Debug)]
pub struct Gpu {
    device: Arc<Device>,
    passes: Arc<Passes>,
    painting: Arc<painter::Passes>,
}

impl Gpu {
    /// Opens the best adapter.
    pub fn open() -> Result<Self, RenderError> {
        Self::on(Arc::new(Device::open()?))
    }

    /// On a device that is open already.
    pub fn on(device: Arc<Device>) -> Result<Self, RenderError> {
        let passes = Arc::new(Passes::new(&device)?);
        Ok(Self { device, passes, painting: Arc::default() })
    }
}

impl Studio for Gpu {
    fn adapter(&self) -> &Adapter {
        &self.device.adapter
    }

    fn open(&self, maps: Arc<Maps>, mesh: &Mesh) -> Result<Box<dyn Renderer>, RenderError> {
        let (device, passes) = (self.device.clone(), self.passes.clone());
        let painter = Painter::sharing(device.clone(), &self.painting, &maps, mesh)?;
        let frames = Frames::new(device.clone(), passes, &maps)?;
        Ok(Box::new(OnGpu { device, maps, painter, frames }))
    }
}

/// Renders a scene on a GPU.
struct OnGpu {
    device: Arc<Device>,
    maps: Arc<Maps>,
    painter: Painter,
    frames: Frames,
}

impl Renderer for OnGpu {
    fn adapter(&self) -> &Adapter {
        &self.device.adapter
    }

    fn patch(&mut self, job: &PatchJob) -> Result<(), RenderError> {
        self.painter.patch(job)
    }

    fn paint(&mut self, painting: &Arc<Painting>) -> Result<(), RenderError> {
        self.painter.paint(painting)
    }

    fn follow(&mut self, paintings: &[Arc<Painting>]) -> Result<(), RenderError> {
        self.painter.follow(paintings)
    }

    fn check_patch(&mut self, job: &PatchJob) -> Result<Vec<Check>, RenderError> {
        self.painter.check_patch(job)
    }

    fn check_paint(&mut self) -> Result<Vec<Check>, RenderError> {
        self.painter.check_paint()
    }

    fn frame(&mut self, job: &FrameJob<'_>) -> Result<Frame, RenderError> {
        self.frames.frame(job, self.painter.color(), self.painter.discolor())
    }

    fn map(&mut self, map: MapId) -> Result<Image, RenderError> {
        match map {
            MapId::Color | MapId::Discolor => self.painter.map(map),
            MapId::Normal => Ok(self.maps.normal.clone()),
            MapId::Occlusion => Ok(self.maps.occlusion.clone()),
            MapId::Specular => Ok(self.maps.specular.clone()),
        }
    }
}
