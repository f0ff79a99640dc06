//! Long work, off the screen's thread: one thread with the replay and its renderer, asked and answered through channels.
//!
//! What is asked later matters more: whatever interrupts puts an end to what is being done, between two events. Pictures wait until everything
//! else is done, and of several only the newest is taken.

mod ask;
mod camera;
mod desk;

use std::collections::VecDeque;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread;

pub(in crate::tui) use ask::{Ask, Opened, Standing, Told};
pub(in crate::tui) use camera::groups;
pub(in crate::tui) use desk::{Desk, Line};

/// The screen's end.
pub(in crate::tui) struct Worker {
    asks: Sender<Ask>,
    /// What the worker has told.
    pub(in crate::tui) told: Receiver<Told>,
}

impl Worker {
    /// Starts the thread. It ends when the worker is dropped.
    pub(in crate::tui) fn start(mut desk: Desk) -> Self {
        let (asks, asked) = channel();
        let (tells, told) = channel();
        thread::spawn(move || {
            let mut line = Wire { asked, tells, waiting: VecDeque::new() };
            while let Some(ask) = line.next() {
                desk.handle(ask, &mut line);
            }
        });
        Self { asks, told }
    }

    /// Asks for something. A worker that is gone has told why.
    pub(in crate::tui) fn ask(&self, ask: Ask) {
        let _ = self.asks.send(ask);
    }
}

/// The worker's end.
struct Wire {
    asked: Receiver<Ask>,
    tells: Sender<Told>,
    waiting: VecDeque<Ask>,
}

impl Wire {
    /// The next thing to do; none when the screen is gone.
    fn next(&mut self) -> Option<Ask> {
        self.collect();
        if self.waiting.is_empty() {
            self.waiting.push_back(self.asked.recv().ok()?);
            self.collect();
        }
        let first = self.waiting.iter().position(|ask| ask.is_urgent());
        first.and_then(|first| self.waiting.remove(first)).or_else(|| self.newest_picture()).or_else(|| {
            self.waiting.clear();
            Some(Ask::Learn)
        })
    }

    fn newest_picture(&mut self) -> Option<Ask> {
        let picture = |ask: &Ask| matches!(ask, Ask::Shoot(_));
        let newest = self.waiting.iter().rposition(picture).and_then(|at| self.waiting.remove(at));
        self.waiting.retain(|ask| !picture(ask));
        newest
    }

    fn collect(&mut self) {
        self.waiting.extend(self.asked.try_iter());
    }
}

impl Line for Wire {
    fn tell(&mut self, told: Told) {
        // A screen that is gone is noticed when the next thing to do is looked for.
        let _ = self.tells.send(told);
    }

    fn is_interrupted(&mut self) -> bool {
        self.collect();
        self.waiting.iter().any(Ask::interrupts)
    }

    fn is_wanted(&mut self) -> bool {
        self.collect();
        self.waiting.iter().any(|ask| !matches!(ask, Ask::Learn))
    }
}
