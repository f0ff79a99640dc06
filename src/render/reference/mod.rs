//! The CPU reference: every pixel as [`canvas`](crate::canvas) defines it, written from the papers and not from the shaders.
//!
//! f32 and f64 `+ − × ÷ √` and libm alone, work shared out by rows and never by time: the same bytes on every machine, and with
//! any number of threads.
//!
//! | file | what it does |
//! | --- | --- |
//! | [`painter`] | the maps: patches, paintings, and what takes them back |
//! | `frames` | the passes of a frame, one after the other |
//! | `lens`, `clip`, `raster` | what an eye or a light sees: projection, clipping, coverage and depth |
//! | `shadow` | shadow maps, and what is read of them |
//! | `surface`, `sample` | what is at a pixel, and what it is made of |
//! | `lighting` | the light that leaves it |
//! | `skin`, `scatter`, `compose` | the passes over the picture, and `layers`, what they hand on |
//! | [`alone`] | single passes, to be measured |

pub mod alone;
mod clip;
mod compose;
mod frames;
mod layers;
pub(crate) mod lens;
mod lighting;
pub mod painter;
pub(crate) mod raster;
mod sample;
mod scatter;
mod shadow;
mod skin;
mod surface;
#[cfg(test)]
mod tests;

use std::sync::Arc;

use crate::canvas::frame::{Frame, FrameJob};
use crate::canvas::image::{Image, MapId, Maps};
use crate::canvas::job::{Painting, PatchJob};
use crate::canvas::{Adapter, Kind, RenderError, Renderer, Studio};
use crate::mesh::Mesh;
use crate::report::Check;
pub use frames::Frames;
use painter::Painter;

/// The studio of the CPU.
#[derive(Clone, Debug)]
pub struct Reference {
    adapter: Adapter,
}

impl Default for Reference {
    fn default() -> Self {
        Self::new()
    }
}

impl Reference {
    /// It needs nothing.
    pub fn new() -> Self {
        let empty = String::new;
        let name = "CPU reference".into();
        Self {
            adapter: Adapter {
                kind: Kind::Reference,
                name,
                driver: empty(),
                backend: empty(),
                shaders: empty(),
            },
        }
    }
}

impl Studio for Reference {
    fn adapter(&self) -> &Adapter {
        &self.adapter
    }

    fn open(&self, maps: Arc<Maps>, mesh: &Mesh) -> Result<Box<dyn Renderer>, RenderError> {
        let (painter, frames) = (Painter::new(&maps, mesh), Frames::new(maps.clone()));
        Ok(Box::new(OnCpu { adapter: self.adapter.clone(), maps, painter, frames }))
    }
}

/// Renders a scene on the CPU.
struct OnCpu {
    adapter: Adapter,
    maps: Arc<Maps>,
    painter: Painter,
    frames: Frames,
}

impl Renderer for OnCpu {
    fn adapter(&self) -> &Adapter {
        &self.adapter
    }

    fn patch(&mut self, job: &PatchJob) -> Result<(), RenderError> {
        self.painter.patch(job);
        Ok(())
    }

    fn paint(&mut self, painting: &Arc<Painting>) -> Result<(), RenderError> {
        self.painter.paint(painting);
        Ok(())
    }

    fn follow(&mut self, paintings: &[Arc<Painting>]) -> Result<(), RenderError> {
        self.painter.follow(paintings);
        Ok(())
    }

    fn check_patch(&mut self, job: &PatchJob) -> Result<Vec<Check>, RenderError> {
        Ok(self.painter.check_patch(job))
    }

    fn check_paint(&mut self) -> Result<Vec<Check>, RenderError> {
        Ok(self.painter.check_paint())
    }

    fn frame(&mut self, job: &FrameJob<'_>) -> Result<Frame, RenderError> {
        self.frames.frame(job, self.painter.color(), self.painter.discolor())
    }

    fn map(&mut self, map: MapId) -> Result<Image, RenderError> {
        Ok(match map {
            MapId::Color => self.painter.color(),
            MapId::Discolor => self.painter.discolor(),
            MapId::Normal => &self.maps.normal,
            MapId::Occlusion => &self.maps.occlusion,
            MapId::Specular => &self.maps.specular,
        }
        .clone())
    }
}
