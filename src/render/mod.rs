//! Those who carry out what [`canvas`](crate::canvas) asks.
//!
//! | module | what it does |
//! | --- | --- |
//! | [`reference`] | on the CPU: the oracle |
//! | `gpu` | the same passes in wgpu and WGSL, over Vulkan |
//! | [`spans`] | which texels a triangle covers |
//! | [`mask`] | which texels the skin covers |
//! | [`layout`] | what a painting touches: triangles and tiles |
//! | [`inspect`] | GP's and PP's invariants of pixels |

#[cfg(feature = "gpu")]
pub mod gpu;
pub mod inspect;
pub mod layout;
pub mod mask;
pub mod reference;
pub mod spans;
