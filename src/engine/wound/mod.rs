//! Cutting wounds on a skin surface (Lam 2016, chapters 3, 4 and 6).

mod event;

pub use event::{CameraChange, Mode, Pick, SETTINGS, Value, WoundEvent};
