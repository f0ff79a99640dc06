//! Stepping: where the run is looked at.
//!
//! What has run is walked at once, and the worker follows. What has not is run by the worker first; a step by stages then waits for the report,
//! which tells what stages there are.

use std::time::Duration;

use crate::report::EventReport;
use crate::tui::action::Action;
use crate::tui::model::{Model, Pace, Place, ran};
use crate::tui::update::stops;
use crate::tui::worker::Ask;

/// The pauses that playing can have, milliseconds.
const PACES: [u64; 8] = [0, 50, 100, 200, 500, 1000, 2000, 5000];

pub(super) fn act(model: &mut Model, action: Action) {
    match action {
        Action::NextEvent => go(model, Place::after(model.place.events + 1)),
        Action::PreviousEvent => previous(model),
        Action::NextStage => next_stage(model),
        Action::PreviousStage => previous_stage(model),
        Action::NextCut => search(model, "cut", true, &|report| report.cut),
        Action::PreviousCut => search(model, "cut", false, &|report| report.cut),
        Action::NextCheckpoint => search(model, "checkpoint", true, &|report| report.checkpoint.is_some()),
        Action::PreviousCheckpoint => {
            search(model, "checkpoint", false, &|report| report.checkpoint.is_some())
        }
        Action::First => go(model, Place::START),
        Action::Last => go(model, Place::after(model.len())),
        Action::FirstFinding => first_finding(model),
        Action::Play => play(model),
        Action::Faster => pace(model, -1),
        Action::Slower => pace(model, 1),
        Action::RunOn => stops::run_on(model),
        Action::Cancel => cancel(model),
        _ => model.ask(Ask::Check),
    }
}

/// Shows another place.
pub(in crate::tui) fn go(model: &mut Model, place: Place) {
    let place = Place { events: place.events.min(model.len()), ..place };
    model.message = None;
    if place != model.place {
        model.place = place;
        model.ask(Ask::Go(place));
    }
    model.follow();
}

/// Goes where an answer says: `12` is event 12, `12.MC` that stage of it, `12.1` the first of its stages that ran.
pub(super) fn go_to(model: &mut Model, text: &str) -> Result<(), String> {
    let (number, stage) = text.split_once('.').map_or((text, None), |(number, stage)| (number, Some(stage)));
    let last = model.len().checked_sub(1).ok_or("there are no events yet")?;
    let event: Option<usize> = number.trim().parse().ok().filter(|event| *event <= last);
    let event =
        event.ok_or_else(|| format!("there is no event `{}`; there are 0 to {last}", number.trim()))?;
    let place = match stage {
        None => Place::after(event + 1),
        Some(stage) => within(model, event, stage.trim())?,
    };
    go(model, place);
    Ok(())
}

/// After a stage of an event, by name or by its number among those that ran.
fn within(model: &Model, event: usize, stage: &str) -> Result<Place, String> {
    let unknown =
        || format!("event {event} has not run yet, so its stages are not known: go to `{event}` first");
    let report = model.report(event).ok_or_else(unknown)?;
    let rows = ran(report);
    let named = rows.iter().find(|row| report.stages[**row].id.eq_ignore_ascii_case(stage));
    let numbered = || rows.get(stage.parse::<usize>().ok()?.checked_sub(1)?);
    let row = *named.or_else(numbered).ok_or_else(|| no_stage(report, stage, &rows))?;
    // After the last stage there is what the session does with the work: the event is over.
    let over = rows.last() == Some(&row);
    Ok(if over { Place::after(event + 1) } else { Place { events: event, stage: Some(row) } })
}

/// Why an event has no such stage, and which it has.
fn no_stage(report: &EventReport, stage: &str, rows: &[usize]) -> String {
    let event = report.index;
    let skipped = report.stages.iter().find(|row| row.id.eq_ignore_ascii_case(stage));
    let why = match skipped.and_then(|row| row.skipped.as_ref()) {
        Some(reason) => format!("stage {stage} of event {event} was skipped: {reason}"),
        None => format!("event {event} has no stage `{stage}`"),
    };
    let ran: Vec<&str> = rows.iter().map(|row| report.stages[*row].id.as_str()).collect();
    match ran.is_empty() {
        true => format!("{why}; none ran"),
        false => format!("{why}; there are 1 to {}: {}", ran.len(), ran.join(", ")),
    }
}

fn previous(model: &mut Model) {
    let Place { events, stage } = model.place;
    // From within an event one step back is its beginning.
    go(model, Place::after(if stage.is_some() { events } else { events.saturating_sub(1) }));
}

fn next_stage(model: &mut Model) {
    let place = model.place;
    if place.events == model.len() {
        return;
    }
    match place.stage_on(model.report(place.events)) {
        Some(on) => go(model, on),
        None => {
            model.wanted = Some(Action::NextStage);
            model.ask(Ask::Learn);
        }
    }
}

fn previous_stage(model: &mut Model) {
    if let Some(back) = model.place.stage_back(|event| model.report(event)) {
        go(model, back);
    }
}

/// Goes to after the next event that is something, or the one before.
fn search(model: &mut Model, what: &str, on: bool, is: &dyn Fn(&EventReport) -> bool) {
    let here = model.place.event();
    let found = if on {
        let from = here.map_or(0, |event| event + 1);
        (from..model.reports.len()).find(|event| model.report(*event).is_some_and(is))
    } else {
        (0..here.unwrap_or(0)).rev().find(|event| model.report(*event).is_some_and(is))
    };
    match found {
        Some(event) => go(model, Place::after(event + 1)),
        None if on && model.reports.len() < model.len() => {
            model.say(format!("no further {what} among the events that have run"));
        }
        None => model.say(format!("no further {what}")),
    }
}

fn first_finding(model: &mut Model) {
    let Some(finding) = model.finding.clone() else {
        let all = model.reports.len() == model.len();
        return model.say(if all { "every invariant holds" } else { "every invariant held so far" });
    };
    go(model, Place::after(finding.event.map_or(model.len(), |event| event + 1)));
    model.selected.clone_from(&finding.check.culprits);
    model.say(format!("{} broke: {}", finding.name(), finding.check.detail));
}

fn play(model: &mut Model) {
    model.playing = match model.playing {
        Some(_) => None,
        None => Some(model.pace.0),
    };
}

fn pace(model: &mut Model, by: isize) {
    let now = model.pace.0.as_millis() as u64;
    let at = PACES.iter().position(|ms| *ms >= now).unwrap_or(PACES.len() - 1);
    let ms = PACES[at.saturating_add_signed(by).min(PACES.len() - 1)];
    model.pace = Pace(Duration::from_millis(ms));
    model.playing = model.playing.map(|_| model.pace.0);
    model.say(format!("{ms} ms after each event"));
}

/// The next event, if it is time for one: the worker stands where it should, and the picture of that place is there.
pub(in crate::tui) fn beat(model: &mut Model) {
    if model.playing.is_none() || model.here().is_none() {
        return;
    }
    if model.place.events == model.len() {
        model.playing = None;
        return;
    }
    let event = model.place.events;
    go(model, Place::after(event + 1));
    stops::halt(model, event);
}

fn cancel(model: &mut Model) {
    if super::compare::cancel(model) {
        return;
    }
    let idle = model.playing.is_none() && model.progress.is_none();
    (model.playing, model.wanted) = (None, None);
    if model.progress.is_some() {
        model.ask(Ask::Cancel);
    }
    model.message = None;
    if idle {
        super::record::stop(model);
    }
}
