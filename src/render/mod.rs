//! Pixels: who carries out what [`canvas`](crate::canvas) defines.
//!
//! | module | what it does |
//! | --- | --- |
//! | [`kernel`], [`beckmann`], [`srgb`] | tables that every renderer takes from here, so that they differ in nothing but arithmetic |
//! | `gpu` | the GPU renderer: wgpu, over Vulkan |

pub mod beckmann;
#[cfg(feature = "gpu")]
pub mod gpu;
pub mod kernel;
pub mod srgb;
