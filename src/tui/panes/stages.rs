//! The stages of the event that is shown: how long each took, beside what it took over the run, or why it was skipped.
//!
//! ```text
//!   FC   112 µs  █┼─
//! ▸ MC   520 µs  ████████─┼─────
//!   CI   skipped: mode
//! ```
//!
//! The bar is this event's time, the line the middle half of the stage's times over the run, the cross their median; where there is room they are
//! written out, too. `▸` is where one is, and what comes after it is fainter. A checkpoint has what was done for its frame instead.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use super::rows;
use crate::report::{EventReport, Pass, StageReport};
use crate::tui::model::{Model, Pane, Place, Spread};
use crate::tui::theme::{Role, Theme};
use crate::tui::{text, update};

/// From this width on the spread is written out, and from that on titles, too.
const WITH_SPREAD: usize = 72;
const WITH_TITLES: usize = 108;
const TITLE: usize = 28;
const SPREAD: usize = 46;
const TIME: usize = 8;

/// A stage, or a pass of the frame.
enum Row<'a> {
    Stage(&'a StageReport),
    Pass(&'a Pass),
}

fn rows_of(report: Option<&EventReport>) -> Vec<Row<'_>> {
    let stages = report.into_iter().flat_map(|report| report.stages.iter().map(Row::Stage));
    stages.chain(report.into_iter().flat_map(|report| report.passes.iter().map(Row::Pass))).collect()
}

impl<'a> Row<'a> {
    fn id(&self) -> &'a str {
        match self {
            Self::Stage(stage) => &stage.id,
            Self::Pass(pass) => &pass.id,
        }
    }

    fn us(&self) -> f64 {
        match self {
            Self::Stage(stage) => stage.us,
            Self::Pass(pass) => pass.us,
        }
    }

    fn skipped(&self) -> Option<&'a str> {
        match self {
            Self::Stage(stage) => stage.skipped.as_deref(),
            Self::Pass(pass) => pass.skipped.as_deref(),
        }
    }
}

pub(super) fn len(model: &Model) -> usize {
    rows_of(model.shown()).len()
}

/// What the event is, and how long it took.
pub(super) fn about(model: &Model) -> String {
    let Some(report) = model.shown() else { return String::new() };
    let us: f64 = rows_of(Some(report)).iter().filter(|row| row.skipped().is_none()).map(Row::us).sum();
    let time = if us > 0.0 { format!(" {}", text::us(us)) } else { String::new() };
    format!("{} {}{time}", report.index, text::line(&report.kind))
}

/// The screen goes to after the stage of the chosen row. Of a skipped one, that is after the one before.
pub(super) fn chosen(model: &mut Model) {
    let len = len(model);
    let Some(row) = model.lists.stages.selected(len) else { return };
    if let Some(place) = model.shown().and_then(|report| Place::after_row(report, row)) {
        update::go(model, place);
        model.lists.stages.select(row, len);
    }
}

/// The culprits of what a stage broke.
pub(super) fn ids(model: &Model) -> Vec<String> {
    let rows = rows_of(model.shown());
    let row = model.lists.stages.selected(rows.len()).and_then(|row| rows.get(row));
    row.map_or(Vec::new(), |row| culprits(row).cloned().collect())
}

fn culprits<'a>(row: &Row<'a>) -> impl Iterator<Item = &'a String> + use<'a> {
    let checks = match row {
        Row::Stage(stage) => &stage.checks[..],
        Row::Pass(_) => &[],
    };
    checks.iter().filter(|check| !check.ok).flat_map(|check| &check.culprits)
}

pub(super) fn texts(model: &Model) -> Vec<String> {
    let text = |row: &Row<'_>| {
        let said = match row.skipped() {
            Some(reason) => format!("skipped: {reason}"),
            None => format!("{}\t{}", row.us(), spread(model, row).map_or(String::new(), written)),
        };
        format!("{}\t{}\t{said}", row.id(), title(model, row))
    };
    rows_of(model.shown()).iter().map(text).collect()
}

/// Why there is nothing to see.
pub(super) fn nothing(model: &Model) -> &'static str {
    if model.shown().is_some() { "no stages in this event" } else { "no event has run here" }
}

pub(super) fn draw(model: &Model, theme: &Theme, area: Rect, buffer: &mut Buffer) {
    let all = rows_of(model.shown());
    let reach = |row: &Row<'_>| spread(model, row).map_or(row.us(), |spread| spread.high.max(row.us()));
    let scale = all.iter().map(reach).fold(0.0, f64::max);
    let ids = all.iter().map(|row| text::width(row.id())).max().unwrap_or(0).min(12);
    let here = model.shown().and_then(|report| model.place.row(report));
    rows::draw(Pane::Stages, model, theme, area, buffer, |row, width| {
        Look { model, theme, ids, scale, here, width }.line(row, &all[row])
    });
}

/// How rows are drawn.
struct Look<'a> {
    model: &'a Model,
    theme: &'a Theme,
    /// Cells for the names.
    ids: usize,
    /// Microseconds of a whole bar.
    scale: f64,
    /// The row of the place.
    here: Option<usize>,
    width: usize,
}

impl Look<'_> {
    fn line(&self, at: usize, row: &Row<'_>) -> Line<'static> {
        let later = matches!(row, Row::Stage(_)) && self.here.is_some_and(|here| at > here);
        let faint = later || row.skipped().is_some();
        let weight = |role| self.theme.style(if faint { Role::Faint } else { role });
        let mut spans =
            vec![self.mark(at, row), Span::styled(text::pad(row.id(), self.ids), weight(Role::Title))];
        if self.width >= WITH_TITLES {
            spans.push(Span::styled(
                format!("  {}", text::pad(&title(self.model, row), TITLE)),
                weight(Role::Text),
            ));
        }
        spans.push(Span::raw(" "));
        if let Some(reason) = row.skipped() {
            let taken: usize = spans.iter().map(Span::width).sum();
            let said = text::fit(&format!(" skipped: {reason}"), self.width.saturating_sub(taken));
            spans.push(Span::styled(said, self.theme.style(Role::Faint)));
            return Line::from(spans);
        }
        spans.push(Span::styled(text::pad_start(&text::us(row.us()), TIME), weight(Role::Text)));
        spans.push(Span::raw(" "));
        let taken: usize = spans.iter().map(Span::width).sum();
        let note = self.note(row);
        let room = self.width.saturating_sub(taken + text::width(&note));
        spans.extend(self.bar(row, room, faint));
        spans.push(Span::styled(note, self.theme.style(Role::Faint)));
        Line::from(spans)
    }

    /// Where one is, or what is selected.
    fn mark(&self, at: usize, row: &Row<'_>) -> Span<'static> {
        let selected = culprits(row).any(|id| self.model.is_selected(id));
        let broken = matches!(row, Row::Stage(stage) if stage.checks.iter().any(|check| !check.ok));
        let (mark, role) = match (selected, broken) {
            (true, _) => (Role::Marked.mark(), Role::Marked),
            (_, true) => (Role::Bad.mark(), Role::Bad),
            _ if self.here == Some(at) => ("▸", Role::Accent),
            _ => (" ", Role::Text),
        };
        Span::styled(format!("{mark} "), self.theme.style(role))
    }

    /// What is written beside the bar.
    fn note(&self, row: &Row<'_>) -> String {
        match row {
            Row::Pass(pass) if pass.of > 0 => format!(" {}/{} tiles", pass.tiles, pass.of),
            Row::Stage(_) if self.width >= WITH_SPREAD => {
                let spread = spread(self.model, row).map_or(String::new(), written);
                text::pad(&format!("  {spread}"), SPREAD)
            }
            _ => String::new(),
        }
    }

    /// The bar, with the spread over it.
    fn bar(&self, row: &Row<'_>, room: usize, faint: bool) -> Vec<Span<'static>> {
        let share = |us: f64| if self.scale > 0.0 { us / self.scale } else { 0.0 };
        let cell = |us: f64| ((share(us) * room as f64) as usize).min(room.saturating_sub(1));
        let marks = spread(self.model, row).filter(|spread| spread.count > 1);
        let mark = |at: usize, symbol: char| match &marks {
            Some(spread) if at == cell(spread.median) => ('┼', Role::Accent),
            Some(spread) if symbol == ' ' && (cell(spread.low)..=cell(spread.high)).contains(&at) => {
                ('─', Role::Border)
            }
            _ => (symbol, if faint { Role::Faint } else { Role::Bar }),
        };
        let bar = text::bar(share(row.us()), room);
        let marked = bar.chars().enumerate().map(|(at, symbol)| mark(at, symbol));
        marked.map(|(symbol, role)| Span::styled(symbol.to_string(), self.theme.style(role))).collect()
    }
}

/// The times of a stage over the run.
fn spread(model: &Model, row: &Row<'_>) -> Option<Spread> {
    match row {
        Row::Stage(stage) => model.timing.spread(&stage.id),
        Row::Pass(_) => None,
    }
}

/// Median and quartiles, and of how many.
fn written(spread: Spread) -> String {
    let Spread { low, median, high, count, .. } = spread;
    format!("median {} ({}…{}, {count} runs)", text::us(median), text::us(low), text::us(high))
}

/// What a stage is called in full.
fn title(model: &Model, row: &Row<'_>) -> String {
    let stages = model.opened.as_ref().map_or(&[][..], |opened| &opened.stages);
    match row {
        Row::Stage(stage) => stages.iter().find(|(id, _)| *id == stage.id),
        Row::Pass(_) => None,
    }
    .map_or(String::new(), |(_, title)| title.clone())
}
