//! Every action, found by a few letters of its name or of what it does; what was done last comes first.
//!
//! ```text
//! ┌ actions ─────────────────────────────────────────┐
//! │ / nex█                                           │
//! │ next-event      Step one event on        l, right│
//! │ next-cut        Go to the next cut              c│
//! │ next-event: Step one event on                    │
//! │ lancet replay REC --until PLACE --json -         │
//! └ enter do it · esc close ─────────────────────────┘
//! ```

use std::cmp::Reverse;

use ratatui::text::{Line, Span};

use super::help;
use super::menu::{Pen, Row, blanks, marked};
use crate::tui::action::{self, ACTIONS};
use crate::tui::fuzzy;
use crate::tui::model::Memory;
use crate::tui::theme::Role;

/// Cells of the column of names.
const NAMES: usize = 20;
/// A letter of the name is worth so much more than one of the description.
const NAME: i32 = 2;

/// An action that was found.
#[derive(Clone, Debug)]
pub(in crate::tui) struct Entry {
    /// Its row in the table.
    pub(in crate::tui) row: &'static action::Row,
    /// The letters of its name that were found.
    name: Vec<usize>,
    /// Those of its description.
    does: Vec<usize>,
    score: i32,
}

/// What is found by what was typed, the best first, and of equals what was done last.
pub(in crate::tui) fn entries(memory: &Memory, typed: &str) -> Vec<Entry> {
    let mut entries: Vec<Entry> = ACTIONS.iter().filter_map(|row| entry(row, typed)).collect();
    let age = |entry: &Entry| memory.actions().iter().position(|action| *action == entry.row.action);
    entries.sort_by_key(|entry| (Reverse(entry.score), age(entry).unwrap_or(usize::MAX)));
    entries
}

fn entry(row: &'static action::Row, typed: &str) -> Option<Entry> {
    let (name, does) = (fuzzy::find(typed, row.name), fuzzy::find_words(typed, row.does));
    let score = |found: &Option<fuzzy::Found>, weight| found.as_ref().map(|found| found.score * weight);
    let score = score(&name, NAME).max(score(&does, 1))?;
    let [name, does] = [name, does].map(|found| found.unwrap_or_default().at);
    Some(Entry { row, name, does, score })
}

pub(super) fn rows(pen: Pen<'_>) -> Vec<Row> {
    entries(&pen.model.memory, pen.typed).iter().map(|entry| row(entry, pen)).collect()
}

fn row(Entry { row, name, does, .. }: &Entry, pen: Pen<'_>) -> Row {
    let mut spans = marked(row.name, name, Role::Text, pen.theme);
    spans.extend([blanks(row.name, NAMES), Span::raw(" ")]);
    spans.extend(marked(row.does, does, Role::Faint, pen.theme));
    Row {
        left: Line::from(spans),
        right: Line::styled(help::keys(row, pen.keys), pen.theme.style(Role::Key)),
        about: help::about(row, pen.model),
    }
}
