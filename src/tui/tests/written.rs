//! `lancet tui --screen`: where the screen is written, and how the program ends.

use std::fs;

use super::suite::{SQUARE, Suite, lancet};
use crate::cli::Status;

/// Writes the screen of something; the status and the complaint.
fn written(suite: &Suite, subject: &str, words: &[&str]) -> (Status, String) {
    let target = suite.text("screen.txt");
    let fixed = ["tui", subject, "--renderer", "reference", "--screen", &target];
    let (status, out, err) = lancet(&[&fixed, words].concat());
    assert_eq!(out, "");
    (status, err)
}

#[test]
fn it_ends_as_the_comparison_does() {
    let suite = Suite::new();
    let recording = suite.recording();
    let other = suite.text("other.json");
    fs::write(&other, SQUARE.replace("[60, 55]", "[61, 55]")).expect("written");
    let same = suite.text("square.json");
    for (words, status) in [
        (vec!["--compare"], Status::Verified),
        (vec!["--keys", "l ="], Status::Verified),
        (vec!["--compare-with", &same], Status::Verified),
        (vec!["--compare-with", &other], Status::Diverged),
        (vec!["--compare-with", &other, "--keys", "="], Status::Verified),
        (vec!["--compare-with", "nowhere.json"], Status::Failed),
        (vec!["--compare-with", &suite.text("recordings")], Status::Failed),
        (vec!["--keys", "+ x enter"], Status::Failed),
        (vec!["--keys", "r 4 enter ="], Status::Failed),
    ] {
        let (ended, err) = written(&suite, &recording, &words);
        assert_eq!(ended, status, "{words:?}: {err}");
        assert_eq!(err.is_empty(), status != Status::Failed, "{words:?}: {err}");
    }
    fs::remove_file(suite.at("golden/square/_run.bin")).expect("a golden");
    assert_eq!(written(&suite, &recording, &["--compare"]).0, Status::Diverged, "as `verify` ends");
}

#[test]
fn keys_that_are_none_are_told_before_anything_is_opened() {
    let suite = Suite::new();
    let (status, err) = written(&suite, "nowhere.lancet", &["--keys", "l nokey"]);
    assert_eq!(status, Status::Failed);
    assert!(err.contains("--keys: `nokey` is no key") && !err.contains("nowhere"), "{err}");
    assert!(!suite.at("screen.txt").exists());
}

#[test]
fn it_lies_where_every_other_answer_would() {
    let suite = Suite::new();
    let target = suite.text("new/folder/screen.svg");
    assert_eq!(
        lancet(&["tui", "builtin:grid", "--screen", &target, "--renderer", "reference"]).0,
        Status::Verified
    );
    assert!(fs::read_to_string(&target).expect("written").starts_with("<svg"));
    let script = suite.text("square.json");
    let (status, _, err) = lancet(&["tui", &script, "--screen", &script]);
    assert_eq!(status, Status::Failed);
    assert!(err.contains("its own input"), "{err}");
    assert_eq!(fs::read_to_string(&script).expect("as it was"), SQUARE);
}
