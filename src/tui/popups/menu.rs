//! A list to choose from: typing finds rows, and what the chosen one is about stands below.
//!
//! ```text
//! ┌ title ────────────────────────────┐
//! │ / rec█                            │  what is typed, where rows can be found by it
//! │ ▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒┃│  rows; on their right what belongs to them
//! │ record-new                  ctrl-n││
//! │ about the chosen row              │  where there is room for it
//! └ enter do it · esc close ──────────┘
//! ```
//!
//! Each menu has a file of its own that says which rows there are; this one draws them all.

use std::path::PathBuf;

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use ratatui::widgets::Widget;

use super::{frame, help, leave, open, palette, stops};
use crate::tui::edit::Edit;
use crate::tui::keys::Keys;
use crate::tui::list::List;
use crate::tui::model::Model;
use crate::tui::text;
use crate::tui::theme::{Role, Theme};

/// What there is to choose.
#[derive(Clone, Debug)]
pub(in crate::tui) enum What {
    /// The keys, by where they count.
    Help,
    /// The actions.
    Palette,
    /// The breakpoints.
    Stops,
    /// The recordings that were found.
    Open(Vec<PathBuf>),
    /// What becomes of a recording that is not saved.
    Leave,
}

/// See the module.
#[derive(Clone, Debug)]
pub(in crate::tui) struct Menu {
    /// What there is to choose.
    pub(in crate::tui) what: What,
    /// What rows are found by.
    pub(in crate::tui) edit: Edit,
    /// Which is chosen.
    pub(in crate::tui) list: List,
    /// What is wrong with what was typed.
    pub(in crate::tui) error: Option<String>,
}

/// What rows are drawn with.
#[derive(Clone, Copy)]
pub(super) struct Pen<'a> {
    pub(super) model: &'a Model,
    pub(super) theme: &'a Theme,
    pub(super) keys: &'a Keys,
    /// What was typed to find rows.
    pub(super) typed: &'a str,
}

/// A row as it is drawn.
#[derive(Default)]
pub(super) struct Row {
    /// From the left.
    pub(super) left: Line<'static>,
    /// At the right, where there is room for it.
    pub(super) right: Line<'static>,
    /// What it is about.
    pub(super) about: Vec<String>,
}

/// The parts of a menu.
pub(super) struct Parts {
    pub(super) edit: Rect,
    pub(super) list: Rect,
    pub(super) about: Rect,
}

/// The lines below the list.
const ABOUT: u16 = 2;
/// Below this many rows all are for the list.
const LEAST: u16 = 6;

impl Menu {
    /// With the first row chosen.
    pub(in crate::tui) fn new(what: What) -> Self {
        Self { what, edit: Edit::default(), list: List::default(), error: None }
    }

    /// Whether rows are found by typing; else letters are keys of the menu's own.
    pub(in crate::tui) fn finds(&self) -> bool {
        !matches!(self.what, What::Stops | What::Leave)
    }

    /// How many rows there are.
    pub(in crate::tui) fn len(&self, model: &Model) -> usize {
        let typed = self.edit.text();
        match &self.what {
            What::Help => help::entries(typed).len(),
            What::Palette => palette::entries(&model.memory, typed).len(),
            What::Stops => model.stops.len(),
            What::Open(files) => open::entries(model, files, typed).len(),
            What::Leave => leave::CHOICES.len(),
        }
    }

    pub(super) fn wants(&self, model: &Model) -> [usize; 2] {
        match self.what {
            What::Help => [100, usize::MAX],
            What::Palette | What::Open(_) => [90, 26],
            What::Stops => [64, (model.stops.len() + 6).clamp(9, 20)],
            What::Leave => [60, leave::CHOICES.len() + 5],
        }
    }

    pub(super) fn words(&self) -> [&'static str; 2] {
        match self.what {
            What::Help => ["keys", "type to find · esc close"],
            What::Palette => ["actions", "enter do it · esc close"],
            What::Stops => ["breakpoints", "a add · d drop · enter go to the next · esc close"],
            What::Open(_) => {
                ["open a recording, or begin one", "enter open · tab complete a path · esc close"]
            }
            What::Leave => ["the recording is not saved", "enter do it · esc stay"],
        }
    }

    /// Where its parts are within its border.
    pub(super) fn parts(&self, inner: Rect) -> Parts {
        let edit = u16::from(self.finds()).min(inner.height);
        let about = if inner.height >= LEAST { ABOUT } else { 0 };
        let height = inner.height - edit - about;
        Parts {
            edit: Rect { height: edit, ..inner },
            list: Rect { y: inner.y + edit, height, ..inner },
            about: Rect { y: inner.y + edit + height, height: about, ..inner },
        }
    }

    fn rows(&self, pen: Pen<'_>, width: usize) -> Vec<Row> {
        match &self.what {
            What::Help => help::rows(pen, width),
            What::Palette => palette::rows(pen),
            What::Stops => stops::rows(pen),
            What::Open(files) => open::rows(pen, files),
            What::Leave => leave::rows(pen),
        }
    }

    /// What is said where there are no rows.
    fn none(&self) -> &'static str {
        match self.what {
            What::Stops => "no breakpoints: `a` adds one",
            _ => "nothing is called so",
        }
    }

    pub(super) fn draw(&self, model: &Model, theme: &Theme, keys: &Keys, inner: Rect, buffer: &mut Buffer) {
        let Parts { edit, list, about } = self.parts(inner);
        let pen = Pen { model, theme, keys, typed: self.edit.text() };
        if !edit.is_empty() {
            self.draw_edit(theme, edit, buffer);
        }
        let rows = self.rows(pen, usize::from(list.width));
        let chosen = self.list.selected(rows.len());
        for (below, row) in self.list.window(usize::from(list.height), rows.len()).enumerate() {
            let line = frame::row(list, below);
            if chosen == Some(row) {
                buffer.set_style(line, theme.style(Role::Selected));
            }
            draw_row(&rows[row], line, buffer);
            let bar = self.list.bar(below, usize::from(list.height), rows.len());
            Line::styled(bar, theme.style(Role::Faint)).right_aligned().render(line, buffer);
        }
        let said = match (chosen, &self.error) {
            (_, Some(error)) => (vec![format!("{} {error}", Role::Bad.mark())], Role::Bad),
            (Some(chosen), None) => (rows[chosen].about.clone(), Role::Faint),
            (None, None) => (vec![self.none().to_owned()], Role::Faint),
        };
        // Without room of its own, an error takes the place of rows.
        let about = if about.is_empty() && self.error.is_some() { list } else { about };
        say(&said.0, theme, said.1, about, buffer);
    }

    fn draw_edit(&self, theme: &Theme, area: Rect, buffer: &mut Buffer) {
        let mark = Line::styled("/ ", theme.style(Role::Key));
        let width = (mark.width() as u16).min(area.width);
        mark.render(area, buffer);
        frame::edit(&self.edit, theme, Rect { x: area.x + width, width: area.width - width, ..area }, buffer);
    }
}

/// The left part takes what the right one leaves; a column is for the scroll bar.
fn draw_row(row: &Row, area: Rect, buffer: &mut Buffer) {
    let width = area.width.saturating_sub(1);
    let right = u16::try_from(row.right.width()).unwrap_or(u16::MAX);
    // The right part is worth having only beside something.
    let right = if right < width / 2 { right } else { 0 };
    let gap = u16::from(right > 0);
    (&row.left).render(Rect { width: width - right - gap, ..area }, buffer);
    (&row.right).render(Rect { x: area.x + width - right, width: right, ..area }, buffer);
}

/// Each on a line of its own, or broken into several where that is all there is.
fn say(said: &[String], theme: &Theme, role: Role, area: Rect, buffer: &mut Buffer) {
    let width = usize::from(area.width);
    let lines = match said {
        [one] => text::wrap(one, width, usize::from(area.height)),
        several => several.iter().map(|line| text::fit(line, width)).collect(),
    };
    frame::lines(&lines, theme.style(role), area, 0, buffer);
}

/// A text with the letters marked that were found in it.
pub(super) fn marked(said: &str, at: &[usize], role: Role, theme: &Theme) -> Vec<Span<'static>> {
    let mut spans: Vec<Span<'static>> = Vec::new();
    let mut was = None;
    for (place, c) in said.chars().enumerate() {
        let is = at.contains(&place);
        match spans.last_mut().filter(|_| was == Some(is)) {
            Some(span) => span.content.to_mut().push(c),
            None => {
                let role = if is { Role::Match } else { role };
                spans.push(Span::styled(c.to_string(), theme.style(role)));
            }
        }
        was = Some(is);
    }
    spans
}

/// As many blanks as a text needs to fill a column.
pub(super) fn blanks(said: &str, width: usize) -> Span<'static> {
    Span::raw(" ".repeat(width.saturating_sub(text::width(said))))
}
