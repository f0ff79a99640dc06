//! Comparing, beside everything else: each comparison has a thread, a replay and a renderer of its own, so stepping never waits for it.
//!
//! One comparison is wanted at a time. The one that is running looks at its number before each event, and ends where another is wanted by then;
//! what it tells carries the number too, so that the screen knows what comes too late.

use std::cell::RefCell;
use std::io;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::thread;

use super::ask::Told;
use super::desk::{Desk, Line};
use super::panic_text;
use crate::render::{self, Choice};
use crate::replay::Options;
use crate::tui::compare::{Differences, Job, With};
use crate::verify::{self, Watch};

/// Makes comparisons, each on a thread of its own.
pub(super) struct Comparer {
    /// The number of the comparison that is wanted.
    wanted: Arc<AtomicU64>,
    begin: Box<Begin>,
}

type Begin = dyn Fn(Job, Arc<AtomicU64>);

impl Comparer {
    /// Compares at desks like this one, and tells what there is to know.
    pub(super) fn new(
        desk: impl Fn() -> Desk + Send + Clone + 'static,
        tell: impl FnMut(Told) + Send + Clone + 'static,
    ) -> Self {
        let begin = move |job: Job, wanted| {
            let (desk, mut tell, number) = (desk.clone(), tell.clone(), job.number);
            if let Err(error) = begin(job, wanted, desk, tell.clone()) {
                tell(Told::Compared { number, found: Box::new(Err(error.to_string())) });
            }
        };
        Self { wanted: Arc::default(), begin: Box::new(begin) }
    }

    /// Begins a comparison; the one before ends.
    pub(super) fn begin(&self, job: Job) {
        self.wanted.store(job.number, Ordering::Relaxed);
        (self.begin)(job, Arc::clone(&self.wanted));
    }

    /// Ends the one that is being made.
    pub(super) fn end(&self) {
        self.wanted.store(0, Ordering::Relaxed);
    }
}

impl Drop for Comparer {
    fn drop(&mut self) {
        self.end();
    }
}

fn begin(
    job: Job,
    wanted: Arc<AtomicU64>,
    desk: impl Fn() -> Desk + Send + 'static,
    tell: impl FnMut(Told) + Send + 'static,
) -> io::Result<()> {
    let mut line = Aside { number: job.number, wanted, tell };
    thread::Builder::new().name("compare".into()).spawn(move || desk().compare(&job, &mut line)).map(drop)
}

/// The way back to the screen from such a thread.
struct Aside<T> {
    number: u64,
    wanted: Arc<AtomicU64>,
    tell: T,
}

impl<T: FnMut(Told)> Line for Aside<T> {
    fn tell(&mut self, told: Told) {
        (self.tell)(told);
    }

    fn is_interrupted(&mut self) -> bool {
        self.wanted.load(Ordering::Relaxed) != self.number
    }

    fn is_wanted(&mut self) -> bool {
        self.is_interrupted()
    }
}

/// Makes a comparison, and tells what it came to. What the program breaks one of its own assertions at is told too.
pub(super) fn carry_out(job: &Job, choice: Choice, line: &mut dyn Line) {
    let (number, line) = (job.number, RefCell::new(line));
    let watch = |done, of| {
        let mut line = line.borrow_mut();
        line.tell(Told::Comparing { number, done, of });
        !line.is_interrupted()
    };
    let found = catch_unwind(AssertUnwindSafe(|| compare(job, choice, &watch)));
    let panicked = |panic: Box<dyn std::any::Any + Send>| {
        Err(format!("a bug of lancet's: panicked: {}", panic_text(panic.as_ref())))
    };
    let found = Box::new(found.unwrap_or_else(panicked));
    line.into_inner().tell(Told::Compared { number, found });
}

fn compare(job: &Job, choice: Choice, watch: Watch<'_>) -> Result<Differences, String> {
    let Job { path, with, .. } = job;
    match with {
        With::Goldens => {
            let studio = render::studio(choice).map_err(|error| error.to_string())?;
            let options = Options::default();
            let compared = verify::against_goldens(path, &options, Some(studio.as_ref()), watch)?;
            Ok(Differences::from_goldens(compared))
        }
        With::Run(other) => Ok(Differences::from_run(with.clone(), verify::against_run(path, other, watch)?)),
    }
}
