//! Actions and commands, held together: what the screen can do there is a command for, which takes what is filled in and gives the same data.

use std::collections::BTreeMap;

use serde_json::Value;

use super::*;
use crate::cli::{Status, flags, parses};
use crate::report::{EventReport, RunReport};
use crate::tui::action::ACTIONS;
use crate::tui::shot::Drawn;
use crate::tui::tests::suite::{Screen, Suite, lancet};
use crate::tui::{key::Key, update};
use crate::verify::{Diff, VerifyReport};

/// Actions that only move about on the screen, by why they do.
const SCREEN_ONLY: &[(&str, &[&str])] = &[
    ("how fast it is looked at", &["faster", "slower"]),
    ("what goes on, or lies over the panes", &["cancel", "help", "palette"]),
    ("which row is chosen", &["up", "down", "page-up", "page-down", "top", "bottom", "select-nothing"]),
    ("which match of a search is looked at", &["next-match", "previous-match"]),
    (
        "which pane is looked at",
        &[
            "focus-next",
            "focus-previous",
            "focus-timeline",
            "focus-stages",
            "focus-mesh",
            "focus-picture",
            "focus-tables",
            "focus-checks",
            "focus-differences",
            "maximise",
        ],
    ),
    (
        "which part of a picture is looked at: a picture in a file is whole",
        &["zoom-in", "zoom-out", "pan-left", "pan-right", "pan-up", "pan-down", "split-left", "split-right"],
    ),
    (
        "where the next point is made, which is in the script once it is",
        &[
            "cross-left",
            "cross-right",
            "cross-up",
            "cross-down",
            "nudge-left",
            "nudge-right",
            "nudge-up",
            "nudge-down",
        ],
    ),
    ("the program itself", &["suspend", "redraw", "quit", "leave"]),
];

/// Flags that show something and that no action has, by why.
const NO_ACTION: &[(&str, &[&str], &str)] = &[
    ("replay", &["repeat"], "the pane of stages has the median and the spread over the run"),
    ("replay", &["trace"], "a file for other programs; the times in it are in the pane of stages"),
    ("replay", &["export-mesh"], "a file for other programs; what it is made of is in the pane of the mesh"),
    ("replay", &["renderer", "no-skip"], "chosen when the screen is started; the answer is the same"),
    ("verify", &["renderer", "no-skip"], "chosen when the screen is started; the answer is the same"),
    (
        "verify",
        &["filter", "shard", "jobs", "fail-fast", "blob", "junit"],
        "for many recordings; the screen has one",
    ),
    ("verify", &["paranoid"], "the whole state is looked at where one stands, by `check`"),
    ("verify", &["plant"], "it spoils a run, to see that this is found"),
];

fn screen_only(row: &Row) -> bool {
    SCREEN_ONLY.iter().any(|(_, names)| names.contains(&row.name))
}

/// A screen with everything on it that a command can have filled in, at a place.
fn full(suite: &Suite, place: Place) -> Screen {
    let mut screen = suite.screen();
    update::go(screen.model(), place);
    let model = screen.model();
    model.stops = vec!["rejected=miss".parse().expect("a stop"), "MC>100000".parse().expect("a stop")];
    model.selected = vec!["f0".into(), "n1".into()];
    model.picture.drawn = Drawn { wire: true, lines: true, tint: Tint::Charts, ..Drawn::default() };
    screen.0.settle();
    let model = screen.model();
    model.picture.orbit = model.orbit().map(|orbit| crate::canvas::frame::Orbit { azimuth: -0.5, ..orbit });
    screen.0.settle();
    screen
}

/// The places of a run that are different for a command.
fn places() -> [Place; 4] {
    [Place::START, Place { events: 2, stage: Some(0) }, Place::after(3), Place::after(6)]
}

fn run(words: &[String]) -> (Status, String, String) {
    let words: Vec<&str> = words[1..].iter().map(String::as_str).collect();
    lancet(&words)
}

fn json<T: serde::de::DeserializeOwned>(words: &[String]) -> T {
    let (_, out, err) = run(words);
    serde_json::from_str(&out).unwrap_or_else(|error| panic!("{words:?}: {error}: {out} {err}"))
}

#[test]
fn every_action_has_a_command_that_the_parser_takes_or_only_moves_about() {
    let suite = Suite::new();
    for place in places() {
        let screen = full(&suite, place);
        for row in ACTIONS {
            let Some(template) = row.command else {
                assert!(screen_only(row), "{} has no command", row.name);
                continue;
            };
            assert!(!screen_only(row), "{} has one", row.name);
            let words = words(&screen.0.model, template);
            parses(&words).unwrap_or_else(|error| panic!("{}: {words:?}: {error}", row.name));
            assert!(of(&screen.0.model, row).is_some_and(|line| !line.contains(['{', '}'])), "{}", row.name);
        }
    }
    let names = SCREEN_ONLY.iter().flat_map(|(_, names)| names.iter());
    let unknown: Vec<_> = names.filter(|name| ACTIONS.iter().all(|row| row.name != **name)).collect();
    assert!(unknown.is_empty(), "{unknown:?}");
}

#[test]
fn every_flag_that_shows_something_is_an_actions_or_has_a_reason_not_to_be() {
    let suite = Suite::new();
    let mut screen = full(&suite, Place::after(3));
    let mut used: BTreeMap<String, Vec<String>> = BTreeMap::new();
    let mut note = |model: &Model| {
        for words in ACTIONS.iter().filter_map(|row| row.command).map(|template| words(model, template)) {
            let flags = words.iter().filter_map(|word| word.strip_prefix("--")).map(str::to_owned);
            used.entry(words[1].clone()).or_default().extend(flags);
        }
    };
    note(screen.model());
    screen.model().picture.subject = Subject::Map(MapId::Discolor);
    note(screen.model());
    update::compare::with(screen.model(), &suite.recording()).expect("it is there");
    screen.0.settle();
    note(screen.model());
    for command in ["replay", "verify", "diff"] {
        for flag in flags(command) {
            let has = used.get(command).is_some_and(|flags| flags.contains(&flag));
            let mut listed =
                NO_ACTION.iter().filter(|(of, flags, _)| *of == command && flags.contains(&flag.as_str()));
            assert_eq!(has, listed.next().is_none(), "lancet {command} --{flag}");
        }
    }
    for (command, listed, why) in NO_ACTION {
        assert!(
            listed.iter().all(|flag| flags(command).iter().any(|other| other == flag)),
            "{command}: {why}"
        );
    }
}

#[test]
fn a_place_of_the_screen_is_the_same_in_the_commands_report() {
    let suite = Suite::new();
    let mut screen = suite.screen();
    for place in (0..=6).map(Place::after).chain((0..2).map(|row| Place { events: 2, stage: Some(row) })) {
        update::go(screen.model(), place);
        screen.0.settle();
        let model = screen.model();
        assert_eq!(model.here().map(|standing| standing.place), Some(place));
        let report: RunReport = json(&words(model, "replay {rec} --until {place} --pixels --json -"));
        let last = report.events.last();
        assert_eq!(last.map(|event| event.index), place.event());
        let standing = model.here().expect("it stands there");
        // What ran whole is what the panes show; of what is held they show as far as it ran.
        let here = standing.within.as_deref().or_else(|| model.shown());
        assert_eq!(last.map(EventReport::without_times), here.map(EventReport::without_times), "{place:?}");
        let ran = last.into_iter().flat_map(|event| &event.stages).filter(|stage| stage.skipped.is_none());
        assert!(ran.clone().all(|stage| stage.us > 0.0), "a stage that ran has its time");
        let whole = report.events.iter().zip(&model.reports).take(place.events);
        assert!(whole.clone().all(|(a, b)| a.without_times() == b.without_times()));
        for (name, size) in &standing.sizes {
            let told = last.and_then(|event| event.sizes.get(*name)).map(|[_, after]| *after);
            let told = told.or_else(|| report.scene.get(*name).map(|count| *count as u64));
            assert_eq!(told, Some(*size), "{name} at {place:?}");
        }
    }
    let report: RunReport = json(&words(screen.model(), Action::Play.row().command.expect("it has one")));
    assert_eq!(report.end, screen.model().end);
    let tables = report.events.iter().map(|event| event.tables.len()).sum::<usize>();
    let overlays = report.events.iter().map(|event| event.overlays.len()).sum::<usize>();
    assert!(tables > 0 && overlays > 0 && report.checks() > 0, "there is something to show");
}

#[test]
fn the_first_broken_invariant_and_the_breakpoints_are_where_the_command_stops() {
    let suite = Suite::new();
    let mut screen = suite.screen();
    screen.model().stops = vec!["rejected".parse().expect("a stop")];
    update::go(screen.model(), Place::START);
    screen.0.settle();
    screen.act(Action::RunOn);
    let report: RunReport = json(&words(screen.model(), Action::RunOn.row().command.expect("it has one")));
    assert_eq!(Place::after(report.events.len()), screen.model().place);
    let report: RunReport =
        json(&words(screen.model(), Action::FirstFinding.row().command.expect("it has one")));
    assert_eq!((report.findings().next(), report.events.len()), (screen.model().finding.clone(), 6));
}

#[test]
fn the_invariants_of_the_whole_state_are_in_the_commands_report() {
    let suite = Suite::new();
    let mut screen = suite.screen();
    update::go(screen.model(), Place::after(3));
    screen.0.settle();
    screen.act(Action::Check);
    let report: RunReport = json(&words(screen.model(), Action::Check.row().command.expect("it has one")));
    let (_, state) = screen.model().checked.clone().expect("it was looked at");
    let last = report.events.last().expect("there is one");
    assert_eq!((&last.checks, last.state.as_ref()), (&state.checks, Some(&state.digest)));
    assert_eq!(last.counts, state.counts);
}

#[test]
fn what_differs_is_in_the_commands_report() {
    let suite = Suite::new();
    suite.change("golden/square/_run.txt", |text| text.replace("total cuts = 1", "total cuts = 2"));
    let mut screen = suite.screen();
    screen.act(Action::Compare);
    let template = Action::NextDivergence.row().command.expect("it has one");
    let report: VerifyReport = json(&words(screen.model(), &format!("{template} --renderer reference")));
    let (rows, pictures) = shown_rows(screen.model());
    assert_eq!(rows, report.recordings[0].divergences);
    assert_eq!(pictures, report.recordings[0].images);
    let (_, out, _) = lancet(&["replay", &suite.recording(), "--json", "-"]);
    let mut other: Value = serde_json::from_str(&out).expect("JSON");
    other["events"][2]["counters"]["links"] = 99.into();
    std::fs::write(suite.at("other.json"), other.to_string()).expect("written");
    update::compare::with(screen.model(), &suite.text("other.json")).expect("it is there");
    screen.0.settle();
    let diff: Diff = json(&words(screen.model(), template));
    assert_eq!((shown_rows(screen.model()).0, diff.divergences.len()), (diff.divergences, 1));
}

fn shown_rows(model: &Model) -> (Vec<crate::verify::Divergence>, Vec<crate::verify::ImageReport>) {
    let differences = model.differences.as_ref().expect("it was compared");
    let value = |row: &crate::tui::compare::Row| match row {
        crate::tui::compare::Row::Value(value) => Some(value.clone()),
        _ => None,
    };
    let pictures = differences.pictures.iter().map(|picture| picture.report.clone());
    (differences.rows.iter().filter_map(value).collect(), pictures.collect())
}

#[test]
fn the_copied_command_draws_what_the_screen_draws() {
    let suite = Suite::new();
    for place in places() {
        let mut screen = full(&suite, place);
        for subject in [Subject::Frame, Subject::Map(MapId::Discolor)] {
            screen.model().picture.subject = subject;
            screen.0.settle();
            let at = suite.text("shown.png");
            let words =
                words(screen.model(), "replay {rec} --until {place} --renderer reference {shown} --frame");
            let (status, _, err) = run(&[words, vec![at.clone()]].concat());
            assert_eq!(status, Status::Verified, "{err}");
            // What is saved is as large as what was recorded, which a command's is too; the screen's own is as large as it can show.
            let saved = suite.text("saved.png");
            update::picture::save(screen.model(), &saved).expect("a file");
            screen.0.settle();
            let [file, own] = [&at, &saved].map(|file| std::fs::read(file).expect("written"));
            assert!(file == own, "{place:?} {subject:?}");
            std::fs::remove_file(&saved).expect("it is there");
        }
    }
}

#[test]
fn the_command_for_the_screen_is_copied_quoted_for_a_shell() {
    let suite = Suite::new();
    let own = suite.at("it's one");
    std::fs::create_dir(&own).expect("made");
    std::fs::copy(suite.recording(), own.join("my cut.lancet")).expect("copied");
    let mut screen = suite.screen();
    let path = own.join("my cut.lancet");
    screen.open(path.to_str().expect("a plain path"));
    update::go(screen.model(), Place { events: 2, stage: Some(0) });
    screen.model().selected = vec!["f0".into()];
    screen.0.settle();
    screen.act(Action::CopyCommand);
    let quoted = path.to_str().expect("a plain path").replace('\'', r"'\''");
    let expected =
        format!("lancet replay '{quoted}' --until 2.FC --json - --frame 'my cut-2.FC.png' --select f0");
    assert_eq!(screen.0.copied(), [expected]);
    screen.act(Action::Compare);
    screen.model().focus = Pane::Differences;
    screen.act(Action::CopyCommand);
    assert_eq!(screen.0.copied()[1], format!("lancet verify '{quoted}' --json -"));
    screen.model().kept.unsaved = true;
    screen.act(Action::CopyCommand);
    assert_eq!(
        screen.said(),
        ("there is no command for this: what is open is in no file: save it first", true)
    );
    assert!("Y".parse::<Key>().is_ok_and(|_| Action::CopyCommand.row().keys == ["Y"]));
}

#[test]
fn a_path_that_looks_like_a_flag_is_none() {
    assert_eq!((argument("-x.json"), argument("a/-x")), ("./-x.json".into(), "a/-x".into()));
    assert_eq!(quoted(""), "''");
    assert_eq!(quoted("MC>0.5"), "'MC>0.5'");
    assert_eq!(quoted("a/b-c.lancet"), "a/b-c.lancet");
}
