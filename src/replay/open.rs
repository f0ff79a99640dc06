//! From a recording to a replay: the only place that says which engine a recording's events are for.

use std::fmt;
use std::path::{Path, PathBuf};

use super::{Options, Replay, Session};
use crate::assets::{self, AssetError, CacheOptions, Loaded, SceneSettings};
use crate::canvas::{RenderError, Renderer, Studio};
use crate::engine::wound::{self, Wound};
use crate::engine::{Control, Engine, Event};
use crate::recording::{self, AnyRecording, ReadError, Recording, SceneRef, Script, ScriptError};

/// Why a recording cannot be replayed.
#[derive(Debug)]
pub enum OpenError {
    /// A file cannot be read, or is not what it should be.
    Asset(AssetError),
    /// The recording is damaged.
    Recording {
        /** Its file. */
        path: PathBuf,
        /** What is wrong with it, and where. */
        error: Box<ReadError>,
    },
    /// The script is none.
    Script {
        /** Its file. */
        path: PathBuf,
        /** What is wrong with it, and where. */
        error: ScriptError,
    },
    /// The renderer cannot take the scene.
    Render(RenderError),
    /// The scene or its mesh is not what was recorded on.
    Mismatch {
        /** `scene` or `mesh`. */
        what: &'static str,
        /** What the recording holds. */
        expected: String,
        /** What was found. */
        found: String,
    },
}

impl fmt::Display for OpenError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Asset(error) => error.fmt(f),
            Self::Render(error) => error.fmt(f),
            Self::Recording { path, error } => write!(f, "{}: {error}", path.display()),
            Self::Script { path, error } => write!(f, "{}: {error}", path.display()),
            Self::Mismatch { what, expected, found } => {
                write!(
                    f,
                    "the {what} is not the one that was recorded on: its hash is {found}, not {expected}"
                )
            }
        }
    }
}

impl std::error::Error for OpenError {}

/// A recording on its scene, ready to be replayed as often as is needed.
#[derive(Debug)]
pub struct Case {
    /// What was recorded.
    pub recording: AnyRecording,
    /// The folder that its paths are relative to.
    pub folder: PathBuf,
    scene: Loaded,
}

impl Case {
    /// Reads a recording, or a script, and opens the scene that it names. A script gets the hashes that the scene has.
    pub fn open(path: &Path) -> Result<Self, OpenError> {
        Self::new(read(path)?, path.parent().unwrap_or(Path::new("")))
    }

    /// Opens the scene that a recording names; its paths are relative to a folder.
    pub fn new(mut recording: AnyRecording, folder: &Path) -> Result<Self, OpenError> {
        let scene = assets::open(recording.scene(), folder, &CacheOptions::from_environment());
        let scene = scene.map_err(OpenError::Asset)?;
        if !recording.is_hashed() {
            recording.set_hashes([scene.scene_hash, scene.mesh_hash]);
        }
        Ok(Self { recording, folder: folder.to_owned(), scene })
    }

    /// A replay of its recording, or of another on the same scene.
    pub fn replay(
        &self,
        recording: &AnyRecording,
        options: Options,
        studio: Option<&dyn Studio>,
    ) -> Result<Box<dyn Replay>, OpenError> {
        open(recording, self.scene.clone(), options, studio)
    }
}

/// Reads a recording, or a script as it stands: its hashes are not known.
pub fn read(path: &Path) -> Result<AnyRecording, OpenError> {
    let bytes = assets::read_file(path).map_err(OpenError::Asset)?;
    if recording::is_script(path, &bytes) {
        let script = Script::parse(&bytes).map_err(|error| OpenError::Script { path: path.into(), error })?;
        return Ok(script.into_unhashed());
    }
    recording::read(&bytes).map_err(|error| OpenError::Recording { path: path.into(), error })
}

/// The scene that a person means by a path where a recording could be meant as well: one that is made by code, a mesh, or a scene's description.
/// None for what may be a recording.
pub fn scene_at(path: &Path) -> Result<Option<SceneRef>, OpenError> {
    let scene = path.to_str().map(SceneRef::typed).unwrap_or_else(|| SceneRef::Mesh(path.into()));
    Ok(match scene {
        _ if assets::is_mesh(path) => Some(SceneRef::Mesh(path.into())),
        SceneRef::Builtin(_) if !assets::is_file(path) => Some(scene),
        SceneRef::File(_) => {
            let bytes = assets::read_file(path).map_err(OpenError::Asset)?;
            assets::scene::is_description(&bytes).then_some(scene)
        }
        _ => None,
    })
}

/// Opens a recording or a script, with the scene that it names.
pub fn open_file(
    path: &Path,
    options: Options,
    studio: Option<&dyn Studio>,
) -> Result<Box<dyn Replay>, OpenError> {
    let Case { recording, scene, .. } = Case::open(path)?;
    open(&recording, scene, options, studio)
}

/// A recording, on the scene that it was recorded on. With a studio it has pixels, if it needs any.
pub fn open(
    recording: &AnyRecording,
    scene: Loaded,
    options: Options,
    studio: Option<&dyn Studio>,
) -> Result<Box<dyn Replay>, OpenError> {
    require_same(recording, &scene)?;
    match recording {
        AnyRecording::Wound(recording) => {
            let renderer = match studio {
                Some(studio) if needs_pixels(recording, &options) => Some(renderer(&scene, studio)?),
                _ => None,
            };
            let Loaded { mesh, settings, maps, .. } = scene;
            let scene = wound_scene(&settings, maps.color_size(), recording.viewport);
            let state = wound::State::new(mesh, scene);
            Ok(Box::new(session::<Wound>(state, recording, options).with_renderer(renderer)))
        }
    }
}

fn session<E: Engine>(state: E::State, recording: &Recording<E::Event>, options: Options) -> Session<E> {
    let events = recording.events.iter().map(|keyed| (keyed.key, keyed.event.clone())).collect();
    Session::new(state, events, recording.seed, options)
}

/// Without a frame nobody sees the maps: they are neither loaded nor painted.
fn needs_pixels<E: Event>(recording: &Recording<E>, options: &Options) -> bool {
    let is_checkpoint = |event: &E| matches!(event.control(), Control::Checkpoint(_));
    options.everything || options.pictures || recording.events.iter().any(|e| is_checkpoint(&e.event))
}

fn renderer(scene: &Loaded, studio: &dyn Studio) -> Result<Box<dyn Renderer>, OpenError> {
    let maps = scene.maps.load().map_err(OpenError::Asset)?;
    studio.open(maps, &scene.mesh).map_err(OpenError::Render)
}

/// What a scene's settings are to the wound engine, with the size of its colour map and of the view.
pub fn wound_scene(settings: &SceneSettings, map_size: [u32; 2], viewport: [u32; 2]) -> wound::Scene {
    let SceneSettings { unit_cm, snap_px, fov_y, target, azimuth, zenith, distance, look } = settings.clone();
    wound::Scene { viewport, unit_cm, snap_px, fov_y, target, azimuth, zenith, distance, look, map_size }
}

fn require_same(recording: &AnyRecording, scene: &Loaded) -> Result<(), OpenError> {
    let found = [scene.scene_hash, scene.mesh_hash];
    for ((what, expected), found) in ["scene", "mesh"].into_iter().zip(recording.hashes()).zip(found) {
        if expected != found {
            let text = |hash: [u8; 32]| blake3::Hash::from_bytes(hash).to_hex()[..16].to_string();
            return Err(OpenError::Mismatch { what, expected: text(expected), found: text(found) });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recording::{Script, to_bytes};
    use crate::report::Outcome;

    /// A square of two triangles, seen from the front, cut from pixel to pixel.
    const SCRIPT: &str = r#"{ "version": 1, "viewport": [100, 100], "seed": 3,
        "scene": { "inline": { "nodes": [[0, 0, 0], [4, 0, 0], [4, 4, 0], [0, 4, 0]], "faces": [[0, 1, 2], [0, 2, 3]] } },
        "events": [ { "mode": "merge" }, { "click": [45, 40] }, { "click": [60, 55] }, { "click": [0.5, 0.5] },
                    { "checkpoint": "cut" }, { "undo": {} }, { "redo": {} } ] }"#;

    fn packed() -> AnyRecording {
        let mut recording = Script::parse(SCRIPT.as_bytes()).expect("a script").unhashed().clone();
        let scene = load(&recording);
        recording.set_hashes([scene.scene_hash, scene.mesh_hash]);
        recording
    }

    fn load(recording: &AnyRecording) -> Loaded {
        assets::open(recording.scene(), Path::new(""), &CacheOptions::off()).expect("a scene")
    }

    fn outcomes(replay: &mut dyn Replay) -> Vec<Outcome> {
        replay.finish();
        replay.run_report("").events.iter().map(|e| e.outcome).collect()
    }

    #[test]
    fn a_recording_finds_its_engine_and_its_scene() {
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("square.lancet");
        let bytes = to_bytes(&packed()).expect("it has a form");
        assets::write_file(&file, &bytes).expect("written");
        let mut replay = open_file(&file, Options::default(), Option::None).expect("it opens");
        use Outcome::{Applied, None, Pending, Rejected};
        let expected = [None, Pending, Applied, Rejected, None, Applied, Applied];
        assert_eq!(outcomes(replay.as_mut()), expected);
        assert_eq!((replay.engine(), replay.finding()), ("wound", Option::None));
        let run = replay.run_report("square");
        assert_eq!((run.scene["faces"], run.totals.cuts), (2, 1));
        assert!(run.end.is_some_and(|end| end.counts["faces"] > 2));
        assets::write_file(&file, &bytes[..bytes.len() - 1]).expect("written");
        assert!(matches!(
            open_file(&file, Options::default(), Option::None),
            Err(OpenError::Recording { .. })
        ));
        let missing = open_file(&folder.path().join("missing"), Options::default(), Option::None);
        assert!(matches!(missing, Err(OpenError::Asset(_))));
    }

    #[test]
    fn seeking_the_wound_engine_equals_linear_replay() {
        let recording = packed();
        let at = |options: Options| open(&recording, load(&recording), options, None).expect("it opens");
        let mut linear = at(Options::default());
        let mut states = vec![linear.state()];
        while linear.step().is_some() {
            states.push(linear.state());
        }
        for budget_bytes in [0, 3000, 1 << 20] {
            let mut replay = at(Options { budget_bytes, ..Options::default() });
            for target in [7, 2, 3, 0, 6, 5, 7, 1] {
                replay.seek(target);
                assert_eq!(replay.state(), states[target], "event {target}, {budget_bytes} bytes");
            }
        }
    }

    #[test]
    fn a_scene_is_told_from_a_recording() {
        let folder = tempfile::tempdir().expect("a folder");
        let at = |name: &str, content: &str| {
            let path = folder.path().join(name);
            assets::write_file(&path, content.as_bytes()).expect("written");
            path
        };
        let scene = |path: &Path| scene_at(path).expect("it can be read");
        for path in [at("cut.json", SCRIPT), at("a.lancet", "x"), at("odd.json", "{"), at("list.json", "[1]")]
        {
            assert_eq!(scene(&path), None, "{}", path.display());
        }
        let described = at("scene.json", r#"{ "mesh": "builtin:grid", "unit_cm": 2 }"#);
        assert_eq!(scene(&described), Some(SceneRef::File(described.clone())));
        for mesh in ["head.obj", "HEAD.GLB", "x.ply", "x.gltf"] {
            assert_eq!(scene(Path::new(mesh)), Some(SceneRef::Mesh(mesh.into())), "there or not");
        }
        assert_eq!(scene(Path::new("builtin:bust:3000")), Some(SceneRef::Builtin("bust:3000".into())));
        assert!(scene_at(&folder.path().join("nowhere.json")).is_err());
    }

    #[test]
    fn another_scene_is_refused() {
        let mut recording = packed();
        let [scene, mut mesh] = recording.hashes();
        mesh[0] ^= 1;
        recording.set_hashes([scene, mesh]);
        let scene = load(&recording);
        let error =
            open(&recording, scene, Options::default(), Option::None).err().expect("it is another mesh");
        assert!(error.to_string().starts_with("the mesh is not the one"), "{error}");
    }
}
