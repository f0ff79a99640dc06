//! The commands that do the same as the screen, with what is on it filled in.
//!
//! | in the table of actions | stands for |
//! | --- | --- |
//! | `{rec}` | the recording |
//! | `{place}` | EVENT, EVENT.STAGE, or `start` |
//! | `{stops}` | `--stop-at` for each breakpoint |
//! | `{compare}` | `verify` of the recording, or `diff` with the run that it is compared with |
//! | `{json}` | that run's report |
//! | `{png}`, `{dir}`, `{script}` | a file or folder to write, or to read a script from, named after the recording |
//! | `{azimuth}`, `{zenith}`, `{distance}` | where the picture is looked at from |
//! | `{select}`, `{lines}`, `{tint}`, `{map}` | a flag for what is selected, the lines drawn, the faces coloured, the map; nothing where there is none |
//! | `{shown}` | all that is drawn, and from where |
//!
//! Words are quoted for a POSIX shell.

use std::path::Path;

use crate::canvas::image::MapId;
use crate::report::Overlay;
use crate::tui::action::{Action, Row};
use crate::tui::compare::With;
use crate::tui::model::{Model, Pane, Place};
use crate::tui::shot::{Subject, Tint};

/// The command of an action, with what is on the screen filled in; none of what only moves about on it.
pub(in crate::tui) fn of(model: &Model, row: &Row) -> Option<String> {
    Some(line(&words(model, row.command?)))
}

/// The command that shows the same as the whole screen. An error says why there is none.
pub(in crate::tui) fn whole(model: &Model) -> Result<String, String> {
    let path = file(model)?;
    path.to_str().ok_or("the recording's path is not Unicode")?;
    let compared = model.focus == Pane::Differences && model.differences.is_some();
    let action = if compared { Action::NextDivergence } else { Action::CopyCommand };
    of(model, action.row()).ok_or_else(|| "it only moves about on the screen".into())
}

/// The file with what is open. An error says why there is none.
pub(in crate::tui) fn file(model: &Model) -> Result<&Path, String> {
    let opened = model.opened.as_ref().ok_or("nothing is open")?;
    let saved = opened.path.as_deref().filter(|_| !model.kept.unsaved);
    saved.ok_or_else(|| "what is open is in no file: save it first".into())
}

/// The words of a command line.
pub(in crate::tui) fn words(model: &Model, template: &str) -> Vec<String> {
    let words = template.split_whitespace().flat_map(|word| match word.strip_prefix('{') {
        Some(name) => filled(model, name.trim_end_matches('}')),
        None => vec![word.to_owned()],
    });
    ["lancet".to_owned()].into_iter().chain(words).collect()
}

fn filled(model: &Model, name: &str) -> Vec<String> {
    match name {
        "rec" => vec![recording(model)],
        "place" => vec![place(model)],
        "stops" => model.stops.iter().flat_map(|stop| ["--stop-at".into(), stop.to_string()]).collect(),
        "compare" => compare(model),
        "json" => vec![other(model).unwrap_or_else(|| "RUN.json".into())],
        "png" => vec![format!("{}-{}.png", stem(model), place(model))],
        "dir" => vec![format!("{}-report", stem(model))],
        "script" => vec![format!("{}.json", stem(model))],
        "select" => flag("--select", &model.selected),
        "lines" => flag("--overlay", &lines(model)),
        "tint" => flag("--overlay", &tint(model)),
        "map" => flag("--map", &map(model)),
        "shown" => shown(model),
        _ => angle(model, name).into_iter().collect(),
    }
}

/// The recording's file, or a word for it.
fn recording(model: &Model) -> String {
    file(model).ok().and_then(Path::to_str).map_or("REC".into(), argument)
}

/// A path as an argument: what begins with a hyphen would be a flag.
fn argument(path: &str) -> String {
    if path.starts_with('-') { format!("./{path}") } else { path.into() }
}

/// The recording's name.
fn stem(model: &Model) -> String {
    let stem = file(model).ok().and_then(|path| path.file_stem()?.to_str());
    argument(stem.unwrap_or("recording"))
}

/// A place as `--until` takes it.
fn place(model: &Model) -> String {
    let Place { events, stage } = model.place;
    let id = stage.and_then(|row| Some(&model.report(events)?.stages.get(row)?.id));
    match (id, model.place.event()) {
        (Some(id), _) => format!("{events}.{id}"),
        (None, Some(event)) => event.to_string(),
        (None, None) => "start".into(),
    }
}

/// The run that it is compared with.
fn other(model: &Model) -> Option<String> {
    match &model.differences.as_ref()?.with {
        With::Run(path) => path.to_str().map(argument),
        With::Goldens => None,
    }
}

fn compare(model: &Model) -> Vec<String> {
    match other(model) {
        Some(other) => vec!["diff".into(), other, recording(model)],
        None => vec!["verify".into(), recording(model)],
    }
}

/// A flag with a list of values; nothing where there are none.
fn flag(name: &str, values: &[String]) -> Vec<String> {
    if values.is_empty() { Vec::new() } else { vec![name.into(), values.join(",")] }
}

/// What can be drawn over the picture of the event that is shown.
fn overlays(model: &Model) -> &[Overlay] {
    model.shown().map_or(&[], |report| &report.overlays)
}

fn lines(model: &Model) -> Vec<String> {
    let lines = overlays(model).iter().filter(|overlay| !matches!(overlay, Overlay::Faces { .. }));
    lines.map(|overlay| overlay.name().to_owned()).collect()
}

fn tint(model: &Model) -> Vec<String> {
    match &model.picture.drawn.tint {
        Tint::None => Vec::new(),
        Tint::Charts => vec!["charts".into()],
        Tint::Group(group) => vec![group.clone()],
    }
}

fn map(model: &Model) -> Vec<String> {
    let name = match model.picture.subject {
        Subject::Frame => return Vec::new(),
        Subject::Map(MapId::Color) => "colour",
        Subject::Map(MapId::Discolor) => "discolor",
        Subject::Map(MapId::Normal) => "normal",
        Subject::Map(MapId::Occlusion) => "occlusion",
        Subject::Map(MapId::Specular) => "specular",
    };
    vec![name.into()]
}

/// One of the three numbers of where the picture is looked at from.
fn angle(model: &Model, name: &str) -> Option<String> {
    let orbit = model.orbit();
    let value = orbit.map(|orbit| match name {
        "azimuth" => orbit.azimuth,
        "zenith" => orbit.zenith,
        _ => orbit.distance,
    });
    Some(value.map_or(name.to_uppercase(), |value| value.to_string()))
}

/// All that is drawn, in the order in which it is, and from where.
fn shown(model: &Model) -> Vec<String> {
    let drawn = &model.picture.drawn;
    let wire = drawn.wire.then(|| "wire".to_owned());
    let lines = if drawn.lines { lines(model) } else { Vec::new() };
    let overlays: Vec<String> = tint(model).into_iter().chain(wire).chain(lines).collect();
    let from = match (model.picture.subject, model.picture.orbit) {
        (Subject::Frame, Some(orbit)) => {
            let numbers =
                [("--azimuth", orbit.azimuth), ("--zenith", orbit.zenith), ("--distance", orbit.distance)];
            numbers.iter().flat_map(|(name, value)| [(*name).to_owned(), value.to_string()]).collect()
        }
        _ => Vec::new(),
    };
    [flag("--map", &map(model)), from, flag("--overlay", &overlays), flag("--select", &model.selected)]
        .concat()
}

/// A command line as it is typed.
fn line(words: &[String]) -> String {
    words.iter().map(|word| quoted(word)).collect::<Vec<_>>().join(" ")
}

/// A word as a POSIX shell reads it.
fn quoted(word: &str) -> String {
    let plain = |letter: char| letter.is_ascii_alphanumeric() || "_-./,=+:@%".contains(letter);
    if !word.is_empty() && word.chars().all(plain) {
        word.into()
    } else {
        format!("'{}'", word.replace('\'', r"'\''"))
    }
}

#[cfg(test)]
mod tests;
