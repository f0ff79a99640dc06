//! The terminal's screen.

pub mod image;
