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
//! A popup has its keys, and draws itself; what its keys do is in `update::popup`. It takes what it wants of the screen between title and status
//! line, or all there is; where there is no room for a border it does without.

mod frame;
mod help;
mod leave;
mod menu;
mod open;
mod palette;
mod prompt;
mod stops;

use ratatui::buffer::Buffer;
use ratatui::layout::{Position, Rect};

use super::keys::Keys;
use super::model::Model;
use super::theme::Theme;

pub(in crate::tui) use leave::{CHOICES as LEAVE, Choice as Leave};
pub(in crate::tui) use menu::{Menu, What};
pub(in crate::tui) use open::{Entry as Opens, entries as opens};
pub(in crate::tui) use palette::entries as actions;
pub(in crate::tui) use prompt::{Prompt, Question};

/// See the module.
#[derive(Clone, Debug)]
pub(in crate::tui) enum Popup {
    /// A question that is answered by typing a line.
    Prompt(Prompt),
    /// A list to choose from.
    Menu(Menu),
}

impl Popup {
    /// Columns and rows that it wants, border and all.
    fn wants(&self, model: &Model) -> [usize; 2] {
        match self {
            Self::Prompt(prompt) => prompt.wants(),
            Self::Menu(menu) => menu.wants(model),
        }
    }

    /// Its title, and what its keys do.
    fn words(&self) -> [String; 2] {
        match self {
            Self::Prompt(prompt) => prompt.words(),
            Self::Menu(menu) => menu.words().map(str::to_owned),
        }
    }

    /// Where it is, border and all.
    pub(in crate::tui) fn area(&self, model: &Model) -> Rect {
        frame::area(model.size, self.wants(model))
    }
}

/// Where the rows of a menu are.
pub(in crate::tui) fn rows_area(model: &Model, menu: &Menu) -> Rect {
    menu.parts(frame::inner(frame::area(model.size, menu.wants(model)))).list
}

/// The row of a menu that is drawn in a cell.
pub(in crate::tui) fn row_at(model: &Model, menu: &Menu, at: Position) -> Option<usize> {
    let area = rows_area(model, menu);
    let below = area.contains(at).then(|| usize::from(at.y - area.y))?;
    menu.list.row_at(below, usize::from(area.height), menu.len(model))
}

pub(super) fn draw(model: &Model, theme: &Theme, keys: &Keys, buffer: &mut Buffer) {
    let Some(popup) = &model.popup else { return };
    let inner = frame::draw(popup.area(model), &popup.words(), theme, buffer);
    match popup {
        Popup::Prompt(prompt) => prompt.draw(theme, inner, buffer),
        Popup::Menu(menu) => menu.draw(model, theme, keys, inner, buffer),
    }
}

#[cfg(test)]
mod tests;
