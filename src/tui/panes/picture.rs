//! The picture, with what it shows in its title, and what its colours mean below it.
//!
//! ```text
//! ┌4 picture frame, edges, stage of 11, 2.0×, 34 ms…──────┐
//! │                                                       │
//! │                      (the picture)                    │
//! │                                                       │
//! └■ stage A  ■ stage B───────────────────────────────────┘
//! ```
//!
//! The three dots say that another picture is on its way; until it is there the last one stays. Where there is none the pane says why.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Color, Style};
use ratatui::text::{Line, Span};
use ratatui::widgets::{Paragraph, Widget, Wrap};

use crate::report::printable;
use crate::tui::image::protocol::Kind;
use crate::tui::model::Model;
use crate::tui::picture;
use crate::tui::picture::golden::{self, Golden};
use crate::tui::record::cross;
use crate::tui::shot::{Picture, Tint};
use crate::tui::theme::{Role, Theme};
use crate::verify::{ImageReport, ImageVerdict, Metric};

/// What is shown.
pub(super) fn about(model: &Model) -> String {
    let picture = &model.picture;
    let shown = match (picture.golden, &picture.got) {
        (Golden::Off, Some(got)) => taken(model, got),
        (Golden::Off, None) => Vec::new(),
        (golden, _) => {
            let checkpoint = golden::compared(model).map(|compared| printable(&compared.checkpoint));
            [golden.name().to_owned()].into_iter().chain(checkpoint).collect()
        }
    };
    let zoom = picture.window.zoom;
    let zoomed = (zoom > 1.0).then(|| format!("{zoom:.1}×"));
    let time = picture.got.as_ref().filter(|_| picture.golden == Golden::Off);
    let time = time.map(|got| format!("{:.0} ms", got.ms));
    let all: Vec<String> = shown.into_iter().chain(zoomed).chain(time).collect();
    format!("{}{}", all.join(", "), if picture.is_awaited() { "…" } else { "" })
}

/// What a picture of the worker's shows.
fn taken(model: &Model, got: &Picture) -> Vec<String> {
    let drawn = &got.shot.drawn;
    let mut shown = vec![got.shot.subject.name().to_owned()];
    shown.extend(drawn.wire.then(|| "edges".into()));
    shown.extend(drawn.lines.then(|| "lines".into()));
    shown.extend(match &drawn.tint {
        Tint::None => None,
        Tint::Charts => Some("charts".into()),
        Tint::Group(group) => Some(printable(group)),
    });
    if drawn.is_of_a_report() && got.of != got.place.event() {
        let of = got.of.map_or("nothing to draw yet".into(), |event| format!("as of event {event}"));
        shown.push(of);
    }
    if let Some(orbit) = got.shot.orbit.filter(|orbit| Some(*orbit) != recorded(model)) {
        shown.push(format!("from {:.2} {:.2} {:.3}", orbit.azimuth, orbit.zenith, orbit.distance));
    }
    shown
}

fn recorded(model: &Model) -> Option<crate::canvas::frame::Orbit> {
    model.standing.as_ref()?.orbit
}

/// What the colours mean, or how far the picture is from its golden.
fn foot(model: &Model, theme: &Theme) -> Line<'static> {
    let picture = &model.picture;
    match (picture.golden, &picture.got) {
        (Golden::Off, Some(got)) => legend(&got.legend),
        (Golden::Off, None) => Line::default(),
        _ => golden::compared(model).map_or_else(Line::default, |picture| verdict(&picture.report, theme)),
    }
}

fn legend(sets: &[(String, [u8; 3])]) -> Line<'static> {
    let spans = sets.iter().flat_map(|(name, [r, g, b])| {
        [
            Span::styled("■ ", Style::new().fg(Color::Rgb(*r, *g, *b))),
            Span::raw(format!("{}  ", printable(name))),
        ]
    });
    Line::from(spans.collect::<Vec<_>>())
}

/// The verdict, and each measure beside what is allowed.
fn verdict(report: &ImageReport, theme: &Theme) -> Line<'static> {
    let (role, word) = match report.verdict {
        ImageVerdict::Equal => (Role::Good, "equal"),
        ImageVerdict::Within => (Role::Good, "within"),
        ImageVerdict::Beyond => (Role::Bad, "beyond"),
        ImageVerdict::Unseen => (Role::Warn, "no golden"),
    };
    let mut spans = vec![Span::styled(format!("{} {word}  ", role.mark()), theme.style(role))];
    let distance = report.distance.filter(|_| report.verdict != ImageVerdict::Equal);
    for (metric, distance) in Metric::ALL.into_iter().zip(distance.into_iter().cycle()) {
        let (is, most) = (distance.get(metric), report.gate.most.get(metric));
        let role = if is <= most { Role::Text } else { Role::Bad };
        spans.push(Span::styled(format!("{metric} {is:.4}/{most:.4}  "), theme.style(role)));
    }
    Line::from(spans)
}

pub(super) fn draw(model: &Model, theme: &Theme, buffer: &mut Buffer) {
    let Some([area, below]) = picture::places(model) else { return };
    foot(model, theme).render(below, buffer);
    match (lack(model), &model.picture.encoded) {
        (Some(lack), _) => {
            let words = Paragraph::new(lack).style(theme.style(Role::Faint));
            words.wrap(Wrap { trim: true }).centered().render(middle(area), buffer);
        }
        (None, Some(encoded)) => encoded.draw(area, buffer, model.popup.is_some()),
        (None, None) => {}
    }
    cross::draw(model, theme, buffer);
}

/// The middle line of an area, and those below it.
fn middle(area: Rect) -> Rect {
    let above = area.height.saturating_sub(1) / 2;
    Rect { y: area.y + above, height: area.height - above, ..area }
}

/// Why there is no picture.
fn lack(model: &Model) -> Option<String> {
    let picture = &model.picture;
    model.opened.as_ref()?;
    match (picture.golden, &picture.missing) {
        _ if picture.medium.kind == Kind::None => Some("pictures are switched off".into()),
        (Golden::Off, Some(why)) => Some(printable(why)),
        (Golden::Off, None) => picture.encoded.is_none().then(|| "the picture is being made".into()),
        _ if picture.beside.is_none() => Some(golden::lack(model)),
        _ => None,
    }
}

#[cfg(test)]
mod tests;
