//! What is typed, clicked and pasted, as changes of the model.

use crossterm::event::Event;

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
        _ => false,
    }
}

fn pressed(model: &mut Model, keys: &Keys, key: Key) -> bool {
    let action = keys.action(key, model);
    action.into_iter().for_each(|action| update::act(model, action));
    action.is_some()
}
