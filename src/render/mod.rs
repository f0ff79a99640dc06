//! Pixels: who carries out what [`canvas`](crate::canvas) defines.
//!
//! | module | what it does |
//! | --- | --- |
//! | [`kernel`], [`beckmann`], [`srgb`] | tables that every renderer takes from here, so that they differ in nothing but arithmetic |

pub mod beckmann;
pub mod kernel;
pub mod srgb;
