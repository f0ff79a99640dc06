//! The events, with what became of them.
//!
//! ```text
//!     ── start
//!   0   mode merge
//!   1 … click 580 235
//! ● 2◆✓ click 700 250                    1.41 ms
//!   3 ! cut node 17 edge 40 0.5 silhouette
//!   4 ✓≠click 702 318 ▸ after FC         1.20 ms
//!   5 ⚑ checkpoint end
//! ```
//!
//! First stands a breakpoint that would hit, then the number, then a mark where the event has to do with what is selected, then what became of it, and
//! whether that is not as in what the run is compared with; then its own words. What has not run yet is fainter.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use super::{rows, words};
use crate::report::{EventReport, Outcome};
use crate::tui::model::{Model, Pane, Place};
use crate::tui::theme::{Role, Theme};
use crate::tui::{compare, text, update};

/// From this width on there is a column of times.
const WITH_TIMES: usize = 34;
/// Its width.
const TIME: usize = 8;

/// A row for the beginning, and one for each event.
pub(super) fn len(model: &Model) -> usize {
    model.len() + 1
}

/// How many of each outcome there are.
pub(super) fn about(model: &Model) -> String {
    // Where a value differs, both are told.
    if let Some(value) = model.place.event().and_then(|event| compare::marks(model, event)) {
        return format!("≠ expected {}, found {}", value.expected, value.found);
    }
    let count = |outcome| model.reports.iter().filter(|report| report.outcome == outcome).count();
    let (applied, rejected) = (count(Outcome::Applied), count(Outcome::Rejected));
    match (applied, rejected) {
        (0, 0) => String::new(),
        (_, 0) => format!("{applied} applied"),
        (0, _) => format!("{rejected} rejected"),
        _ => format!("{applied} applied, {rejected} rejected"),
    }
}

/// The screen goes where the chosen row is.
pub(super) fn chosen(model: &mut Model) {
    let row = model.lists.timeline.selected(len(model)).unwrap_or(0);
    update::go(model, Place::after(row));
}

/// What the event is about: the culprits of what it broke, or else all that its tables name.
pub(super) fn ids(model: &Model) -> Vec<String> {
    let row = model.lists.timeline.selected(len(model)).and_then(|row| row.checked_sub(1));
    let Some(report) = row.and_then(|event| model.report(event)) else { return Vec::new() };
    let culprits: Vec<String> = report.findings().flat_map(|(_, check)| check.culprits.clone()).collect();
    if culprits.is_empty() { named(report).cloned().collect() } else { culprits }
}

fn named(report: &EventReport) -> impl Iterator<Item = &String> {
    report.tables.iter().flat_map(|table| &table.rows).flat_map(|row| &row.ids)
}

/// Number, outcome, words and reason of each event.
pub(super) fn texts(model: &Model) -> Vec<String> {
    let lines = model.opened.iter().flat_map(|opened| &opened.lines);
    let text = |(event, line): (usize, &String)| {
        let report = model.report(event);
        let said = report.map_or("not run yet".into(), said);
        format!("{event}\t{}\t{said}", words::whole(line))
    };
    std::iter::once("start".into()).chain(lines.enumerate().map(text)).collect()
}

fn said(report: &EventReport) -> String {
    let outcome = match report.outcome {
        Outcome::Applied => "applied",
        Outcome::Rejected => "rejected",
        Outcome::Pending => "pending",
        Outcome::Cancelled => "cancelled",
        Outcome::None => "",
    };
    let told = [Some(outcome), report.reason.as_deref(), report.detail.as_deref()];
    let broken = report.findings().map(|(stage, check)| format!("{stage}/{} broken", check.name));
    let told = told.into_iter().flatten().filter(|word| !word.is_empty()).map(str::to_owned);
    told.chain(broken).collect::<Vec<_>>().join("\t")
}

pub(super) fn draw(model: &Model, theme: &Theme, area: Rect, buffer: &mut Buffer) {
    rows::draw(Pane::Timeline, model, theme, area, buffer, |row, width| match row.checked_sub(1) {
        None => Line::styled(text::fit("   ── start", width), theme.style(Role::Faint)),
        Some(event) => Entry { model, theme, event, report: model.report(event) }.line(width),
    });
}

/// A row, while it is put together.
struct Entry<'a> {
    model: &'a Model,
    theme: &'a Theme,
    event: usize,
    report: Option<&'a EventReport>,
}

impl Entry<'_> {
    fn line(&self, width: usize) -> Line<'static> {
        let mut spans = self.head();
        let taken: usize = spans.iter().map(Span::width).sum();
        let time = self.time(width);
        let room = width.saturating_sub(taken + if time.is_some() { TIME } else { 0 });
        let told = self.told();
        let for_told: usize = told.iter().map(Span::width).sum();
        // The words keep at least a few cells beside the reason.
        let line = self.model.opened.as_ref().and_then(|opened| opened.lines.get(self.event));
        let words =
            words::fitted(line.map_or("", String::as_str), room.saturating_sub(for_told).max(room.min(9)));
        let role = if self.report.is_some() { Role::Text } else { Role::Faint };
        let left = room.saturating_sub(text::width(&words));
        spans.push(Span::styled(words, self.theme.style(role)));
        spans.extend(clip(told, left));
        if let Some(time) = time {
            let taken: usize = spans.iter().map(Span::width).sum();
            let blank = width.saturating_sub(taken + TIME);
            spans.push(Span::raw(" ".repeat(blank)));
            spans.push(Span::styled(text::pad_start(&time, TIME), self.theme.style(Role::Faint)));
        }
        Line::from(spans)
    }

    /// Breakpoint, number, selection and outcome.
    fn head(&self) -> Vec<Span<'static>> {
        let style = |role| self.theme.style(role);
        let digits = self.model.len().saturating_sub(1).to_string().len().max(2);
        let stops = self.report.is_some_and(|report| self.model.stops.iter().any(|stop| stop.hits(report)));
        let selected = self.report.is_some_and(|report| self.has_selected(report));
        let differs = self.model.differences.as_ref().is_some_and(|differences| differences.has(self.event));
        let (mark, role) = self.report.map_or((" ", Role::Faint), outcome);
        vec![
            Span::styled(if stops { "●" } else { " " }, style(Role::Warn)),
            Span::styled(format!("{:>digits$}", self.event), style(Role::Faint)),
            Span::styled(if selected { Role::Marked.mark() } else { " " }, style(Role::Marked)),
            Span::styled(mark, style(role)),
            Span::styled(if differs { "≠" } else { " " }, style(Role::Bad)),
        ]
    }

    fn has_selected(&self, report: &EventReport) -> bool {
        let is_selected = |id: &String| self.model.is_selected(id);
        let culprit = |(_, check): (&str, &crate::report::Check)| check.culprits.iter().any(is_selected);
        !self.model.selected.is_empty() && (report.findings().any(culprit) || named(report).any(is_selected))
    }

    /// What is said after the words: where in it one is, the reason, what broke.
    fn told(&self) -> Vec<Span<'static>> {
        let Some(report) = self.report else { return Vec::new() };
        let mut told = Vec::new();
        let mut tell = |role, what: String| told.push(Span::styled(what, self.theme.style(role)));
        let within = self.model.place.stage.filter(|_| self.model.place.events == self.event);
        if let Some(stage) = within.and_then(|stage| report.stages.get(stage)) {
            tell(Role::Accent, format!(" ▸ after {}", text::line(&stage.id)));
        }
        if let Some((stage, check)) = report.findings().next() {
            tell(Role::Bad, format!(" {}/{}", text::line(stage), text::line(&check.name)));
        }
        if let Some(reason) = &report.reason {
            tell(Role::Warn, format!(" {}", text::line(reason)));
        }
        told
    }

    /// How long its stages took, where there is room to say so.
    fn time(&self, width: usize) -> Option<String> {
        let ran = self.report?.stages.iter().filter(|stage| stage.skipped.is_none());
        let (count, us) = ran.fold((0, 0.0), |(count, us), stage| (count + 1, us + stage.us));
        (count > 0 && width >= WITH_TIMES).then(|| text::us(us))
    }
}

/// Of some spans as much as there is room for.
fn clip(spans: Vec<Span<'static>>, mut room: usize) -> Vec<Span<'static>> {
    let mut clipped = Vec::new();
    for span in spans {
        let fitted = text::fit(&span.content, room);
        room -= text::width(&fitted);
        clipped.push(Span::styled(fitted, span.style));
    }
    clipped
}

/// What became of an event, as a mark.
fn outcome(report: &EventReport) -> (&'static str, Role) {
    match report.outcome {
        _ if report.findings().next().is_some() => (Role::Bad.mark(), Role::Bad),
        Outcome::Applied => (Role::Good.mark(), Role::Good),
        Outcome::Rejected => (Role::Warn.mark(), Role::Warn),
        Outcome::Pending => ("…", Role::Accent),
        Outcome::Cancelled => ("⊘", Role::Faint),
        Outcome::None if report.checkpoint.is_some() => ("⚑", Role::Accent),
        Outcome::None => (" ", Role::Faint),
    }
}
