//! Cutting wounds on a skin surface (Lam 2016, chapters 3, 4 and 6).
//!
//! | stage | module | what it does |
//! | --- | --- | --- |
//! | FC | [`form`], [`settle`] | forms the cutting line on the surface |
//! | GP | [`patch`] | says how large its wound patch is, and what is drawn on it |
//! | PP | [`paint`], [`surface`] | lays it on the skin around the line |
//! | MC | [`merge`] | merges it into the mesh |
//! | CI | [`carve`] | opens it, and makes the gutter |
//! | SD | [`subdivide`] | divides the face under a pixel |
//!
//! A cut begins as two picks ([`pick`]); together with the eye they span the cutting plane ([`plane`]), and from there on every
//! decision is the exact sign of something. What a stage promises is looked at by `checks`, by other means than those that made it.

pub mod camera;
pub mod carve;
pub mod chain;
mod checks;
mod engine;
mod event;
pub mod flat;
pub mod form;
pub mod merge;
pub mod paint;
pub mod patch;
pub mod pattern;
pub mod pick;
pub mod plane;
mod settings;
pub mod settle;
mod show;
mod stages;
mod state;
pub mod subdivide;
pub mod surface;
#[cfg(test)]
mod tests;
mod view;

pub use engine::Wound;
pub use event::{CameraChange, Mode, Pick, Value, WoundEvent};
pub use settings::{SETTINGS, Setting, Takes};
pub use state::{Control, Cut, Edit, Scene, State, Work};
pub use view::{Bounds, Seen};
