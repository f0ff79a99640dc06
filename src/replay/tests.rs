//! The session against a toy engine: what a replay may rely on, whatever the engine.

use proptest::prelude::*;

use super::toy::{Toy, ToyEvent, ToyState};
use super::*;
use crate::engine::Input;
use crate::report::Outcome;
use ToyEvent::{Add, Checkpoint, Click, Halve, Leak, Redo, Undo};

fn session_with(events: &[ToyEvent], options: Options) -> Session<Toy> {
    let keyed = events.iter().cloned().enumerate().map(|(i, e)| (i as u32, e)).collect();
    Session::new(ToyState::new(8), keyed, 42, options)
}

fn session(events: &[ToyEvent]) -> Session<Toy> {
    session_with(events, Options::default())
}

fn finished(events: &[ToyEvent], options: Options) -> Session<Toy> {
    let mut session = session_with(events, options);
    session.finish();
    session
}

fn outcomes(events: &[ToyEvent]) -> Vec<(Outcome, Option<String>)> {
    let run = finished(events, Options::default()).run_report("toy");
    run.events.into_iter().map(|e| (e.outcome, e.reason)).collect()
}

fn rejected(reason: &str) -> (Outcome, Option<String>) {
    (Outcome::Rejected, Some(reason.into()))
}

const APPLIED: (Outcome, Option<String>) = (Outcome::Applied, None);

fn name() -> String {
    "here".into()
}

#[test]
fn undo_and_redo_walk_the_applied_edits() {
    let events = [Add(1, 5.0), Undo, Undo, Redo, Redo, Undo, Add(2, 1.0), Redo, Add(99, 1.0), Undo];
    let none = rejected("nothing-to-undo");
    let all = [
        APPLIED,
        APPLIED,
        none,
        APPLIED,
        rejected("nothing-to-redo"),
        APPLIED,
        APPLIED,
        rejected("nothing-to-redo"),
        rejected("miss"),
        APPLIED,
    ];
    assert_eq!(outcomes(&events), all);
    assert_eq!(finished(&events, Options::default()).engine_state().numbers, [0.0; 8]);
}

#[test]
fn a_rejected_edit_leaves_what_can_be_redone() {
    let events = [Add(1, 5.0), Undo, Add(99, 1.0), Redo];
    assert_eq!(outcomes(&events)[3], APPLIED);
}

#[test]
fn undo_gives_the_digest_from_before() {
    let mut session = session(&[Add(1, 5.0), Add(8, 2.0), Undo, Redo]);
    session.seek(1);
    let one = session.state();
    session.seek(2);
    let two = session.state();
    session.seek(3);
    assert_eq!(session.state(), one);
    session.seek(4);
    assert_eq!(session.state(), two);
    assert_ne!(one, two);
}

#[test]
fn clicks_pend_cancel_and_cut() {
    let events = [Click(1), Halve(true), Click(1), Checkpoint(name()), Click(3), Click(2), Undo, Click(77)];
    let words: Vec<Outcome> = outcomes(&events).into_iter().map(|(outcome, _)| outcome).collect();
    use Outcome::{Applied, Cancelled, None, Pending, Rejected};
    assert_eq!(words, [Pending, Cancelled, Pending, None, Applied, Pending, Applied, Rejected]);
}

#[test]
fn stages_have_rows_where_they_take_part() {
    let mut session =
        session(&[Add(1, 5.0), Halve(false), Add(1, 5.0), Add(50, 1.0), Halve(true), Add(50, 0.0)]);
    session.finish();
    let rows = |i: usize| -> Vec<(String, Option<String>, bool)> {
        let stages = session.event(i).expect("it was run").stages.iter();
        stages.map(|s| (s.id.clone(), s.skipped.clone(), s.digest.is_some())).collect()
    };
    let row = |id: &str, skipped: Option<&str>, digest| (id.to_string(), skipped.map(String::from), digest);
    assert_eq!(rows(0), [row("AD", None, true), row("HV", None, true)]);
    assert_eq!(rows(1), []);
    assert_eq!(rows(2), [row("AD", None, true), row("HV", Some("switched off"), false)]);
    assert_eq!(rows(3), [row("AD", None, false), row("HV", Some("switched off"), false)]);
    assert_eq!(rows(5), [row("AD", None, false), row("HV", Some("rejected"), false)]);
}

#[test]
fn a_rejection_in_a_later_stage_leaves_no_trace() {
    let mut session = session(&[Add(1, 5.0), Add(8, 1e6)]);
    session.step();
    let before = session.state();
    let report = session.step().expect("a second event").clone();
    assert_eq!((report.outcome, report.reason.as_deref()), (Outcome::Rejected, Some("too-large")));
    assert!(report.stages[0].digest.is_some() && report.stages[1].digest.is_none());
    assert_eq!(session.state(), before);
}

#[test]
fn the_first_broken_invariant_is_latched_and_the_replay_goes_on() {
    let mut session = session(&[Add(1, 5.0), Add(2, -50.0), Add(3, -5.0), Add(3, 90.0)]);
    session.finish();
    let first = session.finding().expect("a negative sum").clone();
    assert_eq!((first.event, first.name()), (Some(1), "AD/sum".into()));
    let run = session.run_report("toy");
    assert_eq!((run.totals.applied, run.totals.findings), (4, 2));
    session.seek(0);
    assert_eq!(session.finding(), Some(&first));
}

#[test]
fn what_breaks_only_in_the_whole_is_found_at_the_end() {
    let mut state = ToyState::new(2);
    state.numbers[0] = -1.0;
    let session = Session::<Toy>::new(state, Vec::new(), 0, Options::default());
    let finding = session.finding().expect("a negative sum");
    assert_eq!((finding.event, finding.name()), (None, "state/sum".into()));
    assert_eq!(session.run_report("toy").totals.findings, 1);
}

#[test]
fn the_whole_state_is_looked_at_where_asked() {
    let events = [Add(1, 1.0), Checkpoint(name()), Add(2, 1.0), Undo, Redo];
    let looked = |options: Options| -> Vec<(bool, usize)> {
        let run = finished(&events, options).run_report("toy");
        run.events.iter().map(|e| (e.state.is_some(), e.checks.len())).collect()
    };
    let plain = looked(Options::default());
    assert_eq!(plain, [(false, 0), (true, 1), (false, 0), (false, 0), (false, 0)]);
    let second = looked(Options { check_every: 2, ..Options::default() });
    assert_eq!(second, [(false, 0), (true, 1), (false, 1), (false, 0), (false, 1)]);
    assert_eq!(looked(Options { paranoid: true, ..Options::default() }), [(true, 1); 5]);
}

#[test]
fn a_checkpoint_says_why_there_is_no_frame() {
    let mut session = session(&[Checkpoint(name())]);
    let report = session.step().expect("a checkpoint");
    assert_eq!(report.checkpoint.as_deref(), Some("here"));
    assert_eq!(report.frame.as_deref(), Some("skipped: no renderer"));
    assert_eq!(report.counts["numbers"], 8);
}

#[test]
fn options_do_not_change_the_digest() {
    let events = [Add(1, 1.0), Add(2, 99.0), Checkpoint(name()), Undo];
    let digest = |options| finished(&events, options).run_report("toy").totals.digest;
    let plain = digest(Options::default());
    assert_eq!(digest(Options { paranoid: true, ..Options::default() }), plain);
    assert_eq!(digest(Options { check_every: 1, budget_bytes: 0, ..Options::default() }), plain);
}

#[test]
fn the_key_and_not_the_place_makes_an_events_seed() {
    let run = |key: u32| {
        let mut session =
            Session::<Toy>::new(ToyState::new(4), vec![(key, Add(0, 0.0))], 5, Options::default());
        session.finish();
        session.engine_state().numbers[0]
    };
    assert_eq!(run(3), (digest::event_seed(5, 3, "cut") % 7) as f64);
    assert!((0..20).any(|key| run(key) != run(3)));
}

#[test]
fn holding_runs_some_stages_and_stays_until_it_is_let_go() {
    let mut session = session(&[Click(1), Add(2, 3.0)]);
    let report = session.hold(1, "AD").expect("there is such a place");
    assert!(report.stages[0].digest.is_some());
    assert_eq!(report.stages[1].skipped.as_deref(), Some("until"));
    assert_eq!(session.position(), 1);
    assert!(session.engine_state().numbers[2] >= 3.0, "one is within the event");
    session.release();
    assert_eq!(session.engine_state().numbers, [0.0; 8]);
    assert_eq!(session.engine_state().control.pending, Some(1));
    session.hold(1, "AD").expect("there is such a place");
    session.step();
    let linear = finished(&[Click(1), Add(2, 3.0)], Options::default());
    assert_eq!(session.engine_state(), linear.engine_state(), "a step lets go first");
    assert!(session.hold(1, "XX").is_err() && session.hold(2, "AD").is_err());
}

#[test]
fn a_stage_that_an_event_has_not_holds_nothing() {
    let mut session = session(&[Click(1), Add(99, 3.0), Add(2, 3.0)]);
    let error = |held: Result<EventReport, String>| held.expect_err("there is no such place");
    assert_eq!(error(session.hold(2, "NO")), "event 2 (add) has no stage `NO`; it has AD, HV");
    assert_eq!(session.engine_state().numbers, [0.0; 8], "it was let go");
    assert_eq!(error(session.hold(0, "AD")), "event 0 (click) has no stage `AD`; it has none");
    assert_eq!(session.hold(1, "HV").map(|report| report.outcome), Ok(Outcome::Rejected));
}

#[test]
fn what_is_appended_runs_as_if_it_had_been_there_and_can_be_dropped() {
    let script = |text: &str| Input::Script(text.into());
    let mut live = session(&[Click(1), Add(2, 3.0)]);
    live.finish();
    live.append(7, &script(r#"{"Add": [1, 4.0]}"#)).expect("an event");
    assert!(live.append(8, &script("{")).is_err() && live.append(8, &Input::Undo).is_err());
    assert_eq!((live.len(), live.run_report("").end), (3, None), "what may go on has no end");
    live.finish();
    let grown = live.engine_state().clone();
    live.truncate(2);
    assert_eq!((live.len(), live.position()), (2, 2));
    live.append(7, &script(r#"{"Add": [1, 4.0]}"#)).expect("an event");
    live.finish();
    assert_eq!((live.engine_state(), live.finding()), (&grown, None));
}

#[test]
fn a_seek_can_be_stopped_and_taken_up_again() {
    let mut session = session(&[Add(0, 1.0), Add(1, 1.0), Add(2, 1.0), Add(3, 1.0)]);
    assert!(!session.seek_while(4, &mut |position| position < 2));
    assert_eq!(session.position(), 2);
    assert!(session.seek_while(4, &mut |_| true));
    assert!(!session.seek_while(0, &mut |position| position > 3));
    assert_eq!(session.position(), 3);
}

#[test]
fn a_defect_is_planted_in_its_stage() {
    let plant: Plant = "1.AD:numbers:x2:1".parse().expect("a place");
    let events = [Add(2, 1.0), Add(2, 1.0)];
    let run = |plant| finished(&events, Options { plant, ..Options::default() });
    let (clean, planted) = (run(None).run_report("toy"), run(Some(plant.clone())));
    assert_eq!(*planted.planting(), Planting::Done);
    let planted = planted.run_report("toy");
    assert_eq!(planted.events[0].without_times(), clean.events[0].without_times());
    assert_ne!(planted.events[1].stages[0].digest, clean.events[1].stages[0].digest);
    let nowhere = run(Some(Plant { element: 999, ..plant }));
    assert_eq!(*nowhere.planting(), Planting::Failed("there is no element 999".into()));
}

#[test]
fn a_place_to_plant_at_is_read_from_text() {
    let plant: Plant = "12.MC:nodes:n120:-3".parse().expect("a place");
    assert_eq!((plant.event, plant.stage.as_str(), plant.element, plant.ulps), (12, "MC", 120, -3));
    for wrong in ["", "1.MC:nodes:1", "MC:nodes:1:1", "1.MC:nodes:1:1:1", "1.MC:nodes::1", "1.MC:nodes:1:x"] {
        assert!(wrong.parse::<Plant>().is_err(), "{wrong}");
    }
}

#[test]
fn deltas_are_the_buffers_behind_the_digests() {
    let mut session =
        session_with(&[Add(2, 1.0), Halve(false)], Options { keep_deltas: true, ..Options::default() });
    session.finish();
    let deltas = session.take_deltas();
    assert_eq!(deltas.iter().map(|d| (d.event, d.stages.len())).collect::<Vec<_>>(), [(0, 2)]);
    let report = session.event(0).expect("it was run");
    for (delta, row) in deltas[0].stages.iter().zip(&report.stages) {
        assert_eq!(digest::of_buffers(&delta.buffers).1, row.buffers);
    }
    assert!(session.take_deltas().is_empty());
}

#[test]
fn an_event_that_does_not_repeat_is_a_finding() {
    let mut session = session_with(&[Leak, Add(1, 1.0)], Options { budget_bytes: 0, ..Options::default() });
    session.finish();
    assert_eq!(session.finding(), None);
    session.seek(0);
    session.finish();
    assert_eq!(session.finding().map(|f| (f.event, f.name())), Some((Some(0), "replay/repeats".into())));
}

fn any_event() -> impl Strategy<Value = ToyEvent> {
    prop_oneof![
        4 => (0..10usize, -5.0..120.0f64).prop_map(|(at, value)| Add(at, value)),
        2 => (0..12usize).prop_map(Click),
        1 => any::<bool>().prop_map(Halve),
        2 => Just(Undo),
        2 => Just(Redo),
        1 => Just(Checkpoint(name())),
    ]
}

fn any_budget() -> impl Strategy<Value = usize> {
    prop_oneof![Just(0), Just(300), Just(2000), Just(256 << 20)]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    /// Wherever a session is sent, it stands where linear replay stood, bit for bit, and reports what linear replay reported.
    #[test]
    fn seeking_equals_linear_replay(
        events in prop::collection::vec(any_event(), 0..60),
        walk in prop::collection::vec(0..70usize, 0..25),
        budget_bytes in any_budget(),
    ) {
        let options = |budget_bytes| Options { budget_bytes, check_every: 3, ..Options::default() };
        let mut linear = session_with(&events, options(256 << 20));
        let mut states = vec![linear.engine_state().clone()];
        while linear.step().is_some() {
            states.push(linear.engine_state().clone());
        }
        let mut session = session_with(&events, options(budget_bytes));
        for target in walk {
            match target {
                60.. if session.position() > 0 => prop_assert!(session.back()),
                60.. => { session.step(); }
                _ => session.seek(target),
            }
            prop_assert_eq!(session.engine_state(), &states[session.position()]);
            prop_assert!(session.kept_bytes() <= budget_bytes);
        }
        session.finish();
        prop_assert_eq!(session.run_report("").without_times(), linear.run_report("").without_times());
        prop_assert_eq!(session.finding(), linear.finding());
    }
}
