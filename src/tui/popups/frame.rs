//! The border of a popup, and where it is.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, Clear, Widget};

use crate::tui::edit::Edit;
use crate::tui::text;
use crate::tui::theme::{Role, Theme};

/// Below this many columns and rows a border would leave nothing to see.
const LEAST: [u16; 2] = [12, 4];

/// From this many rows on, the first and the last of the screen stay in sight: they say where one is, and what went wrong.
const HIGH: u16 = 8;

/// The middle of a screen.
pub(super) fn area(size: [u16; 2], wants: [usize; 2]) -> Rect {
    let most = [size[0], if size[1] < HIGH { size[1] } else { size[1] - 2 }];
    let [width, height] = [0, 1].map(|axis| u16::try_from(wants[axis]).unwrap_or(u16::MAX).min(most[axis]));
    Rect { x: (size[0] - width) / 2, y: (size[1] - height) / 2, width, height }
}

/// What is within the border of an area.
pub(super) fn inner(area: Rect) -> Rect {
    match is_bordered(area) {
        true => Block::bordered().inner(area),
        false => area,
    }
}

fn is_bordered(area: Rect) -> bool {
    area.width >= LEAST[0] && area.height >= LEAST[1]
}

/// Clears the place of a popup, draws its border, and answers what is within.
pub(super) fn draw(area: Rect, words: &[String; 2], theme: &Theme, buffer: &mut Buffer) -> Rect {
    let area = area.intersection(buffer.area);
    Clear.render(area, buffer);
    if is_bordered(area) {
        let [title, hints] = words.each_ref().map(|words| {
            let words = text::fit(words, usize::from(area.width).saturating_sub(4));
            if words.is_empty() { words } else { format!(" {words} ") }
        });
        Block::bordered()
            .border_style(theme.style(Role::Focus))
            .title(Line::styled(title, theme.style(Role::Focus)))
            .title_bottom(Line::styled(hints, theme.style(Role::Faint)))
            .render(area, buffer);
    }
    inner(area)
}

/// A row of an area, counted from its top; empty below it.
pub(super) fn row(area: Rect, row: usize) -> Rect {
    let at = u16::try_from(row).unwrap_or(u16::MAX).min(area.height);
    Rect { y: area.y + at, height: area.height.saturating_sub(at).min(1), ..area }
}

/// A line that is typed, with its cursor.
pub(super) fn edit(edit: &Edit, theme: &Theme, area: Rect, buffer: &mut Buffer) {
    let view = edit.view(usize::from(area.width));
    let under = if view.under.is_empty() { " " } else { view.under };
    let spans =
        [Span::raw(view.before), Span::styled(under, theme.style(Role::Selected)), Span::raw(view.after)];
    Line::from(spans.to_vec()).render(area, buffer);
}

/// Writes lines of a style from a row of an area on, as far as they fit; answers the row after them.
pub(super) fn lines(lines: &[String], style: Style, area: Rect, from: usize, buffer: &mut Buffer) -> usize {
    for (at, line) in lines.iter().enumerate() {
        let area = row(area, from + at);
        buffer.set_stringn(area.x, area.y, line, usize::from(area.width) * usize::from(area.height), style);
    }
    from + lines.len()
}
