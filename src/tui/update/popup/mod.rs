//! What keys, the mouse and a paste do to what lies over the panes.

mod menu;
mod paths;
mod prompt;

use std::path::{Path, PathBuf};

use crossterm::event::MouseEvent;

use crate::assets;
use crate::recording::SceneRef;
use crate::report::printable;
use crate::tui::key::Key;
use crate::tui::model::Model;
use crate::tui::popups::{Menu, Popup, Prompt, Question, What};
use crate::tui::worker::Ask;

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

/// Shows a list to choose from.
pub(in crate::tui) fn choose(model: &mut Model, what: What) {
    model.popup = Some(Popup::Menu(Menu::new(what)));
}

/// Where recordings are looked for.
const RECORDINGS: &str = "recordings";

/// Offers what can be opened.
pub(in crate::tui) fn open(model: &mut Model) {
    let (files, error) = match assets::list_files(Path::new(RECORDINGS)) {
        Ok(files) => (files, None),
        Err(error) => (Vec::new(), Some(error.to_string())),
    };
    let is_one = |path: &PathBuf| path.extension().is_some_and(|end| end == "lancet" || end == "json");
    let files = files.into_iter().filter(is_one).collect();
    model.popup = Some(Popup::Menu(Menu { error, ..Menu::new(What::Open(files)) }));
}

/// Opens the recording or script that was typed, or begins a recording on a scene.
fn open_path(model: &mut Model, text: &str) -> Result<(), String> {
    let path = PathBuf::from(text.trim());
    let is_made = SceneRef::parse_builtin(text.trim()).is_some();
    if !is_made && !assets::is_file(&path) {
        return Err(format!("{}: there is no such file", printable(path.display())));
    }
    model.ask(Ask::Open(path));
    Ok(())
}

/// Leaves, unless something would be lost that nobody decided about.
pub(in crate::tui) fn quit(model: &mut Model) {
    match model.kept.unsaved {
        true => choose(model, What::Leave),
        false => model.done = true,
    }
}

/// Gives a key to the popup. Whether there is one.
pub(in crate::tui) fn key(model: &mut Model, key: Key) -> bool {
    change(model, |model, popup| match popup {
        Popup::Prompt(prompt) => prompt::key(model, prompt, key),
        Popup::Menu(menu) => menu::key(model, menu, key),
    })
}

/// Gives an event of the mouse to the popup. Whether there is one.
pub(in crate::tui) fn mouse(model: &mut Model, event: MouseEvent) -> bool {
    change(model, |model, popup| match popup {
        // A question is answered by typing; a click beside it must not throw the answer away.
        Popup::Prompt(_) => Then::Stay,
        Popup::Menu(menu) => menu::mouse(model, menu, event),
    })
}

/// Gives a pasted text to the popup. Whether there is one.
pub(in crate::tui) fn paste(model: &mut Model, text: &str) -> bool {
    change(model, |model, popup| match popup {
        Popup::Prompt(prompt) => prompt::paste(model, prompt, text),
        Popup::Menu(menu) => menu::paste(menu, text),
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
        Popup::Menu(_) => None,
    }
}

#[cfg(test)]
mod tests;
