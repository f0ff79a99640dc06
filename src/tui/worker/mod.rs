//! Long work, off the screen's thread: one thread with the replay and its renderer, asked and answered through channels.
//! Comparisons have another (`compare`).
//!
//! What is asked later matters more: whatever interrupts puts an end to what is being done, between two events. Pictures wait until everything
//! else is done, and of several only the newest is taken.

mod ask;
mod camera;
mod compare;
mod desk;
mod recording;

use std::any::Any;
use std::collections::VecDeque;
use std::convert::Infallible;
use std::io;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, TryRecvError, channel};
use std::thread;
use std::time::Duration;

use compare::Comparer;

pub(in crate::tui) use ask::{Ask, Frame, Hand, Opened, Recorded, Standing, Told};
pub(in crate::tui) use desk::{Desk, Line};

/// The screen's end.
pub(in crate::tui) struct Worker {
    asks: Sender<Ask>,
    /// Closed by the thread when it ends.
    over: Receiver<Infallible>,
    comparer: Comparer,
}

impl Worker {
    /// Starts the thread, which tells what there is to know. It ends when the worker is dropped. What the program breaks one of its own
    /// assertions at is told, and the desk is cleared: whatever was on it cannot be relied on.
    pub(in crate::tui) fn start(
        desk: impl Fn() -> Desk + Send + Clone + 'static,
        tell: impl FnMut(Told) + Send + Clone + 'static,
    ) -> io::Result<Self> {
        let (asks, asked) = channel();
        let (running, over) = channel();
        let comparer = Comparer::new(desk.clone(), tell.clone());
        let work = move || {
            let _running = running;
            let mut line = Wire { asked, tell: Box::new(tell), waiting: VecDeque::new(), alone: false };
            let mut now = desk();
            while let Some(ask) = line.next() {
                let urgent = ask.is_urgent();
                let handled = catch_unwind(AssertUnwindSafe(|| now.handle(ask, &mut line)));
                if let Err(panic) = handled {
                    now = desk();
                    line.tell(Told::Broken(panic_text(panic.as_ref())));
                    line.tell(Told::Idle { urgent });
                }
            }
            now.leave().unwrap_or_else(|why| line.tell(Told::Failed(why)));
        };
        thread::Builder::new().name(THREAD.into()).spawn(work)?;
        Ok(Self { asks, over, comparer })
    }

    /// Lets it do what it was asked to, and end: what was recorded is kept then, and what was saved is written. Whatever else takes time is cut
    /// short. False if it did not end in this time.
    pub(in crate::tui) fn finish(self, patience: Duration) -> bool {
        let Self { asks, over, comparer } = self;
        drop((asks, comparer));
        over.recv_timeout(patience) == Err(RecvTimeoutError::Disconnected)
    }

    /// Asks for something. A worker that is gone has told why.
    pub(in crate::tui) fn ask(&self, ask: Ask) {
        match ask {
            Ask::Compare(job) => self.comparer.begin(job),
            Ask::StopComparing => self.comparer.end(),
            ask => drop(self.asks.send(ask)),
        }
    }
}

/// The thread's name.
pub(in crate::tui) const THREAD: &str = "worker";

fn panic_text(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().copied();
    let text = text.or_else(|| panic.downcast_ref::<String>().map(String::as_str));
    text.unwrap_or("without a message").into()
}

/// The worker's end.
struct Wire {
    asked: Receiver<Ask>,
    tell: Box<dyn FnMut(Told) + Send>,
    waiting: VecDeque<Ask>,
    /// Whether the screen is gone: then nothing more is shown to anybody.
    alone: bool,
}

impl Wire {
    /// The next thing to do; none when the screen is gone, and everything done that it wanted done.
    fn next(&mut self) -> Option<Ask> {
        self.collect();
        if self.waiting.is_empty() {
            self.waiting.push_back(self.asked.recv().ok()?);
            self.collect();
        }
        if self.alone {
            self.waiting.retain(Ask::is_urgent);
            return self.waiting.pop_front();
        }
        let urgent = self.first(Ask::is_urgent).or_else(|| self.newest_picture());
        urgent.or_else(|| self.first(|ask| !matches!(ask, Ask::Learn))).or_else(|| {
            self.waiting.clear();
            Some(Ask::Learn)
        })
    }

    fn first(&mut self, is: impl Fn(&Ask) -> bool) -> Option<Ask> {
        self.waiting.iter().position(is).and_then(|at| self.waiting.remove(at))
    }

    fn newest_picture(&mut self) -> Option<Ask> {
        let picture = |ask: &Ask| matches!(ask, Ask::Shoot(_));
        let newest = self.waiting.iter().rposition(picture).and_then(|at| self.waiting.remove(at));
        self.waiting.retain(|ask| !picture(ask));
        newest
    }

    fn collect(&mut self) {
        loop {
            match self.asked.try_recv() {
                Ok(ask) => self.waiting.push_back(ask),
                Err(end) => {
                    self.alone = end == TryRecvError::Disconnected;
                    return;
                }
            }
        }
    }
}

impl Line for Wire {
    fn tell(&mut self, told: Told) {
        (self.tell)(told);
    }

    fn is_interrupted(&mut self) -> bool {
        self.collect();
        self.alone || self.waiting.iter().any(Ask::interrupts)
    }

    fn is_wanted(&mut self) -> bool {
        self.collect();
        self.alone || self.waiting.iter().any(|ask| !matches!(ask, Ask::Learn))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assets;
    use crate::render::Choice;
    use crate::replay::{self, Input};
    use crate::tui::record::Drafts;

    #[test]
    fn what_was_recorded_and_saved_is_there_when_it_ends() {
        let folder = tempfile::tempdir().expect("a folder");
        let (drafts, saved) = (folder.path().join("drafts"), folder.path().join("saved.json"));
        let desk = {
            let drafts = drafts.clone();
            move || Desk::new(Choice::Reference, 1 << 20).with_drafts(Drafts::at(&drafts))
        };
        let worker = Worker::start(desk, drop).expect("a thread");
        worker.ask(Ask::Begin { scene: "builtin:grid".into(), viewport: [64, 64] });
        for number in 0..20 {
            worker.ask(Ask::Record(Hand::Other(Input::Checkpoint(format!("c-{number}")))));
            worker.ask(Ask::Learn);
        }
        worker.ask(Ask::Save(saved.clone()));
        worker.ask(Ask::Record(Hand::Other(Input::Undo)));
        assert!(worker.finish(Duration::from_secs(60)));
        assert_eq!(replay::read(&saved).expect("a script").event_count(), 20);
        let [draft] = &assets::list_files(&drafts).expect("a folder")[..] else { panic!("one draft") };
        assert_eq!(replay::read(draft).expect("a recording").event_count(), 21);
    }
}
