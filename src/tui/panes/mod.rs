//! The panes, a file each: what they show of the model, how many rows they have, and what a row selects.

mod checks;
mod mesh;
mod picture;
mod stages;
mod tables;
mod timeline;

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::Line;

use super::model::{Model, Pane};
use super::theme::Theme;

/// Draws a pane's content.
pub(super) fn draw(pane: Pane, model: &Model, theme: &Theme, area: Rect, buffer: &mut Buffer) {
    match pane {
        Pane::Timeline => timeline::draw(model, theme, area, buffer),
        Pane::Stages => stages::draw(model, theme, area, buffer),
        Pane::Mesh => mesh::draw(model, theme, area, buffer),
        Pane::Picture => picture::draw(model, theme, area, buffer),
        Pane::Tables => tables::draw(model, theme, area, buffer),
        Pane::Checks => checks::draw(model, theme, area, buffer),
        Pane::Differences => {}
    }
}

/// What a pane is about, in its title.
pub(super) fn about(pane: Pane, model: &Model) -> String {
    match pane {
        Pane::Tables => tables::about(model),
        Pane::Checks => checks::about(model),
        Pane::Picture => picture::about(model),
        _ => String::new(),
    }
}

/// What stands below a pane.
pub(super) fn foot(pane: Pane, model: &Model, theme: &Theme) -> Line<'static> {
    match pane {
        Pane::Picture => picture::foot(model, theme),
        _ => Line::default(),
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
        Pane::Picture | Pane::Differences => 0,
    }
}

/// The ids that the chosen row of a pane is about.
pub(super) fn ids(model: &Model, pane: Pane) -> Vec<String> {
    match pane {
        Pane::Tables => tables::ids(model),
        Pane::Checks => checks::ids(model),
        _ => Vec::new(),
    }
}

/// Another row was chosen.
pub(super) fn chosen(model: &mut Model, pane: Pane) {
    if pane == Pane::Timeline {
        timeline::chosen(model);
    }
}
