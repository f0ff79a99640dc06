//! Rows of a pane: those in view, the chosen one, what is selected, what a search found, and a scroll bar where there are more.
//!
//! ```text
//! ◆ FE  f1686  f1686  e5033  0.093566 ┃
//!   EE  f9051  e5033  e10014 0.251023 │
//! ```
//!
//! A pane gives the line of a row, and the text of all of them, in which a search looks. What is found is marked in what is drawn, cell by cell, so
//! that it does not matter how a pane cuts its words; a row whose match is cut off is marked at its beginning.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use ratatui::text::{Line, Span};
use ratatui::widgets::Widget;

use crate::tui::model::{Model, Pane};
use crate::tui::theme::{Role, Theme};
use crate::tui::{list::List, text};

/// Draws the rows of a pane. `row` gives the line of a row for a number of cells.
pub(super) fn draw(
    pane: Pane,
    model: &Model,
    theme: &Theme,
    area: Rect,
    buffer: &mut Buffer,
    row: impl Fn(usize, usize) -> Line<'static>,
) {
    let Some(list) = model.lists.get(pane) else { return };
    let len = super::len(model, pane);
    let shown = list.window(area.height as usize, len);
    let width = area.width.saturating_sub(u16::from(shown.len() < len));
    let found = Found::of(pane, model, theme);
    for (y, at) in (area.y..).zip(shown) {
        let line = Rect { y, width, height: 1, ..area };
        let chosen = list.selected(len) == Some(at);
        if chosen && model.focus != pane {
            buffer.set_style(line, theme.style(Role::Idle));
        }
        row(at, width as usize).render(line, buffer);
        // In the pane that has the keys the row is one piece, or its marks would be lost on its ground.
        if chosen && model.focus == pane {
            buffer.set_style(line, theme.style(Role::Selected));
        }
        found.show(at, line, buffer);
    }
    bar(list, len, theme, area, buffer);
}

/// The scroll bar, in the last column.
fn bar(list: &List, len: usize, theme: &Theme, area: Rect, buffer: &mut Buffer) {
    let height = area.height as usize;
    if area.width == 0 || len <= height {
        return;
    }
    for (row, y) in (area.y..area.bottom()).enumerate() {
        let at = Rect { x: area.right() - 1, y, width: 1, height: 1 };
        Span::styled(list.bar(row, height, len), theme.style(Role::Border)).render(at, buffer);
    }
}

/// Says why there are no rows.
pub(super) fn nothing(why: &str, theme: &Theme, area: Rect, buffer: &mut Buffer) {
    let line = Rect { height: area.height.min(1), ..area };
    Line::styled(text::fit(why, area.width as usize), theme.style(Role::Faint)).render(line, buffer);
}

/// A mark for a row that has something to do with what is selected, or as many blanks.
pub(super) fn mark(selected: bool, theme: &Theme) -> Span<'static> {
    match selected {
        true => Span::styled(format!("{} ", Role::Marked.mark()), theme.style(Role::Marked)),
        false => Span::raw("  "),
    }
}

/// What a search found in a pane.
struct Found {
    needle: String,
    texts: Vec<String>,
    style: Style,
}

impl Found {
    fn of(pane: Pane, model: &Model, theme: &Theme) -> Self {
        let needle = model.search.to_lowercase();
        let texts = if needle.is_empty() { Vec::new() } else { super::texts(model, pane) };
        Self { needle, texts, style: theme.style(Role::Match) }
    }

    /// Marks what was found in a row that is drawn.
    fn show(&self, row: usize, line: Rect, buffer: &mut Buffer) {
        if !self.texts.get(row).is_some_and(|text| text.to_lowercase().contains(&self.needle)) {
            return;
        }
        let cells = cells(line, buffer);
        let drawn: String = cells.iter().map(|(_, symbol)| symbol.as_str()).collect();
        let found: Vec<usize> = drawn.match_indices(&self.needle).map(|(at, _)| at).collect();
        let mut from = 0;
        for (at, symbol) in &cells {
            let to = from + symbol.len();
            if found.iter().any(|found| from < found + self.needle.len() && *found < to) {
                buffer.set_style(*at, self.style);
            }
            from = to;
        }
        if found.is_empty() {
            buffer.set_style(Rect { width: line.width.min(1), ..line }, self.style);
        }
    }
}

/// The cells of a line and what they show, in lower case. The second cell of a wide character is part of the first.
fn cells(line: Rect, buffer: &Buffer) -> Vec<(Rect, String)> {
    let (mut cells, mut x) = (Vec::new(), line.x);
    while x < line.right() {
        let Some(cell) = buffer.cell((x, line.y)) else { break };
        let width = (text::width(cell.symbol()) as u16).clamp(1, line.right() - x);
        cells.push((Rect { x, width, height: 1, ..line }, cell.symbol().to_lowercase()));
        x += width;
    }
    cells
}
