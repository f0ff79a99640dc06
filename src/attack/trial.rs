//! A recording in the making: events are drawn for the state that there is, run, and looked at by every oracle.
//!
//! An oracle needs nothing but the recording: which of the symmetries is tried at an event follows from its place. So a finding is found again when its
//! recording is judged ([`judge`]), and can be reduced.

use std::cell::RefCell;
use std::path::Path;
use std::sync::OnceLock;

use super::drive::{self, Ran};
use super::oracle::{self, Witness};
use super::{Finding, Hits, Outcome, matrix};
use crate::assets::{self, CacheOptions};
use crate::engine::Engine;
use crate::engine::wound::{Edit, Scene, State, Wound, WoundEvent};
use crate::mesh::{FaceId, Mesh, Surface};
use crate::recording::{Keyed, Recorded, Recording, SceneRef, Script};
use crate::replay::{event_seed, wound_scene};

/// Width and height of the view.
const VIEWPORT: [u32; 2] = [640, 360];

thread_local! {
    /// What is being run.
    static UNDER_WAY: RefCell<Option<Recording<WoundEvent>>> = const { RefCell::new(None) };
}

/// See [`super::under_way`].
pub(super) fn under_way() -> Option<Vec<u8>> {
    UNDER_WAY.try_with(|running| running.try_borrow().ok()?.as_ref().map(script)).ok()?
}

/// The same, which is over then.
pub(super) fn take_under_way() -> Option<Vec<u8>> {
    let script = under_way();
    UNDER_WAY.set(None);
    script
}

/// A scene as it is before any event.
#[derive(Clone)]
pub(super) struct Ground {
    pub(super) mesh: Mesh,
    pub(super) scene: Scene,
}

/// The built-in scenes that are cut, made once.
static BUILTINS: [(&str, OnceLock<Option<Ground>>); 6] = [
    ("sphere:20", OnceLock::new()),
    ("sphere:320", OnceLock::new()),
    ("slab", OnceLock::new()),
    ("torus", OnceLock::new()),
    ("two-fingers", OnceLock::new()),
    ("grid", OnceLock::new()),
];

/// The names of the built-in scenes that are cut, the smallest first.
pub(super) fn builtins() -> [&'static str; 6] {
    BUILTINS.each_ref().map(|row| row.0)
}

impl Ground {
    /// The scene that a recording names, if there is one.
    pub(super) fn of(recording: &Recording<WoundEvent>) -> Option<Self> {
        let known = match &recording.scene {
            SceneRef::Builtin(name) => BUILTINS.iter().find(|row| row.0 == name),
            _ => None,
        };
        let ground = match known {
            Some((_, made)) => made.get_or_init(|| Self::open(&recording.scene)).clone(),
            None => Self::open(&recording.scene),
        };
        ground.map(|mut ground| {
            ground.scene.viewport = recording.viewport;
            ground
        })
    }

    fn open(scene: &SceneRef) -> Option<Self> {
        let loaded = assets::open(scene, Path::new(""), &CacheOptions::off()).ok()?;
        let scene = wound_scene(&loaded.settings, loaded.maps.color_size(), VIEWPORT);
        Some(Self { mesh: loaded.mesh, scene })
    }

    pub(super) fn state(&self) -> State {
        State::new(self.mesh.clone(), self.scene.clone())
    }
}

/// What is looked at of an event.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Look {
    /// Nothing: it is run for what it leads to.
    Nothing,
    /// Which cells of the matrix it reaches.
    Cells,
    /// By every oracle.
    Everything,
}

/// A recording, and the state that it has led to.
pub(super) struct Trial {
    pub(super) recording: Recording<WoundEvent>,
    pub(super) state: State,
    ground: Ground,
    look: Look,
    done: Vec<Edit>,
    undone: Vec<Edit>,
    hits: Hits,
    /// What broke first.
    finding: Option<Box<Finding>>,
    /// The last cut that was applied, and the state before it.
    last: Option<oracle::Earlier>,
}

impl Trial {
    /// Before the first event. None where there is no such scene.
    pub(super) fn begin(recording: Recording<WoundEvent>, look: Look) -> Option<Self> {
        let ground = Ground::of(&recording)?;
        let (done, undone, hits, finding, last) = Default::default();
        let state = ground.state();
        Some(Self { recording, state, ground, look, done, undone, hits, finding, last })
    }

    /// A recording of nothing yet.
    pub(super) fn blank(scene: SceneRef, seed: u64) -> Recording<WoundEvent> {
        let (scene_hash, mesh_hash) = ([0; 32], [0; 32]);
        Recording { scene, scene_hash, mesh_hash, viewport: VIEWPORT, seed, events: Vec::new() }
    }

    /// Whether something broke; what comes after it is not looked at.
    pub(super) fn is_over(&self) -> bool {
        self.finding.is_some()
    }

    /// The faces of gutters.
    pub(super) fn gutter(&self) -> Vec<FaceId> {
        let faces = self.state.mesh.faces().iter().enumerate();
        faces.filter(|(_, f)| f.surface == Surface::Gutter).map(|(i, _)| FaceId::of(i)).collect()
    }

    /// Runs a further event.
    pub(super) fn run(&mut self, event: WoundEvent) {
        let last = self.recording.events.last().map_or(0, |keyed| keyed.key + 1);
        self.run_keyed(last, event);
    }

    fn run_keyed(&mut self, key: u32, event: WoundEvent) {
        self.recording.events.push(Keyed { key, event: event.clone() });
        if self.finding.is_none() {
            UNDER_WAY.set(Some(self.recording.clone()));
            self.step(key, &event);
        }
    }

    fn step(&mut self, key: u32, event: &WoundEvent) {
        match event {
            WoundEvent::Undo {} | WoundEvent::Redo {} => self.walk(event),
            WoundEvent::Checkpoint(_) => drop(Wound::interrupt(&mut self.state, event)),
            _ => self.cut(key, event),
        }
    }

    fn walk(&mut self, event: &WoundEvent) {
        Wound::interrupt(&mut self.state, event);
        let back = matches!(event, WoundEvent::Undo {});
        let (from, to) = match back {
            true => (&mut self.done, &mut self.undone),
            false => (&mut self.undone, &mut self.done),
        };
        if let Some(edit) = from.pop() {
            match back {
                true => Wound::revert(&mut self.state, &edit),
                false => Wound::apply(&mut self.state, &edit),
            }
            to.push(edit);
            self.last = None;
        }
    }

    fn cut(&mut self, key: u32, event: &WoundEvent) {
        let before = (self.look != Look::Nothing).then(|| self.state.clone());
        let seed = event_seed(self.recording.seed, key, "cut");
        let ran = drive::run(&mut self.state, event, seed, None);
        if let Some(before) = before {
            self.look(before, seed, key, event, &ran);
        }
        if let Some(edit) = ran.edit {
            self.done.push(edit);
            self.undone.clear();
        }
    }

    fn look(&mut self, before: State, seed: u64, key: u32, event: &WoundEvent, ran: &Ran) {
        if !matches!(event, WoundEvent::Camera(_) | WoundEvent::Mode(_) | WoundEvent::Set(_)) {
            self.hits.note(ran.word());
        }
        let (ground, after) = (&self.ground, &self.state);
        let witness =
            Witness { ground, before: &before, after, event, seed, key, ran, earlier: self.last.as_ref() };
        matrix::note(&witness, &mut self.hits);
        if self.look == Look::Cells {
            return;
        }
        if let Err(finding) = oracle::look(&witness, &mut self.hits) {
            self.finding = Some(finding);
        }
        if ran.edit.is_some() {
            self.last = oracle::Earlier::of(before, event, seed, ran, &self.state);
        }
    }

    /// Looks at the whole recording, and says what was reached or what broke.
    pub(super) fn end(mut self) -> Outcome {
        let found = match self.finding.take() {
            Some(finding) => Err(finding),
            None if self.look != Look::Everything => Ok(()),
            None => oracle::whole(&self.ground, &self.recording, &self.state, &mut self.hits),
        };
        UNDER_WAY.set(None);
        match found {
            Ok(()) => Ok(self.hits),
            Err(finding) => Err(finding.with_recording(script(&self.recording))),
        }
    }
}

/// Runs a recording, and looks at it with every oracle.
pub(super) fn judge(recording: &Recording<WoundEvent>) -> Outcome {
    let Some(mut trial) = Trial::begin(recording.with_events(Vec::new()), Look::Everything) else {
        return Err(Finding::new("scene", format!("there is no {}", recording.scene)));
    };
    recording.events.iter().for_each(|keyed| trial.run_keyed(keyed.key, keyed.event.clone()));
    trial.end()
}

/// A panic on the way.
#[cfg(test)]
pub(super) fn broken_off() -> Outcome {
    let mut trial = Trial::begin(Trial::blank(SceneRef::Builtin("slab".into()), 1), Look::Nothing)
        .expect("there is such a scene");
    let [from, to] = [0, 1].map(|n| crate::engine::wound::Pick::Node(crate::mesh::NodeId::of(n)));
    trial.run(WoundEvent::Cut { from, to });
    panic!("on the way")
}

/// A recording as a script.
pub(super) fn script(recording: &Recording<WoundEvent>) -> Vec<u8> {
    let mut text = Vec::new();
    let recording = WoundEvent::wrap(recording.clone());
    match Script::of(&recording).write(&mut text) {
        Ok(()) => text,
        Err(error) => error.to_string().into_bytes(),
    }
}
