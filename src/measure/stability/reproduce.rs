//! From a finding to the script that leads to it again.
//!
//! A finding on a scene that anyone has is a script; on a scaled one it is a script beside a scene file and its mesh.

use std::path::Path;
use std::sync::Arc;

use super::part::Broken;
use super::scenes::Prepared;
use crate::assets::{self, AssetError, export};
use crate::engine::Event;
use crate::engine::wound::WoundEvent;
use crate::mesh::{IndexedMesh, Mesh};
use crate::recording::{Keyed, Recorded, Recording, SceneRef, Script};

/// What it takes to see a finding again.
#[derive(Clone, Debug, PartialEq)]
pub struct Reproduction {
    /// File name of the script.
    pub name: String,
    /// The script.
    pub script: String,
    /// The scene that it names, where it is not built in.
    scene: Option<Made>,
}

/// A scene that is made here.
#[derive(Clone, Debug, PartialEq)]
struct Made {
    mesh: Arc<IndexedMesh>,
    unit_cm: f64,
    target: Option<[f64; 3]>,
}

pub(super) fn of(kind: &str, seed: u64, part: usize, scene: &Prepared, broken: &Broken) -> Reproduction {
    let stem = format!("{kind}-{seed}-{part}-{}", broken.cut);
    let (reference, made) = match scene.builtin {
        Some(name) => (SceneRef::Builtin(name.into()), None),
        None => (
            SceneRef::File(format!("{stem}.scene.json").into()),
            Some(Made {
                mesh: scene.indexed.clone(),
                unit_cm: scene.scene.unit_cm,
                target: scene.scene.target,
            }),
        ),
    };
    let recording = Recording {
        scene: reference,
        scene_hash: [0; 32],
        mesh_hash: [0; 32],
        viewport: scene.scene.viewport,
        seed,
        events: (0..).zip(broken.events.iter().cloned()).map(|(key, event)| Keyed { key, event }).collect(),
    };
    Reproduction { name: format!("{stem}.json"), script: text(recording), scene: made }
}

/// The script as text; an event that no script may hold is named instead.
fn text(recording: Recording<WoundEvent>) -> String {
    if let Some(invalid) = recording.events.iter().find_map(|keyed| keyed.event.validate().err()) {
        return format!("not a valid event: {invalid}");
    }
    let mut script = Vec::new();
    match Script::of(&WoundEvent::wrap(recording)).write(&mut script) {
        Ok(()) => String::from_utf8_lossy(&script).into_owned(),
        Err(error) => error.to_string(),
    }
}

impl Reproduction {
    /// Writes the script into a folder, with the scene that it needs.
    pub fn save(&self, folder: &Path) -> Result<(), AssetError> {
        assets::write_file(&folder.join(&self.name), self.script.as_bytes())?;
        let Some(made) = &self.scene else { return Ok(()) };
        let stem = self.name.trim_end_matches(".json");
        let mesh = format!("{stem}.obj");
        // It was built before the cuts were made.
        if let Ok(built) = Mesh::build(&made.mesh) {
            export::save(&built, &folder.join(&mesh))?;
        }
        let mut scene = serde_json::json!({ "mesh": mesh, "unit_cm": made.unit_cm });
        if let Some(target) = made.target {
            scene["target"] = target.to_vec().into();
        }
        assets::write_file(&folder.join(format!("{stem}.scene.json")), scene.to_string().as_bytes())
    }
}
