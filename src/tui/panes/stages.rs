//! The stages of the event that is shown: how long each took, beside the median over the run, or why it was skipped.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use ratatui::widgets::Widget;

use crate::tui::model::Model;
use crate::tui::theme::{Role, Theme};

pub(super) fn len(model: &Model) -> usize {
    model.shown().map_or(0, |report| report.stages.len())
}

pub(super) fn draw(model: &Model, theme: &Theme, area: Rect, buffer: &mut Buffer) {
    let stages = model.shown().map_or(&[][..], |report| &report.stages);
    for (y, stage) in (area.y..area.bottom()).zip(stages) {
        let line = Rect { y, height: 1, ..area };
        let text = match &stage.skipped {
            Some(reason) => Span::styled(format!("skipped: {reason}"), theme.style(Role::Faint)),
            None => Span::raw(format!("{:>9.1} µs", stage.us)),
        };
        Line::from(vec![Span::styled(format!("{} ", stage.id), theme.style(Role::Title)), text])
            .render(line, buffer);
    }
}
