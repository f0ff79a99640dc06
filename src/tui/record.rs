//! The recording that is being made.

/// See the module.
#[derive(Clone, Debug, Default)]
pub(in crate::tui) struct Recorder {}
