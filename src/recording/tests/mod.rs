//! Tests of recordings. The fixtures under tests/fixtures/recordings/ are never written again: they keep old versions readable.

mod damage;
mod fixtures;
mod reduce;
mod round_trip;
mod script;

use super::{AnyRecording, Script, to_bytes};

/// Every kind of event and pick.
const EVERYTHING: &str = r#"{
  "version": 1,
  "engine": "wound",
  "scene": "builtin:bust",
  "viewport": [640, 480],
  "seed": 7,
  "events": [
    {"camera": {"azimuth": 0.3, "distance": 40.0}},
    {"mode": "merge"},
    {"click": [640.5, 300.25]},
    {"cut": {"from": {"node": 17}, "to": {"edge": [40, 0.5]}}},
    {"cut": {"from": {"face": [3, 0.25, 0.5]}, "to": {"pixel": [1.0, -0.0]}}},
    {"subdivide": {"at": [500.0, 400.0], "into": 3}},
    {"undo": {}},
    {"redo": {}},
    {"set": {"shadows": false, "snap_px": 2.5}},
    {"checkpoint": "after-first-cut"}
  ]
}
"#;

fn parse(text: &str) -> Script {
    Script::parse(text.as_bytes()).unwrap()
}

/// The recording of a script, with hashes that are easy to see.
fn pack(text: &str) -> AnyRecording {
    parse(text).pack(|_| Ok::<_, ()>(([0x11; 32], [0x22; 32]))).unwrap()
}

fn text(script: &Script) -> String {
    let mut bytes = Vec::new();
    script.write(&mut bytes).unwrap();
    String::from_utf8(bytes).unwrap()
}

fn everything() -> Vec<u8> {
    to_bytes(&pack(EVERYTHING)).unwrap()
}
