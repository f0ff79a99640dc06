//! The panes, a file each: what they show of the model, how many rows they have, and what a row selects.
//!
//! A pane with rows says four things of them: how many, the text of each (searched, and copied, with tabs between its cells), the ids that the chosen one is
//! about, and which have to do with what is selected. Clicks, keys, search and copying work on these and know no pane.

mod checks;
mod differences;
mod grid;
mod mesh;
mod picture;
mod rows;
mod stages;
mod tables;
mod timeline;
mod words;

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use super::model::{Model, Pane};
use super::theme::Theme;

/// Draws a pane's content.
pub(super) fn draw(pane: Pane, model: &Model, theme: &Theme, area: Rect, buffer: &mut Buffer) {
    let body = body(pane, area);
    let why = match pane {
        Pane::Stages => stages::nothing(model),
        Pane::Mesh => mesh::nothing(model),
        Pane::Tables => tables::nothing(model),
        Pane::Checks => checks::nothing(model),
        Pane::Differences => differences::nothing(model),
        Pane::Timeline | Pane::Picture => "",
    };
    if !why.is_empty() && len(model, pane) == 0 {
        return rows::nothing(why, theme, area, buffer);
    }
    match pane {
        Pane::Timeline => timeline::draw(model, theme, area, buffer),
        Pane::Stages => stages::draw(model, theme, area, buffer),
        Pane::Mesh => mesh::draw(model, theme, area, body, buffer),
        Pane::Picture => picture::draw(model, theme, buffer),
        Pane::Tables => tables::draw(model, theme, area, body, buffer),
        Pane::Checks => checks::draw(model, theme, area, buffer),
        Pane::Differences => differences::draw(model, theme, area, body, buffer),
    }
}

/// The part of a pane's content that has its rows: below the heads, where there are any and room for them.
pub(super) fn body(pane: Pane, area: Rect) -> Rect {
    if pane == Pane::Differences {
        return differences::body(area);
    }
    let head = u16::from(matches!(pane, Pane::Tables | Pane::Mesh) && area.height > 1);
    Rect { y: area.y + head, height: area.height - head, ..area }
}

/// What a pane is about, in its title.
pub(super) fn about(pane: Pane, model: &Model) -> String {
    match pane {
        Pane::Timeline => timeline::about(model),
        Pane::Stages => stages::about(model),
        Pane::Mesh => mesh::about(model),
        Pane::Tables => tables::about(model),
        Pane::Checks => checks::about(model),
        Pane::Picture => picture::about(model),
        Pane::Differences => differences::about(model),
    }
}

/// How many rows a pane has.
pub(super) fn len(model: &Model, pane: Pane) -> usize {
    match pane {
        Pane::Timeline => timeline::len(model),
        Pane::Stages => stages::len(model),
        Pane::Mesh => mesh::len(model),
        Pane::Tables => tables::len(model),
        Pane::Checks => checks::len(model),
        Pane::Differences => differences::len(model),
        Pane::Picture => 0,
    }
}

/// The text of each row, with tabs between its cells.
pub(super) fn texts(model: &Model, pane: Pane) -> Vec<String> {
    match pane {
        Pane::Timeline => timeline::texts(model),
        Pane::Stages => stages::texts(model),
        Pane::Mesh => mesh::texts(model),
        Pane::Tables => tables::texts(model),
        Pane::Checks => checks::texts(model),
        Pane::Differences => differences::texts(model),
        Pane::Picture => Vec::new(),
    }
}

/// The heads of what [`texts`] gives, where there are any.
pub(super) fn head(model: &Model, pane: Pane) -> Option<String> {
    (pane == Pane::Tables).then(|| tables::head(model))
}

/// The ids that the chosen row of a pane is about.
pub(super) fn ids(model: &Model, pane: Pane) -> Vec<String> {
    match pane {
        Pane::Timeline => timeline::ids(model),
        Pane::Stages => stages::ids(model),
        Pane::Tables => tables::ids(model),
        Pane::Checks => checks::ids(model),
        Pane::Differences => differences::ids(model),
        Pane::Mesh | Pane::Picture => Vec::new(),
    }
}

/// The rows of a pane that have to do with what is selected.
pub(super) fn marked(model: &Model, pane: Pane) -> Vec<usize> {
    match pane {
        Pane::Tables => tables::marked(model),
        Pane::Checks => checks::marked(model),
        Pane::Differences => differences::marked(model),
        _ => Vec::new(),
    }
}

/// Chooses a row of a pane.
pub(super) fn choose(model: &mut Model, pane: Pane, row: usize) {
    let len = len(model, pane);
    if let Some(list) = model.lists.of(pane) {
        list.select(row, len);
    }
    chosen(model, pane);
}

/// Another row was chosen.
pub(super) fn chosen(model: &mut Model, pane: Pane) {
    match pane {
        Pane::Timeline => timeline::chosen(model),
        Pane::Stages => stages::chosen(model),
        _ => {}
    }
}

/// Shows the next table.
pub(super) fn next_table(model: &mut Model) {
    tables::next(model);
}
