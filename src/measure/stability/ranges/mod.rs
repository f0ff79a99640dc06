//! How far one can go: the same cuts on scenes that are moved away, scaled, turned, shaken, rounded, squeezed and given double points.
//!
//! Each of these is a **ladder** (`ladders`) with a rung for each size. The cuts are drawn once, on the scene as it is (`sample`), and made on every
//! rung by three programs (`rung`): the engine, with every invariant looked at and its line compared with the exact one; and plain f32 and plain f64 with
//! an ε, the thesis's way ([`crate::measure::baseline`]). The usable range of each ends before the first rung on which one of its cuts fails. For the engine that
//! is a broken invariant, a panic, or a line that is not the exact one; a refusal is no failure, and it is told from where on cuts are refused because
//! nothing can be resolved there any more. For the others it is a cut that comes to no line or to no mesh (**lost**), or to a line through elements farther from the
//! plane than ε (**wrong**). Where ε merely takes nodes for coincident with the line the cut counts as done.

mod ladders;
mod plot;
mod report;
mod rung;
mod sample;
#[cfg(test)]
mod tests;

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread;

pub use report::{LadderReport, RangesReport, Until};
pub use rung::{Ours, Rung, Theirs};

use super::Options;
use crate::measure::{MeasureError, Progress};
use ladders::LADDERS;
use rung::{Base, Found};

type Done = (usize, Result<(Rung, Vec<Found>), MeasureError>);

/// Climbs every ladder. The report depends on the number of cuts and the seed alone.
pub(super) fn measure(options: &Options, progress: Progress<'_>) -> Result<RangesReport, MeasureError> {
    if options.per_rung == 0 {
        return Ok(RangesReport::default());
    }
    let bases = bases(options)?;
    let tasks: Vec<(usize, f64)> = (0..)
        .zip(&LADDERS)
        .flat_map(|(i, ladder)| ladder.rungs.iter().map(move |&value| (i, value)))
        .collect();
    let (next, done) = (AtomicUsize::new(0), Mutex::new(Vec::<Done>::with_capacity(tasks.len())));
    let work = || {
        loop {
            let number = next.fetch_add(1, Ordering::Relaxed);
            let Some(&(ladder, value)) = tasks.get(number) else { return };
            let rung = rung::run(&LADDERS[ladder], value, &bases, options.seed);
            let mut done = done.lock().unwrap_or_else(PoisonError::into_inner);
            done.push((number, rung));
            progress(done.len(), tasks.len(), LADDERS[ladder].name);
        }
    };
    thread::scope(|scope| (0..options.jobs.max(1)).for_each(|_| drop(scope.spawn(work))));
    let mut done = done.into_inner().unwrap_or_else(PoisonError::into_inner);
    done.sort_unstable_by_key(|rung| rung.0);
    let rungs = done.into_iter().map(|(_, rung)| rung).collect::<Result<Vec<_>, _>>()?;
    Ok(RangesReport::join(options, tasks.into_iter().map(|task| task.0).zip(rungs)))
}

/// Every scene that a ladder has; the cuts of a rung are divided among them.
fn bases(options: &Options) -> Result<Vec<Base>, MeasureError> {
    let mut names: Vec<&str> = LADDERS.iter().flat_map(|ladder| ladder.scenes).collect();
    names.sort_unstable();
    names.dedup();
    names.into_iter().map(|name| Base::make(name, options.per_rung.div_ceil(2), options.seed)).collect()
}
