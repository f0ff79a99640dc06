//! The GPU renderer: what [`canvas`](crate::canvas) defines, in wgpu and WGSL, over Vulkan.
//!
//! One file a pass, and its shader by the same name: `shadow`, `skin`, `tiles`, `scatter`, `compose`. [`device`] is where everything
//! that can fail does, as a value; [`frames`] puts the passes together.
//!
//! Maps are loaded texel by texel, decoded and mixed in the shaders, in f32: hardware filters differ from device to device. Light is
//! kept in half floats between the passes, which is where frames differ most from the CPU reference's.

mod bindings;
mod compose;
pub mod device;
pub mod frames;
mod lens;
mod mesh;
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
