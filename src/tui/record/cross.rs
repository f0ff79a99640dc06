//! The cross-hair: positions of the recorded view, and the cells of the picture's pane where they are seen.
//!
//! Positions are kept to a hundredth of a pixel, so that what is shown in the status line is what is recorded, digit for digit.

use ratatui::buffer::Buffer;
use ratatui::layout::{Position, Rect};

use super::waiting_at;
use crate::tui::image::protocol::Medium;
use crate::tui::image::window::Fit;
use crate::tui::model::{Model, Pane};
use crate::tui::picture;
use crate::tui::theme::{Role, Theme};
use crate::tui::view;

/// Parts of a pixel that are told apart.
const PARTS: f64 = 100.0;

/// The picture as it lies in its pane.
struct Lie {
    area: Rect,
    medium: Medium,
    fit: Fit,
    viewport: [f64; 2],
}

impl Lie {
    fn of(model: &Model) -> Option<Self> {
        let area = view::areas(model).inner(Pane::Picture)?;
        let viewport = model.opened.as_ref()?.viewport;
        // The picture has the view's shape, but for what rounding to whole pixels does to it.
        let (medium, fit) = (model.picture.medium, picture::fit(model)?);
        Some(Self { area, medium, fit, viewport: viewport.map(f64::from) })
    }

    /// The position of the view in the middle of a cell.
    fn position(&self, cell: Position) -> Option<[f64; 2]> {
        let inside = self.area.contains(cell);
        let cell = [cell.x.checked_sub(self.area.x)?, cell.y.checked_sub(self.area.y)?];
        let share = self.fit.to_share(self.medium.middle(cell)).filter(|_| inside)?;
        Some(within([0, 1].map(|k| share[k] * self.viewport[k]), self.viewport))
    }

    /// The cell where a position of the view is seen.
    fn cell(&self, at: [f64; 2]) -> Option<Position> {
        let pane = self.fit.share_to_pane([0, 1].map(|k| at[k] / self.viewport[k]))?;
        let [x, y] = [0, 1].map(|k| (pane[k] / f64::from(self.medium.cell[k])) as u16);
        let cell = Position { x: self.area.x.checked_add(x)?, y: self.area.y.checked_add(y)? };
        self.area.contains(cell).then_some(cell)
    }

    /// What a cell is of the view, across and down.
    fn step(&self) -> [f64; 2] {
        let shares = self.fit.shares(self.medium.cell.map(f64::from));
        [0, 1].map(|k| shares[k] * self.viewport[k])
    }
}

/// A position that can be recorded: within the view, and to the digits that are shown.
fn within(at: [f64; 2], viewport: [f64; 2]) -> [f64; 2] {
    [0, 1].map(|k| {
        let most = viewport[k] - 1.0 / PARTS;
        (at[k].clamp(0.0, most) * PARTS).round() / PARTS
    })
}

/// The position of the view that is seen in a cell of the screen.
pub(in crate::tui) fn position(model: &Model, cell: Position) -> Option<[f64; 2]> {
    Lie::of(model)?.position(cell)
}

/// A position that is so many cells further, or so many pixels of the view.
pub(in crate::tui) fn moved(model: &Model, from: [f64; 2], by: [f64; 2], by_cells: bool) -> [f64; 2] {
    let Some(lie) = Lie::of(model) else { return from };
    let step = if by_cells { lie.step() } else { [1.0; 2] };
    within([0, 1].map(|k| from[k] + by[k] * step[k]), lie.viewport)
}

/// Draws the cross-hair over the picture, and the point that waits.
pub(in crate::tui) fn draw(model: &Model, theme: &Theme, buffer: &mut Buffer) {
    let (Some(recorder), Some(lie)) = (&model.recorder, Lie::of(model)) else { return };
    let waiting = waiting_at(model).filter(|_| !super::is_turned(model));
    for (at, mark, role) in [(waiting, "●", Role::Bad), (Some(recorder.cross), "╋", Role::Accent)] {
        let cell = at.and_then(|at| lie.cell(at)).and_then(|cell| buffer.cell_mut(cell));
        cell.into_iter().for_each(|cell| {
            cell.set_symbol(mark).set_style(theme.style(role));
        });
    }
}
