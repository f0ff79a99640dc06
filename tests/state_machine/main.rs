//! The session as a state machine: whatever is done to it, it stands where a fresh, linear replay of the same events stands, bit for bit, and
//! reports what that reports.
//!
//! The [`machine`] does [`deeds`] to a session and, by rules of a line each, to the model: a list of events and a place in it. What is seen at that
//! place is looked up in a [`linear`] replay from the first event on, made anew for every list. A failure shrinks to a recording with the
//! fewest and plainest events, written beside the deeds that fail on it: `lancet tui` steps through it.
//!
//! `PROPTEST_CASES=10000 cargo test --test state_machine` goes further.

mod deeds;
mod linear;
mod machine;
mod scenes;
mod story;

use std::collections::BTreeSet;
use std::panic::{AssertUnwindSafe, catch_unwind};

use lancet::recording::SceneRef;
use lancet::replay::Input;
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;

use deeds::Deed;
use machine::Machine;
use story::Story;

/// Cases where nobody asks for another number: some seconds without optimisation.
const CASES: u32 = 100;

/// How long a failure may be shrunk, milliseconds.
const SHRINKING_MS: u32 = 60_000;

/// Bytes that going back may take: none, a few steps, some steps and keyframes, all steps.
const BUDGETS: [usize; 7] = [0, 4 << 10, 24 << 10, 32 << 10, 48 << 10, 64 << 10, 256 << 20];

fn config() -> ProptestConfig {
    let asked = std::env::var("PROPTEST_CASES").ok().and_then(|cases| cases.parse().ok());
    // What failed is kept as a recording. Shrinking it has to end at some time.
    ProptestConfig {
        cases: asked.unwrap_or(CASES),
        failure_persistence: None,
        max_shrink_time: SHRINKING_MS,
        ..ProptestConfig::default()
    }
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn whatever_is_done_to_it_a_session_stands_where_linear_replay_does(
        scene in scenes::any_scene(),
        first in prop::collection::vec(deeds::any_event(), 0..150),
        deeds in prop::collection::vec(deeds::any_deed(), 1..20),
        budget in prop::sample::select(BUDGETS.to_vec()),
    ) {
        let told = told(&scene, &first, &deeds, budget);
        prop_assert!(told.is_ok(), "{}", told.unwrap_err());
    }
}

/// Does all this; what goes wrong is kept.
fn told(scene: &SceneRef, first: &[Input], deeds: &[Deed], budget: usize) -> Result<(), String> {
    let mut story = Story::default();
    let done = catch_unwind(AssertUnwindSafe(|| carry_out(scene, first, deeds, budget, &mut story)));
    let wrong = match done {
        Ok(Ok(())) => return Ok(()),
        Ok(Err(why)) => why,
        Err(panic) => format!("panicked: {}", story::panic_text(panic.as_ref())),
    };
    let kept = story.keep(env!("CARGO_TARGET_TMPDIR").as_ref(), &wrong);
    Err(format!("{wrong}\n{}", kept.unwrap_or_else(|error| format!("not kept: {error}"))))
}

fn carry_out(
    scene: &SceneRef,
    first: &[Input],
    deeds: &[Deed],
    budget: usize,
    story: &mut Story,
) -> Result<(), String> {
    story.tell(format_args!("{budget} bytes for going back"));
    let mut machine = Machine::begin(scene, first, budget, story)?;
    machine.compare()?;
    for deed in deeds {
        machine.carry_out(deed, story)?;
        machine.compare()?;
    }
    for deed in [Deed::Seek(0), Deed::Finish] {
        machine.carry_out(&deed, story)?;
        machine.compare_all()?;
    }
    Ok(())
}

/// What was never done cannot have been right.
#[test]
fn the_events_reach_every_stage_and_outcome() {
    let mut runner = TestRunner::deterministic();
    let strategy = (scenes::any_scene(), prop::collection::vec(deeds::any_event(), 10..20));
    let mut seen = BTreeSet::new();
    for _ in 0..100 {
        let (scene, events) = strategy.new_tree(&mut runner).expect("a value").current();
        let mut machine =
            Machine::begin(&scene, &events, usize::MAX, &mut Story::default()).expect("it opens");
        machine.carry_out(&Deed::Finish, &mut Story::default()).expect("it runs");
        seen.extend(machine.seen());
    }
    let kinds = ["camera", "click", "cut", "mode", "subdivide", "undo", "redo", "set", "checkpoint"];
    let stages = ["FC", "GP", "PP", "MC", "CI", "SD"];
    let outcomes = ["None", "Pending", "Applied", "Rejected", "Cancelled"];
    let reasons = ["miss", "no-such-element", "nothing-to-undo", "nothing-to-redo"];
    let missing = [&kinds[..], &stages, &outcomes, &reasons].concat();
    let missing: Vec<_> = missing.into_iter().filter(|what| !seen.contains(*what)).collect();
    assert!(missing.is_empty(), "{missing:?} of {seen:?}");
}

/// Nor what nobody came by: steps that are kept, keyframes, and the very beginning.
#[test]
fn the_budgets_reach_every_way_back() {
    let mut runner = TestRunner::deterministic();
    let strategy = (
        scenes::any_scene(),
        prop::collection::vec(deeds::any_event(), 150),
        prop::sample::select(BUDGETS.to_vec()),
    );
    let mut seen = BTreeSet::new();
    for _ in 0..60 {
        let (scene, events, budget) = strategy.new_tree(&mut runner).expect("a value").current();
        let mut machine = Machine::begin(&scene, &events, budget, &mut Story::default()).expect("it opens");
        machine.carry_out(&Deed::Finish, &mut Story::default()).expect("it runs");
        // Keyframes are kept once the steps are too many: here when all is run again.
        for deed in [Deed::Seek(0), Deed::Finish] {
            machine.carry_out(&deed, &mut Story::default()).expect("it runs");
        }
        seen.insert(machine.way_back(20));
    }
    assert_eq!(
        seen.into_iter().collect::<Vec<_>>(),
        ["from a keyframe", "from the beginning", "step by step"]
    );
}

#[test]
fn a_failure_is_kept_as_a_recording_with_the_deeds_beside_it() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut story = Story::default();
    let first = [Input::Mode("merge".into()), Input::Point([30.0, 30.0])];
    let mut machine = Machine::begin(&scenes::plate(), &first, 0, &mut story).expect("it opens");
    machine.carry_out(&Deed::Record(vec![Input::Undo]), &mut story).expect("an event");
    machine.carry_out(&Deed::Seek(1), &mut story).expect("a place");
    let said = story.keep(folder.path(), "the moon is down").expect("written");
    let [recording, text] = ["state-machine.json", "state-machine.txt"].map(|name| folder.path().join(name));
    assert!(said.contains("state-machine.json"), "{said}");
    let kept = lancet::replay::read(&recording).expect("a script");
    assert_eq!((kept.event_count(), kept.scene()), (3, &scenes::plate()));
    let text = std::fs::read_to_string(text).expect("text");
    assert!(["the moon is down", "{\"undo\":{}}", "seek 1"].iter().all(|part| text.contains(part)), "{text}");
}
