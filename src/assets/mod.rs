//! assets
pub mod builtin;
