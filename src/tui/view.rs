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
//! With less room the lower panes share one place, and with little of it the focused pane has everything; panes that share a place are tabs in its
//! title. Where the panes are depends on size and focus alone, so that the mouse finds them again.

use ratatui::buffer::Buffer;
use ratatui::layout::{Constraint, Layout, Position, Rect};
use ratatui::text::Line;
use ratatui::widgets::{Block, Borders, Widget};

use super::keys::Keys;
use super::model::{Model, Pane};
use super::theme::{Role, Theme};
use super::{panes, popups, status, tabs};

/// Panes that share the lower place of a screen of medium size.
const LOWER: [Pane; 4] = [Pane::Mesh, Pane::Tables, Pane::Checks, Pane::Differences];
/// Panes that share the lower right place of a large one.
const LAST: [Pane; 2] = [Pane::Checks, Pane::Differences];

/// How much room there is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Room {
    /// For one pane, with a line above it.
    #[default]
    One,
    /// For some, of which one is shared.
    Some,
    /// For all but one.
    Most,
}

/// Where things are.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(in crate::tui) struct Areas {
    room: Room,
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
        Some(self.block(*area).inner(*area))
    }

    /// The pane at a cell, if there is one.
    pub(in crate::tui) fn at(&self, column: u16, row: u16) -> Option<Pane> {
        let at = Position { x: column, y: row };
        self.panes.iter().find(|(_, area)| area.contains(at)).map(|(pane, _)| *pane)
    }

    /// The line in which a pane's title is.
    pub(in crate::tui) fn head(&self, pane: Pane) -> Option<Rect> {
        let (_, area) = self.panes.iter().find(|(other, _)| *other == pane)?;
        let side = u16::from(self.borders(*area).contains(Borders::LEFT));
        let height = u16::from(self.borders(*area).contains(Borders::TOP));
        let width = area.width.saturating_sub(2 * side);
        Some(Rect { x: area.x + side.min(area.width), width, height, ..*area })
    }

    /// The border below a pane, if it has one.
    pub(in crate::tui) fn foot(&self, pane: Pane) -> Option<Rect> {
        let (_, area) = self.panes.iter().find(|(other, _)| *other == pane)?;
        let has_any = self.borders(*area).contains(Borders::BOTTOM) && area.width > 2 && area.height > 1;
        has_any.then(|| Rect { x: area.x + 1, y: area.bottom() - 1, width: area.width - 2, height: 1 })
    }

    /// The panes that share the place of one, itself among them.
    pub(in crate::tui) fn sharing(&self, pane: Pane) -> &'static [Pane] {
        match self.room {
            Room::One => &Pane::ALL,
            Room::Some if LOWER.contains(&pane) => &LOWER,
            Room::Most if LAST.contains(&pane) => &LAST,
            _ => &[],
        }
    }

    fn block(&self, area: Rect) -> Block<'static> {
        Block::new().borders(self.borders(area))
    }

    /// One pane needs no frame, and in very little room not even a title.
    fn borders(&self, area: Rect) -> Borders {
        match self.room {
            Room::One if area.height < 3 => Borders::NONE,
            Room::One => Borders::TOP,
            _ => Borders::ALL,
        }
    }
}

/// Where things are on a screen of some columns and rows.
pub(in crate::tui) fn areas(model: &Model) -> Areas {
    let [width, height] = model.size;
    let screen = Rect::new(0, 0, width, height);
    let bar = |lines| Constraint::Length(if height > 3 { lines } else { 0 });
    let [title, middle, status] = screen.layout(&Layout::vertical([bar(1), Constraint::Fill(1), bar(1)]));
    let room = match model.size {
        _ if model.maximised => Room::One,
        [width, height] if width < 60 || height < 16 => Room::One,
        [width, height] if width < 100 || height < 30 => Room::Some,
        _ => Room::Most,
    };
    let panes = match room {
        Room::One => vec![(model.focus, middle)],
        Room::Some => some(model, middle),
        Room::Most => most(model, middle),
    };
    Areas { room, title, panes, status }
}

/// Lines for the stages, with their border.
fn stages(model: &Model, middle: Rect) -> Constraint {
    let stages = model.opened.as_ref().map_or(0, |opened| opened.stages.len()).clamp(3, 10);
    Constraint::Length((stages as u16 + 2).min(middle.height / 3))
}

fn some(model: &Model, middle: Rect) -> Vec<(Pane, Rect)> {
    let side = Constraint::Length((middle.width * 3 / 8).clamp(26, 36));
    let [left, right] = middle.layout(&Layout::horizontal([side, Constraint::Fill(1)]));
    let [timeline, steps] = left.layout(&Layout::vertical([Constraint::Fill(1), stages(model, middle)]));
    let [picture, below] = right.layout(&Layout::vertical([Constraint::Fill(3), Constraint::Fill(2)]));
    let lower = if LOWER.contains(&model.focus) { model.focus } else { Pane::Checks };
    vec![(Pane::Timeline, timeline), (Pane::Stages, steps), (Pane::Picture, picture), (lower, below)]
}

fn most(model: &Model, middle: Rect) -> Vec<(Pane, Rect)> {
    let side = Constraint::Length((middle.width / 16 * 5).clamp(38, 60));
    let [left, right] = middle.layout(&Layout::horizontal([side, Constraint::Fill(1)]));
    let parts = [Constraint::Fill(1), stages(model, middle), Constraint::Length(9)];
    let [timeline, steps, mesh] = left.layout(&Layout::vertical(parts));
    let [picture, below] = right.layout(&Layout::vertical([Constraint::Fill(3), Constraint::Fill(2)]));
    let [tables, last] = below.layout(&Layout::horizontal([Constraint::Fill(1), Constraint::Fill(1)]));
    let of_last = if model.focus == Pane::Differences { Pane::Differences } else { Pane::Checks };
    vec![
        (Pane::Timeline, timeline),
        (Pane::Stages, steps),
        (Pane::Mesh, mesh),
        (Pane::Picture, picture),
        (Pane::Tables, tables),
        (of_last, last),
    ]
}

/// Draws the screen, in the colours that there are.
pub(in crate::tui) fn draw(model: &Model, theme: &Theme, keys: &Keys, buffer: &mut Buffer) {
    let areas = areas(model);
    status::title(model, theme, areas.title, buffer);
    for (pane, area) in &areas.panes {
        let border = if model.focus == *pane { Role::Focus } else { Role::Border };
        areas.block(*area).border_style(theme.style(border)).render(*area, buffer);
        if let (Some(head), Some(inner)) = (areas.head(*pane), areas.inner(*pane)) {
            let title = tabs::title(&areas, *pane, model, theme, head.width as usize);
            Line::from_iter(title.into_iter().map(|part| part.span)).render(head, buffer);
            panes::draw(*pane, model, theme, inner, buffer);
        }
    }
    status::status(model, theme, keys, areas.status, buffer);
    popups::draw(model, theme, keys, buffer);
    theme.lower(buffer);
}

#[cfg(test)]
mod tests;
