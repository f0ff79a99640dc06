//! The events, with what became of them.
//!
//! ```text
//!     ── start
//!   0 · camera azimuth 0.3 zenith 1.4
//!   1 … click 640.5 300.25
//! ▸ 2 ✓ click 702 318
//!   3 ! cut (silhouette)
//! ```

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use ratatui::widgets::Widget;

use crate::report::{EventReport, Outcome, printable};
use crate::tui::model::{Model, Place};
use crate::tui::theme::{Role, Theme};
use crate::tui::update;

/// A row for the beginning, and one for each event.
pub(super) fn len(model: &Model) -> usize {
    model.len() + 1
}

/// The screen goes where the chosen row is.
pub(super) fn chosen(model: &mut Model) {
    let row = model.lists.timeline.selected(len(model)).unwrap_or(0);
    update::go(model, Place::after(row));
}

pub(super) fn draw(model: &Model, theme: &Theme, area: Rect, buffer: &mut Buffer) {
    let list = &model.lists.timeline;
    let chosen = list.selected(len(model));
    let rows = list.window(area.height as usize, len(model));
    for (y, row) in (area.y..).zip(rows) {
        let line = Rect { y, height: 1, ..area };
        if Some(row) == chosen {
            buffer.set_style(
                line,
                theme.style(if model.focus == crate::tui::model::Pane::Timeline {
                    Role::Selected
                } else {
                    Role::Idle
                }),
            );
        }
        match row.checked_sub(1) {
            None => Line::styled("    ── start", theme.style(Role::Faint)).render(line, buffer),
            Some(event) => entry(model, theme, event).render(line, buffer),
        }
    }
}

fn entry<'a>(model: &'a Model, theme: &Theme, event: usize) -> Line<'a> {
    let report = model.report(event);
    let role = report.map_or(Role::Faint, role);
    let mark = report.map_or(" ", mark);
    let text = model.opened.as_ref().and_then(|opened| opened.lines.get(event));
    let text = text.map_or(String::new(), |line| words(line));
    let mut spans = vec![
        Span::styled(format!("{event:>4} "), theme.style(Role::Faint)),
        Span::styled(format!("{mark} "), theme.style(role)),
        Span::raw(printable(text)),
    ];
    let differs = model.differences.as_ref().is_some_and(|differences| differences.has(event));
    spans.extend(differs.then(|| Span::styled(" ≠", theme.style(Role::Bad))));
    if let Some(reason) = report.and_then(|report| report.reason.as_ref()) {
        spans.push(Span::styled(format!(" ({reason})"), theme.style(role)));
    }
    Line::from(spans)
}

fn role(report: &EventReport) -> Role {
    match report.outcome {
        _ if report.findings().next().is_some() => Role::Bad,
        Outcome::Applied => Role::Good,
        Outcome::Rejected => Role::Warn,
        Outcome::Pending | Outcome::Cancelled | Outcome::None => Role::Faint,
    }
}

fn mark(report: &EventReport) -> &'static str {
    match report.outcome {
        Outcome::Pending => "…",
        Outcome::Cancelled => "⊘",
        _ => role(report).mark(),
    }
}

/// A line of a script without its brackets: `{"click":[640.5,300.25]}` is `click 640.5 300.25`.
fn words(line: &str) -> String {
    let spaced: String = line
        .chars()
        .map(|c| if matches!(c, '{' | '}' | '[' | ']' | '"' | ':' | ',') { ' ' } else { c })
        .collect();
    spaced.split_whitespace().collect::<Vec<_>>().join(" ")
}
