//! The title of a pane: its number and name, and what it is about; or tabs, where several panes share its place.
//!
//! ```text
//! 5 tables links (34)
//! 3mesh 5 tables 6invariants 7differences · links (34)
//! 1 timeline 2sta 3mes 4pic 5tab 6inv 7dif
//! ```
//!
//! The number is the key that goes there. What there is no room for goes from the end: what the pane is about, then the names of the tabs behind it, letter by
//! letter.

use ratatui::text::Span;

use super::model::{Model, Pane};
use super::theme::{Role, Theme};
use super::view::Areas;
use super::{panes, text};

/// What a pane is about is cut no shorter than this.
const LEAST: usize = 9;

/// A part of a title.
pub(in crate::tui) struct Part {
    /// The pane that it goes to when it is clicked.
    pub(in crate::tui) pane: Option<Pane>,
    /// What is written.
    pub(in crate::tui) span: Span<'static>,
}

/// The title of a pane in so many cells.
pub(in crate::tui) fn title(
    areas: &Areas,
    pane: Pane,
    model: &Model,
    theme: &Theme,
    width: usize,
) -> Vec<Part> {
    let alone = [pane];
    let sharing = match areas.sharing(pane) {
        [] => &alone[..],
        sharing => sharing,
    };
    let letters = (0..=12).rev().find(|letters| taken(sharing, pane, *letters) <= width).unwrap_or(0);
    let mut parts: Vec<Part> = sharing
        .iter()
        .flat_map(|tab| entry(*tab, *tab == pane, model.focus == pane, letters, theme))
        .collect();
    let taken: usize = parts.iter().map(|part| part.span.width()).sum();
    let about = about(pane, model, sharing.len() > 1, width.saturating_sub(taken));
    parts.push(Part { pane: None, span: Span::styled(about, theme.style(Role::Faint)) });
    parts
}

/// What a pane is about, in so many cells; nothing where that would say nothing.
fn about(pane: Pane, model: &Model, tabs: bool, room: usize) -> String {
    let about = panes::about(pane, model);
    let about = if tabs && !about.is_empty() { format!("· {about}") } else { about };
    if room < LEAST.min(text::width(&about)) { String::new() } else { text::fit(&about, room) }
}

/// The number and the name of a pane, and a blank after them.
fn entry(tab: Pane, shown: bool, focused: bool, letters: usize, theme: &Theme) -> [Part; 2] {
    let role = match (shown, focused) {
        (true, true) => Role::Focus,
        (true, false) => Role::Title,
        _ => Role::Faint,
    };
    let name = if shown { format!(" {} ", tab.title()) } else { format!("{} ", short(tab, letters)) };
    let part = |role, text| Part { pane: Some(tab), span: Span::styled(text, theme.style(role)) };
    [part(Role::Key, (tab as usize + 1).to_string()), part(role, name)]
}

/// The first letters of a pane's name.
fn short(tab: Pane, letters: usize) -> String {
    tab.title().chars().take(letters).collect()
}

/// Cells of the tabs, if those that are not shown have so many letters.
fn taken(sharing: &[Pane], pane: Pane, letters: usize) -> usize {
    let one = |tab: &Pane| if *tab == pane { tab.title().len() + 3 } else { short(*tab, letters).len() + 2 };
    sharing.iter().map(one).sum::<usize>().saturating_sub(1)
}

/// The pane that a click on a title goes to, so many cells from its beginning.
pub(in crate::tui) fn at(parts: &[Part], cell: usize) -> Option<Pane> {
    let mut end = 0;
    let hit = |part: &&Part| {
        end += part.span.width();
        cell < end
    };
    parts.iter().find(hit).and_then(|part| part.pane)
}
