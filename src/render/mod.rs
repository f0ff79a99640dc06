//! Pixels: who carries out what [`canvas`](crate::canvas) defines.
//!
//! | module | what it does |
//! | --- | --- |
//! | [`reference`] | the CPU: the oracle, written from the papers; the same bytes on every machine |
//! | [`kernel`], [`beckmann`], [`srgb`] | tables that every renderer takes from here, so that they differ in nothing but arithmetic |

pub mod beckmann;
pub mod kernel;
pub mod reference;
pub mod srgb;

/// Clamps to 0 … 1; a NaN counts as 0.
#[inline]
pub(crate) fn sat(x: f32) -> f32 {
    if x > 0.0 { x.min(1.0) } else { 0.0 }
}
