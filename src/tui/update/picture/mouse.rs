//! The picture by mouse: drag to turn the model, or to move what is enlarged; the wheel enlarges at the pointer; a click selects the face under it.
//!
//! A press that is let go of where it began is a click, so nothing happens before that.

use ratatui::crossterm::event::{KeyModifiers, MouseButton, MouseEvent, MouseEventKind};
use ratatui::layout::{Position, Rect};

use super::{ZOOM, look, pan, zoom};
use crate::tui::model::{Model, Pane};
use crate::tui::picture::golden::Golden;
use crate::tui::picture::{self, Drag, Pull};
use crate::tui::update::record;
use crate::tui::worker::Ask;

/// Takes an event of the mouse that lies in the picture, or that a drag which began there goes on with. Whether anything came of it.
pub(in crate::tui) fn mouse(model: &mut Model, event: MouseEvent) -> bool {
    let at = Position { x: event.column, y: event.row };
    let Some(area) = picture::area(model) else {
        return model.picture.drag.take().is_some();
    };
    match event.kind {
        MouseEventKind::Down(button) if area.contains(at) => press(model, button, event.modifiers, at),
        MouseEventKind::Drag(_) if model.picture.drag.is_some() => drag(model, area, at),
        MouseEventKind::Up(_) if model.picture.drag.is_some() => release(model, area, at),
        MouseEventKind::ScrollUp if area.contains(at) => wheel(model, area, at, ZOOM),
        MouseEventKind::ScrollDown if area.contains(at) => wheel(model, area, at, 1.0 / ZOOM),
        _ => return false,
    }
    true
}

fn press(model: &mut Model, button: MouseButton, modifiers: KeyModifiers, at: Position) {
    let plain = button == MouseButton::Left && !modifiers.contains(KeyModifiers::SHIFT);
    let pull = match plain {
        true if model.picture.golden == Golden::Split => Pull::Split,
        true if !model.picture.is_flat() => Pull::Orbit,
        _ => Pull::Pan,
    };
    model.focus = Pane::Picture;
    model.picture.drag = Some(Drag { pull, last: at, moved: false });
}

fn drag(model: &mut Model, area: Rect, at: Position) {
    let Some(drag) = &mut model.picture.drag else { return };
    let cells = [at.x, at.y].map(f64::from);
    let by = [cells[0] - f64::from(drag.last.x), cells[1] - f64::from(drag.last.y)];
    drag.moved |= by != [0.0; 2];
    drag.last = at;
    let shares = [by[0] / f64::from(area.width), by[1] / f64::from(area.height)];
    match drag.pull {
        // What is dragged comes along: the model's front to the right, and the one who looks to the left. A whole pane is half a turn.
        Pull::Orbit => look(model, shares.map(|share| -share * std::f64::consts::PI), 1.0),
        Pull::Pan => pan(model, shares),
        Pull::Split => {
            let share = (cells[0] + 0.5 - f64::from(area.x)) / f64::from(area.width);
            model.picture.split = share.clamp(0.0, 1.0) - 0.5;
        }
    }
}

fn release(model: &mut Model, area: Rect, at: Position) {
    let Some(Drag { pull, .. }) = model.picture.drag.take().filter(|drag| !drag.moved) else { return };
    if pull != Pull::Orbit || !record::clicked(model, at) {
        identify(model, area, at);
    }
}

/// Asks for the face that is seen in a cell.
fn identify(model: &mut Model, area: Rect, at: Position) {
    let point = model.picture.medium.middle([at.x.saturating_sub(area.x), at.y.saturating_sub(area.y)]);
    let Some((got, encoded)) = picture::seen(model) else { return };
    let ask = encoded.fit.to_share(point).map(|share| Ask::Identify {
        place: got.place,
        sight: got.sight,
        at: share,
    });
    match ask {
        Some(ask) => model.ask(ask),
        None => model.selected.clear(),
    }
}

fn wheel(model: &mut Model, area: Rect, at: Position, factor: f64) {
    let point = model.picture.medium.middle([at.x - area.x, at.y - area.y]);
    zoom(model, Some(point), factor);
}
