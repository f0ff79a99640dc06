//! What users of the GPU renderer rely on. Without an adapter they say so and pass, unless LANCET_GPU=require.

mod bounds;
mod frames;
pub(crate) mod kit;
mod shaders;
mod skips;
