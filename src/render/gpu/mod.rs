//! The GPU renderer: the passes of the CPU reference in wgpu and WGSL, over Vulkan.

pub mod device;
pub mod painter;
pub mod readback;
pub(crate) mod shaders;
