//! The title line and the status line.
//!
//! ```text
//! lancet cut-across.lancet · engine  12+MC/40  ▶ 200 ms      ◆ f7 e12
//! l next-event  h previous-event  s next-stage  : palette  ? help
//! ```

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use ratatui::widgets::{Clear, Widget};

use super::action::Action;
use super::keys::Keys;
use super::model::{Message, Model, Pane, Place, Progress};
use super::theme::{Role, Theme};
use super::worker::Opened;
use super::{record, text};

/// A message takes at most so many lines, and of a small screen a third.
const LINES: u16 = 6;

/// The title line: what is open and where one is in it on the left; what goes on and what is selected on the right.
pub(super) fn title(model: &Model, theme: &Theme, area: Rect, buffer: &mut Buffer) {
    buffer.set_style(area, theme.style(Role::Status));
    let width = area.width as usize;
    let place = place(model);
    let going = going(model);
    let fixed = text::width(&place) + text::width(&going);
    let name = text::fit_end(&name(model), width.saturating_sub(fixed).max(width.min(8)));
    let mut spans = vec![
        Span::styled(name, theme.style(Role::Title)),
        Span::styled(place, theme.style(Role::Accent)),
        Span::styled(going, theme.style(Role::Warn)),
    ];
    let taken: usize = spans.iter().map(Span::width).sum();
    if let Some(engine) = model.opened.as_ref().map(|opened| format!(" · {}", text::line(&opened.engine)))
        && taken + text::width(&engine) <= width
    {
        spans.insert(1, Span::styled(engine, theme.style(Role::Faint)));
    }
    let taken: usize = spans.iter().map(Span::width).sum();
    Line::from(spans).render(area, buffer);
    let selected = text::fit(&selected(model), width.saturating_sub(taken + 2));
    // A style of the line would be one of all that is on it.
    Line::from(Span::styled(selected, theme.style(Role::Marked))).right_aligned().render(area, buffer);
}

/// What is open.
fn name(model: &Model) -> String {
    match &model.opened {
        Some(Opened { path: Some(path), .. }) => format!("lancet {}", path.display()),
        Some(_) => "lancet new recording".into(),
        None => "lancet nothing open".into(),
    }
}

/// Where in it one is, of how many events.
fn place(model: &Model) -> String {
    let of = |opened: &Opened| format!("  {}/{}", text::line(&model.name(model.place)), opened.lines.len());
    model.opened.as_ref().map_or(String::new(), of)
}

/// What goes on: whether it plays, what the worker does, what is not saved.
fn going(model: &Model) -> String {
    let unsaved = model.kept.unsaved.then(|| "  not saved".to_owned());
    let playing = model.playing.map(|pause| format!("  ▶ {} ms", pause.as_millis()));
    let comparing = model.comparing.as_ref();
    let comparing = comparing.map(|it| Progress { what: "comparing", done: it.done, of: it.of });
    let busy = model.progress.or(comparing).map(|Progress { what, done, of }| match of {
        0 => format!("  {what}…"),
        of => format!("  {what} {done}/{of}"),
    });
    let ahead = Some(model.ahead.len()).filter(|count| *count > 0);
    let ahead = ahead.map(|count| format!("  typed ahead: {count}"));
    [unsaved, playing, busy, ahead].into_iter().flatten().collect()
}

/// What is selected.
fn selected(model: &Model) -> String {
    match model.selected.len() {
        0 => String::new(),
        1..=3 => format!("{} {}", Role::Marked.mark(), model.selected.join(" ")),
        count => format!("{} {} and {} more", Role::Marked.mark(), model.selected[..2].join(" "), count - 2),
    }
}

/// The status line: what is said, over as many lines as it needs, or else what the keys do.
pub(super) fn status(model: &Model, theme: &Theme, keys: &Keys, area: Rect, buffer: &mut Buffer) {
    buffer.set_style(area, theme.style(Role::Status));
    let record = record::status(model, theme);
    let taken: usize = record.iter().map(Span::width).sum();
    match &model.message {
        Some(message) if record.is_empty() => say(message, model.size, theme, buffer),
        Some(message) => {
            let (said, role) = said(message);
            let said = text::fit(&said, (area.width as usize).saturating_sub(taken));
            let spans = record.into_iter().chain([Span::styled(said, theme.style(role))]);
            Line::from_iter(spans).render(area, buffer);
        }
        None => {
            let room = (area.width as usize).saturating_sub(taken);
            let hints = fitting(hints(model), keys, room);
            let spans = hints.into_iter().flat_map(|(key, name)| {
                [Span::styled(key, theme.style(Role::Key)), Span::styled(name, theme.style(Role::Faint))]
            });
            Line::from_iter(record.into_iter().chain(spans)).render(area, buffer);
        }
    }
}

fn said(message: &Message) -> (String, Role) {
    match message.wrong {
        true => (format!("{} {}", Role::Bad.mark(), message.text), Role::Bad),
        false => (message.text.clone(), Role::Text),
    }
}

/// Says something on the last line, and on those above it if it is longer; nothing is lost of what fits on six.
fn say(message: &Message, [width, height]: [u16; 2], theme: &Theme, buffer: &mut Buffer) {
    let (said, role) = said(message);
    let most = LINES.min(height.div_ceil(3));
    let lines = text::wrap(&said, width as usize, most as usize);
    let from = height.saturating_sub(lines.len() as u16);
    for (y, line) in (from..height).zip(lines) {
        let at = Rect { x: 0, y, width, height: 1 };
        // What was drawn there is no longer.
        Clear.render(at, buffer);
        buffer.set_style(at, theme.style(Role::Status));
        Line::styled(line, theme.style(role)).render(at, buffer);
    }
}

/// Keys and names of actions, as many as fit. The last comes before all others: it is the way to the rest.
fn fitting(actions: impl Iterator<Item = Action>, keys: &Keys, room: usize) -> Vec<(String, String)> {
    let hint = |action: Action| Some((keys.first(action)?.to_string(), format!(" {}", action.row().name)));
    let mut hints: Vec<(String, String)> = actions.filter_map(hint).collect();
    let width = |hints: &[(String, String)]| -> usize {
        let words = hints.iter().map(|(key, name)| text::width(key) + text::width(name));
        words.sum::<usize>() + 2 * hints.len().saturating_sub(1)
    };
    while width(&hints) > room && !hints.is_empty() {
        hints.remove(hints.len().saturating_sub(2));
    }
    let last = hints.len().saturating_sub(1);
    hints.iter_mut().take(last).for_each(|(_, name)| name.push_str("  "));
    hints
}

/// What is worth a hint, where the focus is: nothing that would lead nowhere.
fn hints(model: &Model) -> impl Iterator<Item = Action> {
    use Action as A;
    let (at_start, at_end) = (model.place == Place::START, model.place == Place::after(model.len()));
    let leads_nowhere = move |action: &Action| match action {
        A::PreviousEvent => at_start,
        A::NextEvent | A::NextStage | A::NextCut | A::Play => at_end,
        _ => false,
    };
    of_focus(model).iter().copied().filter(move |action| !leads_nowhere(action))
}

fn of_focus(model: &Model) -> &'static [Action] {
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
