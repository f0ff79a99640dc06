//! Random and adversarial cuts over the built-in scenes: what becomes of them, and whether any invariant breaks.
//!
//! Three fifths of the cuts go between random pixels, a fifth through nodes and along edges or with hostile values (`cuts`), and a fifth
//! over earlier cuts. They are merged or carved, seen from random cameras, on the scenes as they are and scaled to millionths and millions
//! (`scenes`). After each stage of each cut its local checks are made, and every hundred cuts, before a fresh scene is taken, the checks of
//! the whole. A rejected cut must leave no trace; now and then that is looked at bit for bit. A panic is a finding too.
//!
//! The cuts come in **parts**, one scene each, and a part depends on the seed and its number alone. So parts can be run by any number of
//! threads; their results are joined in order. Every finding comes with the script that leads to it ([`reproduce`]).
//!
//! How far away, how large, how thin it may be before something breaks is asked on ladders ([`ranges`]).

mod cuts;
mod part;
pub mod ranges;
pub mod report;
pub mod reproduce;
mod scenes;

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread;

pub use report::StabilityReport;

use super::{MeasureError, Progress};
use part::Part;
use scenes::Prepared;

/// Cuts of a part.
const CUTS: usize = 100;

/// What is run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// How many random cuts.
    pub cuts: usize,
    /// How many cuts on every rung of every ladder.
    pub per_rung: usize,
    /// What they are drawn from.
    pub seed: u64,
    /// How many parts at a time.
    pub jobs: usize,
}

/// Runs the cuts. The report depends on their number and the seed alone.
pub fn measure(options: &Options, progress: Progress<'_>) -> Result<StabilityReport, MeasureError> {
    let scenes = scenes::prepare()?;
    let parts = run_parts(options, &scenes, progress);
    Ok(StabilityReport::join(options, &scenes, parts, ranges::measure(options, progress)?))
}

fn run_parts(options: &Options, scenes: &[Prepared], progress: Progress<'_>) -> Vec<Part> {
    let count = options.cuts.div_ceil(CUTS);
    let (next, done) = (AtomicUsize::new(0), Mutex::new(Vec::with_capacity(count)));
    let work = || {
        loop {
            let number = next.fetch_add(1, Ordering::Relaxed);
            if number >= count {
                return;
            }
            let scene = &scenes[number % scenes.len()];
            let part = part::run(options.seed, number, scene, CUTS.min(options.cuts - number * CUTS));
            let mut done = done.lock().unwrap_or_else(PoisonError::into_inner);
            done.push(part);
            progress(done.len(), count, &scene.name);
        }
    };
    thread::scope(|scope| (0..options.jobs.clamp(1, count.max(1))).for_each(|_| drop(scope.spawn(work))));
    let mut parts = done.into_inner().unwrap_or_else(PoisonError::into_inner);
    parts.sort_unstable_by_key(|part| part.number);
    parts
}
