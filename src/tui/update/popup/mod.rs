//! What keys, the mouse and a paste do to what lies over the panes.

mod prompt;

use crossterm::event::MouseEvent;

use crate::tui::key::Key;
use crate::tui::model::Model;
use crate::tui::popups::{Popup, Prompt, Question};

/// What becomes of a popup.
enum Then {
    /// It stays.
    Stay,
    /// It is done with, and shows what was under it.
    Close,
}

/// Asks a question, over what is there.
pub(in crate::tui) fn ask(model: &mut Model, question: Question) {
    put(model, Prompt::new(question));
}

/// Asks a question with an answer that only has to be confirmed.
pub(in crate::tui) fn confirm(model: &mut Model, question: Question, answer: &str) {
    put(model, Prompt::new(question).with(answer));
}

fn put(model: &mut Model, prompt: Prompt) {
    let under = model.popup.take().map(Box::new);
    let mut prompt = Prompt { under, ..prompt };
    prompt::offer(model, &mut prompt);
    model.popup = Some(Popup::Prompt(prompt));
}

/// Gives a key to the popup. Whether there is one.
pub(in crate::tui) fn key(model: &mut Model, key: Key) -> bool {
    change(model, |model, popup| match popup {
        Popup::Prompt(prompt) => prompt::key(model, prompt, key),
    })
}

/// Gives an event of the mouse to the popup. Whether there is one.
pub(in crate::tui) fn mouse(model: &mut Model, _event: MouseEvent) -> bool {
    model.popup.is_some()
}

/// Gives a pasted text to the popup. Whether there is one.
pub(in crate::tui) fn paste(model: &mut Model, text: &str) -> bool {
    change(model, |model, popup| match popup {
        Popup::Prompt(prompt) => prompt::paste(model, prompt, text),
    })
}

/// Changes the popup, which is not in the model meanwhile. Whether there is one.
fn change(model: &mut Model, change: impl FnOnce(&mut Model, &mut Popup) -> Then) -> bool {
    let Some(mut popup) = model.popup.take() else { return false };
    let then = change(model, &mut popup);
    // Where another was opened, that has taken its place.
    if model.popup.is_none() {
        model.popup = match then {
            Then::Stay => Some(popup),
            Then::Close => under(popup),
        };
    }
    true
}

/// What a popup lies over.
fn under(popup: Popup) -> Option<Popup> {
    match popup {
        Popup::Prompt(prompt) => prompt.under.map(|under| *under),
    }
}

#[cfg(test)]
mod tests;
