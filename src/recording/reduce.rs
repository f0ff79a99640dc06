//! The least of a recording that still fails.
//!
//! Delta debugging (Zeller and Hildebrandt 2002, "Simplifying and Isolating Failure-Inducing Input", ddmin): cut the events into n parts; if
//! one part alone fails, or all but one, go on with that; else into twice as many. Where we depart: single parts are not tried (what cuts
//! need, they need from before, so that a part alone fails seldom), and after n has reached the number of events, a pass is repeated
//! until it removes nothing.
//!
//! Then the numbers that are left are made as round as they can be (`simplify`).
//!
//! Promised: the result fails, its events are some of the recording's in their order and with their keys, and no single one can be left out
//! (provided that the same events always fail or always do not). Not promised: the smallest of all such parts.

use super::{Keyed, Recording, simplify};
use crate::engine::Event;

/// How far the reducer is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// Recordings tried so far.
    pub tried: u64,
    /// Events that are left.
    pub events: usize,
}

/// The least of a failing recording that still fails. One that does not fail is returned as it is.
pub fn reduce<E: Event>(
    recording: &Recording<E>,
    still_fails: impl FnMut(&Recording<E>) -> bool,
    progress: impl FnMut(Progress),
) -> Recording<E> {
    let mut search = Search { recording, still_fails, progress, tried: 0 };
    let mut events = recording.events.clone();
    if !search.fails(&events) {
        return recording.clone();
    }
    let half = events.len().div_ceil(2);
    search.leave_out(&mut events, half);
    search.round(&mut events);
    search.leave_out(&mut events, 1);
    recording.with_events(events)
}

struct Search<'a, E: Event, F, P> {
    recording: &'a Recording<E>,
    still_fails: F,
    progress: P,
    tried: u64,
}

impl<E: Event, F: FnMut(&Recording<E>) -> bool, P: FnMut(Progress)> Search<'_, E, F, P> {
    /// Leaves out runs of at most `size` events, then of half as many, until no single one can be left out.
    fn leave_out(&mut self, events: &mut Vec<Keyed<E>>, mut size: usize) {
        size = size.max(1);
        while !self.pass(events, size) || size > 1 {
            size = size.div_ceil(2).min(events.len()).max(1);
        }
    }

    /// Makes each number as round as it can be.
    fn round(&mut self, events: &mut [Keyed<E>]) {
        for at in 0..events.len() {
            // A number that became whole is no longer counted: from the last to the first the others keep their places.
            for place in (0..simplify::numbers(&events[at].event)).rev() {
                let before = events[at].event.clone();
                let fails = |rounder: &E| {
                    events[at].event = rounder.clone();
                    self.fails(events)
                };
                let kept = simplify::rounder(&before, place).find(fails);
                events[at].event = kept.unwrap_or(before);
            }
        }
    }

    /// Tries to leave out each run of `size` events, the last first; returns true when none could be.
    fn pass(&mut self, events: &mut Vec<Keyed<E>>, size: usize) -> bool {
        let (mut end, before) = (events.len(), events.len());
        while end > 0 {
            let start = end.saturating_sub(size);
            let fewer = [&events[..start], &events[end..]].concat();
            if self.fails(&fewer) {
                *events = fewer;
            }
            end = start;
        }
        events.len() == before
    }

    fn fails(&mut self, events: &[Keyed<E>]) -> bool {
        self.tried += 1;
        (self.progress)(Progress { tried: self.tried, events: events.len() });
        (self.still_fails)(&self.recording.with_events(events.to_vec()))
    }
}
