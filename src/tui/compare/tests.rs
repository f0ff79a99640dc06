//! Comparing, from the key to the selected element.

use super::*;
use crate::canvas::image::Image;
use crate::tui::action::Action;
use crate::tui::model::Pane;
use crate::tui::tests::suite::{Screen, Suite, lancet};
use crate::tui::update;
use crate::verify::ImageVerdict;

const RUN: &str = "golden/square/_run.txt";

fn compared(suite: &Suite) -> Screen {
    let mut screen = suite.screen();
    screen.act(Action::Compare);
    screen
}

fn found(screen: &Screen) -> &Differences {
    screen.0.model.differences.as_ref().expect("it was compared")
}

/// Changes a digest of the goldens, and where the values behind it are kept, what they say.
fn spoil(suite: &Suite, line: &str) {
    suite.change(RUN, |text| {
        let begin = text.find(line).unwrap_or_else(|| panic!("no {line} in {text}")) + line.len() + 3;
        format!("{}0000{}", &text[..begin], &text[begin + 4..])
    });
}

/// The run's report as a file, with something about it changed.
fn other_run(suite: &Suite, change: impl FnOnce(&mut serde_json::Value)) -> String {
    let (_, out, _) = lancet(&["replay", &suite.recording(), "--json", "-"]);
    let mut report = serde_json::from_str(&out).expect("JSON");
    change(&mut report);
    std::fs::write(suite.at("other.json"), report.to_string()).expect("written");
    suite.text("other.json")
}

#[test]
fn a_run_as_its_goldens_are_is_the_same_pictures_and_all() {
    let suite = Suite::new();
    let screen = compared(&suite);
    assert_eq!(screen.said(), ("the same as the goldens, 1 pictures too", false));
    assert_eq!(found(&screen).rows.len(), 1, "a picture that is fine has its row too");
    assert!((0..6).all(|event| !found(&screen).has(event)));
    let beside = picture(&screen.0.model, Place::after(5)).expect("the checkpoint's");
    assert_eq!((beside.checkpoint.as_str(), beside.report.verdict), ("cut", ImageVerdict::Equal));
    assert_eq!(beside.golden, Some(beside.actual.clone()));
    let shown = beside.difference.as_ref().expect("there is a golden");
    assert_eq!(**shown, Image::filled(beside.actual.size, [0, 0, 0, 255]));
    assert!(picture(&screen.0.model, Place::after(4)).is_none());
}

#[test]
fn what_differs_is_marked_and_gone_to_from_one_to_the_next() {
    let suite = Suite::new();
    spoil(&suite, "event 2 digest FC.links");
    spoil(&suite, "event 2 digest MC.nodes");
    suite.change(RUN, |text| text.replace("event 3 = click rejected miss", "event 3 = click applied"));
    let mut screen = compared(&suite);
    assert_eq!(screen.said(), ("not as the goldens: 3 values differ", true));
    let marked: Vec<usize> = (0..6).filter(|event| found(&screen).has(*event)).collect();
    assert_eq!(marked, [2, 3]);
    let first = marks(&screen.0.model, 2).expect("it differs");
    assert_eq!((first.stage.as_deref(), first.buffer.as_deref()), (Some("FC"), Some("links")));
    assert_eq!(marks(&screen.0.model, 3).map(|value| value.expected.as_str()), Some("click applied"));
    let mut places = Vec::new();
    for _ in 0..4 {
        screen.act(Action::NextDivergence);
        places.push((screen.0.model.place, screen.0.model.lists.differences.selected(4)));
    }
    let within = Place { events: 2, stage: Some(0) };
    let walked = [(within, 0), (Place::after(3), 1), (Place::after(4), 2), (within, 0)];
    assert_eq!(places, walked.map(|(place, row)| (place, Some(row))));
    assert!(
        screen
            .said()
            .0
            .starts_with("from the last to the first: event 2, stage FC, buffer links: expected 0000")
    );
}

#[test]
fn what_was_not_compared_yet_is_compared_before_going_to_the_first_divergence() {
    let suite = Suite::new();
    suite.change(RUN, |text| text.replace("event 3 = click rejected miss", "event 3 = click applied"));
    let mut screen = suite.screen();
    screen.act(Action::NextDivergence);
    assert_eq!(screen.0.model.place, Place::after(4));
    screen.act(Action::NextDivergence);
    assert!(
        screen.said().0.starts_with("there is no other: event 3: expected click applied"),
        "{:?}",
        screen.said()
    );
}

#[test]
fn an_element_that_differs_is_selected_everywhere() {
    let suite = Suite::new();
    let planted = suite.text("planted.json");
    std::fs::write(&planted, crate::tui::tests::suite::SQUARE.replace("[60, 55]", "[60, 56]"))
        .expect("written");
    let mut screen = suite.screen();
    update::compare::with(screen.model(), &planted).expect("it is there");
    screen.0.settle();
    assert!(screen.said().0.starts_with(&format!("not as {planted}: ")), "{:?}", screen.said());
    let all = found(&screen);
    let row = all.rows.iter().position(|row| !all.ids(row).is_empty()).expect("elements are named");
    let (ids, len) = (all.ids(&all.rows[row]), all.rows.len());
    let at = place(&screen.0.model, row).expect("it has a place");
    screen.0.model.focus = Pane::Differences;
    screen.0.model.lists.differences.select(row, len);
    screen.act(Action::Select);
    assert_eq!((&screen.0.model.selected, screen.0.model.place), (&ids, at));
    assert!(ids.iter().all(|id| screen.0.model.is_selected(id)));
}

#[test]
fn another_runs_report_is_compared_with_both_values() {
    let suite = Suite::new();
    let other = other_run(&suite, |report| report["events"][2]["counters"]["links"] = 99.into());
    let mut screen = suite.screen();
    update::compare::with(screen.model(), &format!(" {other} ")).expect("it is there");
    screen.0.settle();
    let [Row::Value(value)] = found(&screen).rows.as_slice() else { panic!("{:?}", found(&screen).rows) };
    assert_eq!((value.what.as_str(), value.expected.as_str()), ("event 2 counter links", "99"));
    assert!(!found(&screen).verified);
    let same = other_run(&suite, |_| ());
    update::compare::with(screen.model(), &same).expect("it is there");
    screen.0.settle();
    assert_eq!(screen.said(), (format!("the same as {same}").as_str(), false));
    screen.act(Action::NextDivergence);
    assert_eq!(screen.said().0, format!("no event differs from {same}"));
}

#[test]
fn what_cannot_be_compared_is_told() {
    let suite = Suite::new();
    let mut screen = suite.screen();
    let error = update::compare::with(screen.model(), "no/where.json").expect_err("nothing is there");
    assert_eq!(error, "no/where.json: there is no such file");
    std::fs::write(suite.at("golden/gates.json"), "{").expect("written");
    screen.act(Action::Compare);
    let (said, wrong) = screen.said();
    assert!(wrong && said.starts_with("not compared: ") && said.contains("gates.json: "), "{said}");
    assert!(screen.0.model.differences.is_none() && screen.0.model.comparing.is_none());
    let mut nothing = Model::default();
    update::act(&mut nothing, Action::Compare);
    assert_eq!(nothing.message.map(|message| message.text), Some("nothing is open".into()));
    if let Some(opened) = &mut screen.0.model.opened {
        opened.path = None;
    }
    screen.act(Action::NextDivergence);
    assert!(screen.said().0.ends_with("save it first"), "{:?}", screen.said());
}

#[test]
fn a_golden_that_is_missing_is_a_problem_and_so_is_a_picture_that_is_another() {
    let suite = Suite::new();
    std::fs::remove_file(suite.at("golden/square/_run.bin")).expect("removed");
    std::fs::write(suite.at("golden/square/cut.png"), b"x").expect("written");
    let mut screen = compared(&suite);
    let rows = &found(&screen).rows;
    assert!(matches!(&rows[0], Row::Problem(problem) if problem.contains("cut.png: damaged")), "{rows:?}");
    assert!(matches!(&rows[1], Row::Problem(problem) if problem.ends_with("_run.bin: missing")), "{rows:?}");
    assert_eq!(screen.said(), ("not as the goldens: 2 problems", true));
    screen.act(Action::NextDivergence);
    assert_eq!(
        screen.said(),
        ("not as the goldens: 2 problems", true),
        "no event differs, but all is not well"
    );
}

#[test]
fn a_comparison_that_was_stopped_or_overtaken_is_not_shown() {
    let suite = Suite::new();
    let mut screen = suite.screen();
    update::act(screen.model(), Action::Compare);
    assert!(screen.0.model.comparing.is_some());
    update::act(screen.model(), Action::Cancel);
    assert_eq!((screen.said().0, screen.0.model.comparing.is_some()), ("not compared: stopped", false));
    screen.0.settle();
    assert!(screen.0.model.differences.is_none(), "it came too late");
}

#[test]
fn the_last_stage_of_an_event_is_its_end() {
    let mut screen = compared(&Suite::new());
    let stages = screen.0.model.report(2).expect("it ran").stages.clone();
    let ran: Vec<usize> = (0..stages.len()).filter(|row| stages[*row].skipped.is_none()).collect();
    for (row, stage) in stages.iter().enumerate() {
        let last = ran.last() == Some(&row) || stage.skipped.is_some();
        let expected = if last { Place::after(3) } else { Place { events: 2, stage: Some(row) } };
        assert_eq!(after_stage(&screen.0.model, 2, &stage.id), expected, "{}", stage.id);
    }
    screen.0.model.reports.clear();
    assert_eq!(
        after_stage(&screen.0.model, 2, &stages[0].id),
        Place::after(3),
        "what stages it has is not known"
    );
}

#[test]
fn an_element_is_a_word_with_a_number() {
    assert!(["n1", "f120", "gn7"].iter().all(|id| is_id(id)));
    assert!(["", "n", "7", "all", "n1a", "N1", "n-1", "n1..n3"].iter().all(|id| !is_id(id)));
}
