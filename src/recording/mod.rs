//! Recordings: what was done to a scene, event by event, so that it can be done again.
//!
//! A recording has two forms that say the same. The **file** (`.lancet`, module `format`) is binary, checked frame by frame, and holds the
//! content hashes of its scene and mesh. The **script** (JSON, module `script`) is for people: it holds no hashes, since those are
//! found when it is packed. `unpack(pack(script))` is the script, `pack(unpack(file))` the file, byte for byte.
//!
//! Each event carries a **key**, its index when it was packed. Whatever is random about an event comes from the recording's seed and that
//! key; so an event that is taken out by the reducer changes nothing about those after it.
//!
//! This room opens no file: it reads slices and writes to writers that are passed in.

mod any;
mod diff;
mod error;
mod format;
mod frame;
mod reduce;
mod rules;
mod scene_ref;
mod script;
mod script_text;
mod simplify;
mod summary;
#[cfg(test)]
mod tests;

use crate::engine::{Event, Input};

pub use any::{AnyRecording, ENGINES, Recorded, Visit};
pub use diff::{InputDifference, first_difference};
pub use error::{Cause, ReadError, ScriptError, WriteError};
pub use format::{is_script, read, to_bytes, write};
pub use frame::VERSION;
pub use reduce::{Progress, reduce};
pub use rules::VIEWPORT;
pub use scene_ref::{InlineMesh, SceneRef};
pub use script::{Script, script_schema};
pub use summary::{Summary, summary};

/// An event, and the key that its randomness comes from.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Keyed<E> {
    /// The event's index when it was packed.
    pub key: u32,
    /// What was done.
    pub event: E,
}

/// What was done to a scene, for one engine.
#[derive(Clone, Debug, PartialEq)]
pub struct Recording<E: Event> {
    /// What it was recorded on.
    pub scene: SceneRef,
    /// blake3 of the scene's description.
    pub scene_hash: [u8; 32],
    /// blake3 of the scene's mesh.
    pub mesh_hash: [u8; 32],
    /// Width and height of the view, pixels.
    pub viewport: [u32; 2],
    /// What all randomness of the run comes from, together with the events' keys.
    pub seed: u64,
    /// What was done, in order.
    pub events: Vec<Keyed<E>>,
}

impl<E: Event> Recording<E> {
    /// The same recording with other events.
    #[must_use]
    pub fn with_events(&self, events: Vec<Keyed<E>>) -> Self {
        Self { scene: self.scene.clone(), events, ..*self }
    }

    /// Adds what was done by hand, under a key that no event had. An error says why it cannot be recorded.
    pub fn append(&mut self, input: &Input) -> Result<u32, String> {
        let event: E = input.event()?;
        let mut names = rules::Names::default();
        self.events.iter().try_for_each(|keyed| names.admit(&keyed.event))?;
        names.admit(&event)?;
        let last = self.events.iter().map(|keyed| keyed.key).max();
        let key = last.map_or(Some(0), |last| last.checked_add(1)).ok_or("no key is left")?;
        self.events.push(Keyed { key, event });
        Ok(key)
    }

    /// What is wrong with it, if anything: the place (`viewport`, `events[3].cut.from`), then what.
    pub fn validate(&self) -> Result<(), String> {
        rules::head(&self.scene, self.viewport)?;
        let mut names = rules::Names::default();
        self.events.iter().enumerate().try_for_each(|(i, keyed)| {
            names.admit(&keyed.event).map_err(|what| format!("events[{i}].{what}"))
        })
    }
}
