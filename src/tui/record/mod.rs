//! The recording that is being made: where its cross-hair is, what it waits for, what of it is not saved.
//!
//! Every event is at the end: what comes after the place where one begins is dropped, from a copy. Turning the model changes only the picture; the
//! view is recorded when a point is made in it, so that a recording has one event for it and not one for every key.

pub(in crate::tui) mod cross;
mod drafts;
#[cfg(test)]
mod tests;

use std::path::PathBuf;

use ratatui::text::Span;

pub use drafts::Drafts;
pub(in crate::tui) use drafts::{Draft, Slot};

use crate::report::Outcome;
use crate::tui::model::Model;
use crate::tui::theme::{Role, Theme};

/// What there is while a recording is being made.
#[derive(Clone, Debug, Default, PartialEq)]
pub(in crate::tui) struct Recorder {
    /// The cross-hair, in pixels of the recorded view from the top left.
    pub(in crate::tui) cross: [f64; 2],
    /// How many events there were before.
    pub(in crate::tui) from: usize,
    /// The events that pointed, and where.
    pub(in crate::tui) points: Vec<(usize, [f64; 2])>,
}

/// What becomes of what was recorded, whether it still goes on or not.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(in crate::tui) struct Kept {
    /// Whether some of it is in no file but its draft.
    pub(in crate::tui) unsaved: bool,
    /// The file that it was saved to.
    pub(in crate::tui) saved: Option<PathBuf>,
    /// The file that was there, and may be written over if it is named again.
    pub(in crate::tui) refused: Option<PathBuf>,
    /// Recordings of before that were not saved, the newest first.
    pub(in crate::tui) drafts: Vec<Draft>,
}

impl Recorder {
    /// With the cross-hair in the middle of a view, after some events.
    pub(in crate::tui) fn new(viewport: [u32; 2], from: usize) -> Self {
        Self { cross: viewport.map(|side| f64::from(side) / 2.0), from, points: Vec::new() }
    }
}

/// The event whose point waits for another one, at the place that is shown.
pub(in crate::tui) fn waiting(model: &Model) -> Option<usize> {
    let ran = &model.reports[..model.place.events.min(model.reports.len())];
    let last = ran.iter().rposition(|report| report.outcome != Outcome::None)?;
    (ran[last].outcome == Outcome::Pending).then_some(last)
}

/// Where the point is that waits, as far as it was made here.
pub(in crate::tui) fn waiting_at(model: &Model) -> Option<[f64; 2]> {
    let event = waiting(model)?;
    let points = &model.recorder.as_ref()?.points;
    points.iter().find(|(pointed, _)| *pointed == event).map(|(_, at)| *at)
}

/// Whether the picture is seen from elsewhere than the recording does.
pub(in crate::tui) fn is_turned(model: &Model) -> bool {
    let recorded = model.standing.as_ref().and_then(|standing| standing.orbit);
    model.picture.orbit.is_some_and(|orbit| Some(orbit) != recorded)
}

/// What the status line says of the recording that is being made; empty when there is none.
pub(in crate::tui) fn status<'a>(model: &Model, theme: &Theme) -> Vec<Span<'a>> {
    let Some(recorder) = &model.recorder else { return Vec::new() };
    let mode = model.standing.as_ref().map_or("", |standing| standing.mode);
    let mut spans = vec![
        Span::styled("● ", theme.style(Role::Bad)),
        Span::styled(format!("{} ", at(recorder.cross)), theme.style(Role::Accent)),
        Span::styled(format!("{mode} "), theme.style(Role::Faint)),
    ];
    if waiting(model).is_some() {
        let place = waiting_at(model).map_or_else(String::new, |point| format!(" at {}", at(point)));
        spans.push(match is_turned(model) {
            false => Span::styled(format!("a point waits{place} "), theme.style(Role::Accent)),
            true => Span::styled(
                format!("the view is another: pointing drops the point that waits{place} "),
                theme.style(Role::Warn),
            ),
        });
    }
    spans
}

/// A position as it is recorded.
pub(in crate::tui) fn at([x, y]: [f64; 2]) -> String {
    format!("{x} {y}")
}
