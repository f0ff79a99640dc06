//! The engines that a recording can be for. This file is the only place of the room that lists them.

use crate::engine::wound::WoundEvent;
use crate::engine::{Event, Input};

use super::{Recording, SceneRef, rules};
use crate::report::quoted;

/// The engines' names, as they stand in files and scripts; the first is a script's default.
pub const ENGINES: &[&str] = &[WoundEvent::ENGINE];

/// A recording for one of the engines.
#[derive(Clone, Debug, PartialEq)]
pub enum AnyRecording {
    /// Cutting wounds on a skin surface.
    Wound(Recording<WoundEvent>),
}

/// The events of an engine that recordings are made for.
pub trait Recorded: Event {
    /// The engine's name.
    const ENGINE: &'static str;
    /// The recording as one of any engine.
    fn wrap(recording: Recording<Self>) -> AnyRecording;
}

impl Recorded for WoundEvent {
    const ENGINE: &'static str = "wound";

    fn wrap(recording: Recording<Self>) -> AnyRecording {
        AnyRecording::Wound(recording)
    }
}

/// Something to do with a recording, whatever its engine.
pub trait Visit {
    /// What comes of it.
    type Output;
    /// Does it.
    fn visit<E: Recorded>(self, recording: &Recording<E>) -> Self::Output;
}

/// Something to do for an engine that is known by its name.
pub(super) trait ForEngine {
    /// What comes of it.
    type Output;
    /// Does it.
    fn run<E: Recorded>(self) -> Self::Output;
}

/// Does something for the engine of a name; `None` when there is no such engine.
pub(super) fn for_engine<F: ForEngine>(name: &str, job: F) -> Option<F::Output> {
    match name {
        WoundEvent::ENGINE => Some(job.run::<WoundEvent>()),
        _ => None,
    }
}

/// The same expression for each engine's recording.
macro_rules! each {
    ($any:expr, $recording:ident => $do:expr) => {
        match $any {
            AnyRecording::Wound($recording) => $do,
        }
    };
}

/// Begins a recording.
struct Begin {
    scene: SceneRef,
    viewport: [u32; 2],
}

impl ForEngine for Begin {
    type Output = AnyRecording;

    fn run<E: Recorded>(self) -> AnyRecording {
        let Self { scene, viewport } = self;
        let (scene_hash, mesh_hash) = ([0; 32], [0; 32]);
        E::wrap(Recording { scene, scene_hash, mesh_hash, viewport, seed: 0, events: Vec::new() })
    }
}

impl AnyRecording {
    /// A recording of nothing yet, for an engine by its name. Its hashes are not known. An error says why there is none.
    pub fn begin(engine: &str, scene: SceneRef, viewport: [u32; 2]) -> Result<Self, String> {
        rules::head(&scene, viewport)?;
        let none = || format!("there is no engine {}", quoted(engine));
        for_engine(engine, Begin { scene, viewport }).ok_or_else(none)
    }

    /// Does something that holds for every engine.
    pub fn visit<V: Visit>(&self, job: V) -> V::Output {
        each!(self, recording => job.visit(recording))
    }

    /// Name of the engine that it is for.
    pub fn engine(&self) -> &'static str {
        struct Name;
        impl Visit for Name {
            type Output = &'static str;
            fn visit<E: Recorded>(self, _: &Recording<E>) -> &'static str {
                E::ENGINE
            }
        }
        self.visit(Name)
    }

    /// What it was recorded on.
    pub fn scene(&self) -> &SceneRef {
        each!(self, recording => &recording.scene)
    }

    /// blake3 of the scene's description and of its mesh.
    pub fn hashes(&self) -> [[u8; 32]; 2] {
        each!(self, recording => [recording.scene_hash, recording.mesh_hash])
    }

    /// Whether the hashes are known. Those of a script are zero until it is packed.
    pub fn is_hashed(&self) -> bool {
        self.hashes() != [[0; 32]; 2]
    }

    /// Width and height of the view, pixels.
    pub fn viewport(&self) -> [u32; 2] {
        each!(self, recording => recording.viewport)
    }

    /// How many events there are.
    pub fn event_count(&self) -> usize {
        each!(self, recording => recording.events.len())
    }

    /// The modes that can be chosen by hand.
    pub fn modes(&self) -> &'static [&'static str] {
        struct Modes;
        impl Visit for Modes {
            type Output = &'static [&'static str];
            fn visit<E: Recorded>(self, _: &Recording<E>) -> Self::Output {
                E::MODES
            }
        }
        self.visit(Modes)
    }

    /// The events as they stand in a script, a line of JSON each.
    pub fn event_lines(&self) -> Vec<String> {
        each!(self, recording => recording.events.iter().map(|keyed| line(&keyed.event)).collect())
    }

    /// Adds what was done by hand, and says its key. An error says why it cannot be recorded.
    pub fn append(&mut self, input: &Input) -> Result<u32, String> {
        each!(self, recording => recording.append(input))
    }

    /// Drops all events but the first few.
    pub fn truncate(&mut self, events: usize) {
        each!(self, recording => recording.events.truncate(events));
    }

    /// Says where the scene is.
    pub fn set_scene(&mut self, scene: SceneRef) {
        each!(self, recording => recording.scene = scene);
    }

    /// Says what the scene and its mesh hash to.
    pub fn set_hashes(&mut self, [scene, mesh]: [[u8; 32]; 2]) {
        each!(self, recording => (recording.scene_hash, recording.mesh_hash) = (scene, mesh));
    }
}

/// An event that cannot be written says so: it is one that no script gave.
fn line<E: Event>(event: &E) -> String {
    serde_json::to_string(event).unwrap_or_else(|error| format!("{}: {error}", event.kind()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recording::{Script, VIEWPORT};

    #[test]
    fn a_recording_that_begins_is_a_script_without_events() {
        let scene = SceneRef::typed("builtin:bust");
        let begun = AnyRecording::begin(ENGINES[0], scene.clone(), VIEWPORT).expect("an engine");
        let script = br#"{ "version": 1, "scene": "builtin:bust", "events": [] }"#;
        assert_eq!(&begun, Script::parse(script).expect("a script").unhashed());
        assert!(AnyRecording::begin("none", scene.clone(), VIEWPORT).is_err());
        assert!(AnyRecording::begin(ENGINES[0], scene, [0, 1]).is_err());
    }

    #[test]
    fn a_scene_is_typed_by_its_name_or_its_files() {
        assert_eq!(SceneRef::typed("builtin:bust"), SceneRef::Builtin("bust".into()));
        assert_eq!(SceneRef::typed("a/Scene.JSON"), SceneRef::File("a/Scene.JSON".into()));
        assert_eq!(SceneRef::typed("a/head.obj"), SceneRef::Mesh("a/head.obj".into()));
    }
}
