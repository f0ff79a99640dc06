//! The invariants: of the event that is shown, stage by stage, and of the whole state where it was looked at; what is broken stands first.
//!
//! ```text
//! ✗ MC     manifold  3         an edge has three faces  e12 e40
//! ✓ FC     links-join
//! ✓ FC     ends      0
//! ✓ end    topology
//! ```

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use super::rows;
use crate::report::{Check, StateReport};
use crate::tui::model::{Model, Pane, Place};
use crate::tui::text;
use crate::tui::theme::{Role, Theme};

/// Cells for a value.
const VALUE: usize = 9;

/// An invariant, and where it was looked at.
struct Row<'a> {
    at: String,
    check: &'a Check,
    /// Whether it comes after the place that is shown.
    later: bool,
}

fn rows_of(model: &Model) -> Vec<Row<'_>> {
    let mut rows = of_event(model);
    if let Some(end) = model.end.as_ref().filter(|_| model.place == Place::after(model.len())) {
        rows.extend(of_state("end", end));
    }
    if let Some((place, state)) = &model.checked {
        rows.extend(of_state(&format!("at {}", model.name(*place)), state));
    }
    // The sort is stable: what holds and what does not each stay in the order of the run.
    rows.sort_by_key(|row| row.check.ok);
    rows
}

fn of_event(model: &Model) -> Vec<Row<'_>> {
    let Some(report) = model.shown() else { return Vec::new() };
    let here = model.place.row(report);
    let stages = report.stages.iter().enumerate().flat_map(|(at, stage)| {
        let later = here.is_some_and(|here| at > here);
        stage.checks.iter().map(move |check| Row { at: stage.id.clone(), check, later })
    });
    let later = model.place.stage.is_some();
    let state = report.checks.iter().map(|check| Row { at: "state".into(), check, later });
    stages.chain(state).collect()
}

fn of_state<'a>(at: &str, state: &'a StateReport) -> impl Iterator<Item = Row<'a>> {
    let at = at.to_owned();
    state.checks.iter().map(move |check| Row { at: at.clone(), check, later: false })
}

pub(super) fn about(model: &Model) -> String {
    let rows = rows_of(model);
    match rows.iter().filter(|row| !row.check.ok).count() {
        0 if rows.is_empty() => String::new(),
        0 => format!("{} hold", rows.len()),
        broken => format!("{broken} of {} broken", rows.len()),
    }
}

pub(super) fn len(model: &Model) -> usize {
    rows_of(model).len()
}

/// The culprits of the chosen invariant.
pub(super) fn ids(model: &Model) -> Vec<String> {
    let rows = rows_of(model);
    let row = model.lists.checks.selected(rows.len());
    row.map_or(Vec::new(), |row| rows[row].check.culprits.clone())
}

/// The rows that have something to do with what is selected.
pub(super) fn marked(model: &Model) -> Vec<usize> {
    let rows = rows_of(model);
    (0..rows.len()).filter(|row| model.any_selected(&rows[*row].check.culprits)).collect()
}

pub(super) fn texts(model: &Model) -> Vec<String> {
    let text = |row: &Row<'_>| {
        let Row { at, check, .. } = row;
        let held = if check.ok { "holds" } else { "broken" };
        let value = check.value.map_or(String::new(), |value| format!("{value:e}"));
        format!("{at}\t{}\t{held}\t{value}\t{}\t{}", check.name, check.detail, check.culprits.join(" "))
    };
    rows_of(model).iter().map(text).collect()
}

/// Why there is nothing to see.
pub(super) fn nothing(model: &Model) -> &'static str {
    if model.shown().is_some() { "no invariant was looked at here" } else { "no event has run here" }
}

pub(super) fn draw(model: &Model, theme: &Theme, area: Rect, buffer: &mut Buffer) {
    let all = rows_of(model);
    let widest = |of: &dyn Fn(&Row<'_>) -> usize| all.iter().map(of).max().unwrap_or(0).min(16);
    let (at, name) = (widest(&|row| text::width(&row.at)), widest(&|row| text::width(&row.check.name)));
    rows::draw(Pane::Checks, model, theme, area, buffer, |row, width| {
        line(&all[row], model, theme, [at, name], width)
    });
}

fn line(row: &Row<'_>, model: &Model, theme: &Theme, widths: [usize; 2], width: usize) -> Line<'static> {
    let Row { at, check, later } = row;
    let role = if check.ok { Role::Good } else { Role::Bad };
    let weight = if *later { Role::Faint } else { Role::Text };
    let value = check.value.map_or(String::new(), figure);
    let mut spans = vec![
        Span::styled(format!("{} ", role.mark()), theme.style(if *later { Role::Faint } else { role })),
        Span::styled(format!("{} ", text::pad(at, widths[0])), theme.style(Role::Faint)),
        Span::styled(format!("{} ", text::pad(&check.name, widths[1])), theme.style(weight)),
        Span::styled(format!("{} ", text::pad(&value, VALUE)), theme.style(Role::Faint)),
    ];
    if model.any_selected(&check.culprits) {
        spans.push(rows::mark(true, theme));
    }
    let taken: usize = spans.iter().map(Span::width).sum();
    let said = format!("{}  {}", check.detail, check.culprits.join(" "));
    let role = if check.ok { Role::Faint } else { Role::Text };
    spans.push(Span::styled(text::fit(said.trim(), width.saturating_sub(taken)), theme.style(role)));
    Line::from(spans)
}

/// A value in a few digits: counts as they are, what is small by its exponent.
fn figure(value: f64) -> String {
    if value.fract() == 0.0 && value.abs() < 1e9 { format!("{value}") } else { format!("{value:.2e}") }
}
