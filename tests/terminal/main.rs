//! `lancet tui` in a real pseudo-terminal: what a user types and sees, and a terminal that is as it was when he is back.
#![cfg(all(unix, feature = "tui"))]

mod pty;
mod record;

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Instant;

use pty::Program;

/// A recording of a square that is cut once, then missed.
const SQUARE: &str = r#"{ "version": 1, "viewport": [100, 100], "seed": 3,
    "scene": { "inline": { "nodes": [[0, 0, 0], [4, 0, 0], [4, 4, 0], [0, 4, 0]], "faces": [[0, 1, 2], [0, 2, 3]] } },
    "events": [ { "mode": "merge" }, { "click": [45, 40] }, { "click": [60, 55] }, { "click": [0.5, 0.5] },
                { "checkpoint": "end" } ] }"#;

const CTRL_C: &str = "\x03";
const CTRL_L: &str = "\x0c";
const CTRL_Z: &str = "\x1a";
const RIGHT: &str = "\x1b[C";
const ESC: &str = "\x1b";

/// A folder with the square in it.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("square.json"), SQUARE).expect("written");
    folder
}

/// The program with the square open.
fn opened(folder: &Path, size: [u16; 2]) -> Program {
    let program = Program::start(folder, &["square.json"], size);
    program.expect("0/5");
    program
}

/// It was set aside as if there were none, and so were the settings that its user believed in.
#[test]
fn a_folder_in_the_place_of_the_settings_is_told() {
    let folder = folder();
    fs::create_dir_all(folder.path().join("lancet/config.toml")).expect("made");
    let mut lancet = Command::new(env!("CARGO_BIN_EXE_lancet"));
    let lancet = lancet.args(["tui", "--screen", "-", "square.json"]).current_dir(folder.path());
    let output = lancet.env("XDG_CONFIG_HOME", folder.path()).output().expect("it runs");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.code() == Some(2) && said.contains("config.toml: "), "{said}");
}

#[test]
fn it_starts_steps_and_follows_the_terminals_size() {
    let folder = folder();
    let mut program = Program::start(folder.path(), &["square.json"], [120, 40]);
    program.until("a frame", |screen| screen.alternate_screen() && screen.contents().contains("lancet"));
    let frame = program.started.elapsed();
    program.expect("0/5");
    let open = program.started.elapsed();
    eprintln!("first frame after {} ms, the recording after {} ms", frame.as_millis(), open.as_millis());
    program.press("l");
    program.expect("1/5");
    program.press("ll");
    program.expect("3/5");
    program.press(&RIGHT.repeat(9));
    program.until("the end, and what became of it", |screen| {
        ["5/5", "0.5 miss"].iter().all(|text| screen.contents().contains(text))
    });
    for size in [[80, 24], [40, 12], [1, 1], [200, 60]] {
        program.resize(size);
        program.press(if size == [1, 1] { "h" } else { CTRL_L });
    }
    program.until("the wide screen", |screen| {
        let rows: Vec<String> = screen.rows(0, 200).collect();
        // The title and the status line are at the edges of the screen as it is now.
        rows[0].contains("4/5") && rows[59].contains("help") && rows[1].contains("picture")
    });
    program.press("q");
    let (status, _) = program.left();
    assert!(status.success(), "{status}");
}

#[test]
fn what_is_typed_while_a_recording_is_opened_is_not_lost() {
    let folder = folder();
    let mut program = Program::start(folder.path(), &["square.json"], [120, 40]);
    // Typed before even the first frame is there.
    program.press("lll\x0e");
    let screen = program.expect("record on a scene");
    assert!(screen.contains("3/5"), "{screen}");
    // The bust takes its time.
    program.press("builtin:bust\ree");
    program.until("a recording that is begun on the bust", |screen| {
        ["lancet new recording", "merge"].iter().all(|text| screen.contents().contains(text))
    });
    program.press(CTRL_C);
    program.left();
}

#[test]
fn two_hundred_cuts_are_walked_key_by_key() {
    let folder = folder();
    let cuts = concat!(env!("CARGO_MANIFEST_DIR"), "/recordings/wound/two-hundred-cuts.lancet");
    fs::copy(cuts, folder.path().join("cuts.lancet")).expect("copied");
    let mut program = Program::start(folder.path(), &["cuts.lancet"], [120, 40]);
    let title = program.expect(" 0/").lines().next().expect("a title").to_owned();
    let count = title.split("0/").nth(1).and_then(|rest| rest.split(' ').next()).expect("a number");
    let count: usize = count.parse().expect("a number");
    program.press("\x1b[F");
    program.expect(&format!("{count}/{count}"));
    let mut waits: Vec<u128> = (1..=40)
        .map(|back| {
            let begin = Instant::now();
            program.press("h");
            program.expect(&format!("{}/{count}", count - back));
            begin.elapsed().as_millis()
        })
        .collect();
    waits.sort_unstable();
    eprintln!("{count} events: a key is answered after {} ms, {} ms at most", waits[20], waits[39]);
    program.press("q");
    program.left();
}

#[test]
fn help_lies_over_the_panes_until_it_is_closed() {
    let folder = folder();
    let mut program = opened(folder.path(), [120, 40]);
    program.press("?");
    let help = program.expect("Step one event on");
    assert!(help.contains("Step one event back"), "{help}");
    program.press(ESC);
    program.until("the panes", |screen| !screen.contents().contains("Step one event on"));
    program.press("q");
    program.left();
}

#[test]
fn the_terminal_is_given_back_however_it_is_left() {
    for way in ["q", CTRL_C, "TERM", "HUP", "INT"] {
        let folder = folder();
        let mut program = opened(folder.path(), [80, 24]);
        match way.len() {
            1 => program.press(way),
            _ => program.signal(way),
        }
        let (status, after) = program.left();
        assert!(status.success(), "{way:?}: {status}");
        assert_eq!(after.trim(), "", "{way:?} leaves something behind");
    }
}

#[test]
fn it_comes_back_from_the_background() {
    let folder = folder();
    let mut program = opened(folder.path(), [80, 24]);
    // No shell looks after it here, so that it goes on at once.
    program.press(CTRL_Z);
    program.until_written(b"\x1b[?1049l", 1);
    program.until_written(b"\x1b[?1049h", 2);
    program.expect("0/5");
    program.press("lq");
    program.left();
}

#[test]
fn a_closed_terminal_ends_it() {
    let folder = folder();
    let status = opened(folder.path(), [80, 24]).close();
    assert!(status.signal().is_none(), "{status}: it ends in order");
}

#[test]
fn a_recording_that_cannot_be_read_is_told_in_its_place() {
    let folder = folder();
    fs::write(folder.path().join("broken.lancet"), "no recording").expect("written");
    for (file, why) in [("missing.lancet", "No such file"), ("broken.lancet", "broken.lancet: ")] {
        let mut program = Program::start(folder.path(), &[file], [120, 40]);
        let screen = program.expect(why);
        let status = screen.lines().last().expect("a status line");
        assert!(status.contains('✗') && status.contains(file), "{status}");
        program.press("q");
        assert!(program.left().0.success());
    }
}

#[test]
fn where_there_is_no_terminal_it_says_what_does_the_same() {
    let folder = folder();
    let mut command = Command::new(env!("CARGO_BIN_EXE_lancet"));
    command.args(["tui", "square.json"]).current_dir(folder.path());
    let output = command.stdin(Stdio::null()).output().expect("it runs");
    assert_eq!(output.status.code(), Some(2));
    assert!(output.stdout.is_empty());
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(said.contains("not a terminal") && said.contains("lancet replay"), "{said}");
}

#[cfg(target_os = "linux")]
#[test]
fn what_is_written_to_standard_error_meanwhile_comes_afterwards() {
    use std::io::Write as _;

    let folder = folder();
    let mut program = opened(folder.path(), [120, 40]);
    let file = format!("/proc/{}/fd/2", program.process());
    let mut errors = fs::OpenOptions::new().write(true).open(file).expect("its standard error");
    errors.write_all(b"error: a driver is not content\n").expect("written");
    drop(errors);
    // What the screen shows now was written after that.
    program.press("l");
    let screen = program.expect("1/5");
    assert!(!screen.contains("driver"), "{screen}");
    program.press("q");
    let (_, after) = program.left();
    assert!(after.contains("error: a driver is not content"), "{after}");
}
