//! What lies over the panes: one thing at a time, in the middle of the screen, sized to it.
//!
//! ```text
//! ┌ panes ──────────────────────────┐
//! │  ┌ title ────────────────────┐  │
//! │  │ content                   │  │
//! │  └ what the keys do ─────────┘  │
//! └─────────────────────────────────┘
//! ```
//!
//! A popup has its keys, and draws itself; what its keys do is in `update::popup`. It takes what it wants of the screen, or all there is; where there
//! is no room for a border it does without.

mod frame;
mod prompt;

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use super::keys::Keys;
use super::model::Model;
use super::theme::Theme;

pub(in crate::tui) use prompt::{Prompt, Question};

/// See the module.
#[derive(Clone, Debug)]
pub(in crate::tui) enum Popup {
    /// A question that is answered by typing a line.
    Prompt(Prompt),
}

impl Popup {
    /// Columns and rows that it wants, border and all.
    fn wants(&self, _model: &Model) -> [usize; 2] {
        match self {
            Self::Prompt(prompt) => prompt.wants(),
        }
    }

    /// Its title, and what its keys do.
    fn words(&self) -> [String; 2] {
        match self {
            Self::Prompt(prompt) => prompt.words(),
        }
    }
}

/// Where the popup is, border and all; nowhere if there is none.
pub(in crate::tui) fn area(model: &Model) -> Rect {
    model.popup.as_ref().map_or(Rect::ZERO, |popup| frame::area(model.size, popup.wants(model)))
}

pub(super) fn draw(model: &Model, theme: &Theme, _keys: &Keys, buffer: &mut Buffer) {
    let Some(popup) = &model.popup else { return };
    let inner = frame::draw(area(model), &popup.words(), theme, buffer);
    match popup {
        Popup::Prompt(prompt) => prompt.draw(theme, inner, buffer),
    }
}
