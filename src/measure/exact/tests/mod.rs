//! The exact way against what is known, and the engine against the exact way.

mod agree;
mod known;
