//! Those who make pixels.

#[cfg(feature = "gpu")]
pub mod gpu;
