//! All keys, by where they count, with what they do; from the table of actions and the keys as they are.
//!
//! ```text
//! ┌ keys ────────────────────────────────────────────┐
//! │ / █                                              │
//! │ everywhere                                       │
//! │   l, right          Step one event on  next-event│
//! │   h, left         Step one event back            │
//! │ next-event: Step one event on                    │
//! │ lancet replay REC --until PLACE --json -         │
//! └ type to find · esc close ────────────────────────┘
//! ```

use ratatui::text::Line;

use super::menu::{Pen, Row, blanks, marked};
use crate::tui::action::{self, ACTIONS, Scope};
use crate::tui::command;
use crate::tui::fuzzy;
use crate::tui::keys::Keys;
use crate::tui::model::Model;
use crate::tui::theme::Role;

/// Where keys count, in the order of the help.
const SCOPES: [(Scope, &str); 4] = [
    (Scope::Always, "everywhere"),
    (Scope::List, "in a pane with rows"),
    (Scope::Picture, "in the picture"),
    (Scope::Recording, "in the picture, while recording"),
];

/// From this many cells on there is room for names, too.
const WIDE: usize = 70;

/// A row of the help.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(in crate::tui) enum Entry {
    /// Where the keys below count.
    Heading(&'static str),
    /// An action, with the letters of its description, and of its name, that were found.
    Action(&'static action::Row, [Vec<usize>; 2]),
}

/// What is found by what was typed, in the order of the table.
pub(in crate::tui) fn entries(typed: &str) -> Vec<Entry> {
    let scopes = SCOPES.iter().flat_map(|(scope, title)| {
        let rows = ACTIONS.iter().filter(|row| row.scope == *scope);
        let found: Vec<Entry> = rows.filter_map(|row| Some(Entry::Action(row, found(typed, row)?))).collect();
        let heading = (!found.is_empty()).then_some(Entry::Heading(title));
        heading.into_iter().chain(found)
    });
    scopes.collect()
}

fn found(typed: &str, row: &action::Row) -> Option<[Vec<usize>; 2]> {
    let (does, name) = (fuzzy::find_words(typed, row.does), fuzzy::find_words(typed, row.name));
    let is_found = does.is_some() || name.is_some();
    is_found.then(|| [does, name].map(|found| found.unwrap_or_default().at))
}

pub(super) fn rows(pen: Pen<'_>, width: usize) -> Vec<Row> {
    entries(pen.typed).iter().map(|entry| row(entry, pen, width)).collect()
}

fn row(entry: &Entry, pen: Pen<'_>, width: usize) -> Row {
    let (theme, column) = (pen.theme, (width / 6).clamp(10, 16));
    match entry {
        Entry::Heading(title) => {
            Row { left: Line::styled(*title, theme.style(Role::Title)), ..Row::default() }
        }
        Entry::Action(row, [does, name]) => {
            let keys = keys(row, pen.keys);
            let mut spans = vec![blanks("", 1)];
            spans.extend(marked(&keys, &[], Role::Key, theme));
            // Keys that are wider than their column push the rest away: they are what one looks for.
            spans.extend([blanks(&keys, column), blanks("", 1)]);
            spans.extend(marked(row.does, does, Role::Text, theme));
            let name = marked(row.name, name, Role::Faint, theme);
            Row {
                left: Line::from(spans),
                right: if width < WIDE { Line::default() } else { Line::from(name) },
                about: about(row, pen.model),
            }
        }
    }
}

/// The keys of an action.
pub(super) fn keys(row: &action::Row, keys: &Keys) -> String {
    let keys: Vec<String> = keys.of(row.action).iter().map(ToString::to_string).collect();
    if keys.is_empty() { "no key".into() } else { keys.join(", ") }
}

/// What an action does, and the command that does the same, with what is on the screen.
pub(super) fn about(row: &action::Row, model: &Model) -> Vec<String> {
    let nothing = || "only the screen changes: no command is needed".into();
    let command = command::of(model, row).unwrap_or_else(nothing);
    vec![format!("{}: {}", row.name, row.does), command]
}
