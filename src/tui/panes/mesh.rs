//! What the state is made of: before the event that is shown, after it or at the place within it, and what else is known of the state there.
//!
//! ```text
//!           before   after  change
//! edges     14,031  14,136    +105
//! faces      9,354   9,424     +70
//! euler                  2
//! digest  6ba63e91c70fd6d0ce8df77cbdf41480
//! view    azimuth 0.30  zenith 1.57  distance 40.0
//! kept    1.21 MB for going back
//! ```

use std::collections::BTreeMap;

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use ratatui::widgets::Widget;

use super::grid::Grid;
use super::rows;
use crate::tui::model::{Model, Pane, Place};
use crate::tui::text;
use crate::tui::theme::{Role, Theme};

/// A row: figures in columns, or words after a name.
enum Row {
    Figures([String; 4]),
    Words(&'static str, String),
}

/// Cells for the names of rows of words.
const NAME: usize = 9;

fn rows_of(model: &Model) -> Vec<Row> {
    let mut rows: Vec<Row> = sizes(model).into_iter().map(Row::Figures).collect();
    let (counts, digest) = whole(model);
    let known: Vec<String> = names(model);
    let counts = counts.into_iter().flatten().filter(|(name, _)| !known.contains(name));
    rows.extend(counts.map(|(name, count)| {
        Row::Figures([name.replace('_', " "), String::new(), signed(*count), String::new()])
    }));
    rows.extend(digest.map(|digest| Row::Words("digest", digest.to_owned())));
    rows.extend(words(model));
    rows
}

/// What the sizes are of.
fn names(model: &Model) -> Vec<String> {
    match model.shown() {
        Some(report) => report.sizes.keys().cloned().collect(),
        None => model
            .here()
            .map_or(Vec::new(), |here| here.sizes.iter().map(|(name, _)| (*name).to_owned()).collect()),
    }
}

/// Name, before, after or here, and change.
fn sizes(model: &Model) -> Vec<[String; 4]> {
    let here = |name: &str| {
        let standing = model.here()?;
        standing.sizes.iter().find(|(other, _)| *other == name).map(|(_, size)| *size)
    };
    let row = |name: String| {
        let [before, after] = model
            .shown()
            .and_then(|report| report.sizes.get(&name).copied())
            .map_or([None; 2], |[before, after]| [Some(before), Some(after)]);
        // Within an event the state is neither; at the beginning there is nothing before.
        let now = if model.place.stage.is_some() || before.is_none() { here(&name) } else { after };
        let written = |size: Option<u64>| size.map_or("…".into(), text::count);
        let change = before.zip(now).map_or(String::new(), |(before, now)| change(before, now));
        [name, before.map_or(String::new(), text::count), written(now), change]
    };
    names(model).into_iter().map(row).collect()
}

fn change(before: u64, now: u64) -> String {
    match now.cmp(&before) {
        std::cmp::Ordering::Equal => "·".into(),
        std::cmp::Ordering::Greater => format!("+{}", text::count(now - before)),
        std::cmp::Ordering::Less => format!("−{}", text::count(before - now)),
    }
}

fn signed(count: i64) -> String {
    let digits = text::count(count.unsigned_abs());
    if count < 0 { format!("−{digits}") } else { digits }
}

/// Counts and digest of the whole state, where it was looked at.
fn whole(model: &Model) -> (Option<&BTreeMap<String, i64>>, Option<&str>) {
    let event = model.shown().filter(|_| model.place.stage.is_none());
    let of_event = event.and_then(|report| Some((&report.counts, report.state.as_deref()?)));
    let end = model.end.as_ref().filter(|_| model.place == Place::after(model.len()));
    let checked = model.checked.as_ref().filter(|(place, _)| *place == model.place).map(|(_, state)| state);
    let of_state = end.or(checked).map(|state| (&state.counts, state.digest.as_str()));
    of_event.or(of_state).unzip()
}

/// What is known in words.
fn words(model: &Model) -> Vec<Row> {
    let standing = model.standing.as_ref();
    let view = model.here().and_then(|here| here.orbit).map(|orbit| {
        let [azimuth, zenith, distance] = [orbit.azimuth, orbit.zenith, orbit.distance];
        Row::Words("view", format!("azimuth {azimuth:.2}  zenith {zenith:.2}  distance {distance:.1}"))
    });
    let kept = standing.map(|standing| {
        Row::Words("kept", format!("{} for going back", text::bytes(standing.kept_bytes as u64)))
    });
    let opened = model.opened.as_ref();
    let of = |name, what: &dyn Fn(&crate::tui::worker::Opened) -> String| {
        opened.map(|opened| Row::Words(name, what(opened)))
    };
    let scene = of("scene", &|opened| opened.scene.clone());
    let viewport = of("viewport", &|opened| format!("{} x {}", opened.viewport[0], opened.viewport[1]));
    let renderer = of("renderer", &|opened| opened.renderer.clone());
    [view, kept, scene, viewport, renderer].into_iter().flatten().collect()
}

pub(super) fn len(model: &Model) -> usize {
    rows_of(model).len()
}

/// What the figures are of.
pub(super) fn about(model: &Model) -> String {
    match (model.shown(), model.place.stage) {
        (None, _) if model.opened.is_some() => "before the first event".into(),
        (None, _) => String::new(),
        (Some(_), Some(_)) => format!("at {}", text::line(&model.name(model.place))),
        (Some(report), None) => format!("after {}", report.index),
    }
}

pub(super) fn texts(model: &Model) -> Vec<String> {
    let text = |row: Row| match row {
        Row::Figures(cells) => cells.join("\t"),
        Row::Words(name, words) => format!("{name}\t{words}"),
    };
    rows_of(model).into_iter().map(text).collect()
}

/// Why there is nothing to see.
pub(super) fn nothing(_: &Model) -> &'static str {
    "nothing is open"
}

/// Draws the heads in the first line, and the rows in `body`.
pub(super) fn draw(model: &Model, theme: &Theme, area: Rect, body: Rect, buffer: &mut Buffer) {
    let all = rows_of(model);
    let now = if model.place.stage.is_some() { "here" } else { "after" };
    let heads = ["", "before", now, "change"].map(String::from);
    let figures = all.iter().map(|row| match row {
        Row::Figures(cells) => cells.to_vec(),
        Row::Words(..) => Vec::new(),
    });
    let grid = Grid::new(&heads, figures);
    if body.y > area.y {
        let head = grid.head(area.width as usize);
        Line::styled(head, theme.style(Role::Faint)).render(Rect { height: 1, ..area }, buffer);
    }
    rows::draw(Pane::Mesh, model, theme, body, buffer, |row, width| match &all[row] {
        Row::Figures(_) => Line::raw(grid.line(row, width)),
        Row::Words(name, words) => Line::from(vec![
            Span::styled(text::pad(name, NAME.min(width)), theme.style(Role::Faint)),
            Span::raw(text::fit(words, width.saturating_sub(NAME))),
        ]),
    });
}
