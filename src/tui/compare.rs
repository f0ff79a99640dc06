//! What a run is compared with, and how it differs.

/// See the module.
#[derive(Clone, Debug, Default)]
pub(in crate::tui) struct Differences {}
