//! Bytes to the reader of scenes, and a cut in what they say.
//!
//! A scene that is read is within its ranges, and within them nothing may break. So its settings go around a small square that is cut twice, as a replay
//! does it: with every check, and with a look at what is seen.
//!
//! What must hold: a fault names a line of the file; written and read again the scene says the same; no invariant breaks, whatever becomes of the
//! cuts; the square and its views stay finite. Maps are files, and are not opened.

use std::path::Path;
use std::sync::OnceLock;

use super::{Finding, Hits, Outcome};
use crate::assets::scene::SceneFile;
use crate::assets::{self, CacheOptions, Fault, Loaded, Place, SceneSettings};
use crate::recording::{AnyRecording, Script};
use crate::replay::{self, Options, Replay};

/// A square of two triangles, cut from pixel to pixel, from a face to an edge, and from elsewhere again.
const SCRIPT: &str = r#"{ "version": 1, "viewport": [100, 80], "seed": 3,
    "scene": { "inline": { "nodes": [[-2, -2, 0], [2, -2, 0], [2, 2, 0], [-2, 2, 0]], "faces": [[0, 1, 2], [0, 2, 3]] } },
    "events": [ { "cut": { "from": { "pixel": [45, 40] }, "to": { "pixel": [60, 50.5] } } },
                { "cut": { "from": { "face": [0, 0.25, 0.5] }, "to": { "edge": [1, 0.5] } } },
                { "camera": { "zenith": 1 } }, { "click": [40, 40] }, { "click": [50, 30] },
                { "subdivide": { "at": [50, 40], "into": 4 } }, { "undo": {} } ] }"#;

pub(super) fn run(data: &[u8]) -> Outcome {
    let mut hits = Hits::default();
    match SceneFile::read(data) {
        Err(fault) => {
            hits.note(format!("{:?}", fault.kind));
            within(&fault, data)?;
        }
        Ok(scene) => {
            hits.note("read");
            says_the_same(&scene)?;
            cut(scene.settings(), &mut hits)?;
        }
    }
    Ok(hits)
}

fn within(fault: &Fault, data: &[u8]) -> Result<(), Box<Finding>> {
    let lines = 1 + data.iter().filter(|&&b| b == b'\n').count() as u64;
    match fault.place {
        // serde_json says line 0 of what has no place.
        Place::Line(line) if line > lines => {
            Err(Finding::new("fault-within-file", format!("{fault}, of {lines} lines")))
        }
        _ => Ok(()),
    }
}

fn says_the_same(scene: &SceneFile) -> Result<(), Box<Finding>> {
    let failed = |what: String| Finding::new("reads-what-it-wrote", what);
    let text = serde_json::to_vec(scene).map_err(|e| failed(e.to_string()))?;
    let again = SceneFile::read(&text).map_err(|fault| failed(fault.to_string()))?;
    if again == *scene { Ok(()) } else { Err(failed("it is another scene".into())) }
}

/// The square before it is cut; `None` only where the script above is wrong, which a test would show.
fn square() -> Option<&'static (AnyRecording, Loaded)> {
    static SQUARE: OnceLock<Option<(AnyRecording, Loaded)>> = OnceLock::new();
    let make = || {
        let mut recording = Script::parse(SCRIPT.as_bytes()).ok()?.into_unhashed();
        let loaded = assets::open(recording.scene(), Path::new(""), &CacheOptions::off()).ok()?;
        recording.set_hashes([loaded.scene_hash, loaded.mesh_hash]);
        Some((recording, loaded))
    };
    SQUARE.get_or_init(make).as_ref()
}

fn cut(settings: SceneSettings, hits: &mut Hits) -> Result<(), Box<Finding>> {
    let (recording, square) = square().ok_or_else(|| Finding::new("square", "the script is none"))?;
    let scene = Loaded { settings, ..square.clone() };
    let options = Options { paranoid: true, ..Options::default() };
    let mut replay = replay::open(recording, scene, options, None)
        .map_err(|error| Finding::new("opens", error.to_string()))?;
    replay.finish();
    let report = replay.run_report("scene");
    report.events.iter().for_each(|event| hits.note(format!("{} {:?}", event.kind, event.outcome)));
    match replay.finding() {
        Some(broken) => Err(Finding::new("invariants-hold", format!("{broken:?}"))),
        None => finite(replay.as_ref()),
    }
}

fn finite(replay: &dyn Replay) -> Result<(), Box<Finding>> {
    let finite = replay.mesh().is_none_or(|mesh| mesh.positions().iter().all(|p| p.is_finite()));
    if finite { Ok(()) } else { Err(Finding::new("mesh-is-finite", "a coordinate is not")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_usual_scene_is_cut_and_every_part_of_its_file_holds() {
        let text = r#"{ "mesh": "builtin:grid", "unit_cm": 2.5, "lights": [ { "azimuth": 1 } ] }"#;
        let hits = run(text.as_bytes()).expect("no finding").0;
        assert_eq!((hits["read"], hits["cut Applied"]), (1, 2), "{hits:?}");
        (0..text.len()).for_each(|end| drop(run(&text.as_bytes()[..end]).expect("no finding")));
    }
}
