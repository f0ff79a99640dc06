//! The keys of a list to choose from, and what choosing does.

use crossterm::event::{MouseButton, MouseEvent, MouseEventKind};
use ratatui::layout::Position;

use super::prompt::scene_of;
use super::{Then, paths};
use crate::tui::action::Action;
use crate::tui::edit::Typed;
use crate::tui::key::Key;
use crate::tui::list::List;
use crate::tui::model::Model;
use crate::tui::popups::{self, LEAVE, Leave, Menu, Opens, Popup, Question, What};
use crate::tui::update::{self, record, stops};
use crate::tui::worker::Ask;

/// Rows that a notch of the wheel goes.
const NOTCH: usize = 3;

pub(super) fn key(model: &mut Model, menu: &mut Menu, key: Key) -> Then {
    let name = key.to_string();
    if moved(model, menu, &name) {
        return Then::Stay;
    }
    match (name.as_str(), &menu.what) {
        ("esc", _) => Then::Close,
        ("enter", _) => choose(model, menu),
        ("tab", What::Open(_)) => complete(menu),
        (name, What::Stops) => change_stops(model, menu, name),
        (name, What::Leave) => match LEAVE.iter().find(|(_, own, ..)| *own == name) {
            Some((choice, ..)) => leave(model, *choice),
            None => Then::Stay,
        },
        _ => {
            if menu.edit.key(key) == Typed::Changed {
                typed(menu);
            }
            Then::Stay
        }
    }
}

pub(super) fn paste(menu: &mut Menu, text: &str) -> Then {
    if menu.finds() {
        menu.edit.insert(text);
        typed(menu);
    }
    Then::Stay
}

/// What is looked for is another.
fn typed(menu: &mut Menu) {
    (menu.list, menu.error) = (List::default(), None);
}

/// Whether a key chooses another row.
fn moved(model: &Model, menu: &mut Menu, name: &str) -> bool {
    let len = menu.len(model);
    let page = List::page(usize::from(popups::rows_area(model, menu).height));
    let letters = !menu.finds();
    match name {
        "up" | "ctrl-p" | "shift-tab" => menu.list.up(1, len),
        "down" | "ctrl-n" => menu.list.down(1, len),
        "pgup" => menu.list.up(page, len),
        "pgdn" => menu.list.down(page, len),
        "ctrl-home" => menu.list.top(),
        "ctrl-end" => menu.list.bottom(len),
        "k" if letters => menu.list.up(1, len),
        "j" if letters => menu.list.down(1, len),
        "g" | "home" if letters => menu.list.top(),
        "G" | "end" if letters => menu.list.bottom(len),
        _ => return false,
    }
    true
}

pub(super) fn mouse(model: &mut Model, menu: &mut Menu, event: MouseEvent) -> Then {
    let (at, len) = (Position { x: event.column, y: event.row }, menu.len(model));
    match event.kind {
        MouseEventKind::ScrollUp => menu.list.up(NOTCH, len),
        MouseEventKind::ScrollDown => menu.list.down(NOTCH, len),
        MouseEventKind::Down(MouseButton::Left) => return clicked(model, menu, at),
        _ => {}
    }
    Then::Stay
}

/// A click chooses a row, and another one does what it says; beside the menu it closes it.
fn clicked(model: &mut Model, menu: &mut Menu, at: Position) -> Then {
    let Some(row) = popups::row_at(model, menu, at) else {
        let inside = Popup::Menu(menu.clone()).area(model).contains(at);
        return if inside { Then::Stay } else { Then::Close };
    };
    let len = menu.len(model);
    if menu.list.selected(len) == Some(row) {
        return choose(model, menu);
    }
    menu.list.select(row, len);
    Then::Stay
}

/// Does what the chosen row says.
fn choose(model: &mut Model, menu: &mut Menu) -> Then {
    let Some(row) = menu.list.selected(menu.len(model)) else { return Then::Stay };
    match &menu.what {
        What::Help => Then::Stay,
        What::Palette => {
            let action = popups::actions(&model.memory, menu.edit.text())[row].row.action;
            model.memory.acted(action);
            update::act(model, action);
            Then::Close
        }
        What::Stops => {
            let stop = model.stops[row].clone();
            stops::next(model, &stop);
            Then::Close
        }
        What::Open(files) => {
            let entry = popups::opens(model, files, menu.edit.text()).swap_remove(row).0;
            let opened = open(model, entry);
            menu.error = opened.err();
            if menu.error.is_some() { Then::Stay } else { Then::Close }
        }
        What::Leave => leave(model, LEAVE[row].0),
    }
}

/// Opens something, or begins something new.
fn open(model: &mut Model, entry: Opens) -> Result<(), String> {
    match entry {
        Opens::Draft(draft) => model.ask(Ask::Open(draft.path)),
        Opens::File(path) => model.ask(Ask::Open(path)),
        Opens::Typed(path) => super::open_path(model, &path)?,
        // The number of faces is still to be said.
        Opens::Scene(name, _) if name.ends_with('N') => {
            super::confirm(model, Question::Scene, &scene_of(name));
        }
        Opens::Scene(name, _) => record::begin(model, &scene_of(name))?,
    }
    Ok(())
}

/// Goes on with a path as far as there is one way to.
fn complete(menu: &mut Menu) -> Then {
    match paths::beginning(menu.edit.text()) {
        Ok(files) => {
            let common = paths::common(&files);
            if common.len() > menu.edit.text().len() {
                menu.edit.set(&common);
                typed(menu);
            }
        }
        Err(error) => menu.error = Some(error),
    }
    Then::Stay
}

fn change_stops(model: &mut Model, menu: &mut Menu, name: &str) -> Then {
    match (name, menu.list.selected(model.stops.len())) {
        ("a" | "ins" | "+", _) => {
            // The question lies over the list, which is there again when it is answered.
            model.popup = Some(Popup::Menu(menu.clone()));
            super::ask(model, Question::Stop);
        }
        ("d" | "del" | "backspace" | "-", Some(row)) => {
            model.stops.remove(row);
        }
        _ => {}
    }
    Then::Stay
}

fn leave(model: &mut Model, choice: Leave) -> Then {
    match choice {
        Leave::Save => {
            model.leaving = true;
            update::act(model, Action::Save);
        }
        Leave::Draft => model.done = true,
        Leave::Stay => {}
    }
    Then::Close
}
