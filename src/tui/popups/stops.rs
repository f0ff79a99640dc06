//! The breakpoints, with how often each was met by the events that have run.
//!
//! ```text
//! ┌ breakpoints ─────────────────────────────────────┐
//! │ configurations=FE                        3 events│
//! │ rejected                                     none│
//! │ met by events 2, 14, 15                          │
//! └ a add · d drop · enter go to the next · esc close┘
//! ```

use ratatui::text::Line;

use super::menu::{Pen, Row};
use crate::report::{Stop, printable};
use crate::tui::model::Model;
use crate::tui::theme::Role;
use crate::tui::update::stops;

/// As many events are named.
const NAMED: usize = 12;

pub(super) fn rows(pen: Pen<'_>) -> Vec<Row> {
    pen.model.stops.iter().map(|stop| row(stop, pen)).collect()
}

fn row(stop: &Stop, pen: Pen<'_>) -> Row {
    let met = stops::met(pen.model, stop);
    let (count, role) = match met.len() {
        0 => ("none".into(), Role::Faint),
        1 => ("1 event".into(), Role::Accent),
        count => (format!("{count} events"), Role::Accent),
    };
    Row {
        left: Line::raw(printable(stop)),
        right: Line::styled(count, pen.theme.style(role)),
        about: vec![about(&met, pen.model)],
    }
}

fn about(met: &[usize], model: &Model) -> String {
    let so_far = if model.reports.len() < model.len() { " so far" } else { "" };
    if met.is_empty() {
        return format!("met by no event{so_far}");
    }
    let named: Vec<String> = met.iter().take(NAMED).map(ToString::to_string).collect();
    let more = if met.len() > NAMED { ", …" } else { "" };
    format!("met by events {}{more}{so_far}", named.join(", "))
}
