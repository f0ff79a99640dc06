//! What is in a recording, in a few figures.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::Serialize;

use super::{AnyRecording, Recorded, Recording, SceneRef, VERSION, Visit, WriteError, to_bytes};
use crate::engine::{Control, Event};

/// What is in a recording.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Summary {
    /// Version of the file format.
    pub version: u32,
    /// The engine's name.
    pub engine: String,
    /// What it was recorded on.
    pub scene: SceneRef,
    /// blake3 of the scene's description, in hexadecimal; none in a script.
    pub scene_hash: Option<String>,
    /// blake3 of the scene's mesh, in hexadecimal; none in a script.
    pub mesh_hash: Option<String>,
    /// Width and height of the view, pixels.
    pub viewport: [u32; 2],
    /// What all randomness comes from.
    pub seed: u64,
    /// How many events there are.
    pub events: usize,
    /// How many of each kind.
    pub kinds: BTreeMap<String, usize>,
    /// The checkpoints' names, in order.
    pub checkpoints: Vec<String>,
    /// Length of the file, bytes.
    pub bytes: usize,
}

/// What is in a recording. It fails where the recording could not be written.
pub fn summary(recording: &AnyRecording) -> Result<Summary, WriteError> {
    let bytes = to_bytes(recording)?.len();
    Ok(Summary { bytes, ..recording.visit(Summarize) })
}

struct Summarize;

impl Visit for Summarize {
    type Output = Summary;

    fn visit<E: Recorded>(self, recording: &Recording<E>) -> Summary {
        let mut kinds = BTreeMap::new();
        for keyed in &recording.events {
            *kinds.entry(keyed.event.kind().to_owned()).or_default() += 1;
        }
        Summary {
            version: VERSION,
            engine: E::ENGINE.to_owned(),
            scene: recording.scene.clone(),
            scene_hash: known(&recording.scene_hash),
            mesh_hash: known(&recording.mesh_hash),
            viewport: recording.viewport,
            seed: recording.seed,
            events: recording.events.len(),
            kinds,
            checkpoints: recording.events.iter().filter_map(|k| checkpoint(&k.event)).collect(),
            bytes: 0,
        }
    }
}

fn checkpoint(event: &impl Event) -> Option<String> {
    match event.control() {
        Control::Checkpoint(name) => Some(name.to_owned()),
        _ => None,
    }
}

/// A script's recording has zeros for hashes.
fn known(hash: &[u8; 32]) -> Option<String> {
    (*hash != [0; 32]).then(|| blake3::Hash::from_bytes(*hash).to_hex().to_string())
}
