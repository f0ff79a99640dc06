//! What the state is made of, before the event and after it.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::Line;
use ratatui::widgets::Widget;

use crate::tui::model::Model;
use crate::tui::theme::Theme;

pub(super) fn len(model: &Model) -> usize {
    model.standing.as_ref().map_or(0, |standing| standing.sizes.len())
}

pub(super) fn draw(model: &Model, _theme: &Theme, area: Rect, buffer: &mut Buffer) {
    let sizes = model.standing.as_ref().map_or(&[][..], |standing| &standing.sizes);
    for (y, (name, size)) in (area.y..area.bottom()).zip(sizes) {
        Line::raw(format!("{name:<10} {size:>10}")).render(Rect { y, height: 1, ..area }, buffer);
    }
}
