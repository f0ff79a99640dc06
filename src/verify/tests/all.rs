//! Everything that differs of one recording, and its pictures beside their goldens.

use super::pictures::{drawn, gpu, reference};
use super::*;
use crate::report::{Check, Counter, RunReport};
use crate::verify::image::tests::face;
use std::sync::Arc;

#[test]
fn every_difference_is_named_in_the_order_of_the_run() {
    let suite = Suite::new(&[("a", &cut())]).blessed();
    let mut text = suite.get("golden/a/_run.txt");
    for (from, to) in [
        ("end numbers = 6", "end numbers = 7"),
        ("event 4 = add rejected miss", "event 4 = add applied"),
        ("scene numbers = 6", "scene numbers = 5"),
        ("event 2 counter width = 3", "event 2 counter width = 4"),
    ] {
        assert!(text.contains(from), "{text}");
        text = text.replace(from, to);
    }
    suite.put("golden/a/_run.txt", text.as_bytes());
    let state = suite.get("golden/a/after.txt").replace("state numbers = 6", "state numbers = 9");
    suite.put("golden/a/after.txt", state.as_bytes());
    let report = suite.verify();
    let report = only(&report);
    let named: Vec<&str> = report.divergences.iter().map(|d| d.what.as_str()).collect();
    let at_the_checkpoint = "checkpoint after state numbers";
    assert_eq!(
        named,
        ["scene numbers", "event 2 counter width", at_the_checkpoint, "event 4", "end numbers"]
    );
    assert_eq!(report.differing, 5);
    assert_eq!(report.divergence.as_ref(), report.divergences.first());
    let second = &report.divergences[1];
    assert_eq!((second.event, second.expected.as_str(), second.found.as_str()), (Some(2), "4", "3"));
}

#[test]
fn each_difference_names_its_element() {
    let suite = Suite::new(&[("a", &cut())]).blessed();
    let plant = Some("0.AD:numbers:x2:1".parse().expect("a place"));
    let replay = Options { plant, ..Options::default() };
    let report = suite.verify_as(&VerifyOptions { replay, ..VerifyOptions::default() });
    let digests: Vec<&Divergence> =
        only(&report).divergences.iter().filter(|d| d.event.is_some() && d.stage.is_some()).collect();
    let events: Vec<Option<usize>> = digests.iter().map(|d| d.event).collect();
    assert!(events.contains(&Some(0)) && events.contains(&Some(2)), "it is still there at the next event");
    for divergence in digests {
        assert_eq!(divergence.element.as_deref(), Some("x2"), "{divergence}");
        assert!(divergence.found.ends_with("ulp)"), "{divergence}");
    }
}

#[test]
fn of_very_many_differences_the_first_are_named_and_all_are_counted() {
    let many = |value: f64| (0..600).map(|_| Add(1, value)).collect::<Vec<_>>();
    let suite = Suite::new(&[("a", &many(1.0))]).blessed();
    suite.record("a", &many(2.0));
    let report = suite.verify();
    let report = only(&report);
    assert!(report.differing > 1000, "{}", report.differing);
    assert_eq!(report.divergences.len(), 1000);
    assert_eq!(report.divergences[0].event, Some(0));
}

#[test]
fn a_report_without_a_difference_has_no_list() {
    let suite = Suite::new(&[("a", &cut())]).blessed();
    let json = serde_json::to_value(suite.verify()).expect("a report is JSON");
    assert_eq!(json["recordings"][0].get("divergences"), None);
}

fn recording(suite: &Suite) -> PathBuf {
    suite.at("recordings/wound/square-0.lancet")
}

fn compared(suite: &Suite, studio: &Arc<dyn Studio>) -> Compared {
    against_goldens(&recording(suite), &Options::default(), Some(studio.as_ref()), &unwatched)
        .expect("it is there")
}

#[test]
fn a_picture_comes_with_its_golden_and_its_measures() {
    let suite = drawn(1);
    let same = compared(&suite, &reference());
    assert_eq!((same.report.verdict, same.report.divergences.len()), (Verdict::Verified, 0));
    let [picture] = same.pictures.as_slice() else { panic!("one checkpoint") };
    assert_eq!((picture.checkpoint.as_str(), picture.event), ("cut", 3));
    assert_eq!((picture.golden.as_deref(), &*picture.actual), (Some(&face([128, 96])), &face([128, 96])));
    assert_eq!(picture.report.verdict, ImageVerdict::Equal);
    let holed = gpu(|mut image| {
        image.texels[128 * 50 + 60] = [0, 0, 0, 255];
        image
    });
    let other = compared(&suite, &holed);
    let picture = &other.pictures[0];
    assert_eq!((other.report.verdict, picture.report.verdict), (Verdict::Failed, ImageVerdict::Beyond));
    assert_eq!(other.report.images[0], picture.report);
    let shown = picture.difference.as_ref().expect("there is a golden");
    let seen: Vec<usize> = (0..shown.texels.len()).filter(|at| shown.texels[*at] != [0, 0, 0, 255]).collect();
    assert_eq!(seen, [128 * 50 + 60]);
}

#[test]
fn what_is_compared_is_what_verifying_says() {
    let suite = drawn(1);
    let text = suite.get("golden/wound/square-0/_run.txt");
    suite.put("golden/wound/square-0/_run.txt", text.replace("total cuts = 1", "total cuts = 2").as_bytes());
    let darker = gpu(|mut image| {
        image.texels.iter_mut().for_each(|texel| texel[0] = texel[0].saturating_sub(9));
        image
    });
    let (mut one, mut of_many) = (compared(&suite, &darker).report, suite.blob(&darker, None).report);
    (one.ms, of_many.recordings[0].ms) = (0.0, 0.0);
    one.skips.iter_mut().chain(&mut of_many.recordings[0].skips).for_each(|skips| skips.us = 0.0);
    assert_eq!(one, of_many.recordings[0]);
    assert_eq!(one.divergences[0].what, "total cuts");
}

#[test]
fn a_missing_golden_leaves_the_picture_alone() {
    let suite = drawn(1);
    std::fs::remove_file(suite.at("golden/wound/square-0/cut.png")).expect("removed");
    let compared = compared(&suite, &reference());
    let picture = &compared.pictures[0];
    assert_eq!((&picture.golden, &picture.difference), (&None, &None));
    assert_eq!(*picture.actual, face([128, 96]));
    assert!(compared.report.goldens[0].ends_with("cut.png: missing"));
}

#[test]
fn without_a_renderer_there_is_no_picture() {
    let suite = drawn(1);
    let compared =
        against_goldens(&recording(&suite), &Options::default(), None, &unwatched).expect("it is there");
    assert_eq!((compared.report.verdict, compared.pictures.len()), (Verdict::Verified, 0));
}

#[test]
fn what_cannot_be_compared_is_named() {
    let suite = drawn(1);
    suite.put("golden/gates.json", b"{");
    let why = |studio: Option<&dyn Studio>| {
        against_goldens(&recording(&suite), &Options::default(), studio, &unwatched).expect_err("it cannot")
    };
    assert!(why(Some(reference().as_ref())).contains("gates.json: "));
    suite.put("recordings/wound/square-0.lancet", b"garbage");
    assert!(why(None).contains("square-0.lancet: byte 0, "), "{}", why(None));
}

#[test]
fn a_run_is_compared_with_a_stored_one() {
    let suite = drawn(1);
    let mut run = Side::open(&recording(&suite), &unwatched).expect("it is there").run;
    let store = |run: &RunReport| {
        suite.put("stored.json", &serde_json::to_vec(run).expect("a report is JSON"));
        against_run(&recording(&suite), &suite.at("stored.json"), &unwatched).expect("both are there")
    };
    assert!(store(&run).is_empty());
    run.events[2].counters.insert("links".into(), Counter::Count(99));
    run.scene.insert("faces".into(), 7);
    let diff = store(&run);
    let named: Vec<&str> = diff.divergences.iter().map(|d| d.what.as_str()).collect();
    assert_eq!((named, diff.differing), (vec!["scene faces", "event 2 counter links"], 2));
    assert_eq!(diff.divergences[1].expected, "99");
    run.schema = 9;
    suite.put("stored.json", &serde_json::to_vec(&run).expect("a report is JSON"));
    let error =
        against_run(&recording(&suite), &suite.at("stored.json"), &unwatched).expect_err("another layout");
    assert!(error.ends_with("stored.json: a report of schema 9, not 1"), "{error}");
}

#[test]
fn an_invariant_that_only_one_run_broke_is_a_difference() {
    let suite = drawn(1);
    let side =
        || Side { recording: None, ..Side::open(&recording(&suite), &unwatched).expect("it is there") };
    let (whole, mut broken) = (side(), side());
    let stages = &mut broken.run.events[2].stages;
    stages[0].checks.push(Check::pass("only here"));
    let row = stages.iter_mut().find(|row| row.id == "MC").expect("it was merged");
    row.checks[0].ok = false;
    let name = row.checks[0].name.clone();
    let diff = diff(whole, broken);
    let [divergence] = diff.divergences.as_slice() else { panic!("{:?}", diff.divergences) };
    assert_eq!(divergence.what, format!("event 2 check MC.{name}"));
    assert_eq!((divergence.event, divergence.stage.as_deref()), (Some(2), Some("MC")));
    assert_eq!((divergence.expected.as_str(), divergence.found.as_str()), ("holds", "broken"));
    assert_eq!((diff.differing, diff.new.len()), (1, 0), "what one of them did not look at says nothing");
}

#[test]
fn whoever_watches_sees_it_run_and_can_stop_it() {
    let suite = drawn(1);
    let seen = std::cell::RefCell::new(Vec::new());
    let watch = |done, of| {
        seen.borrow_mut().push((done, of));
        done < 2
    };
    let error = against_goldens(&recording(&suite), &Options::default(), None, &watch).expect_err("stopped");
    assert_eq!(*seen.borrow(), [(0, 4), (1, 4), (2, 4)]);
    assert_eq!(error, "stopped before event 2 of 4");
    assert_eq!(against_run(&recording(&suite), &recording(&suite), &watch).expect_err("too"), error);
}
