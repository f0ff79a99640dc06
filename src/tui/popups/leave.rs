//! What becomes of a recording that is not saved, when one leaves.
//!
//! ```text
//! ┌ the recording is not saved ──────────┐
//! │ s save it, then leave                │
//! │ d leave it as a draft                │
//! │ esc stay                             │
//! └ enter do it · esc stay ──────────────┘
//! ```

use ratatui::text::{Line, Span};

use super::menu::{Pen, Row, blanks};
use crate::tui::theme::Role;

/// What can become of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::tui) enum Choice {
    /// Save it, then leave.
    Save,
    /// Leave; it stays as a draft.
    Draft,
    /// Go on.
    Stay,
}

/// All of them, with their keys.
pub(in crate::tui) const CHOICES: [(Choice, &str, &str, &str); 3] = [
    (Choice::Save, "s", "save it, then leave", "asks for the file"),
    (Choice::Draft, "d", "leave it as a draft", "the next start offers it again"),
    (Choice::Stay, "esc", "stay", "nothing is left, and nothing is lost"),
];

pub(super) fn rows(pen: Pen<'_>) -> Vec<Row> {
    CHOICES.iter().map(|(_, key, does, about)| row(key, does, about, pen)).collect()
}

fn row(key: &'static str, does: &'static str, about: &str, pen: Pen<'_>) -> Row {
    let key = Span::styled(key, pen.theme.style(Role::Key));
    let gap = blanks(&key.content, 4);
    Row {
        left: Line::from(vec![key, gap, Span::raw(does)]),
        right: Line::default(),
        about: vec![about.into()],
    }
}
