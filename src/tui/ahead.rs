//! What is typed while something is being opened: it is kept, and takes effect once that is open, in order. What cannot be opened takes it along.
//!
//! Only keys and pasted texts wait. A click is about what one sees, and that will be gone.

use std::collections::VecDeque;

use crossterm::event::Event;

use super::action::Action;
use super::key::Key;
use super::keys::Keys;
use super::model::Model;

/// See the module.
#[derive(Clone, Debug, Default)]
pub(in crate::tui) struct Ahead {
    /// Which of all that the worker was asked is the opening; none while nothing is being opened.
    until: Option<u64>,
    typed: VecDeque<Event>,
}

impl Ahead {
    /// Something is being opened: it is the last of so many things that the worker was asked.
    pub(in crate::tui) fn begin(&mut self, asked: u64) {
        self.until = Some(asked);
    }

    /// What the worker does after so many answers went wrong.
    pub(in crate::tui) fn fail(&mut self, answered: u64) {
        if self.until == Some(answered + 1) {
            self.typed.clear();
        }
    }

    /// The worker has given so many answers.
    pub(in crate::tui) fn answer(&mut self, answered: u64) {
        self.until.take_if(|until| *until <= answered);
    }

    /// How much waits.
    pub(in crate::tui) fn len(&self) -> usize {
        self.typed.len()
    }

    /// The next that has waited long enough.
    pub(in crate::tui) fn next(&mut self) -> Option<Event> {
        if self.until.is_some() { None } else { self.typed.pop_front() }
    }
}

/// Keeps what has to wait; gives back what has not.
pub(in crate::tui) fn keep(model: &mut Model, keys: &Keys, event: Event) -> Option<Event> {
    if model.ahead.until.is_none() || !waits(model, keys, &event) {
        return Some(event);
    }
    model.ahead.typed.push_back(event);
    None
}

fn waits(model: &Model, keys: &Keys, event: &Event) -> bool {
    match event {
        Event::Key(event) => {
            Key::pressed(*event).is_some_and(|key| !is_for_now(model, keys.action(key, model)))
        }
        Event::Paste(_) => true,
        _ => false,
    }
}

/// What has nothing to do with what is being opened; and nobody has to wait for it only in order to leave.
fn is_for_now(model: &Model, action: Option<Action>) -> bool {
    let leaves = action == Some(Action::Quit) && model.ahead.typed.is_empty() && !model.kept.unsaved;
    leaves || action.is_some_and(Action::passes_popups)
}

#[cfg(test)]
mod tests {
    use crossterm::event::KeyEvent;

    use super::*;
    use crate::tui::events::{catch_up, take};
    use crate::tui::model::{Effect, Place};
    use crate::tui::update::{self, kit};
    use crate::tui::worker::{Ask, Told};

    fn press(model: &mut Model, text: &str) {
        for word in text.split(' ') {
            let key: Key = word.parse().expect("a key");
            take(model, &Keys::new(&[]), Event::Key(KeyEvent::new(key.code(), key.modifiers())));
        }
    }

    fn tell(model: &mut Model, all: impl IntoIterator<Item = Told>) {
        for told in all {
            update::told(model, told);
            catch_up(model, &Keys::new(&[]));
        }
    }

    /// A screen that has asked for a recording, and then for something else.
    fn opening() -> Model {
        let mut model = Model { size: [80, 24], ..Model::default() };
        update::begin(&mut model, Some("some/where.lancet".into()));
        model
    }

    fn opened() -> Told {
        Told::Opened(Box::new(kit::model().opened.expect("it is open")))
    }

    const IDLE: Told = Told::Idle { urgent: true };

    #[test]
    fn what_is_typed_while_opening_takes_effect_when_it_is_open_in_order() {
        let mut model = opening();
        press(&mut model, "l l h l l 4 ? x");
        assert_eq!((model.ahead.len(), model.place, model.popup.is_some()), (8, Place::START, false));
        tell(&mut model, [opened()]);
        assert_eq!(model.place, Place::START, "it is not told all yet");
        tell(&mut model, [IDLE]);
        assert_eq!((model.ahead.len(), model.place), (0, Place::after(3)));
        let Some(crate::tui::popups::Popup::Menu(menu)) = &model.popup else { panic!("the help") };
        assert_eq!(menu.edit.text(), "x", "what is typed after it is typed into it");
        let went = model.effects.iter().filter_map(|effect| match effect {
            Effect::Ask(Ask::Go(place)) => Some(place.events),
            _ => None,
        });
        assert_eq!(went.collect::<Vec<_>>(), [1, 2, 1, 2, 3]);
    }

    #[test]
    fn what_cannot_be_opened_takes_along_what_was_typed_for_it() {
        for why in [Told::Failed("no such file".into()), Told::Broken("a bug".into())] {
            let mut model = opening();
            press(&mut model, "ctrl-o l");
            tell(&mut model, [why, IDLE]);
            assert!(model.ahead.len() == 0 && model.popup.is_none());
            press(&mut model, "?");
            assert!(model.popup.is_some(), "keys are taken again");
        }
        // Something that was asked before and went wrong is not the opening.
        let mut model = kit::model();
        model.ask(Ask::Check);
        model.ask(Ask::Open("other.lancet".into()));
        press(&mut model, "l");
        tell(&mut model, [Told::Failed("nothing to check".into()), IDLE]);
        assert_eq!(model.ahead.len(), 1);
        tell(&mut model, [opened(), IDLE]);
        assert_eq!(model.place, Place::after(1));
    }

    #[test]
    fn who_wants_to_leave_need_not_wait() {
        let mut model = opening();
        press(&mut model, "q");
        assert!(model.done);
        let mut model = opening();
        press(&mut model, "l q");
        assert!(!model.done, "it comes after what is still to be done");
        press(&mut model, "ctrl-c");
        assert!(model.done);
    }
}
