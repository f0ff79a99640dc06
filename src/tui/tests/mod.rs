//! Whole screens: how they look, and that no key breaks one.

mod keys;
mod screens;
pub(in crate::tui) mod suite;
mod written;

use std::path::Path;

use super::theme::Theme;
use super::{Stage, Start, With};
use crate::render::Choice;

/// The screen with a recording open, in front of the CPU reference, with times that depend on no machine.
fn opened(recording: &Path, compare: Option<With>, theme: Theme, size: [u16; 2]) -> Stage {
    let start = Start {
        recording: Some(recording.to_owned()),
        renderer: Choice::Reference,
        budget_bytes: 64 << 20,
        compare,
        ..Start::default()
    };
    Stage::open(&start, theme, size, true)
}
