//! Pixels: those who carry out what [`canvas`](crate::canvas) asks.
//!
//! | module | what it does |
//! | --- | --- |
//! | [`mod@reference`] | on the CPU: the oracle, written from the papers; the same bytes on every machine |
//! | `gpu` | on a GPU: wgpu, over Vulkan |
//! | [`kernel`], [`beckmann`], [`srgb`] | tables that every renderer takes from here, so that they differ in nothing but arithmetic |
//! | [`spans`] | which texels a triangle covers |
//! | [`mask`] | which texels the skin covers |
//! | [`layout`] | what a painting touches: triangles and tiles |
//! | [`overlay`] | what is drawn over a frame |
//! | [`inspect`] | GP's and PP's invariants of pixels |
//!
//! A front end asks for a [`studio`] and hands it on. Nobody else knows which renderer it is.

pub mod beckmann;
#[cfg(feature = "gpu")]
pub mod gpu;
pub mod inspect;
pub mod kernel;
pub mod layout;
pub mod mask;
pub mod overlay;
pub mod reference;
pub mod spans;
pub mod srgb;

use crate::canvas::{RenderError, Studio};

/// Who is to render.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Choice {
    /// A GPU if there is one, else the CPU reference.
    #[default]
    Auto,
    /// A GPU, or a program that plays one.
    Gpu,
    /// The CPU reference.
    Reference,
}

/// Opens a studio of this choice.
pub fn studio(choice: Choice) -> Result<Box<dyn Studio>, RenderError> {
    match choice {
        Choice::Gpu => gpu(),
        Choice::Auto => gpu().or_else(|_| Ok(Box::new(reference::Reference::new()))),
        Choice::Reference => Ok(Box::new(reference::Reference::new())),
    }
}

#[cfg(feature = "gpu")]
fn gpu() -> Result<Box<dyn Studio>, RenderError> {
    Ok(Box::new(gpu::Gpu::open()?))
}

#[cfg(not(feature = "gpu"))]
fn gpu() -> Result<Box<dyn Studio>, RenderError> {
    Err(RenderError::NoAdapter("this program was built without the feature `gpu`".into()))
}

/// Clamps to 0 … 1; a NaN counts as 0.
#[inline]
pub(crate) fn sat(x: f32) -> f32 {
    if x > 0.0 { x.min(1.0) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::canvas::Kind;

    #[test]
    fn there_is_always_somebody_who_renders() {
        assert_eq!(studio(Choice::Reference).map(|s| s.adapter().kind), Ok(Kind::Reference));
        assert!(studio(Choice::Auto).is_ok());
    }
}
