//! The tables of the report.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::Line;
use ratatui::widgets::Widget;

use crate::report::Table;
use crate::tui::model::Model;
use crate::tui::theme::Theme;

fn table(model: &Model) -> Option<&Table> {
    let tables = &model.shown()?.tables;
    tables.get(model.table % tables.len().max(1))
}

pub(super) fn about(model: &Model) -> String {
    table(model).map_or(String::new(), |table| table.title.clone())
}

pub(super) fn len(model: &Model) -> usize {
    table(model).map_or(0, |table| table.rows.len())
}

pub(super) fn ids(model: &Model) -> Vec<String> {
    let Some(table) = table(model) else { return Vec::new() };
    let row = model.lists.tables.selected(table.rows.len());
    row.map_or(Vec::new(), |row| table.rows[row].ids.clone())
}

pub(super) fn draw(model: &Model, _theme: &Theme, area: Rect, buffer: &mut Buffer) {
    let Some(table) = table(model) else { return };
    let rows = model.lists.tables.window(area.height as usize, table.rows.len());
    for (y, row) in (area.y..).zip(rows) {
        Line::raw(table.rows[row].cells.join(" ")).render(Rect { y, height: 1, ..area }, buffer);
    }
}
