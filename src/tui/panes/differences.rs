//! What the run is compared with, and all that differs; below the list, what its chosen row says in full.
//!
//! ```text
//! ┌7 differences the goldens───────────────────────────────────────────┐
//! │✗ not as the goldens: 2 values differ, 1 pictures differ            │
//! │▸  4 ✗ MC nodes n120     (0.1, 2.0, 0.0)    (0.1, 2.0000000000000004│
//! │   4 ✗ counter links     12                 13                      │
//! │   9 ✗ picture after     tile 12.3, outliers 40, …                  │
//! │  12 ✓ picture end       equal                                      │
//! │                                                                    │
//! │expected (0.1, 2.0, 0.0)                                            │
//! │found    (0.1, 2.0000000000000004, 0.0) (1 ulp)                     │
//! └────────────────────────────────────────────────────────────────────┘
//! ```
//!
//! Where there is no room for columns of values, the chosen row's stand below alone.

use ratatui::buffer::Buffer;
use ratatui::layout::{Constraint, Layout, Rect};
use ratatui::text::{Line, Span};
use ratatui::widgets::{Paragraph, Widget, Wrap};

use crate::tui::compare::{At, Differences, Row, verdict};
use crate::tui::model::{Model, Pane};
use crate::tui::text::{fit, line, pad, width};
use crate::tui::theme::{Role, Theme};
use crate::verify::{ComparedPicture, Divergence, ImageVerdict};

/// Cells from which there are columns of values, and how wide the column of names is then.
const COLUMNS: usize = 70;
const NAME: usize = 26;
/// Cells before a row's text: the cursor, the event, the mark.
const HEAD: usize = 8;

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

fn chosen(model: &Model) -> Option<(&Differences, &Row)> {
    let differences = model.differences.as_ref()?;
    let row = model.lists.differences.selected(differences.rows.len())?;
    Some((differences, &differences.rows[row]))
}

pub(super) fn draw(model: &Model, theme: &Theme, area: Rect, buffer: &mut Buffer) {
    let Some(differences) = &model.differences else { return nothing(model, theme, area, buffer) };
    let said = chosen(model).map_or(Vec::new(), |(all, row)| said(all, row));
    let below = height(&said, area);
    let parts = [Constraint::Length(1), Constraint::Fill(1), Constraint::Length(below)];
    let [top, list, bottom] = area.layout(&Layout::vertical(parts));
    let role = if differences.verified { Role::Good } else { Role::Bad };
    Line::styled(format!("{} {}", role.mark(), line(&verdict(differences))), theme.style(role))
        .render(top, buffer);
    rows(model, differences, theme, list, buffer);
    let said = said.into_iter().map(|(name, text)| labelled(name, text, theme)).collect::<Vec<_>>();
    Paragraph::new(said).wrap(Wrap { trim: false }).render(bottom, buffer);
}

/// Before anything was compared.
fn nothing(model: &Model, theme: &Theme, area: Rect, buffer: &mut Buffer) {
    let text = match model.comparing {
        Some(_) => "comparing…",
        None => "nothing is compared yet: compare does it with the goldens, compare-with with another run",
    };
    let text = Paragraph::new(text).wrap(Wrap { trim: true }).style(theme.style(Role::Faint));
    text.render(area, buffer);
}

fn labelled<'a>(name: &'a str, text: String, theme: &Theme) -> Line<'a> {
    Line::from(vec![Span::styled(name, theme.style(Role::Faint)), Span::raw(text)])
}

/// Lines that what is said takes at most, and no more than half of the pane; none in a pane that is hardly there.
fn height(said: &[(&str, String)], area: Rect) -> u16 {
    let wide = usize::from(area.width).max(1);
    // Words that do not fit are moved on whole, which wastes some cells of a line.
    let lines = |(name, text): &(&str, String)| (width(name) + width(text)).div_ceil(wide * 4 / 5 + 1).max(1);
    let lines: usize = said.iter().map(lines).sum();
    if area.height < 4 { 0 } else { (area.height / 2).min(lines.min(usize::from(u16::MAX)) as u16) }
}

fn rows(model: &Model, differences: &Differences, theme: &Theme, area: Rect, buffer: &mut Buffer) {
    let list = &model.lists.differences;
    let chosen = list.selected(differences.rows.len());
    for (y, at) in (area.y..).zip(list.window(area.height.into(), differences.rows.len())) {
        let place = Rect { y, height: 1, ..area };
        let row = &differences.rows[at];
        if Some(at) == chosen {
            let role = if model.focus == Pane::Differences { Role::Selected } else { Role::Idle };
            buffer.set_style(place, theme.style(role));
        }
        entry(differences, row, Some(at) == chosen, theme, area.width.into()).render(place, buffer);
    }
}

fn entry<'a>(differences: &Differences, row: &Row, chosen: bool, theme: &Theme, wide: usize) -> Line<'a> {
    let role = if differences.is_fine(row) { Role::Good } else { Role::Bad };
    let cursor = if chosen { Role::Selected.mark() } else { " " };
    let event = match differences.at(row) {
        Some(At::Event(event)) => event.to_string(),
        Some(At::Start) => "start".into(),
        Some(At::End) => "end".into(),
        None => String::new(),
    };
    Line::from(vec![
        Span::raw(format!("{cursor}{event:>4} ")),
        Span::styled(format!("{} ", role.mark()), theme.style(role)),
        Span::raw(cells(differences, row, wide.saturating_sub(HEAD))),
    ])
}

/// What a row says in its line.
fn cells(differences: &Differences, row: &Row, wide: usize) -> String {
    let (name, values) = match row {
        Row::Problem(problem) => return fit(problem, wide),
        Row::Value(value) => (name(value), vec![value.expected.clone(), value.found.clone()]),
        Row::Picture(at) => {
            let picture = &differences.pictures[*at];
            (format!("picture {}", picture.checkpoint), vec![measured(picture)])
        }
    };
    if wide + HEAD < COLUMNS {
        return fit(&name, wide);
    }
    let each = (wide - NAME) / values.len();
    let values = values.iter().map(|value| format!("{} ", pad(value, each.saturating_sub(1))));
    pad(&name, NAME - 1) + " " + &values.collect::<String>()
}

/// What differs, without the event.
fn name(value: &Divergence) -> String {
    let event = value.event.map_or(String::new(), |event| format!("event {event} "));
    let what = value.what.strip_prefix(&event).unwrap_or(&value.what);
    match (&value.stage, &value.buffer, &value.element) {
        (Some(stage), Some(buffer), Some(element)) => format!("{stage} {buffer} {element}"),
        (Some(stage), Some(buffer), None) => format!("{stage} {buffer}"),
        _ if what.is_empty() || Some(what) == event.strip_suffix(' ') => "outcome".into(),
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
        Row::Picture(at) => {
            let picture = &differences.pictures[*at];
            let gate = &picture.report.gate;
            let missed = picture
                .report
                .problems()
                .into_iter()
                .filter(|_| picture.report.verdict != ImageVerdict::Beyond);
            let missed = missed.map(|problem| ("", line(&problem)));
            let measured = [
                ("found    ", line(&measured(picture))),
                ("at most  ", line(&format!("{} ({})", gate.most, gate.of))),
            ];
            measured.into_iter().chain(missed).collect()
        }
    }
}
