//! The hot paths: what is prepared for each, and what is counted.

use std::hint::black_box;
use std::path::Path as File;

use lancet::assets::builtin::builtin;
use lancet::assets::{self, CacheOptions, SceneSettings, export};
use lancet::engine::wound::merge::face_box;
use lancet::engine::wound::{Pick, State, pick};
use lancet::geometry::bvh::Bvh;
use lancet::mesh::{IndexedMesh, Mesh};
use lancet::recording::{self, SceneRef};
use lancet::replay::{self, Input, Options, Replay};
use lancet::report::Buffer;

use crate::kit::{Cutter, RECORDINGS, look, stage};

/// A path.
pub(crate) struct Path {
    pub(crate) name: &'static str,
    /// What comes before it.
    prepare: fn(&mut Bench),
    run: fn(&mut Bench),
}

const fn path(name: &'static str, prepare: fn(&mut Bench), run: fn(&mut Bench)) -> Path {
    Path { name, prepare, run }
}

/// All of them, in the order of the file.
pub(crate) const PATHS: &[Path] = &[
    path("mesh-build", |_| {}, |bench| drop(black_box(Mesh::build(&bench.bust)))),
    path("bvh-build", |_| {}, |bench| drop(black_box(bench.bvh()))),
    path("load-obj", |_| {}, |bench| drop(black_box(bench.load()))),
    path("picks", |_| {}, |bench| bench.pick()),
    path("fc", |bench| bench.cutter.prepare("FC"), |bench| bench.cutter.run(stage("FC"))),
    path("gp", |bench| bench.cutter.prepare("GP"), |bench| bench.cutter.run(stage("GP"))),
    path("pp", |bench| bench.cutter.prepare("PP"), |bench| bench.cutter.run(stage("PP"))),
    path("mc", |bench| bench.cutter.prepare("MC"), |bench| bench.cutter.run(stage("MC"))),
    path("ci", |bench| bench.cutter.prepare("CI"), |bench| bench.cutter.run(stage("CI"))),
    path("digests", |_| {}, |bench| bench.digest()),
    path("undo", |bench| bench.record(Input::Undo), |bench| bench.step()),
    path("redo", |bench| bench.record(Input::Redo), |bench| bench.step()),
    path("whole-state", |_| {}, |bench| drop(black_box(bench.replay.state()))),
    path("decode", |_| {}, |bench| drop(black_box(recording::read(&bench.bytes)))),
];

/// The cut whose stages are counted: one of the thesis's large ones.
const SAMPLE: &str = "large VI";
/// Picks that are counted together.
const PICKS: u32 = 64;

/// What the paths work on.
pub(crate) struct Bench {
    bust: IndexedMesh,
    mesh: Mesh,
    state: State,
    cutter: Cutter,
    /// After the cut.
    replay: Box<dyn Replay>,
    key: u32,
    /// What the cut's stages changed.
    buffers: Vec<Buffer>,
    /// A recording of two hundred cuts.
    bytes: Vec<u8>,
    /// The bust as OBJ lies in it.
    folder: tempfile::TempDir,
}

/// Runs all paths, each of them counted; one may do its work twice. Says what processor this is.
pub(crate) fn run(plant: Option<&str>, said: &mut String) -> Result<(), String> {
    if let Some(name) = plant.filter(|name| PATHS.iter().all(|path| path.name != *name)) {
        let names: Vec<&str> = PATHS.iter().map(|path| path.name).collect();
        return Err(format!("there is no path {name}; there are {}", names.join(", ")));
    }
    let mut bench = Bench::new();
    for path in PATHS {
        (path.prepare)(&mut bench);
        let again = plant == Some(path.name);
        measured(&mut || {
            (path.run)(&mut bench);
            if again {
                (path.prepare)(&mut bench);
                (path.run)(&mut bench);
            }
        });
    }
    *said += &processor();
    Ok(())
}

/// The function that callgrind counts in.
#[inline(never)]
fn measured(work: &mut dyn FnMut()) {
    work();
}

/// What the libraries choose their code by, as far as it can be seen from in here.
fn processor() -> String {
    #[cfg(target_arch = "x86_64")]
    let with = if std::arch::is_x86_feature_detected!("avx2") { " with avx2" } else { "" };
    #[cfg(not(target_arch = "x86_64"))]
    let with = "";
    format!("{}{with}", std::env::consts::ARCH)
}

fn recording_of(name: &str) -> std::path::PathBuf {
    File::new(RECORDINGS).join(name)
}

impl Bench {
    fn new() -> Self {
        let bust = builtin("bust").expect("a bust").mesh;
        let mesh = Mesh::build(&bust).expect("a mesh");
        let mut state = State::new(mesh.clone(), look(&SceneSettings::default(), [1280, 720]));
        state.mesh_and_bvh();
        let folder = tempfile::tempdir().expect("a folder");
        export::save(&mesh, &folder.path().join("bust.obj")).expect("it is written");
        let options = Options { keep_deltas: true, ..Options::default() };
        let cut = recording_of(&format!("thesis-{}.lancet", SAMPLE.replace(' ', "-")));
        let mut replay = replay::open_file(&cut, options, None).unwrap_or_else(|error| panic!("{error}"));
        replay.finish();
        let stages = replay.take_deltas().into_iter().flat_map(|event| event.stages);
        let buffers: Vec<Buffer> = stages.flat_map(|stage| stage.buffers).collect();
        let bytes = assets::read_file(&recording_of("two-hundred-cuts.lancet")).expect("a recording");
        let (cutter, key) = (Cutter::at(SAMPLE), 1000);
        Self { bust, mesh, state, cutter, replay, key, buffers, bytes, folder }
    }

    fn bvh(&self) -> Bvh {
        Bvh::build(self.mesh.face_count(), &|face| face_box(&self.mesh, face))
    }

    fn load(&self) -> assets::Loaded {
        let scene = SceneRef::Mesh("bust.obj".into());
        assets::open(&scene, self.folder.path(), &CacheOptions::off()).expect("it opens")
    }

    /// On a lattice over the face, one after another.
    fn pick(&mut self) {
        for i in 0..PICKS {
            let pixel = [560.0 + f64::from(i * 37 % 160), 200.0 + f64::from(i * 59 % 280)];
            let _ = black_box(pick::resolve(&mut self.state, Pick::Pixel(pixel)));
        }
    }

    fn digest(&self) {
        for buffer in &self.buffers {
            black_box(buffer.digest());
        }
    }

    fn record(&mut self, input: Input) {
        self.key += 1;
        self.replay.append(self.key, &input).expect("an event");
    }

    fn step(&mut self) {
        black_box(self.replay.step().expect("an event"));
    }
}
