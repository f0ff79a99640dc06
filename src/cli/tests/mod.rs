//! What a user sees: the answers, the complaints, the exit status.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

mod runs;

use super::*;

/// Runs the program; its status, answer and complaints.
fn lancet(arguments: &[&str]) -> (Status, String, String) {
    let (mut out, mut err) = (Vec::new(), Vec::new());
    let status = run(words(arguments), &mut Console::plain(&mut out, &mut err));
    (status, String::from_utf8(out).unwrap(), String::from_utf8(err).unwrap())
}

fn words(arguments: &[&str]) -> impl Iterator<Item = OsString> {
    ["lancet"].iter().chain(arguments).map(OsString::from)
}

/// The answer of a command that does what it is asked.
#[track_caller]
fn answer(arguments: &[&str]) -> String {
    let (status, out, err) = lancet(arguments);
    assert_eq!((status, err.as_str()), (Status::Verified, ""));
    out
}

/// The complaint of a command that does not.
#[track_caller]
fn complaint(arguments: &[&str]) -> String {
    let (status, out, err) = lancet(arguments);
    assert_eq!((status, out.as_str()), (Status::Failed, ""));
    err
}

fn fixture(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures/recordings").join(name);
    path.to_str().unwrap().to_owned()
}

/// A file in a folder of its own.
fn file(name: &str, bytes: &[u8]) -> (tempfile::TempDir, String) {
    let folder = tempfile::tempdir().unwrap();
    let path: PathBuf = folder.path().join(name);
    std::fs::write(&path, bytes).unwrap();
    (folder, path.to_str().unwrap().to_owned())
}

#[test]
fn the_parser_is_consistent() {
    use clap::CommandFactory;
    Args::command().debug_assert();
}

#[test]
#[cfg(feature = "canary")]
fn a_program_with_the_planted_bug_says_of_nothing_that_it_is_right() {
    for command in [&["verify"][..], &["bless", "--reason", "x"], &["nightly", "--for", "1s"]] {
        assert!(complaint(command).contains("a bug is planted in this program"), "{command:?}");
    }
    assert!(answer(&["doctor"]).contains("CANARY"));
}

#[test]
fn help_and_version_are_answers() {
    assert!(answer(&["--help"]).contains("Exit status: 0"));
    assert!(answer(&["--version"]).starts_with("lancet 0"));
    assert!(complaint(&["cheese"]).contains("unrecognized subcommand"));
    assert!(complaint(&[]).contains("Usage: lancet"));
}

#[test]
fn a_recording_is_unpacked() {
    let script = std::fs::read_to_string(fixture("v1.json")).unwrap();
    assert_eq!(answer(&["unpack", &fixture("v1.lancet")]), script);
    assert_eq!(answer(&["unpack", &fixture("v1.json"), "-o", "-"]), script);
}

#[test]
fn a_scene_is_found_from_where_the_script_goes() {
    let script = br#"{"version": 1, "scene": {"mesh": "head.obj"}, "events": []}"#;
    let (folder, path) = file("a.json", script);
    let below = folder.path().join("scripts/b.json");
    assert_eq!(answer(&["unpack", &path, "-o", below.to_str().unwrap()]), "");
    assert!(std::fs::read_to_string(below).unwrap().contains(r#"{"mesh": "../head.obj"}"#));
}

/// A script of a tetrahedron.
const TETRAHEDRON: &str =
    r#"{"version": 1, "scene": {"mesh": "tetra.obj"}, "events": [{"click": [1.5, 2.5]}]}"#;
const TETRA_OBJ: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";

#[test]
fn a_script_is_packed_and_comes_back() {
    let (folder, script) = file("a.json", TETRAHEDRON.as_bytes());
    std::fs::write(folder.path().join("tetra.obj"), TETRA_OBJ).unwrap();
    let packed = folder.path().join("packed/a.lancet");
    let packed = packed.to_str().unwrap();
    assert_eq!(answer(&["pack", &script, "-o", packed]), "");
    let info: serde_json::Value = serde_json::from_str(&answer(&["info", packed, "--json"])).unwrap();
    assert_eq!((&info["scene"]["mesh"], &info["events"]), (&"../tetra.obj".into(), &1.into()));
    assert_eq!(info["mesh_hash"].as_str().unwrap().len(), 64);
    let again = answer(&["unpack", packed]).replace("../", "");
    assert_eq!(again, answer(&["unpack", &script]));
    let nowhere = complaint(&["pack", &fixture("v1.json").replace("v1", "none"), "-o", packed]);
    assert!(nowhere.contains("none.json"), "{nowhere}");
}

#[test]
fn a_mesh_is_told_about() {
    let (_folder, mesh) = file("tetra.obj", TETRA_OBJ.as_bytes());
    let out = answer(&["check", &mesh]);
    assert!(out.contains("closed") && out.contains("genus 0"), "{out}");
    let facts: serde_json::Value = serde_json::from_str(&answer(&["check", &mesh, "--json"])).unwrap();
    assert_eq!((&facts["faces"], &facts["euler"], &facts["closed"]), (&4.into(), &2.into(), &true.into()));
    let (_folder, broken) = file("broken.obj", b"v 0 0 0\nf 1 2 3\n");
    assert!(complaint(&["check", &broken]).contains("broken.obj: line 2"));
}

#[test]
fn the_scenes_are_listed() {
    assert!(answer(&["scenes"]).contains("builtin:bust"));
}

#[test]
fn the_doctor_answers() {
    assert!(answer(&["doctor"]).contains(env!("CARGO_PKG_VERSION")));
}

#[test]
fn info_says_what_is_in_it() {
    let out = answer(&["info", &fixture("v1.lancet")]);
    for expected in
        ["builtin:bust", "640 x 480", "10 (1 camera, 1 checkpoint, 1 click, 2 cut,", "after-first-cut"]
    {
        assert!(out.contains(expected), "{out}");
    }
    for json in [&["--json"][..], &["--json", "-"]] {
        let out = answer(&[&["info", &fixture("v1.lancet")], json].concat());
        let info: serde_json::Value = serde_json::from_str(&out).unwrap();
        assert_eq!((&info["events"], &info["kinds"]["cut"]), (&10.into(), &2.into()));
        assert_eq!(info["mesh_hash"], "22".repeat(32));
    }
    assert!(answer(&["info", &fixture("v1.json")]).contains("found when packed"));
}

#[test]
fn a_damaged_recording_is_told_about_up_to_the_damage() {
    let bytes = std::fs::read(fixture("v1.lancet")).unwrap();
    let (_folder, path) = file("a.lancet", &bytes[..bytes.len() - 60]);
    let (status, out, err) = lancet(&["info", &path]);
    assert_eq!(status, Status::Failed);
    assert!(out.contains("9 (1 camera,"), "{out}");
    assert!(err.contains("a.lancet: byte 508, frame 11 (after 9 events): the file ends here"), "{err}");
    assert!(complaint(&["unpack", &path]).contains("the file ends here"));
}

#[test]
fn bad_input_is_named() {
    assert!(complaint(&["info", "/nowhere/a.lancet"]).contains("/nowhere/a.lancet: "));
    let (_folder, path) = file("a.json", b"{\"version\": 1,\n\"scene\": 5}");
    assert!(complaint(&["unpack", &path]).contains("a.json: line 2, column 10: scene: invalid type"));
    let (_folder, path) = file("a.lancet", b"hello");
    assert!(complaint(&["info", &path]).contains("not a recording"));
}

#[test]
fn completions_and_manual_pages_come_from_the_parser() {
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        assert!(answer(&["completions", shell]).contains("unpack"));
    }
    assert!(answer(&["man"]).contains("lancet\\-unpack(1)"));
    assert!(answer(&["man", "unpack"]).contains(".TH lancet-unpack 1"));
    assert!(complaint(&["man", "cheese"]).contains("there is no command `cheese`"));
}

#[test]
fn schemas_are_json() {
    let schema: serde_json::Value = serde_json::from_str(&answer(&["schema", "script"])).unwrap();
    assert_eq!(schema["title"], "lancet script");
}

/// A pipe whose reader has gone away, or a disk that is full.
struct Fails(io::ErrorKind);

impl Write for Fails {
    fn write(&mut self, _: &[u8]) -> io::Result<usize> {
        Err(self.0.into())
    }

    fn flush(&mut self) -> io::Result<()> {
        Err(self.0.into())
    }
}

#[test]
fn a_broken_pipe_is_fine_and_a_full_disk_is_not() {
    let script = fixture("v1.json");
    for arguments in [&["man"][..], &["info", &script], &["--help"], &["completions", "bash"]] {
        let mut err = Vec::new();
        let status =
            run(words(arguments), &mut Console::plain(&mut Fails(io::ErrorKind::BrokenPipe), &mut err));
        assert_eq!((status, err), (Status::Verified, vec![]));
    }
    let mut err = Vec::new();
    let status = run(words(&["man"]), &mut Console::plain(&mut Fails(io::ErrorKind::StorageFull), &mut err));
    assert_eq!(status, Status::Failed);
    assert!(String::from_utf8(err).unwrap().starts_with("error: writing: "));
}
