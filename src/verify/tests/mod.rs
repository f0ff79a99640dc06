//! Whole suites of toy recordings, blessed and verified in a folder of their own.

use std::path::{Path, PathBuf};

mod all;
mod pictures;

use super::bless::bless_with;
use super::suite::verify_with;
use super::*;
use crate::assets::{self, CacheOptions, list_files, read_file, write_file};
use crate::canvas::Studio;
use crate::recording::{Script, to_bytes};
use crate::replay::toy::{Toy, ToyEvent, ToyState};
use crate::replay::{Options, Replay, Session};
use ToyEvent::{Add, Checkpoint, Click, Undo};

/// A folder with recordings and their goldens.
struct Suite(tempfile::TempDir);

fn open(path: &Path, options: Options, _: Option<&dyn Studio>) -> Result<Box<dyn Replay>, String> {
    let bytes = read_file(path).map_err(|e| e.to_string())?;
    let events: Vec<ToyEvent> = serde_json::from_slice(&bytes).map_err(|e| e.to_string())?;
    assert!(!matches!(events.first(), Some(Add(0, 666.0))), "a bug of ours");
    let keyed = events.into_iter().enumerate().map(|(i, e)| (i as u32, e)).collect();
    Ok(Box::new(Session::<Toy>::new(ToyState::new(6), keyed, 9, options)))
}

impl Suite {
    fn new(recordings: &[(&str, &[ToyEvent])]) -> Self {
        let suite = Self(tempfile::tempdir().expect("a folder"));
        recordings.iter().for_each(|(name, events)| suite.record(name, events));
        suite
    }

    fn record(&self, name: &str, events: &[ToyEvent]) {
        let bytes = serde_json::to_vec(events).expect("events are JSON");
        self.put(&format!("recordings/{name}.lancet"), &bytes);
    }

    fn put(&self, path: &str, bytes: &[u8]) {
        write_file(&self.at(path), bytes).expect("written");
    }

    fn get(&self, path: &str) -> String {
        String::from_utf8(read_file(&self.at(path)).expect("it is there")).expect("text")
    }

    fn at(&self, path: &str) -> PathBuf {
        self.0.path().join(path)
    }

    fn bless(&self, options: &BlessOptions) -> BlessReport {
        bless_with(&[self.at("recordings")], options, &(), &open)
    }

    fn blessed(self) -> Self {
        let report = self.bless(&because("a test"));
        assert_eq!(report.exit_code(), 0, "{report:?}");
        self
    }

    fn verify(&self) -> VerifyReport {
        self.verify_as(&VerifyOptions::default())
    }

    fn verify_as(&self, options: &VerifyOptions) -> VerifyReport {
        verify_with(&[self.at("recordings")], options, &(), &open).report
    }
}

fn because(reason: &str) -> BlessOptions {
    BlessOptions { reason: reason.into(), ..BlessOptions::default() }
}

fn cut() -> Vec<ToyEvent> {
    vec![Add(2, 3.5), Click(1), Click(3), Checkpoint("after".into()), Add(40, 1.0), Undo, Add(1, 2.0)]
}

fn only(report: &VerifyReport) -> &RecordingReport {
    assert_eq!(report.recordings.len(), 1);
    &report.recordings[0]
}

#[test]
fn what_was_blessed_verifies() {
    let suite = Suite::new(&[("wound/a", &cut()), ("b", &cut()[..2])]).blessed();
    let report = suite.verify();
    assert_eq!(report.exit_code(), 0, "{report:?}");
    let names: Vec<&str> = report.recordings.iter().map(|r| r.recording.as_str()).collect();
    assert_eq!(names, ["b", "wound/a"]);
    let a = &report.recordings[1];
    assert_eq!((a.verdict, a.events, a.cuts, a.applied, a.rejected), (Verdict::Verified, 7, 4, 4, 1));
    assert!(a.checks > 0);
    let files = list_files(&suite.at("golden")).expect("a folder");
    let names = ["b/_run.bin", "b/_run.txt", "wound/a/_run.bin", "wound/a/_run.txt", "wound/a/after.txt"];
    assert_eq!(files, names.map(|n| suite.at("golden").join(n)));
}

#[test]
fn a_planted_defect_is_named_to_the_element() {
    let suite = Suite::new(&[("a", &cut())]).blessed();
    let plant = Some("2.AD:numbers:x2:1".parse().expect("a place"));
    let replay = Options { plant, ..Options::default() };
    let report = suite.verify_as(&VerifyOptions { replay, ..VerifyOptions::default() });
    assert_eq!(report.exit_code(), 1);
    let divergence = only(&report).divergence.clone().expect("it is found");
    let seed = only(&report).divergence.as_ref().map(|d| (d.event, d.stage.as_deref(), d.buffer.as_deref()));
    assert_eq!(seed, Some((Some(2), Some("AD"), Some("numbers"))));
    assert_eq!(divergence.element.as_deref(), Some("x2"));
    let value = |text: &str| -> f64 {
        let number = text.trim_start_matches('(').split(')').next();
        number.and_then(|n| n.parse().ok()).expect("a number")
    };
    let (expected, found) = (value(&divergence.expected), value(&divergence.found));
    assert_eq!(found.to_bits() - expected.to_bits(), 1);
    assert!(divergence.found.ends_with("(1 ulp)"));
    assert!(divergence.to_string().starts_with("event 2, stage AD, buffer numbers, element x2: expected ("));
}

#[test]
fn a_defect_without_a_place_is_bad_input() {
    let suite = Suite::new(&[("a", &cut())]).blessed();
    for nowhere in ["2.AD:numbers:99:1", "2.AD:letters:1:1", "1.AD:numbers:1:1", "2.ZZ:numbers:1:1"] {
        let replay = Options { plant: Some(nowhere.parse().expect("a place")), ..Options::default() };
        let report = suite.verify_as(&VerifyOptions { replay, ..VerifyOptions::default() });
        assert_eq!(report.exit_code(), 2, "{nowhere}");
        assert!(only(&report).error.as_deref().is_some_and(|e| e.starts_with("nothing to plant")));
    }
}

#[test]
fn goldens_are_never_written_by_verifying() {
    let suite = Suite::new(&[("a", &cut())]);
    let report = suite.verify();
    assert_eq!(report.exit_code(), 1);
    assert!(only(&report).goldens.iter().any(|g| g.ends_with("_run.txt: missing")));
    assert!(list_files(&suite.at("golden")).expect("none").is_empty());
}

#[test]
fn every_missing_or_damaged_golden_is_a_failure() {
    for name in ["_run.txt", "_run.bin", "after.txt"] {
        let suite = Suite::new(&[("a", &cut())]).blessed();
        let file = suite.at("golden/a").join(name);
        let bytes = read_file(&file).expect("it is there");
        write_file(&file, &bytes[..bytes.len() - 3]).expect("written");
        let report = suite.verify();
        assert_eq!(report.exit_code(), 1);
        assert!(only(&report).goldens[0].contains(&format!("{name}: damaged: ")), "{report:?}");
        std::fs::remove_file(&file).expect("removed");
        assert!(only(&suite.verify()).goldens[0].ends_with(&format!("{name}: missing")));
    }
}

#[test]
fn orphans_are_a_failure_and_are_listed() {
    let suite = Suite::new(&[("a", &cut())]).blessed();
    suite.put("golden/a/before.txt", b"?");
    suite.put("golden/gone/_run.txt", b"?");
    let report = suite.verify();
    assert_eq!(report.exit_code(), 1);
    assert!(only(&report).goldens[0].contains("before.txt: orphaned"));
    assert!(report.orphans.len() == 1 && report.orphans[0].contains("gone"));
    let blessed = suite.bless(&because("again"));
    assert_eq!((blessed.recordings[0].change, blessed.orphans.len()), (Change::Same, 1));
    assert!(suite.at("golden/gone/_run.txt").exists());
}

#[test]
fn the_first_difference_in_the_order_of_the_run_is_named() {
    let suite = Suite::new(&[("a", &cut())]).blessed();
    let text = suite.get("golden/a/_run.txt");
    let tamper = |from: &str, to: &str| {
        assert!(text.contains(from), "{text}");
        suite.put("golden/a/_run.txt", text.replace(from, to).as_bytes());
        let report = suite.verify();
        let d = only(&report).divergence.clone().expect("it differs");
        (d.what, d.expected, d.found)
    };
    let three = |a: &str, b: &str, c: &str| (a.to_string(), b.to_string(), c.to_string());
    assert_eq!(
        tamper("event 4 = add rejected miss", "event 4 = add applied"),
        three("event 4", "add applied", "add rejected miss")
    );
    assert_eq!(
        tamper("event 2 counter width = 3", "event 2 counter width = 4"),
        three("event 2 counter width", "4", "3")
    );
    assert_eq!(tamper("end numbers = 6", "end numbers = 7"), three("end numbers", "7", "6"));
    assert_eq!(tamper("scene numbers = 6", "scene numbers = 5"), three("scene numbers", "5", "6"));
    suite.put("golden/a/_run.txt", text.as_bytes());
    suite.put(
        "golden/a/after.txt",
        suite.get("golden/a/after.txt").replace("state numbers = 6", "state numbers = 9").as_bytes(),
    );
    let report = suite.verify();
    let divergence = only(&report).divergence.as_ref().expect("it differs");
    assert_eq!((divergence.event, divergence.what.as_str()), (Some(3), "checkpoint after state numbers"));
}

#[test]
fn what_a_golden_does_not_know_is_new_and_hides_nothing() {
    let suite = Suite::new(&[("a", &cut())]).blessed();
    let text = suite.get("golden/a/_run.txt");
    // As if HV had been added to the engine after the blessing.
    let without: Vec<&str> = text.lines().filter(|line| !line.contains("digest HV.")).collect();
    let dropped = text.lines().count() - without.len();
    let facts: usize =
        text.lines().last().and_then(|l| l.strip_prefix("facts = ")?.parse().ok()).expect("a count");
    let older =
        without.join("\n").replace(&format!("facts = {facts}"), &format!("facts = {}", facts - dropped));
    suite.put("golden/a/_run.txt", older.as_bytes());
    let report = suite.verify();
    assert_eq!(
        (report.exit_code(), only(&report).new.as_slice()),
        (1, ["digest HV.numbers".to_string()].as_slice())
    );
    assert_eq!(only(&report).divergence, None);
    suite.put("golden/a/_run.txt", older.replace("width = 3", "width = 8").as_bytes());
    let report = suite.verify();
    assert_eq!((only(&report).new.len(), only(&report).differing), (1, 1));
}

#[test]
fn an_unreadable_recording_does_not_stop_the_others() {
    let suite = Suite::new(&[("a", &cut()), ("c", &cut())]).blessed();
    suite.put("recordings/b.lancet", b"garbage");
    suite.put("recordings/notes.txt", b"no recording");
    let report = suite.verify();
    assert_eq!(report.exit_code(), 2);
    let verdicts: Vec<Verdict> = report.recordings.iter().map(|r| r.verdict).collect();
    assert_eq!(verdicts, [Verdict::Verified, Verdict::Unreadable, Verdict::Verified]);
}

#[test]
fn a_bug_of_ours_fails_its_recording_alone() {
    let suite = Suite::new(&[("a", &cut())]).blessed();
    suite.record("b", &[Add(0, 666.0)]);
    let report = suite.verify();
    assert_eq!(report.exit_code(), 1);
    assert_eq!(report.recordings[1].error.as_deref(), Some("panicked: a bug of ours"));
}

#[test]
fn a_broken_invariant_fails_and_is_not_blessed() {
    let suite = Suite::new(&[("a", &[Add(1, -90.0)])]);
    let blessed = suite.bless(&because("why not"));
    assert_eq!((blessed.exit_code(), blessed.recordings[0].change), (2, Change::Refused));
    assert!(list_files(&suite.at("golden")).expect("none").is_empty());
    let report = suite.verify();
    assert_eq!(report.exit_code(), 1);
    assert_eq!(only(&report).findings[0].name(), "AD/sum");
    assert!(only(&report).problems()[0].starts_with("event 0: AD/sum broke: "));
}

#[test]
fn blessing_says_what_changed_and_keeps_what_did_not() {
    let suite = Suite::new(&[("a", &cut()), ("b", &cut())]).blessed();
    suite.record("b", &[Add(2, 3.5), Add(2, 1.0)]);
    let dry = suite.bless(&BlessOptions { dry_run: true, ..because("another") });
    let changes: Vec<Change> = dry.recordings.iter().map(|r| r.change).collect();
    assert_eq!(changes, [Change::Same, Change::Changed]);
    assert!(dry.recordings[1].differing > 3 && dry.recordings[1].divergence.is_some());
    assert_eq!(suite.verify().exit_code(), 1, "a dry run writes nothing");
    assert_eq!(suite.bless(&because("another")).exit_code(), 0);
    assert!(suite.get("golden/a/_run.txt").contains("reason = a test\n"));
    assert!(suite.get("golden/b/_run.txt").contains("reason = another\n"));
    let orphan = &suite.verify().recordings[1].goldens;
    assert!(orphan.len() == 1 && orphan[0].contains("after.txt: orphaned"));
}

#[test]
fn a_blessing_needs_a_reason() {
    let suite = Suite::new(&[("a", &cut())]);
    assert_eq!(suite.bless(&because(" \n")).exit_code(), 2);
    assert!(list_files(&suite.at("golden")).expect("none").is_empty());
}

#[test]
fn the_report_does_not_depend_on_the_threads() {
    let names = ["a", "b", "c", "d", "e", "f"];
    let all: Vec<(&str, Vec<ToyEvent>)> = names.iter().map(|n| (*n, cut())).collect();
    let all: Vec<(&str, &[ToyEvent])> = all.iter().map(|(n, e)| (*n, e.as_slice())).collect();
    let suite = Suite::new(&all).blessed();
    suite.record("d", &cut()[..3]);
    let report = |jobs, fail_fast| {
        let mut report = suite.verify_as(&VerifyOptions { jobs, fail_fast, ..VerifyOptions::default() });
        report.ms = 0.0;
        report.recordings.iter_mut().for_each(|r| r.ms = 0.0);
        report
    };
    assert_eq!(report(4, false), report(1, false));
    assert_eq!(report(4, true), report(1, true));
    let fast = report(4, true);
    assert_eq!((fast.recordings.len(), fast.left_out, fast.exit_code()), (4, 2, 1));
}

#[test]
fn a_filter_picks_by_name() {
    let suite = Suite::new(&[("wound/a", &cut()), ("cubes/b", &cut())]).blessed();
    let filtered = |word: &str| {
        suite.verify_as(&VerifyOptions { filter: Some(word.into()), ..VerifyOptions::default() })
    };
    assert_eq!(
        (only(&filtered("wound/")).recording.as_str(), filtered("wound/").exit_code()),
        ("wound/a", 0)
    );
    assert_eq!(filtered("nothing-like-it").exit_code(), 2);
    let nowhere = verify_with(&[suite.at("recordings/none")], &VerifyOptions::default(), &(), &open).report;
    assert_eq!(nowhere.exit_code(), 2);
}

#[test]
fn a_failure_goes_by_the_name_of_its_invariant() {
    let replay = |events: Vec<ToyEvent>| -> Box<dyn Replay> {
        let keyed = events.into_iter().enumerate().map(|(i, e)| (i as u32, e)).collect();
        Box::new(Session::<Toy>::new(ToyState::new(6), keyed, 9, Options::default()))
    };
    assert_eq!(failure(replay(cut())), None);
    assert_eq!(failure(replay(vec![Add(1, 1.0), Add(1, -90.0)])), Some("AD/sum".into()));
    assert_eq!(failure(replay(vec![Click(6), Click(8)])), None);
}

/// Two triangles of a square, cut from pixel to pixel.
const SQUARE: &str = r#"{ "version": 1, "viewport": [100, 100], "seed": 3,
    "scene": { "inline": { "nodes": [[0, 0, 0], [4, 0, 0], [4, 4, 0], [0, 4, 0]], "faces": [[0, 1, 2], [0, 2, 3]] } },
    "events": [ { "mode": "merge" }, { "click": [45, 40] }, { "click": [60, 55] }, { "checkpoint": "cut" } ] }"#;

/// A script, packed.
fn packed(script: &str) -> Vec<u8> {
    let mut recording = Script::parse(script.as_bytes()).expect("a script").unhashed().clone();
    let scene = assets::open(recording.scene(), Path::new(""), &CacheOptions::off()).expect("a scene");
    recording.set_hashes([scene.scene_hash, scene.mesh_hash]);
    to_bytes(&recording).expect("it has a form")
}

#[test]
fn a_corrupted_node_of_a_real_cut_is_named() {
    let suite = Suite::new(&[]);
    suite.put("recordings/square.lancet", &packed(SQUARE));
    let paths = [suite.at("recordings")];
    assert_eq!(bless(&paths, &because("a test"), &()).exit_code(), 0);
    let report = verify(&paths, &VerifyOptions::default(), &());
    assert_eq!(report.exit_code(), 0, "{report:?}");
    let replay = Options { plant: Some("2.MC:nodes:n5:2".parse().expect("a place")), ..Options::default() };
    let report = verify(&paths, &VerifyOptions { replay, ..VerifyOptions::default() }, &());
    assert_eq!(report.exit_code(), 1);
    let text = only(&report).divergence.as_ref().expect("it is found").to_string();
    assert!(text.starts_with("event 2, stage MC, buffer nodes, element n5: expected ("), "{text}");
    assert!(text.ends_with("(2 ulp)"), "{text}");
}
