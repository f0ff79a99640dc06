//! Scripts: what they may say, and how a mistake in one is named.

use super::{EVERYTHING, pack, parse, text};
use crate::recording::{Script, script_schema, summary};

fn error(text: &str) -> String {
    Script::parse(text.as_bytes()).unwrap_err().to_string()
}

/// A script of some events.
fn events(events: &str) -> String {
    format!(r#"{{"version": 1, "scene": "builtin:bust", "events": [{events}]}}"#)
}

#[track_caller]
fn assert_complains(script: &str, expected: &str) {
    let error = error(script);
    assert!(error.contains(expected), "{error}");
}

#[test]
fn defaults() {
    let script = parse(&events(""));
    let recording = script.unhashed();
    assert_eq!((recording.engine(), recording.viewport()), ("wound", [1280, 720]));
    assert_eq!(summary(recording).unwrap().seed, 0);
}

#[test]
fn scenes() {
    for scene in [
        r#""builtin:sphere:500""#,
        r#"{"file": "a/scene.json"}"#,
        r#"{"mesh": "../head.obj"}"#,
        r#"{"inline": {"nodes": [[0.1, -0.0, 1e-300]], "faces": [[0, 0, 0]], "uv": [[0.1, 0.7]]}}"#,
    ] {
        let script = parse(&format!(r#"{{"version": 1, "scene": {scene}, "events": []}}"#));
        assert!(text(&script).contains(&format!("\"scene\": {scene},")), "{}", text(&script));
    }
}

#[test]
fn mistakes_are_named_with_their_place() {
    assert_eq!(error("{"), "line 1, column 1: EOF while parsing an object");
    let script =
        events("{\"undo\": {}},\n  {\"cut\": {\"from\": {\"edge\": [4, 1.5]}, \"to\": {\"node\": 1}}}");
    assert_eq!(error(&script), "line 2, column 59: events[1].cut.from: 1.5 is not in [0, 1]");
    assert_eq!(
        error("{\"version\": 1,\n\"scene\": \"builtin:bust\", \"evnts\": []}"),
        "line 2, column 32: evnts: unknown field `evnts`, expected one of `version`, `engine`, `scene`, `viewport`, `seed`, `events`, `keys`"
    );
}

#[test]
fn mistakes_in_events() {
    assert_complains(&events(r#"{"clik": [1, 2]}"#), "events[0]: unknown variant `clik`");
    assert_complains(&events(r#"{"cut": {"frm": {"node": 1}}}"#), "events[0].cut.frm: unknown field `frm`");
    assert_complains(&events(r#"{"cut": {"from": {"node": 1}}}"#), "events[0].cut: missing field `to`");
    assert_complains(&events(r#"{"click": [1]}"#), "events[0].click: invalid length 1");
    assert_complains(&events(r#"{"click": [1e999, 0]}"#), "number out of range");
    assert_complains(&events(r#"{"camera": {"zenith": 4}}"#), "events[0].camera.zenith: 4 is not in");
    assert_complains(&events(r#"{"set": {"shadow": true}}"#), "events[0].set: there is no setting `shadow`");
    let one_key = "events[0]: one key says what it is, and here";
    assert_complains(&events(r#"{"undo": {}, "redo": {}}"#), &format!(r#"{one_key} are "redo" and "undo""#));
    assert_complains(&events("{}"), &format!("{one_key} is none"));
    assert_complains(&events(r#"{"click": [1, 2, 3]}"#), "events[0].click: 3 elements are too many");
    assert_complains(&events(r#"{"set": {"shadows": "no"}}"#), "neither true, false nor a number");
    assert_complains(&events(r#"{"set": {"shadows": true, "shadows": false}}"#), r#""shadows" is set twice"#);
    assert_complains(&events(r#"{"set": {"snap_px": 1e300}}"#), "events[0].set");
    assert_complains(&events(r#"{"undo": {}},"#), "events: expected value");
}

#[test]
fn mistakes_in_names() {
    assert_complains(&events(r#"{"checkpoint": "Nose"}"#), r#"events[0].checkpoint: "Nose" is not 1 to 64"#);
    assert_complains(&events(r#"{"checkpoint": ""}"#), "is not 1 to 64 of a-z, 0-9 and -");
    assert_complains(&events(&format!(r#"{{"checkpoint": "{}"}}"#, "a".repeat(65))), "is not 1 to 64");
    let twice = events(r#"{"checkpoint": "a"}, {"checkpoint": "a"}"#);
    assert_complains(&twice, r#"events[1].checkpoint: there is a checkpoint named "a" already"#);
    parse(&events(&format!(r#"{{"checkpoint": "{}"}}"#, "a".repeat(64))));
}

#[test]
fn mistakes_in_fields() {
    let with = |field: &str| EVERYTHING.replacen("\"seed\": 7", field, 1);
    assert_complains(
        &EVERYTHING.replace("\"version\": 1", "\"version\": 2"),
        "version: version 2; this program",
    );
    assert_complains(
        &EVERYTHING.replace("wound", "cheese"),
        "engine: there is no engine \"cheese\"; there is wound",
    );
    assert_complains(
        &EVERYTHING.replace("[640, 480]", "[640, 0]"),
        "viewport: a side of 0 pixels is not within",
    );
    assert_complains(&EVERYTHING.replace("builtin:bust", "bust"), "scene: \"bust\" is no scene; expected");
    assert_complains(
        &EVERYTHING.replace("\"builtin:bust\"", "{\"builtin\": \"bust\"}"),
        "scene: write \"builtin:bust\"",
    );
    assert_complains(
        &EVERYTHING.replace("\"builtin:bust\"", "{\"mesh\": \"a\", \"file\": \"b\"}"),
        "scene: ",
    );
    assert_complains(&EVERYTHING.replace("\"builtin:bust\"", "{}"), "scene: ");
    assert_complains(&with("\"seed\": -1"), "seed: invalid value");
    assert_complains(&with("\"seed\": 7, \"seed\": 8"), "duplicate field `seed`");
    assert_complains(&with("\"keys\": [1]"), "keys: 1 keys for 10 events");
    assert_complains(&format!("{EVERYTHING} 1"), "trailing characters");
    assert_complains("[]", "invalid length 0");
    assert_complains("", "EOF while parsing");
}

#[test]
fn keys_are_written_where_they_are_not_the_indices() {
    let plain = events(r#"{"undo": {}}, {"redo": {}}"#);
    let keyed = plain.replace("\"events\"", "\"keys\": [0, 5], \"events\"");
    assert!(!text(&parse(&plain)).contains("keys"));
    assert!(text(&parse(&keyed)).contains("\"keys\": [0, 5],"));
    assert_eq!(parse(&text(&parse(&keyed))), parse(&keyed));
    assert_ne!(parse(&keyed), parse(&plain));
}

#[test]
fn a_byte_order_mark_is_no_mistake() {
    assert_eq!(parse(&format!("\u{feff}{EVERYTHING}")), parse(EVERYTHING));
}

#[test]
fn the_summary_counts() {
    let summary = summary(&pack(EVERYTHING)).unwrap();
    assert_eq!((summary.events, summary.kinds["cut"], summary.kinds["undo"]), (10, 2, 1));
    assert_eq!(summary.checkpoints, ["after-first-cut"]);
    assert_eq!(summary.scene_hash, Some("11".repeat(32)));
    assert_eq!(summary.bytes, super::everything().len());
}

#[test]
fn the_schema_names_every_field_and_event() {
    let schema = serde_json::to_string(&script_schema()).unwrap();
    for word in
        ["viewport", "keys", "builtin:", "inline", "checkpoint", "azimuth", "16384", "snap_px", "[3,4,6]"]
    {
        assert!(schema.contains(word), "{word} is not in {schema}");
    }
}
