//! The reducer, with failures that are made up.

use super::pack;
use crate::engine::wound::{Pick, WoundEvent};
use crate::mesh::{EdgeId, NodeId};
use crate::recording::{AnyRecording, Recording, reduce};

/// Clicks at 0, 1, 2, …
fn clicks(count: usize) -> Recording<WoundEvent> {
    let events: Vec<String> = (0..count).map(|i| format!(r#"{{"click": [{i}, 0]}}"#)).collect();
    let AnyRecording::Wound(recording) =
        pack(&format!(r#"{{"version": 1, "scene": "builtin:bust", "events": [{}]}}"#, events.join(",")));
    recording
}

fn keys(recording: &Recording<WoundEvent>) -> Vec<u32> {
    recording.events.iter().map(|keyed| keyed.key).collect()
}

fn has(recording: &Recording<WoundEvent>, key: u32) -> bool {
    recording.events.iter().any(|keyed| keyed.key == key)
}

#[test]
fn what_is_needed_is_left_with_its_keys() {
    for needed in [&[][..], &[0], &[99], &[3, 4], &[0, 50, 99], &[7, 11, 13, 17, 19, 23]] {
        let reduced = reduce(&clicks(100), |r| needed.iter().all(|&key| has(r, key)), |_| ());
        assert_eq!(keys(&reduced), needed);
        assert_eq!(reduced, clicks(100).with_events(reduced.events.clone()));
    }
}

#[test]
fn nothing_more_can_be_left_out() {
    // Needs an even number of the first ten, at least two, and either 40 or 60.
    let fails = |r: &Recording<WoundEvent>| {
        let first = r.events.iter().filter(|keyed| keyed.key < 10).count();
        first >= 2 && first % 2 == 0 && (has(r, 40) || has(r, 60))
    };
    let reduced = reduce(&clicks(100), fails, |_| ());
    assert!(fails(&reduced));
    for left_out in 0..reduced.events.len() {
        let mut events = reduced.events.clone();
        events.remove(left_out);
        assert!(!fails(&reduced.with_events(events)));
    }
    assert_eq!(reduced, reduce(&clicks(100), fails, |_| ()));
}

#[test]
fn what_does_not_fail_stays_as_it_is() {
    assert_eq!(reduce(&clicks(5), |_| false, |_| ()), clicks(5));
    assert_eq!(reduce(&clicks(0), |_| true, |_| ()), clicks(0));
}

#[test]
fn one_event_of_a_thousand_takes_few_tries() {
    let mut tried = 0;
    reduce(&clicks(1000), |r| has(r, 617), |progress| tried = progress.tried);
    assert!(tried < 40, "{tried} recordings tried");
}

#[test]
fn numbers_become_as_round_as_they_can() {
    let script = r#"{"version": 1, "scene": "builtin:bust", "events": [
        {"click": [3.24159, 2.71828]}, {"cut": {"from": {"edge": [7, 0.123456]}, "to": {"node": 5}}}]}"#;
    let AnyRecording::Wound(recording) = pack(script);
    // The click must lie right of 3.2, the cut begin before the eighth part of its edge.
    let fails = |r: &Recording<WoundEvent>| {
        let events: Vec<&WoundEvent> = r.events.iter().map(|keyed| &keyed.event).collect();
        matches!(events[..], [WoundEvent::Click([x, _]), WoundEvent::Cut { from: Pick::Edge(_, t), .. }]
            if *x > 3.2 && (0.1..0.125).contains(t))
    };
    let reduced = reduce(&recording, fails, |_| ());
    let edge = Pick::Edge(EdgeId(7), 0.1);
    let cut = WoundEvent::Cut { from: edge, to: Pick::Node(NodeId(5)) };
    let events: Vec<WoundEvent> = reduced.events.into_iter().map(|keyed| keyed.event).collect();
    assert_eq!(events, [WoundEvent::Click([3.24, 3.0]), cut]);
}
