//! What the worker tells.

use super::{picture, record, stops};
use crate::tui::action::Action;
use crate::tui::model::{Model, Place, Progress};
use crate::tui::popups::{Menu, Popup, What};
use crate::tui::worker::{Ask, Opened, Told};

/// Takes a word of the worker's.
pub(in crate::tui) fn told(model: &mut Model, told: Told) {
    match told {
        Told::Opened(opened) => open(model, *opened),
        Told::Report(report) => {
            model.timing.add(&report);
            record::reported(model, &report);
            model.reports.push(report);
            played(model);
        }
        Told::End(end) => model.end = Some(*end),
        Told::Finding(finding) => model.finding = Some(*finding),
        Told::At(standing) => {
            model.standing = Some(*standing);
            record::stood(model);
        }
        Told::Recorded(recorded) => {
            model.picture.forget();
            record::recorded(model, *recorded);
        }
        Told::Saved(path) => {
            record::saved(model, path);
            model.done |= model.leaving;
        }
        Told::Drafts(drafts) => record::drafts(model, drafts),
        Told::Progress { what, done, of } => model.progress = Some(Progress { what, done, of }),
        Told::Idle { urgent } => idle(model, urgent),
        Told::Picture(picture) => model.picture.take(*picture),
        Told::NoPicture { number, why } => model.picture.miss(number, why),
        Told::Identified(face) => picture::identified(model, face),
        Told::PictureSaved { path, size: [width, height] } => {
            model.say(format!("written to {}, {width} x {height}", path.display()));
        }
        Told::Checked(state) => {
            let broken = state.checks.iter().filter(|check| !check.ok).count();
            let all = state.checks.len();
            model.checked = Some((model.place, *state));
            match broken {
                0 => model.say(format!("all {all} invariants of the whole state hold here")),
                _ => {
                    model.complain(format!("{broken} of {all} invariants of the whole state are broken here"))
                }
            }
        }
        Told::Comparing { number, done, of } => super::compare::advanced(model, number, done, of),
        Told::Compared { number, found } => super::compare::compared(model, number, *found),
        Told::Stopped(why) => {
            model.playing = None;
            model.say(format!("stopped: {why}"));
        }
        Told::Broken(why) => broken(model, &why),
        Told::Failed(why) => {
            model.leaving = false;
            model.ahead.fail(model.answered);
            model.complain(why);
        }
    }
}

/// Playing went to an event of which nothing was known; now it is known whether it meets a breakpoint.
fn played(model: &mut Model) {
    if model.playing.is_some() && model.place == Place::after(model.reports.len()) {
        stops::halt(model, model.reports.len() - 1);
    }
}

/// What ran stays on the screen; nothing further can be asked about it.
fn broken(model: &mut Model, why: &str) {
    (model.standing, model.playing, model.wanted) = (None, None, None);
    model.ahead.fail(model.answered);
    model.picture.forget();
    model.complain(format!("a bug of lancet's: panicked: {why}; open the recording again to go on"));
    record::broken(model);
}

fn open(model: &mut Model, opened: Opened) {
    let comparisons = super::compare::end(model);
    let old = std::mem::take(model);
    // What was asked about what is gone is gone, too.
    let stays = |popup: &Popup| {
        matches!(popup, Popup::Menu(Menu { what: What::Help | What::Palette | What::Stops, .. }))
    };
    let (popup, kept) = (old.popup.filter(stays), old.kept);
    *model = Model {
        opened: Some(opened),
        popup,
        size: old.size,
        focus: old.focus,
        maximised: old.maximised,
        pace: old.pace,
        stops: old.stops,
        memory: old.memory,
        picture: old.picture.anew(),
        effects: old.effects,
        asked: old.asked,
        answered: old.answered,
        ahead: old.ahead,
        ..Model::default()
    };
    model.ask(Ask::Learn);
    record::opened(model, kept);
    super::compare::begin_first(model, comparisons);
}

/// Where the worker got to by itself, or was stopped, is where the screen goes too, unless it has been sent on since.
fn idle(model: &mut Model, urgent: bool) {
    model.answered += u64::from(urgent);
    model.ahead.answer(model.answered);
    if model.answered < model.asked {
        return;
    }
    model.progress = None;
    if let Some(standing) = &model.standing
        && standing.place != model.place
    {
        model.place = standing.place;
        model.follow();
    }
    let known = model.place.events < model.reports.len() || model.place == Place::after(model.len());
    if known && let Some(action) = model.wanted.take() {
        debug_assert_eq!(action, Action::NextStage);
        super::act(model, action);
    } else if model.reports.len() < model.len() {
        model.ask(Ask::Learn);
    }
}
