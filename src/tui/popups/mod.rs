//! What lies over the panes.

use ratatui::buffer::Buffer;

use super::keys::Keys;
use super::model::Model;
use super::theme::Theme;

/// See the module.
#[derive(Clone, Debug)]
pub(in crate::tui) enum Popup {
    /// All keys.
    Help,
}

pub(super) fn draw(_model: &Model, _theme: &Theme, _keys: &Keys, _buffer: &mut Buffer) {}
