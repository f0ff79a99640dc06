//! The keys of a question, and where its answer goes.

use super::{Then, paths};
use crate::assets::builtin;
use crate::tui::edit::Typed;
use crate::tui::key::Key;
use crate::tui::model::{Model, ran};
use crate::tui::popups::{Prompt, Question};
use crate::tui::update::{compare, picture, record, search, step, stops};

/// Does what was answered; an error says what is wrong with the answer.
fn answer(model: &mut Model, question: Question, text: &str) -> Result<(), String> {
    match question {
        Question::GoTo => step::go_to(model, text),
        Question::Search => search::find(model, text),
        Question::Stop => stops::add(model, text),
        Question::Checkpoint => record::checkpoint(model, text),
        Question::Event => record::event(model, text),
        Question::Save => record::save(model, text),
        Question::SavePicture => picture::save(model, text),
        Question::Scene => record::begin(model, text),
        Question::CompareWith => compare::with(model, text),
    }
}

pub(super) fn key(model: &mut Model, prompt: &mut Prompt, key: Key) -> Then {
    match key.to_string().as_str() {
        "esc" => {
            model.leaving = false;
            return Then::Close;
        }
        "enter" => return enter(model, prompt),
        "up" | "ctrl-p" => recall(model, prompt, 1),
        "down" | "ctrl-n" => recall(model, prompt, -1),
        "tab" => complete(prompt, 1),
        "shift-tab" => complete(prompt, -1),
        _ if prompt.edit.key(key) == Typed::Changed => typed(model, prompt),
        _ => {}
    }
    Then::Stay
}

pub(super) fn paste(model: &mut Model, prompt: &mut Prompt, text: &str) -> Then {
    prompt.edit.insert(text);
    typed(model, prompt);
    Then::Stay
}

/// The answer is another.
fn typed(model: &Model, prompt: &mut Prompt) {
    (prompt.error, prompt.recalled) = (None, None);
    offer(model, prompt);
}

fn enter(model: &mut Model, prompt: &mut Prompt) -> Then {
    let text = prompt.edit.text().trim().to_owned();
    // What the question was asked over is there again when it is answered.
    let under = prompt.under.take();
    model.popup = under.map(|under| *under);
    match answer(model, prompt.question, &text) {
        Ok(()) => {
            model.memory.answered(prompt.question, &text);
            Then::Close
        }
        Err(error) => {
            prompt.under = model.popup.take().map(Box::new);
            prompt.error = Some(error);
            Then::Stay
        }
    }
}

/// Goes back among the answers that were given before, or on.
fn recall(model: &Model, prompt: &mut Prompt, by: isize) {
    let answers = model.memory.answers(prompt.question);
    let at = prompt.recalled.as_ref().map_or(-1, |(at, _)| *at as isize) + by;
    let typed = prompt.recalled.take().map_or_else(|| prompt.edit.text().to_owned(), |(_, typed)| typed);
    match usize::try_from(at).ok().map(|at| at.min(answers.len().saturating_sub(1))) {
        Some(at) if !answers.is_empty() => {
            prompt.edit.set(&answers[at]);
            prompt.recalled = Some((at, typed));
        }
        _ => prompt.edit.set(&typed),
    }
    prompt.error = None;
    offer(model, prompt);
}

/// Types what all choices begin with, and then one after the other of them.
fn complete(prompt: &mut Prompt, by: isize) {
    if prompt.question.is_file() && prompt.choices.is_empty() {
        match paths::beginning(prompt.edit.text()) {
            Ok(files) => prompt.choices = files,
            Err(error) => prompt.error = Some(error),
        }
    }
    let common = paths::common(&prompt.choices);
    if prompt.chosen.is_none() && common.len() > prompt.edit.text().len() {
        return prompt.edit.set(&common);
    }
    let Some(last) = prompt.choices.len().checked_sub(1) else { return };
    let at = match (prompt.chosen, by) {
        (None, 1..) => 0,
        (None, _) => last,
        (Some(at), by) => (at + prompt.choices.len()).saturating_add_signed(by) % prompt.choices.len(),
    };
    prompt.chosen = Some(at);
    prompt.edit.set(&prompt.choices[at]);
}

/// Offers what begins with what was typed. Folders are only looked at when that is asked for.
pub(super) fn offer(model: &Model, prompt: &mut Prompt) {
    prompt.chosen = None;
    prompt.choices = match prompt.question {
        Question::GoTo => stages(model, prompt.edit.text()),
        Question::Stop => stops::words(model),
        Question::Scene => builtin::list().iter().map(|scene| scene_of(scene.name)).collect(),
        _ => Vec::new(),
    };
    let typed = prompt.edit.text();
    prompt.choices.retain(|choice| choice.starts_with(typed) && choice != typed);
}

/// How a built-in scene is named where scenes are typed; where it takes a number, up to that.
pub(super) fn scene_of(name: &str) -> String {
    format!("builtin:{}", name.strip_suffix('N').unwrap_or(name))
}

/// The stages of the event that was typed.
fn stages(model: &Model, text: &str) -> Vec<String> {
    let event = text.split_once('.').and_then(|(number, _)| number.parse().ok());
    let report = event.and_then(|event| model.report(event));
    let rows = report.into_iter().flat_map(|report| ran(report).into_iter().map(|row| &report.stages[row]));
    rows.map(|stage| format!("{}.{}", event.unwrap_or(0), stage.id)).collect()
}
