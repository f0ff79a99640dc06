//! The CPU reference: the oracle for pixels.

pub mod painter;
