//! What users of the reference rely on: formulas worked out again here in f64, figures of known geometry, and the promises about
//! skips and threads.

mod frames;
mod kit;
mod raster;
mod scattering;
mod shading;
mod shadows;
mod wild;
