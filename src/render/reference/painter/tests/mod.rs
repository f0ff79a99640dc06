//! Patches and paintings: by the formulas, on charts, and as the list of paintings changes.

mod charts;
mod follow;
mod kit;
mod pixels;
