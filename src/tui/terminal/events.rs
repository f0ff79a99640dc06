//! What the user does, read in a thread of its own.
//!
//! So one channel can carry keys and finished work alike, and nobody polls. It also is the only way to survive a terminal that is closed:
//! crossterm 0.29 then reads nothing at all, again and again, and never returns. Here that keeps only this thread busy, until the
//! program, which the system told ([`super::Terminal::ended`]), has ended in order.

use std::io;
use std::panic::catch_unwind;
use std::thread;

use ratatui::crossterm::event::{self, Event};

/// Why there is nothing more to read.
const UNREADABLE: &str = "the terminal sent what cannot be read";

/// Hands on every event until the receiver says `false`, or one cannot be read. Questions to the terminal, such as which pictures it
/// shows, must have been answered before: from now on all its input is taken for the user's.
pub fn listen(mut hand_on: impl FnMut(io::Result<Event>) -> bool + Send + 'static) -> io::Result<()> {
    let read = move || {
        loop {
            // A report that crossterm cannot take, such as a click in column 0, is a panic of its: it must not leave a screen that hears nothing.
            let event = catch_unwind(event::read).unwrap_or_else(|_| Err(io::Error::other(UNREADABLE)));
            let failed = event.is_err();
            if !hand_on(event) || failed {
                return;
            }
        }
    };
    thread::Builder::new().name("events".into()).spawn(read).map(drop)
}
