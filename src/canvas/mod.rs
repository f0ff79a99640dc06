//! What can be asked of pixels, as data: paint jobs, frame jobs, maps, and the traits of those who carry them out. No pixels are made here.
//!
//! An engine emits jobs and knows no renderer. The session hands them to a [`Renderer`] that a front end gave it; there are two, the CPU
//! reference (the oracle) and the GPU, and both carry out what is defined here:
//!
//! | module | what it defines |
//! | --- | --- |
//! | [`image`] | images, maps and how they are sampled |
//! | [`look`] | what a scene says about light, skin and wounds |
//! | [`job`] | GP's patch and PP's painting, texel by texel |
//! | [`frame`] | a view, and the picture that it gives, pixel by pixel |
//!
//! **Maps follow the jobs.** The maps of a renderer are a function of the list of paintings that were applied to the scene's own maps. So
//! undo, seek and rejection need no map in the state: [`Renderer::follow`] is given the list and makes the maps those of exactly
//! this list, bit for bit, from 64² tiles that were saved, or by carrying the jobs out again.

pub mod frame;
pub mod image;
pub mod job;
pub mod look;

use std::fmt;
use std::sync::Arc;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::mesh::Mesh;
use crate::report::Check;
use frame::{Frame, FrameJob};
use image::{Image, MapId, Maps};
use job::{Painting, PatchJob};

/// What kind of renderer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// The CPU reference.
    Reference,
    /// A GPU, or a program that plays one.
    Gpu,
}

/// Who renders.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Adapter {
    /// What kind of renderer.
    pub kind: Kind,
    /// The device's name, such as `llvmpipe (LLVM 15.0.6, 256 bits)`; of the reference, `CPU reference`.
    pub name: String,
    /// The driver and its version; empty for the reference.
    pub driver: String,
    /// The interface it is driven through, such as `vulkan`; empty for the reference.
    pub backend: String,
    /// blake3 of the shaders' text, 32 hexadecimal digits; empty for the reference.
    pub shaders: String,
}

impl fmt::Display for Adapter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.name)?;
        if self.driver.is_empty() { Ok(()) } else { write!(f, " ({}, {})", self.backend, self.driver) }
    }
}

/// Why something was not rendered: the renderer cannot, not the job's fault.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum RenderError {
    /// There is no adapter.
    NoAdapter(String),
    /// The device was lost.
    Lost(String),
    /// The device or the machine has not the memory, or not the limits, for this.
    TooLarge(String),
    /// The interface refused a command: a defect of this program.
    Refused(String),
}

impl fmt::Display for RenderError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoAdapter(why) => write!(f, "no adapter: {why}"),
            Self::Lost(why) => write!(f, "the device was lost: {why}"),
            Self::TooLarge(why) => write!(f, "too large for the device: {why}"),
            Self::Refused(why) => write!(f, "the device refused: {why}"),
        }
    }
}

impl std::error::Error for RenderError {}

/// Makes renderers: one device, many scenes.
pub trait Studio: Send + Sync {
    /// Who renders.
    fn adapter(&self) -> &Adapter;
    /// A renderer of a scene: its maps before any cut, and its mesh, of which only the faces' texture coordinates matter here.
    fn open(&self, maps: Arc<Maps>, mesh: &Mesh) -> Result<Box<dyn Renderer>, RenderError>;
}

/// Carries jobs out, and renders frames of one scene.
pub trait Renderer: Send {
    /// Who renders.
    fn adapter(&self) -> &Adapter;
    /// Makes the wound patch of a cut, and waits until it is there. It is the one that the next painting uses.
    fn patch(&mut self, job: &PatchJob) -> Result<(), RenderError>;
    /// Carries a painting out over those that were carried out before, and waits for it. Its patch need not be made again if it
    /// is the one that [`Renderer::patch`] made last.
    fn paint(&mut self, painting: &Arc<Painting>) -> Result<(), RenderError>;
    /// Makes the maps those of these paintings, in this order, whatever was painted before.
    fn follow(&mut self, paintings: &[Arc<Painting>]) -> Result<(), RenderError>;
    /// Looks at the texels of the patch that was made last: GP's invariants `border` and `palette`.
    fn check_patch(&mut self, job: &PatchJob) -> Result<Vec<Check>, RenderError>;
    /// Looks at the texels that the last painting changed: PP's invariants `within` and `finite`.
    fn check_paint(&mut self) -> Result<Vec<Check>, RenderError>;
    /// Renders a frame.
    fn frame(&mut self, job: &FrameJob<'_>) -> Result<Frame, RenderError>;
    /// A map as it is now.
    fn map(&mut self, map: MapId) -> Result<Image, RenderError>;
}
