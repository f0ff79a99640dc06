//! The tables of the report, one at a time, and what was counted as the last of them.
//!
//! ```text
//!   configuration  face   from   to       length
//! ◆ FE             f1686  f1686  e5033  0.093566
//!   EE             f9051  e5033  e10014 0.251023
//! ```

use std::borrow::Cow;

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use ratatui::widgets::Widget;

use super::grid::Grid;
use super::rows;
use crate::report::{Counter, Counters, Row, Table};
use crate::tui::model::{Model, Pane};
use crate::tui::text;
use crate::tui::theme::{Role, Theme};

/// Cells for the mark of a row.
const MARK: usize = 2;

/// The table that is shown.
fn table(model: &Model) -> Option<Cow<'_, Table>> {
    let report = model.shown()?;
    let at = model.table % count(model).max(1);
    let counted = || (!report.counters.is_empty()).then(|| Cow::Owned(counted(&report.counters)));
    report.tables.get(at).map(Cow::Borrowed).or_else(counted)
}

/// How many tables there are.
fn count(model: &Model) -> usize {
    model.shown().map_or(0, |report| report.tables.len() + usize::from(!report.counters.is_empty()))
}

/// The counters as a table.
fn counted(counters: &Counters) -> Table {
    let row = |cells: [String; 2]| Row { ids: Vec::new(), cells: cells.to_vec() };
    let rows = counters.iter().flat_map(|(name, counter)| match counter {
        Counter::Count(count) => vec![row([name.clone(), count.to_string()])],
        Counter::ByName(counts) => {
            counts.iter().map(|(by, count)| row([format!("{name} {by}"), count.to_string()])).collect()
        }
    });
    Table { title: "counters".into(), columns: vec!["counter".into(), "count".into()], rows: rows.collect() }
}

/// Goes on to the next table.
pub(super) fn next(model: &mut Model) {
    model.table = (model.table + 1) % count(model).max(1);
    model.lists.tables.top();
}

pub(super) fn about(model: &Model) -> String {
    let Some(table) = table(model) else { return String::new() };
    let title = text::line(&table.title);
    let rows = text::count(table.rows.len() as u64);
    match count(model) {
        1 => format!("{title} ({rows})"),
        of => format!("{title} ({rows}), {} of {of}", model.table % of + 1),
    }
}

pub(super) fn len(model: &Model) -> usize {
    table(model).map_or(0, |table| table.rows.len())
}

pub(super) fn ids(model: &Model) -> Vec<String> {
    let Some(table) = table(model) else { return Vec::new() };
    let row = model.lists.tables.selected(table.rows.len());
    row.map_or(Vec::new(), |row| table.rows[row].ids.clone())
}

/// The rows that have something to do with what is selected.
pub(super) fn marked(model: &Model) -> Vec<usize> {
    let Some(table) = table(model) else { return Vec::new() };
    (0..table.rows.len()).filter(|row| model.any_selected(&table.rows[*row].ids)).collect()
}

pub(super) fn texts(model: &Model) -> Vec<String> {
    table(model).map_or(Vec::new(), |table| table.rows.iter().map(|row| row.cells.join("\t")).collect())
}

/// The heads, as [`texts`] are.
pub(super) fn head(model: &Model) -> String {
    table(model).map_or(String::new(), |table| table.columns.join("\t"))
}

/// Why there is nothing to see.
pub(super) fn nothing(model: &Model) -> &'static str {
    if model.shown().is_some() { "no tables at this event" } else { "no event has run here" }
}

/// Draws the heads in the first line, and the rows in `body`.
pub(super) fn draw(model: &Model, theme: &Theme, area: Rect, body: Rect, buffer: &mut Buffer) {
    let Some(table) = table(model) else { return };
    let grid = Grid::new(&table.columns, table.rows.iter().map(|row| row.cells.clone()));
    // The heads leave the scroll bar's column alone, so that they stand over their columns.
    let bar = usize::from(table.rows.len() > body.height as usize);
    let head = grid.head((area.width as usize).saturating_sub(MARK + bar));
    if body.y > area.y {
        let line = vec![Span::raw(" ".repeat(MARK)), Span::styled(head, theme.style(Role::Faint))];
        Line::from(line).render(Rect { height: 1, ..area }, buffer);
    }
    rows::draw(Pane::Tables, model, theme, body, buffer, |row, width| {
        let mark = rows::mark(model.any_selected(&table.rows[row].ids), theme);
        Line::from(vec![mark, Span::raw(grid.line(row, width.saturating_sub(MARK)))])
    });
}
