//! Those who carry out what [`canvas`](crate::canvas) asks.
//!
//! | module | what it does |
//! | --- | --- |
//! | [`reference`] | on the CPU: the oracle |
//! | [`spans`] | which texels a triangle covers |
//! | [`mask`] | which texels the skin covers |
//! | [`layout`] | what a painting touches: triangles and tiles |
//! | [`inspect`] | GP's and PP's invariants of pixels |

pub mod inspect;
pub mod layout;
pub mod mask;
pub mod reference;
pub mod spans;
