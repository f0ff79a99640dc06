//! Recording with the mouse: what was pointed at is cut, saved, and replays to the same digests; what was not saved is not lost.

use std::fs;
use std::path::Path;
use std::process::Command;

use serde_json::Value;

use crate::pty::{Area, Program};

const CTRL_S: &str = "\x13";
const ENTER: &str = "\r";

/// The program while it records on a scene, with a cut that was made by two clicks on the picture.
fn recorded(folder: &Path) -> Program {
    let mut program = Program::start(folder, &[], [120, 40]);
    program.expect("open a recording, or begin one");
    program.press("grid");
    program.expect("begin a new recording on builtin:grid");
    program.press(ENTER);
    // The panes lie where they stay once there is a picture in theirs.
    program.expect("picture frame");
    let Area { x, y, width, height } = program.pane("picture");
    program.click([x + width / 2 - 4, y + height / 2]);
    program.expect("a second point is waited for");
    program.click([x + width / 2 + 5, y + height / 2 + 1]);
    program.expect("click: done");
    program
}

/// The report of a recording that is replayed.
fn replayed(folder: &Path, recording: &str) -> Value {
    let mut command = Command::new(env!("CARGO_BIN_EXE_lancet"));
    command.args(["replay", recording, "--json", "-"]).current_dir(folder);
    let output = command.env("LANCET_CACHE_DIR", folder).output().expect("it runs");
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).expect("a report")
}

/// The kinds and outcomes of a report's events.
fn outcomes(report: &Value) -> Vec<(&str, &str)> {
    let events = report["events"].as_array().expect("events");
    events.iter().map(|event| (word(&event["kind"]), word(&event["outcome"]))).collect()
}

fn word(value: &Value) -> &str {
    value.as_str().expect("a word")
}

/// The drafts that there are.
fn drafts(folder: &Path) -> Vec<String> {
    let files = fs::read_dir(folder.join("drafts")).expect("drafts");
    let path = |file: fs::DirEntry| file.path().display().to_string();
    files.map(|file| path(file.expect("a draft"))).collect()
}

#[test]
fn a_cut_made_with_the_mouse_is_saved_and_replays_to_the_same_digests() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut program = recorded(folder.path());
    let drafts = drafts(folder.path());
    assert_eq!(drafts.len(), 1, "what is recorded is on the disk before it is saved: {drafts:?}");
    let as_recorded = replayed(folder.path(), &drafts[0]);
    program.press(CTRL_S);
    program.expect("save the recording");
    program.press("mine");
    program.press(ENTER);
    program.expect("saved as mine.lancet");
    program.press("q");
    assert!(program.left().0.success());

    let [once, again] = [(); 2].map(|()| replayed(folder.path(), "mine.lancet"));
    assert_eq!(outcomes(&once), [("click", "pending"), ("click", "applied")]);
    let digest = |report: &Value| word(&report["totals"]["digest"]).to_owned();
    assert_eq!(digest(&once), digest(&again));
    assert_eq!(digest(&once), digest(&as_recorded));
    assert!(self::drafts(folder.path()).is_empty(), "what is saved is no draft");
}

#[test]
fn what_was_not_saved_survives_a_closed_terminal() {
    let folder = tempfile::tempdir().expect("a folder");
    recorded(folder.path()).close();
    let mut program = Program::start(folder.path(), &[], [120, 40]);
    program.expect("a recording of before was not saved");
    // The draft comes before all that is new.
    program.press(ENTER);
    program.expect("0/2");
    program.expect("click");
    program.press("\x03");
    program.left();
}
