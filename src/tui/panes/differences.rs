//! What the run is compared with, and all that differs; below the list, what its chosen row says in full.
//!
//! ```text
//! ┌7 differences the goldens───────────────────────────────────────────┐
//! │✗ not as the goldens: 2 values differ, 1 pictures differ            │
//! │◆   4 ✗ MC nodes n120     (0.1, 2.0, 0.0)    (0.1, 2.000000000000000│
//! │    4 ✗ counter links     12                 13                     │
//! │    9 ✗ picture after     tile 12.3, outliers 40, …                 │
//! │   12 ✓ picture end       equal                                     │
//! │                                                                    │
//! │expected (0.1, 2.0, 0.0)                                            │
//! │found    (0.1, 2.0000000000000004, 0.0) (1 ulp)                     │
//! └────────────────────────────────────────────────────────────────────┘
//! ```
//!
//! Where there is no room for columns of values, the chosen row's stand below alone.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use ratatui::widgets::{Paragraph, Widget, Wrap};

use super::rows;
use crate::tui::compare::{At, Differences, Row, verdict};
use crate::tui::model::{Model, Pane};
use crate::tui::text::{fit, line, pad};
use crate::tui::theme::{Role, Theme};
use crate::verify::{ComparedPicture, Divergence, ImageVerdict};

/// Cells from which there are columns of values, and how wide the column of names is then.
const COLUMNS: usize = 70;
const NAME: usize = 26;
/// Cells before a row's text: what is selected, the event, the mark.
const HEAD: usize = 9;
/// Lines that the chosen row has below, where there is room; and how many lines there have to be for any.
const SAID: u16 = 4;
const ROOM: u16 = 5;

pub(super) fn about(model: &Model) -> String {
    match (&model.comparing, &model.differences) {
        (Some(comparing), _) => format!("comparing with {}", line(&comparing.job.with.name())),
        (None, Some(differences)) => line(&differences.with.name()),
        (None, None) => String::new(),
    }
}

pub(super) fn len(model: &Model) -> usize {
    model.differences.as_ref().map_or(0, |differences| differences.rows.len())
}

pub(super) fn ids(model: &Model) -> Vec<String> {
    chosen(model).map_or(Vec::new(), |(differences, row)| differences.ids(row))
}

pub(super) fn marked(model: &Model) -> Vec<usize> {
    let Some(differences) = &model.differences else { return Vec::new() };
    let rows = differences.rows.iter().enumerate();
    rows.filter(|(_, row)| model.any_selected(&differences.ids(row))).map(|(at, _)| at).collect()
}

/// Event, name and all that is said of each row.
pub(super) fn texts(model: &Model) -> Vec<String> {
    let Some(differences) = &model.differences else { return Vec::new() };
    let text = |row: &Row| {
        let said = said(differences, row).into_iter().map(|(_, text)| text);
        [at(differences, row), name(differences, row)].into_iter().chain(said).collect::<Vec<_>>().join("\t")
    };
    differences.rows.iter().map(text).collect()
}

/// Why there are no rows.
pub(super) fn nothing(model: &Model) -> &'static str {
    match (&model.comparing, &model.differences) {
        (Some(_), _) => "comparing…",
        (None, None) => {
            "nothing is compared yet: `compare` does it with the goldens, `compare-with` with another run"
        }
        (None, Some(_)) => "nothing differs",
    }
}

fn chosen(model: &Model) -> Option<(&Differences, &Row)> {
    let differences = model.differences.as_ref()?;
    let row = model.lists.differences.selected(differences.rows.len())?;
    Some((differences, &differences.rows[row]))
}

/// The part that has the rows: below the verdict, and above what the chosen row says.
pub(super) fn body(area: Rect) -> Rect {
    let head = u16::from(area.height > 1);
    let said = if area.height < ROOM { 0 } else { SAID.min(area.height / 2) };
    Rect { y: area.y + head, height: area.height - head - said, ..area }
}

pub(super) fn draw(model: &Model, theme: &Theme, area: Rect, body: Rect, buffer: &mut Buffer) {
    let Some((differences, chosen)) = chosen(model) else { return };
    if body.y > area.y {
        let role = if differences.verified { Role::Good } else { Role::Bad };
        let text = fit(&format!("{} {}", role.mark(), verdict(differences)), area.width.into());
        Line::styled(text, theme.style(role)).render(Rect { height: 1, ..area }, buffer);
    }
    rows::draw(Pane::Differences, model, theme, body, buffer, |row, width| {
        let row = &differences.rows[row];
        entry(differences, row, model.any_selected(&differences.ids(row)), theme, width)
    });
    let below = Rect { y: body.bottom(), height: area.bottom() - body.bottom(), ..area };
    let said = said(differences, chosen)
        .into_iter()
        .map(|(name, text)| Line::from(vec![Span::styled(name, theme.style(Role::Faint)), Span::raw(text)]));
    Paragraph::new(said.collect::<Vec<_>>()).wrap(Wrap { trim: false }).render(below, buffer);
}

fn entry(differences: &Differences, row: &Row, selected: bool, theme: &Theme, wide: usize) -> Line<'static> {
    let role = if differences.is_fine(row) { Role::Good } else { Role::Bad };
    Line::from(vec![
        rows::mark(selected, theme),
        Span::styled(format!("{:>4} ", fit(&at(differences, row), 4)), theme.style(Role::Faint)),
        Span::styled(format!("{} ", role.mark()), theme.style(role)),
        Span::raw(cells(differences, row, wide.saturating_sub(HEAD))),
    ])
}

/// The event of a row, or what stands for it.
fn at(differences: &Differences, row: &Row) -> String {
    match differences.at(row) {
        Some(At::Event(event)) => event.to_string(),
        Some(At::Start) => "0".into(),
        Some(At::End) => "end".into(),
        None => String::new(),
    }
}

/// What a row says in its line.
fn cells(differences: &Differences, row: &Row, wide: usize) -> String {
    let name = name(differences, row);
    let values = match row {
        Row::Problem(_) => Vec::new(),
        Row::Value(value) => vec![value.expected.clone(), value.found.clone()],
        Row::Picture(at) => vec![measured(&differences.pictures[*at])],
    };
    if values.is_empty() || wide + HEAD < COLUMNS {
        return fit(&name, wide);
    }
    let each = (wide - NAME) / values.len();
    let values = values.iter().map(|value| format!("{} ", pad(value, each.saturating_sub(1))));
    pad(&name, NAME - 1) + " " + &values.collect::<String>()
}

/// What a row is about, without its event.
fn name(differences: &Differences, row: &Row) -> String {
    match row {
        Row::Problem(problem) => line(problem),
        Row::Value(value) => line(&what(value)),
        Row::Picture(at) => format!("picture {}", line(&differences.pictures[*at].checkpoint)),
    }
}

fn what(value: &Divergence) -> String {
    let event = value.event.map_or(String::new(), |event| format!("event {event}"));
    let what = value.what.strip_prefix(&event).unwrap_or(&value.what).trim_start();
    match (&value.stage, &value.buffer, &value.element) {
        (Some(stage), Some(buffer), Some(element)) => format!("{stage} {buffer} {element}"),
        (Some(stage), Some(buffer), None) => format!("{stage} {buffer}"),
        _ if what.is_empty() => "outcome".into(),
        _ => what.into(),
    }
}

fn measured(picture: &ComparedPicture) -> String {
    let distance = picture.report.distance.map_or(String::new(), |distance| format!(": {distance}"));
    match picture.report.verdict {
        ImageVerdict::Equal => "equal".into(),
        ImageVerdict::Within => format!("within its gate{distance}"),
        ImageVerdict::Beyond => format!("beyond its gate{distance}"),
        ImageVerdict::Unseen => "there is no golden".into(),
    }
}

/// All that a row has to say: names and texts.
fn said(differences: &Differences, row: &Row) -> Vec<(&'static str, String)> {
    match row {
        Row::Problem(problem) => vec![("", line(problem))],
        Row::Value(value) => {
            let note = value.note.iter().map(|note| ("", line(note)));
            [("expected ", line(&value.expected)), ("found    ", line(&value.found))]
                .into_iter()
                .chain(note)
                .collect()
        }
        Row::Picture(at) => of_picture(&differences.pictures[*at]),
    }
}

fn of_picture(picture: &ComparedPicture) -> Vec<(&'static str, String)> {
    let gate = &picture.report.gate;
    let measured = [
        ("found    ", line(&measured(picture))),
        ("at most  ", line(&format!("{} ({})", gate.most, gate.of))),
    ];
    // That it is beyond its gate is said already.
    let beyond = usize::from(picture.report.verdict == ImageVerdict::Beyond);
    let missed = picture.report.problems().into_iter().skip(beyond).map(|problem| ("", line(&problem)));
    measured.into_iter().chain(missed).collect()
}

#[cfg(test)]
mod tests;
