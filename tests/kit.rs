//! Random cuts on real meshes: `LANCET_KIT` names a folder of OBJ, glTF and PLY files, none of which is part of the package.
//!
//! A mesh is opened as a scene in which it measures 30 cm (a scan's unit may be a metre or an inch), and cut in a session until twenty cuts
//! had a surface under both picks: carve and merge in turns, some short and some long, each over what the cuts before it left.
//! Nothing may panic or break an invariant. A refusal has one of the engine's reasons; that no section joins two picks is
//! looked at independently, by a flood over the faces that the plane crosses. Of the cuts that a section joins, a clean closed mesh refuses
//! next to none.

use std::cmp::Ordering;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use glam::DVec3;
use lancet::assets::{self, AssetError, CacheOptions, Loaded};
use lancet::engine::wound::camera::Camera;
use lancet::engine::wound::{CameraChange, Mode, Pick, WoundEvent};
use lancet::geometry::predicates::orient3d;
use lancet::mesh::Mesh;
use lancet::recording::{AnyRecording, Keyed, Recording, SceneRef};
use lancet::replay::{self, Options, Replay};
use lancet::report::{EventReport, Outcome};
use support::Random;

mod support;

/// Cuts with two hits on each mesh.
const CUTS: usize = 20;
/// Cuts that are tried for that: much of the view is beside the mesh.
const TRIES: usize = 200;
const SIDE: u32 = 640;
/// What a mesh measures from corner to corner.
const DIAGONAL_CM: f64 = 30.0;
/// Every reason for which the engine may refuse a cut between two pixels.
const REASONS: &[&str] = &[
    "below-resolution",
    "boundary",
    "degenerate-plane",
    "fold",
    "grazing",
    "miss",
    "no-tissue",
    "other-component",
    "same-point",
    "silhouette",
    "too-short-to-open",
];
/// Those of them that say that no section joins the picks.
const APART: &[&str] = &["other-component", "silhouette"];

#[test]
fn random_cuts_on_real_meshes() {
    let Some(kit) = std::env::var_os("LANCET_KIT").map(PathBuf::from) else {
        eprintln!("skipped: LANCET_KIT is not set");
        return;
    };
    let rows: Vec<Row> = meshes(&kit).iter().map(|path| row(&kit, path)).collect();
    eprintln!("{}", table(&rows));
    let wrong: Vec<_> = rows.iter().flat_map(|row| row.wrong.iter().map(|f| (&row.name, f))).collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
    let clean = rows.iter().filter(|row| row.clean);
    let (applied, joined) = clean.fold((0, 0), |(a, j), row| (a + row.applied, j + row.hits - row.apart));
    assert!(joined > 0, "{}: no clean closed mesh", kit.display());
    eprintln!(
        "clean closed meshes: {applied} of {joined} cuts between picks that a section joins are applied"
    );
    assert!(applied * 100 >= joined * 95, "{applied} of {joined}");
}

/// What became of the cuts of a mesh.
#[derive(Default)]
struct Row {
    name: String,
    faces: usize,
    /// Closed, and read without a repair.
    clean: bool,
    /// Cuts with a surface under both picks.
    hits: usize,
    applied: usize,
    /// Cuts whose picks no section joins.
    apart: usize,
    /// Refusals by reason; of a mesh that was not opened, why.
    refused: String,
    /// Broken invariants, and refusals for a reason that is not true.
    wrong: Vec<String>,
}

fn row(kit: &Path, path: &Path) -> Row {
    let name = path.strip_prefix(kit).unwrap_or(path).display().to_string();
    match open(&name, path) {
        Ok((scene, loaded)) => cut(name, scene, loaded),
        Err(error) => Row { name, refused: error.to_string(), ..Row::default() },
    }
}

/// Opens a mesh in a scene where it has a person's size.
fn open(name: &str, path: &Path) -> Result<(SceneRef, Loaded), AssetError> {
    let path = path.canonicalize().expect("a file that was listed");
    let open = |scene: &SceneRef| assets::open(scene, Path::new(""), &CacheOptions::off());
    let [low, high] = open(&SceneRef::Mesh(path.clone()))?.mesh.bounds();
    let unit_cm = DIAGONAL_CM / (high - low).length();
    let scene = serde_json::json!({ "mesh": path, "unit_cm": unit_cm });
    let scene = SceneRef::File(keep(name, "scene.json", scene.to_string().as_bytes()));
    let loaded = open(&scene)?;
    Ok((scene, loaded))
}

/// Leaves a file under `target/tmp/kit`, for `lancet replay` and `lancet reduce`.
fn keep(name: &str, extension: &str, bytes: &[u8]) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("kit").join(name).with_extension(extension);
    assets::write_file(&path, bytes).expect("a folder to write to");
    path
}

fn cut(name: String, scene: SceneRef, loaded: Loaded) -> Row {
    let facts = assets::inspect(&loaded.mesh);
    assert!(facts.manifold && facts.oriented, "{name}: {facts:?}");
    let recording = recording(&name, scene, &loaded);
    let clean = facts.closed && loaded.notes.is_empty();
    let any = AnyRecording::Wound(recording.clone());
    keep(&name, "lancet", &lancet::recording::to_bytes(&any).expect("a recording has a form"));
    let camera = camera(&loaded.mesh);
    let mut replay = replay::open(&any, loaded, Options::default(), None).expect("its own scene");
    let mut row = Row { name, faces: facts.faces, clean, ..Row::default() };
    let mut reasons = BTreeMap::new();
    while row.hits < CUTS {
        let Some(event) = replay.step().cloned() else { break };
        let reason = event.reason.as_deref().unwrap_or("");
        if event.kind != "cut" || reason == "miss" {
            continue;
        }
        row.hits += 1;
        row.applied += usize::from(event.outcome == Outcome::Applied);
        if event.outcome != Outcome::Applied {
            *reasons.entry(reason.to_owned()).or_insert(0) += 1;
            let apart =
                replay.mesh().is_some_and(|mesh| apart(mesh, &camera, &recording.events[..=event.index]));
            row.apart += usize::from(apart);
            row.wrong.extend(untrue(&event, apart));
        }
    }
    row.refused = reasons.iter().map(|(reason, n)| format!("{n} {reason}")).collect::<Vec<_>>().join(", ");
    row.wrong.extend(findings(replay.as_ref()));
    row
}

/// What is not true about a refusal.
fn untrue(event: &EventReport, apart: bool) -> Option<String> {
    let reason = event.reason.as_deref().unwrap_or("none");
    let known = REASONS.contains(&reason);
    let said_apart = APART.contains(&reason);
    (!known || said_apart && !apart).then(|| format!("event {}: {reason}: {:?}", event.index, event.detail))
}

fn findings(replay: &dyn Replay) -> Vec<String> {
    let run = replay.run_report("");
    let whole = replay.state().checks.into_iter().filter(|check| !check.ok);
    let at_events = run.findings().map(|finding| format!("{finding:?}"));
    at_events.chain(whole.map(|check| format!("{check:?}"))).collect()
}

/// The view of a whole mesh, before its angles are said.
fn camera(mesh: &Mesh) -> Camera {
    let [low, high] = mesh.bounds();
    let (fov_y, viewport) = (0.6, [SIDE; 2]);
    let distance = Camera::fitting_distance((high - low).length() * 0.5, fov_y, viewport);
    Camera { target: (low + high) * 0.5, azimuth: 0.0, zenith: 0.0, distance, fov_y, viewport }
}

fn recording(name: &str, scene: SceneRef, loaded: &Loaded) -> Recording<WoundEvent> {
    let mut random = Random::named(name);
    let camera = camera(&loaded.mesh);
    let tries = (0..TRIES).flat_map(|i| attempt(i, &loaded.mesh, camera, &mut random));
    let events = (0..).zip(tries).map(|(key, event)| Keyed { key, event }).collect();
    let (scene_hash, mesh_hash) = (loaded.scene_hash, loaded.mesh_hash);
    Recording { scene, scene_hash, mesh_hash, viewport: [SIDE; 2], seed: 1, events }
}

/// A view, a mode and a cut from where a point of some face is seen to a place nearby.
fn attempt(i: usize, mesh: &Mesh, mut camera: Camera, random: &mut Random) -> [WoundEvent; 3] {
    let change = CameraChange {
        azimuth: Some(std::f64::consts::TAU * f64::from(random.below(8)) / 8.0),
        zenith: Some(0.4 + 0.6 * f64::from(random.below(4))),
        distance: None,
    };
    camera.change(&change);
    let [a, b, c] =
        mesh.faces()[random.below(mesh.face_count() as u32) as usize].nodes.map(|n| mesh.position(n));
    let (u, v) = (random.unit(), random.unit());
    let point = a + ((b - a) * (1.0 - v) + (c - a) * v) * u.sqrt();
    let reach = if i % 4 < 2 { 40.0 } else { 160.0 };
    let from = camera.project(point).expect("all of the mesh is in front");
    let to = from.map(|x| x + (2.0 * random.unit() - 1.0) * reach);
    let mode = if i.is_multiple_of(2) { Mode::Carve } else { Mode::Merge };
    let cut = WoundEvent::Cut { from: Pick::Pixel(from), to: Pick::Pixel(to) };
    [WoundEvent::Camera(change), WoundEvent::Mode(mode), cut]
}

/// Whether no section by the plane of the last event, a cut, joins its picks.
fn apart(mesh: &Mesh, camera: &Camera, events: &[Keyed<WoundEvent>]) -> bool {
    let mut camera = *camera;
    for keyed in events {
        if let WoundEvent::Camera(change) = &keyed.event {
            camera.change(change);
        }
    }
    let Some(WoundEvent::Cut { from: Pick::Pixel(from), to: Pick::Pixel(to) }) =
        events.last().map(|k| &k.event)
    else {
        return false;
    };
    let eye = camera.eye();
    let [a, b] = [from, to].map(|pixel| camera.through(*pixel).expect("within the view"));
    let [start, end] = [a, b].map(|through| first_face(mesh, eye, through - eye).expect("it was hit"));
    !flooded(mesh, start, |node| orient3d(eye, a, b, node))[end]
}

/// The faces that are reached from one over edges whose ends do not lie on one side.
fn flooded(mesh: &Mesh, start: usize, side: impl Fn(DVec3) -> Ordering) -> Vec<bool> {
    let sides: Vec<Ordering> = mesh.positions().iter().map(|&node| side(node)).collect();
    let mut seen = vec![false; mesh.face_count()];
    let mut open = vec![start];
    while let Some(at) = open.pop() {
        if std::mem::replace(&mut seen[at], true) {
            continue;
        }
        for edge in mesh.faces()[at].edges.map(|edge| mesh.edge(edge)) {
            let [a, b] = edge.nodes.map(|node| sides[node.at()]);
            if a != b || a == Ordering::Equal {
                let beside = edge.faces.into_iter().filter_map(|face| face.some());
                open.extend(beside.map(|face| face.at()).filter(|&face| !seen[face]));
            }
        }
    }
    seen
}

/// The face that a ray meets first (Möller and Trumbore).
fn first_face(mesh: &Mesh, eye: DVec3, ray: DVec3) -> Option<usize> {
    let distance = |[a, b, c]: [DVec3; 3]| {
        let (ab, ac) = (b - a, c - a);
        let p = ray.cross(ac);
        let scale = 1.0 / ab.dot(p);
        let u = (eye - a).dot(p) * scale;
        let q = (eye - a).cross(ab);
        let v = ray.dot(q) * scale;
        (u >= 0.0 && v >= 0.0 && u + v <= 1.0).then(|| ac.dot(q) * scale)
    };
    let faces = mesh.faces().iter().enumerate();
    let hits = faces.filter_map(|(i, face)| Some((distance(face.nodes.map(|n| mesh.position(n)))?, i)));
    hits.filter(|(t, _)| *t > 0.0).min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, i)| i)
}

/// Every mesh file below a folder, in order.
fn meshes(kit: &Path) -> Vec<PathBuf> {
    let is_mesh = |path: &PathBuf| {
        path.extension().is_some_and(|end| ["obj", "ply", "gltf", "glb"].iter().any(|known| end == *known))
    };
    assets::list_files(kit).expect("a folder to read").into_iter().filter(is_mesh).collect()
}

fn table(rows: &[Row]) -> String {
    let mut text = format!(
        "{:66} {:>6} {:>6} {:>5} {:>8} {:>6}  refused\n",
        "mesh", "faces", "clean", "hits", "applied", "apart"
    );
    for Row { name, faces, clean, hits, applied, apart, refused, .. } in rows {
        let clean = if *clean { "yes" } else { "no" };
        writeln!(text, "{name:66} {faces:>6} {clean:>6} {hits:>5} {applied:>8} {apart:>6}  {refused}")
            .expect("a string takes it");
    }
    text
}
