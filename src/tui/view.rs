//! The screen: a title line, the panes, a status line.
//!
//! ```text
//! ┌ title: recording, engine, place, what the worker does ────────────────┐
//! │┌1 timeline───┐┌4 picture─────────────────────────────────────────────┐│
//! ││             ││                                                      ││
//! │├2 stages─────┤│                                                      ││
//! ││             │├5 tables──────────────────┬6 invariants───────────────┤│
//! │├3 mesh───────┤│                          │                           ││
//! │└─────────────┘└──────────────────────────┴───────────────────────────┘│
//! └ status: what is said, or what the keys do ────────────────────────────┘
//! ```
//!
//! With less room the lower panes share one place, and with little of it the focused pane has everything. Where the panes are depends on size
//! and focus alone, so that the mouse finds them again.

use ratatui::buffer::Buffer;
use ratatui::layout::{Constraint, Layout, Rect};
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, Widget};

use super::keys::Keys;
use super::model::{Model, Pane};
use super::theme::{Role, Theme};
use super::{panes, popups, status};

/// Where things are.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(in crate::tui) struct Areas {
    /// The title line.
    pub(in crate::tui) title: Rect,
    /// The panes with their borders.
    pub(in crate::tui) panes: Vec<(Pane, Rect)>,
    /// The status line.
    pub(in crate::tui) status: Rect,
}

impl Areas {
    /// The place of a pane's content.
    pub(in crate::tui) fn inner(&self, pane: Pane) -> Option<Rect> {
        let (_, area) = self.panes.iter().find(|(other, _)| *other == pane)?;
        Some(Block::bordered().inner(*area))
    }

    /// The pane at a cell, if there is one.
    pub(in crate::tui) fn at(&self, column: u16, row: u16) -> Option<Pane> {
        let at = ratatui::layout::Position { x: column, y: row };
        self.panes.iter().find(|(_, area)| area.contains(at)).map(|(pane, _)| *pane)
    }
}

/// Where things are on a screen of some columns and rows.
pub(in crate::tui) fn areas(model: &Model) -> Areas {
    let [width, height] = model.size;
    let screen = Rect::new(0, 0, width, height);
    let bar = |lines| Constraint::Length(if height > 3 { lines } else { 0 });
    let [title, middle, status] = screen.layout(&Layout::vertical([bar(1), Constraint::Fill(1), bar(1)]));
    let panes = if model.maximised || width < 60 || height < 16 {
        vec![(model.focus, middle)]
    } else if width < 100 || height < 30 {
        medium(model, middle)
    } else {
        wide(model, middle)
    };
    Areas { title, panes, status }
}

/// The pane of the lower ones that is shown where there is room for one.
fn lower(model: &Model) -> Pane {
    match model.focus {
        pane @ (Pane::Mesh | Pane::Tables | Pane::Checks | Pane::Differences) => pane,
        _ => Pane::Checks,
    }
}

fn medium(model: &Model, middle: Rect) -> Vec<(Pane, Rect)> {
    let [left, right] = middle.layout(&Layout::horizontal([Constraint::Length(30), Constraint::Fill(1)]));
    let [timeline, stages] = left.layout(&Layout::vertical([Constraint::Fill(1), Constraint::Length(7)]));
    let [picture, below] = right.layout(&Layout::vertical([Constraint::Fill(3), Constraint::Fill(2)]));
    vec![(Pane::Timeline, timeline), (Pane::Stages, stages), (Pane::Picture, picture), (lower(model), below)]
}

fn wide(model: &Model, middle: Rect) -> Vec<(Pane, Rect)> {
    let [left, right] = middle.layout(&Layout::horizontal([Constraint::Length(38), Constraint::Fill(1)]));
    let parts = [Constraint::Fill(1), Constraint::Length(8), Constraint::Length(8)];
    let [timeline, stages, mesh] = left.layout(&Layout::vertical(parts));
    let [picture, below] = right.layout(&Layout::vertical([Constraint::Fill(3), Constraint::Fill(2)]));
    let [tables, checks] = below.layout(&Layout::horizontal([Constraint::Fill(1), Constraint::Fill(1)]));
    let checks_or = if model.focus == Pane::Differences { Pane::Differences } else { Pane::Checks };
    vec![
        (Pane::Timeline, timeline),
        (Pane::Stages, stages),
        (Pane::Mesh, mesh),
        (Pane::Picture, picture),
        (Pane::Tables, tables),
        (checks_or, checks),
    ]
}

/// Draws the screen.
pub(in crate::tui) fn draw(model: &Model, theme: &Theme, keys: &Keys, buffer: &mut Buffer) {
    let areas = areas(model);
    status::title(model, theme, areas.title, buffer);
    for (pane, area) in &areas.panes {
        frame(*pane, model, theme, *area, buffer);
        if let Some(inner) = areas.inner(*pane) {
            panes::draw(*pane, model, theme, inner, buffer);
        }
    }
    status::status(model, theme, keys, areas.status, buffer);
    popups::draw(model, theme, keys, buffer);
}

/// The border of a pane, with its number, its title and what it is about.
fn frame(pane: Pane, model: &Model, theme: &Theme, area: Rect, buffer: &mut Buffer) {
    let focused = model.focus == pane;
    let number = Span::styled((pane as usize + 1).to_string(), theme.style(Role::Key));
    let role = if focused { Role::Focus } else { Role::Title };
    let about = panes::about(pane, model);
    let about =
        Span::styled(if about.is_empty() { about } else { format!(" {about}") }, theme.style(Role::Faint));
    let title =
        Line::from(vec![number, Span::raw(" "), Span::styled(pane.title(), theme.style(role)), about]);
    let border = theme.style(if focused { Role::Focus } else { Role::Border });
    let foot = panes::foot(pane, model, theme);
    Block::bordered().border_style(border).title(title).title_bottom(foot).render(area, buffer);
}
