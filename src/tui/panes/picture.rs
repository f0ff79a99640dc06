//! The picture.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::Line;
use ratatui::widgets::Widget;

use crate::tui::model::Model;
use crate::tui::record::cross;
use crate::tui::theme::Theme;

pub(super) fn about(model: &Model) -> String {
    model.picture.got.as_ref().map_or(String::new(), |picture| format!("{:.0} ms", picture.ms))
}

pub(super) fn draw(model: &Model, theme: &Theme, area: Rect, buffer: &mut Buffer) {
    let size = model.picture.got.as_ref().map_or([0; 2], |picture| picture.image.size);
    Line::raw(format!("{} x {}", size[0], size[1])).render(area, buffer);
    cross::draw(model, theme, buffer);
}
