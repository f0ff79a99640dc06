//! What is typed, clicked and pasted, as changes of the model.
//!
//! While something is being opened, keys wait (`ahead`).

use crossterm::event::{Event, MouseButton, MouseEvent, MouseEventKind};
use ratatui::layout::{Position, Rect};

use super::action::Action;
use super::key::Key;
use super::keys::Keys;
use super::model::{Model, Pane};
use super::theme::Theme;
use super::view::Areas;
use super::{ahead, panes, tabs, update, view};

/// Rows that the wheel scrolls by.
const WHEEL: isize = 3;

/// Takes an event of the terminal. Whether the screen is another.
pub(in crate::tui) fn take(model: &mut Model, keys: &Keys, event: Event) -> bool {
    // That something waits is shown, too.
    ahead::keep(model, keys, event).is_none_or(|event| carry_out(model, keys, event))
}

/// Takes what was typed ahead of what is open by now.
pub(in crate::tui) fn catch_up(model: &mut Model, keys: &Keys) {
    while let Some(event) = model.ahead.next() {
        carry_out(model, keys, event);
    }
}

fn carry_out(model: &mut Model, keys: &Keys, event: Event) -> bool {
    let selected = model.selected.clone();
    let changed = dispatch(model, keys, event);
    update::reveal(model, &selected);
    changed
}

fn dispatch(model: &mut Model, keys: &Keys, event: Event) -> bool {
    match event {
        Event::Key(event) => Key::pressed(event).is_some_and(|key| pressed(model, keys, key)),
        Event::Resize(width, height) => {
            model.size = [width, height];
            true
        }
        Event::Mouse(event) => moved(model, event),
        Event::Paste(text) => update::popup::paste(model, &text),
        _ => false,
    }
}

/// The mouse acts on the pane under it, whichever has the keys.
fn moved(model: &mut Model, event: MouseEvent) -> bool {
    if update::popup::mouse(model, event) {
        return true;
    }
    // What is dragged goes on wherever the pointer gets to.
    if model.picture.drag.is_some() {
        return update::picture::mouse(model, event);
    }
    let areas = view::areas(model);
    let Some(pane) = areas.at(event.column, event.row) else { return false };
    let at = Position { x: event.column, y: event.row };
    match event.kind {
        MouseEventKind::Down(MouseButton::Left) if areas.head(pane).is_some_and(|head| head.contains(at)) => {
            title(model, &areas, pane, at);
            true
        }
        _ if pane == Pane::Picture => update::picture::mouse(model, event),
        MouseEventKind::Down(MouseButton::Left) => {
            row(model, &areas, pane, at);
            true
        }
        MouseEventKind::ScrollUp => wheel(model, &areas, pane, -WHEEL),
        MouseEventKind::ScrollDown => wheel(model, &areas, pane, WHEEL),
        _ => false,
    }
}

/// A click on a title goes to the pane; on that of the pane that has the keys already it shows it alone, or among the others again.
fn title(model: &mut Model, areas: &Areas, pane: Pane, at: Position) {
    let head = areas.head(pane).unwrap_or_default();
    let parts = tabs::title(areas, pane, model, &Theme::default(), head.width as usize);
    let tab = tabs::at(&parts, usize::from(at.x - head.x)).unwrap_or(pane);
    if model.focus == tab {
        update::act(model, Action::Maximise);
    }
    model.focus = tab;
}

/// A click on a row goes there, a second one selects what it is about.
fn row(model: &mut Model, areas: &Areas, pane: Pane, at: Position) {
    let again = std::mem::replace(&mut model.focus, pane) == pane;
    let len = panes::len(model, pane);
    let body = body(areas, pane);
    let Some(list) = model.lists.get(pane).filter(|_| body.contains(at)) else { return };
    let Some(row) = list.row_at(usize::from(at.y - body.y), body.height as usize, len) else { return };
    if again && list.selected(len) == Some(row) {
        update::act(model, Action::Select);
    } else {
        panes::choose(model, pane, row);
    }
}

/// The wheel scrolls what is under it, and leaves the chosen row where it is.
fn wheel(model: &mut Model, areas: &Areas, pane: Pane, by: isize) -> bool {
    let (height, len) = (body(areas, pane).height as usize, panes::len(model, pane));
    model.lists.of(pane).map(|list| list.scroll(by, height, len)).is_some()
}

/// Where a pane has its rows.
fn body(areas: &Areas, pane: Pane) -> Rect {
    areas.inner(pane).map_or(Rect::ZERO, |inner| panes::body(pane, inner))
}

fn pressed(model: &mut Model, keys: &Keys, key: Key) -> bool {
    let action = keys.action(key, model);
    // What is typed belongs to what is on top, and so do all keys but those that leave it as it is.
    let passes = key.typed().is_none() && action.is_some_and(Action::passes_popups);
    if !passes && update::popup::key(model, key) {
        return true;
    }
    // What was said has been read by now; what went wrong stays until something else is said, or it is dismissed.
    if action.is_some() && model.message.as_ref().is_some_and(|message| !message.wrong) {
        model.message = None;
    }
    action.into_iter().for_each(|action| update::act(model, action));
    action.is_some()
}

#[cfg(test)]
mod tests;
