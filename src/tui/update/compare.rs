//! Comparing: what is compared with what, going from one divergence to the next, and taking what was found.

use std::path::{Path, PathBuf};

use crate::assets;
use crate::report::printable;
use crate::tui::action::Action;
use crate::tui::command;
use crate::tui::compare::{self, Comparing, Comparisons, Differences, Job, Row, With};
use crate::tui::model::{Model, Pane};
use crate::tui::worker::Ask;

pub(super) fn act(model: &mut Model, action: Action) {
    match action {
        Action::Compare => begin(model, With::Goldens, false),
        Action::NextDivergence => next(model),
        _ => choose(model),
    }
}

/// Compares with another run, as it was typed. An error says why that cannot be.
pub(in crate::tui) fn with(model: &mut Model, text: &str) -> Result<(), String> {
    try_to_begin(model, With::Run(text.trim().into()), false)
}

/// Compares the recording that is open, or says why that cannot be.
pub(in crate::tui) fn begin(model: &mut Model, with: With, then_go: bool) {
    if let Err(why) = try_to_begin(model, with, then_go) {
        model.complain(why);
    }
}

fn try_to_begin(model: &mut Model, with: With, then_go: bool) -> Result<(), String> {
    let path = comparable(model, &with);
    model.comparisons.refused = path.clone().err();
    let path = path?;
    model.comparisons.begun += 1;
    let job = Job { number: model.comparisons.begun, path, with };
    model.say(format!("comparing with {}", job.with.name()));
    model.comparing = Some(Comparing { job: job.clone(), done: 0, of: 0, then_go });
    model.ask(Ask::Compare(job));
    Ok(())
}

/// The file to be compared, if it and what it is compared with are there.
fn comparable(model: &Model, with: &With) -> Result<PathBuf, String> {
    match with {
        With::Run(path) if !assets::is_file(path) => {
            Err(format!("{}: there is no such file", printable(path.display())))
        }
        _ => command::file(model).map(Path::to_owned),
    }
}

/// Ends the comparison that is being made. Whether there was one.
pub(super) fn cancel(model: &mut Model) -> bool {
    let running = model.comparing.take().is_some();
    if running {
        model.ask(Ask::StopComparing);
        model.say("not compared: stopped");
    }
    running
}

/// Another recording is opened: what is being compared is of no use any longer.
pub(super) fn end(model: &mut Model) -> Comparisons {
    cancel(model);
    std::mem::take(&mut model.comparisons)
}

/// Another recording is open.
pub(super) fn begin_first(model: &mut Model, mut comparisons: Comparisons) {
    let first = comparisons.first.take();
    model.comparisons = comparisons;
    first.into_iter().for_each(|with| begin(model, with, false));
}

/// How far a comparison is.
pub(super) fn advanced(model: &mut Model, number: u64, done: usize, of: usize) {
    let wanted = model.comparing.as_mut().filter(|comparing| comparing.job.number == number);
    wanted.into_iter().for_each(|comparing| (comparing.done, comparing.of) = (done, of));
}

/// What a comparison came to, unless it is no longer wanted.
pub(super) fn compared(model: &mut Model, number: u64, found: Result<Differences, String>) {
    let Some(comparing) = model.comparing.take_if(|comparing| comparing.job.number == number) else { return };
    match found {
        Err(why) => {
            let why = format!("not compared: {why}");
            model.comparisons.refused = Some(why.clone());
            model.complain(why);
        }
        Ok(found) => {
            model.lists.differences.top();
            let verdict = compare::verdict(&found);
            if found.verified {
                model.say(verdict)
            } else {
                model.complain(verdict)
            }
            model.differences = Some(found);
            if comparing.then_go {
                next(model);
            }
        }
    }
}

/// Goes to the next place at which something differs, and from the last one to the first. Compares first where that was not done.
fn next(model: &mut Model) {
    let Some(differences) = &model.differences else {
        return begin(model, With::Goldens, true);
    };
    let differs = |row: &usize| !differences.is_fine(&differences.rows[*row]);
    let rows = (0..differences.rows.len()).filter(differs);
    let places: Vec<_> = rows.filter_map(|row| Some((compare::place(model, row)?, row))).collect();
    let on = places.iter().filter(|(place, _)| *place > model.place).min();
    let (Some((place, row)), wraps) = (on.or(places.iter().min()), on.is_none()) else {
        // What is wrong with the comparison as a whole, such as goldens that are missing, is at no event.
        return match differences.verified {
            true => model.say(format!("no event differs from {}", differences.with.name())),
            false => model.complain(compare::verdict(differences)),
        };
    };
    let (row, back) = (*row, wraps && *place != model.place);
    let alone = wraps && !back;
    show(model, row);
    match (alone, back) {
        (true, _) => note(model, "there is no other: "),
        (_, true) => note(model, "from the last to the first: "),
        _ => {}
    }
}

/// Says something before what is said.
fn note(model: &mut Model, words: &str) {
    let said = model.message.take().map_or(String::new(), |message| message.text);
    model.say(format!("{words}{said}"));
}

/// Shows what the chosen row is about.
fn choose(model: &mut Model) {
    let len = model.differences.as_ref().map_or(0, |differences| differences.rows.len());
    let row = model.lists.of(Pane::Differences).and_then(|list| list.selected(len));
    row.into_iter().for_each(|row| show(model, row));
}

/// Goes to the place of a row, and selects its elements everywhere.
fn show(model: &mut Model, row: usize) {
    let place = compare::place(model, row);
    place.into_iter().for_each(|place| super::go(model, place));
    let Some(differences) = &model.differences else { return };
    let (ids, said) = (differences.ids(&differences.rows[row]), said(differences, row));
    model.lists.differences.select(row, differences.rows.len());
    if !ids.is_empty() {
        model.selected = ids;
    }
    model.say(said);
}

/// What a row says, on a line.
fn said(differences: &Differences, row: usize) -> String {
    match &differences.rows[row] {
        Row::Problem(problem) => problem.clone(),
        Row::Value(value) => value.to_string(),
        Row::Picture(at) => {
            let picture = &differences.pictures[*at];
            let problems = picture.report.problems();
            problems.first().cloned().unwrap_or_else(|| format!("picture {} is fine", picture.checkpoint))
        }
    }
}
