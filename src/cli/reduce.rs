//! `lancet reduce`: the least of a recording that still fails in the same way.

use std::io::Write;

use super::args::Reduce;
use super::failure::Failure;
use super::{Console, Done, Status, json, place};
use crate::recording::{AnyRecording, Progress, Recorded, Recording, Visit, reduce, to_bytes};
use crate::replay::{Case, Options};
use crate::verify;

pub(super) fn run(typed: &Reduce, console: &mut Console<'_>) -> Done {
    let case = Case::open(&typed.recording)?;
    let Some(failure) = failure(&case, &case.recording)? else {
        return Err(Failure::about(&typed.recording)(&"nothing breaks in it: there is nothing to reduce"));
    };
    let mut reduced = case.recording.visit(Reducer { case: &case, failure: &failure, console });
    let (after, before) = (reduced.event_count(), case.recording.event_count());
    reduced.set_scene(place::moved(reduced.scene(), &case.folder, &typed.output)?);
    json::put(&to_bytes(&reduced)?, &typed.output, console)?;
    writeln!(console.err, "{after} of {before} events still break {failure}")?;
    Ok(Status::Verified)
}

/// How a recording fails: the name of the first invariant that breaks, else that of an oracle of the fuzzers.
fn failure(case: &Case, recording: &AnyRecording) -> Result<Option<String>, Failure> {
    let broken = verify::failure(case.replay(recording, Options::default(), None)?);
    Ok(broken.or_else(|| oracle(recording)))
}

/// The oracle that a recording breaks.
#[cfg(feature = "attack")]
fn oracle(recording: &AnyRecording) -> Option<String> {
    crate::attack::judge(recording)
}

/// There are no oracles in this program.
#[cfg(not(feature = "attack"))]
fn oracle(_: &AnyRecording) -> Option<String> {
    None
}

struct Reducer<'a, 'c, 'w> {
    case: &'a Case,
    failure: &'a str,
    console: &'c mut Console<'w>,
}

impl Visit for Reducer<'_, '_, '_> {
    type Output = AnyRecording;

    fn visit<E: Recorded>(self, recording: &Recording<E>) -> AnyRecording {
        let fails_so = |candidate: &Recording<E>| {
            let found = failure(self.case, &E::wrap(candidate.clone()));
            found.is_ok_and(|found| found.as_deref() == Some(self.failure))
        };
        let mut work = self.console.err.work();
        let progress = |Progress { tried, events }: Progress| {
            work.show(format_args!("{tried} tried, {events} of {} events", recording.events.len()));
        };
        E::wrap(reduce(recording, fails_so, progress))
    }
}
