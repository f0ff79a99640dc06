//! What the benchmarks share: the thesis's cuts, ready to be run stage by stage.

use std::path::Path;

use lancet::assets::{self, CacheOptions, SceneSettings};
use lancet::engine::wound::{Control, Scene, State, Work, Wound, WoundEvent};
use lancet::engine::{Engine, Part, Stage, Start};
use lancet::recording::AnyRecording;
use lancet::replay;

/// Where the recordings are, from the package's folder, in which cargo runs benchmarks. Whole paths would lay out the heap by the place of the checkout, and
/// with it what is moved when something grows.
pub(crate) const RECORDINGS: &str = "recordings/wound";

/// A state before a cut, and how far into the cut it is.
pub(crate) struct Cutter {
    state: State,
    event: WoundEvent,
    /// The camera, the mode and a first click, before the event.
    control: Control,
    /// An open transaction.
    work: Option<Work>,
}

impl Cutter {
    /// Stands before the first cut of the recording of one of the thesis's samples.
    pub(crate) fn at(sample: &str) -> Self {
        let name = format!("thesis-{}.lancet", sample.replace(' ', "-"));
        let path = Path::new(RECORDINGS).join(name);
        let AnyRecording::Wound(recording) = replay::read(&path).unwrap_or_else(|error| panic!("{error}"));
        let scene = assets::open(&recording.scene, path.parent().unwrap(), &CacheOptions::off()).unwrap();
        let mut state = State::new(scene.mesh, look(&scene.settings, recording.viewport));
        state.mesh_and_bvh();
        for keyed in &recording.events {
            let control = Wound::control(&state);
            if let Start::Run(work) = Wound::start(&mut state, &keyed.event, 0) {
                return Self { state, event: keyed.event.clone(), control, work: Some(work) };
            }
        }
        panic!("there is no cut in {}", path.display());
    }

    /// Takes back what was done of the cut, and does it again up to a stage.
    pub(crate) fn prepare(&mut self, stage: &str) {
        if let Some(mut work) = self.work.take() {
            Wound::rollback(&mut self.state, &mut work);
        }
        Wound::set_control(&mut self.state, self.control.clone());
        let Start::Run(work) = Wound::start(&mut self.state, &self.event, 0) else { panic!("it is a cut") };
        self.work = Some(work);
        for earlier in Wound::STAGES.iter().take_while(|s| s.id != stage) {
            self.run(earlier);
        }
    }

    /// Runs a stage.
    pub(crate) fn run(&mut self, stage: &Stage<Wound>) {
        let work = self.work.as_mut().expect("it is prepared");
        if (stage.part)(work) == Part::Run {
            (stage.run)(&mut self.state, work).unwrap_or_else(|rejection| panic!("{}", rejection.detail));
        }
    }
}

/// The wound engine's stage of a name.
pub(crate) fn stage(id: &str) -> &'static Stage<Wound> {
    Wound::STAGES.iter().find(|stage| stage.id == id).expect("there is such a stage")
}

/// How a scene is looked at.
pub(crate) fn look(settings: &SceneSettings, viewport: [u32; 2]) -> Scene {
    let SceneSettings { unit_cm, snap_px, fov_y, target, azimuth, zenith, distance, look } = settings.clone();
    let map_size = [1024; 2];
    Scene { viewport, unit_cm, snap_px, fov_y, target, azimuth, zenith, distance, look, map_size }
}
