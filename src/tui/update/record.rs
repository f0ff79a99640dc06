//! Recording by hand: what is asked of the worker, and what becomes of the screen when it answers.

use std::path::{Path, PathBuf};

use ratatui::layout::Position;

use super::popup;
use crate::assets;
use crate::recording::{AnyRecording, SceneRef, VIEWPORT};
use crate::replay::{self, Input};
use crate::report::{EventReport, Outcome};
use crate::tui::action::Action;
use crate::tui::model::{Model, Pane, Place, Timing};
use crate::tui::picture::golden::Golden;
use crate::tui::popups::Question;
use crate::tui::record::{self, Draft, Kept, Recorder, cross};
use crate::tui::shot::Subject;
use crate::tui::worker::{Ask, Hand, Recorded};

pub(super) fn act(model: &mut Model, action: Action) {
    match action {
        Action::Record if model.recorder.is_some() => stop(model),
        Action::Record if model.opened.is_some() => go_on(model),
        Action::Point => point(model),
        Action::CrossLeft => cross(model, [-1.0, 0.0], true),
        Action::CrossRight => cross(model, [1.0, 0.0], true),
        Action::CrossUp => cross(model, [0.0, -1.0], true),
        Action::CrossDown => cross(model, [0.0, 1.0], true),
        Action::NudgeLeft => cross(model, [-1.0, 0.0], false),
        Action::NudgeRight => cross(model, [1.0, 0.0], false),
        Action::NudgeUp => cross(model, [0.0, -1.0], false),
        Action::NudgeDown => cross(model, [0.0, 1.0], false),
        Action::Mode => hand(model, Hand::NextMode),
        Action::Undo => hand(model, Hand::Other(Input::Undo)),
        Action::Redo => hand(model, Hand::Other(Input::Redo)),
        Action::Drop => drop_last(model),
        Action::Checkpoint => popup::confirm(model, Question::Checkpoint, &free_name(model)),
        Action::Event => popup::ask(model, Question::Event),
        Action::Save if model.opened.is_none() => model.complain("nothing is open that could be saved"),
        Action::Save => popup::confirm(model, Question::Save, &file(model)),
        _ => popup::ask(model, Question::Scene),
    }
}

/// Goes on from the place that is shown, in a copy.
fn go_on(model: &mut Model) {
    let events = model.place.events;
    let dropped = model.len() - events;
    let viewport = model.opened.as_ref().map_or(VIEWPORT, |opened| opened.viewport);
    super::compare::cancel(model);
    change(model, Recorded { kept: events, unsaved: model.kept.unsaved, ..Recorded::default() });
    start(model, Recorder::new(viewport, events));
    model.ask(Ask::GoOn(events));
    match dropped {
        0 => model.say("recording on from here"),
        _ => model.say(format!("recording on from here, in a copy without the {dropped} events after it")),
    }
}

fn start(model: &mut Model, recorder: Recorder) {
    (model.playing, model.wanted) = (None, None);
    model.recorder = Some(recorder);
    model.focus = Pane::Picture;
    (model.picture.subject, model.picture.golden) = (Subject::Frame, Golden::Off);
}

/// Stops recording; what was recorded stays.
pub(super) fn stop(model: &mut Model) {
    if model.recorder.take().is_some() {
        let unsaved =
            if model.kept.unsaved { "; what was recorded is kept as a draft until it is saved" } else { "" };
        model.say(format!("no longer recording{unsaved}"));
    }
}

/// Whether something can be recorded now; says why not.
fn can_record(model: &mut Model) -> bool {
    if model.recorder.is_none() {
        model.complain("nothing is being recorded");
        return false;
    }
    if model.place != Place::after(model.len()) {
        model.complain("what is recorded comes at the end: go there first");
        return false;
    }
    true
}

fn hand(model: &mut Model, hand: Hand) {
    if can_record(model) {
        model.ask(Ask::Record(hand));
    }
}

fn drop_last(model: &mut Model) {
    if can_record(model) {
        match model.len() {
            0 => model.complain("there is no event to drop"),
            _ => model.ask(Ask::DropLast),
        }
    }
}

/// Points where the cross-hair is, in the view that the picture shows.
fn point(model: &mut Model) {
    if !can_record(model) {
        return;
    }
    if model.picture.is_flat() {
        return model.complain("this picture is not the frame: points are made in that");
    }
    if !is_seen(model) {
        return model.complain("the picture is still that of another view: point again when it is there");
    }
    let (at, from) =
        (model.recorder.as_ref().map_or([0.0; 2], |recorder| recorder.cross), model.picture.orbit);
    model.ask(Ask::Record(Hand::Point { at, from }));
}

/// Whether the picture that is there is seen from where it should be: one points at what one sees. Without any, one points by numbers.
fn is_seen(model: &Model) -> bool {
    let recorded = model.standing.as_ref().and_then(|standing| standing.orbit);
    let got = model.picture.got.as_ref().filter(|got| got.shot.subject == Subject::Frame);
    got.is_none_or(|got| got.shot.orbit.or(recorded) == model.picture.orbit.or(recorded))
}

fn cross(model: &mut Model, by: [f64; 2], by_cells: bool) {
    let Some(from) = model.recorder.as_ref().map(|recorder| recorder.cross) else { return };
    place_cross(model, cross::moved(model, from, by, by_cells));
}

/// Puts the cross-hair somewhere, and the picture so that it is seen.
fn place_cross(model: &mut Model, at: [f64; 2]) {
    model.message = None;
    model.recorder.iter_mut().for_each(|recorder| recorder.cross = at);
    if let Some(centre) = cross::out_of_sight(model, at) {
        model.picture.window.centre = centre;
    }
}

/// A click on the picture: puts the cross-hair there, and points. False if nothing is recorded, or the cell shows nothing of the view.
pub(in crate::tui) fn clicked(model: &mut Model, cell: Position) -> bool {
    let at = cross::position(model, cell).filter(|_| model.recorder.is_some());
    if let Some(at) = at {
        place_cross(model, at);
        point(model);
    }
    at.is_some()
}

/// Begins a recording on a scene, as it is typed.
pub(in crate::tui) fn begin(model: &mut Model, text: &str) -> Result<(), String> {
    let scene = text.trim();
    if scene.is_empty() {
        return Err("a scene is builtin:NAME, a scene file (.json) or a mesh file".into());
    }
    model.ask(Ask::Begin { scene: scene.into(), viewport: VIEWPORT });
    Ok(())
}

/// Sets a checkpoint.
pub(in crate::tui) fn checkpoint(model: &mut Model, text: &str) -> Result<(), String> {
    typed(model, Input::Checkpoint(text.trim().into()))
}

/// Records an event as it stands in a script.
pub(in crate::tui) fn event(model: &mut Model, text: &str) -> Result<(), String> {
    typed(model, Input::Script(text.into()))
}

fn typed(model: &mut Model, input: Input) -> Result<(), String> {
    require_possible(model, &input)?;
    hand(model, Hand::Other(input));
    Ok(())
}

/// Tries an input out on a recording of nothing but the checkpoints that there are, so that what is wrong with it is said where it is typed.
fn require_possible(model: &Model, input: &Input) -> Result<(), String> {
    let opened = model.opened.as_ref().ok_or("no recording is open")?;
    let mut blank = AnyRecording::begin(&opened.engine, SceneRef::Builtin(String::new()), opened.viewport)?;
    names(model).try_for_each(|name| blank.append(&Input::Checkpoint(name.into())).map(drop))?;
    blank.append(input).map(drop)
}

/// The checkpoints that there are.
fn names(model: &Model) -> impl Iterator<Item = &str> {
    model.reports.iter().filter_map(|report| report.checkpoint.as_deref())
}

/// A name that no checkpoint has.
fn free_name(model: &Model) -> String {
    let is_free = |name: &String| !names(model).any(|taken| taken == name);
    (1..).map(|number| format!("checkpoint-{number}")).find(is_free).unwrap_or_default()
}

/// Saves the recording. A file that is not its own has to be named twice.
pub(in crate::tui) fn save(model: &mut Model, text: &str) -> Result<(), String> {
    let mut path = PathBuf::from(text.trim());
    if model.opened.is_none() {
        return Err("no recording is open".into());
    }
    if assets::is_folder(&path) {
        return Err(format!("{}: is a folder", path.display()));
    }
    if path.extension().is_none() && path.file_name().is_some() {
        path.set_extension("lancet");
    }
    replay::require_form(&path).map_err(|error| error.to_string())?;
    let Kept { saved, refused, .. } = &mut model.kept;
    if assets::is_file(&path) && saved.as_ref() != Some(&path) && refused.as_ref() != Some(&path) {
        *refused = Some(path.clone());
        return Err(format!("{}: is there already; name it again to write over it", path.display()));
    }
    *refused = None;
    model.ask(Ask::Save(path));
    Ok(())
}

/// The file that it is saved to unless another is named.
fn file(model: &Model) -> String {
    model.kept.saved.as_deref().map_or_else(String::new, |path: &Path| path.display().to_string())
}

/// What was recorded, or dropped.
pub(super) fn recorded(model: &mut Model, recorded: Recorded) {
    let Recorded { kept, begins, pointed, .. } = recorded;
    let last = (kept + recorded.lines.len()).checked_sub(1);
    if begins {
        let viewport = model.opened.as_ref().map_or(VIEWPORT, |opened| opened.viewport);
        start(model, Recorder::new(viewport, kept));
        model.say("recording: enter points, two points make a cut, ctrl-s saves");
    }
    change(model, recorded);
    if let Some(recorder) = &mut model.recorder {
        recorder.from = recorder.from.min(kept);
        recorder.points.retain(|(event, _)| *event < kept);
        recorder.points.extend(last.zip(pointed));
    }
}

/// The events are others from one on. Who was at the end stays there.
fn change(model: &mut Model, Recorded { kept, lines, unsaved, .. }: Recorded) {
    let was_at_end = model.place == Place::after(model.len());
    model.kept.unsaved = unsaved;
    let Some(opened) = &mut model.opened else { return };
    if kept < opened.lines.len() || !lines.is_empty() {
        opened.path = None;
        (model.end, model.checked, model.differences) = (None, None, None);
    }
    opened.lines.truncate(kept);
    opened.lines.extend(lines);
    let (len, dropped) = (opened.lines.len(), model.reports.len() > kept);
    if dropped {
        model.reports.truncate(kept);
        model.timing = Timing::default();
        model.reports.iter().for_each(|report| model.timing.add(report));
        model.finding.take_if(|finding| finding.event.is_none_or(|event| event >= kept));
    }
    if was_at_end || model.place > Place::after(len) {
        model.place = Place::after(len);
        model.follow();
    }
}

/// It is saved.
pub(super) fn saved(model: &mut Model, path: PathBuf) {
    model.say(format!("saved as {}", path.display()));
    model.opened.iter_mut().for_each(|opened| opened.path = Some(path.clone()));
    (model.kept.unsaved, model.kept.saved) = (false, Some(path));
}

/// Something else is open. What was recorded before and not saved is among the drafts now.
pub(super) fn opened(model: &mut Model, before: Kept) {
    model.kept.drafts = before.drafts;
    if before.unsaved {
        model.ask(Ask::Drafts);
    }
}

/// What was open is closed. What was recorded is among the drafts.
pub(super) fn broken(model: &mut Model) {
    model.recorder = None;
    model.kept.unsaved = false;
    model.ask(Ask::Drafts);
}

/// There are recordings that were not saved, or not.
pub(super) fn drafts(model: &mut Model, drafts: Vec<Draft>) {
    match drafts.len() {
        _ if model.message.is_some() => {}
        0 => {}
        1 => model.say("a recording of before was not saved: ctrl-o opens it"),
        count => model.say(format!("{count} recordings of before were not saved: ctrl-o opens them")),
    }
    model.kept.drafts = drafts;
}

/// Says what became of an event that was recorded.
pub(super) fn reported(model: &mut Model, report: &EventReport) {
    if model.recorder.as_ref().is_none_or(|recorder| report.index < recorder.from) {
        return;
    }
    let kind = &report.kind;
    let detail = report.detail.as_deref().unwrap_or_default();
    match (report.outcome, &report.reason) {
        (Outcome::Rejected, reason) => {
            model.complain(format!("{kind}: {}: {detail}", reason.as_deref().unwrap_or("rejected")));
        }
        (Outcome::Pending, _) => model.say(format!("{kind}: a second point is waited for")),
        (Outcome::Cancelled, _) => model.say(format!("{kind}: the point that waited is dropped")),
        (Outcome::Applied, _) => model.say(format!("{kind}: done")),
        (Outcome::None, _) => model.say(kind.clone()),
    }
}

/// The view that was recorded is that of the picture: from now on it is seen from where the recording looks.
pub(super) fn stood(model: &mut Model) {
    if model.recorder.is_some() && !record::is_turned(model) {
        model.picture.orbit = None;
    }
}
