//! The CPU reference: every pixel as [`canvas`](crate::canvas) defines it, written from the papers and not from the shaders.
//!
//! f32 and f64 `+ − × ÷ √` and libm alone, work shared out by rows and never by time: the same bytes on every machine, and with
//! any number of threads.
//!
//! | file | what it does |
//! | --- | --- |
//! | `frames` | the passes, one after the other |
//! | `lens`, `clip`, `raster` | what an eye or a light sees: projection, clipping, coverage and depth |
//! | `shadow` | shadow maps, and what is read of them |
//! | `surface`, `sample` | what is at a pixel, and what it is made of |
//! | `lighting` | the light that leaves it |
//! | `skin`, `scatter`, `compose` | the passes over the picture, and `layers`, what they hand on |

mod clip;
mod compose;
mod frames;
mod layers;
mod lens;
mod lighting;
mod raster;
mod sample;
mod scatter;
mod shadow;
mod skin;
mod surface;

pub use frames::Frames;
