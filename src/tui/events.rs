//! What is typed, clicked and pasted, as changes of the model.

use crossterm::event::{Event, MouseEvent};

use super::action::Action;
use super::key::Key;
use super::keys::Keys;
use super::model::Model;
use super::update;

/// Takes an event of the terminal. Whether the screen is another.
pub(in crate::tui) fn take(model: &mut Model, keys: &Keys, event: Event) -> bool {
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

fn moved(model: &mut Model, event: MouseEvent) -> bool {
    update::popup::mouse(model, event) || update::picture::mouse(model, event)
}

fn pressed(model: &mut Model, keys: &Keys, key: Key) -> bool {
    let action = keys.action(key, model);
    // What is typed belongs to what is on top, and so do all keys but those that leave it as it is.
    let passes = key.typed().is_none() && action.is_some_and(Action::passes_popups);
    if !passes && update::popup::key(model, key) {
        return true;
    }
    action.into_iter().for_each(|action| update::act(model, action));
    action.is_some()
}
