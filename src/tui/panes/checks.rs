//! The invariants of the event that is shown.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use ratatui::widgets::Widget;

use crate::report::Check;
use crate::tui::model::Model;
use crate::tui::theme::{Role, Theme};

fn rows(model: &Model) -> Vec<(&str, &Check)> {
    let Some(report) = model.shown() else { return Vec::new() };
    let stages =
        report.stages.iter().flat_map(|stage| stage.checks.iter().map(|check| (stage.id.as_str(), check)));
    stages.chain(report.checks.iter().map(|check| ("state", check))).collect()
}

pub(super) fn about(model: &Model) -> String {
    let rows = rows(model);
    format!("{} of {} hold", rows.iter().filter(|(_, check)| check.ok).count(), rows.len())
}

pub(super) fn len(model: &Model) -> usize {
    rows(model).len()
}

pub(super) fn ids(model: &Model) -> Vec<String> {
    let rows = rows(model);
    let row = model.lists.checks.selected(rows.len());
    row.map_or(Vec::new(), |row| rows[row].1.culprits.clone())
}

pub(super) fn draw(model: &Model, theme: &Theme, area: Rect, buffer: &mut Buffer) {
    let all = rows(model);
    for (y, row) in (area.y..).zip(model.lists.checks.window(area.height as usize, all.len())) {
        let (stage, check) = all[row];
        let role = if check.ok { Role::Good } else { Role::Bad };
        let value = check.value.map_or(String::new(), |value| format!(" {value:.3e}"));
        let spans = vec![
            Span::styled(format!("{} ", role.mark()), theme.style(role)),
            Span::raw(format!("{stage} {}{value} {}", check.name, check.detail)),
        ];
        Line::from(spans).render(Rect { y, height: 1, ..area }, buffer);
    }
}
