//! The title line and the status line.
//!
//! ```text
//! lancet  cut-across.lancet · wound   12/40 cut   ▶ 200 ms      seeking 7/40
//! l next-event  h previous-event  s next-stage  : palette  ? help
//! ```

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use ratatui::widgets::Widget;

use super::action::Action;
use super::keys::Keys;
use super::model::{Model, Pane};
use super::record;
use super::theme::{Role, Theme};
use crate::report::printable;

pub(super) fn title(model: &Model, theme: &Theme, area: Rect, buffer: &mut Buffer) {
    buffer.set_style(area, theme.style(Role::Status));
    let (bold, faint) = (theme.style(Role::Title), theme.style(Role::Faint));
    let name = match &model.opened {
        Some(opened) => match &opened.path {
            Some(path) => printable(path.display()),
            None => "new recording".into(),
        },
        None => "nothing open".into(),
    };
    let mut spans = vec![Span::styled("lancet ", theme.style(Role::Accent)), Span::styled(name, bold)];
    if let Some(opened) = &model.opened {
        spans.push(Span::styled(format!(" · {} ", opened.engine), faint));
        spans.push(Span::raw(format!(" {}/{} ", model.place.events, opened.lines.len())));
    }
    if model.kept.unsaved {
        spans.push(Span::styled("not saved ", theme.style(Role::Warn)));
    }
    if let Some(pause) = model.playing {
        spans.push(Span::styled(format!("▶ {} ms ", pause.as_millis()), theme.style(Role::Accent)));
    }
    Line::from(spans).render(area, buffer);
    let busy = model.progress.map_or(String::new(), |progress| match progress.of {
        0 => format!(" {}… ", progress.what),
        of => format!(" {} {}/{of} ", progress.what, progress.done),
    });
    Line::styled(busy, theme.style(Role::Warn)).right_aligned().render(area, buffer);
}

pub(super) fn status(model: &Model, theme: &Theme, keys: &Keys, area: Rect, buffer: &mut Buffer) {
    buffer.set_style(area, theme.style(Role::Status));
    let mut spans = record::status(model, theme);
    if let Some(message) = &model.message {
        let role = if message.wrong { Role::Bad } else { Role::Text };
        let mark = if message.wrong { format!("{} ", Role::Bad.mark()) } else { String::new() };
        let text = format!("{mark}{}", printable(&message.text));
        spans.push(Span::styled(text, theme.style(role)));
        return Line::from(spans).render(area, buffer);
    }
    for action in hints(model) {
        let Some(key) = keys.first(*action) else { continue };
        spans.push(Span::styled(format!("{key} "), theme.style(Role::Key)));
        spans.push(Span::styled(format!("{}  ", action.row().name), theme.style(Role::Faint)));
    }
    Line::from(spans).render(area, buffer);
}

/// What is worth a hint, where the focus is.
fn hints(model: &Model) -> &'static [Action] {
    use Action as A;
    if model.recorder.is_some() {
        return &[A::Point, A::Mode, A::Undo, A::Checkpoint, A::Save, A::Cancel, A::Help];
    }
    match model.focus {
        Pane::Picture => {
            &[A::OrbitLeft, A::OrbitRight, A::ZoomIn, A::Wire, A::Lines, A::Tint, A::Subject, A::Help]
        }
        Pane::Timeline => &[
            A::NextEvent,
            A::PreviousEvent,
            A::NextStage,
            A::NextCut,
            A::Play,
            A::Stops,
            A::Palette,
            A::Help,
        ],
        _ => &[A::Down, A::Select, A::Copy, A::Search, A::NextEvent, A::Maximise, A::Palette, A::Help],
    }
}
