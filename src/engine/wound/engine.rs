//! The wound engine as the session sees it.

use std::sync::Arc;

use glam::DVec3;

use super::camera::Camera;
use super::event::{Pick, Value, WoundEvent};
use super::settings::{FIRST, SETTINGS, Setting};
use super::state::{Before, Control, Cut, Edit, State, Work};
use super::{checks, pick, show, stages, subdivide, view};
use crate::canvas::frame::{FrameJob, Orbit};
use crate::canvas::job::Painting;
use crate::engine::{Control as EventControl, Engine, Event, Shown, Stage, Start};
use crate::mesh::refine::Refined;
use crate::mesh::{FaceId, Mark, Mesh, NodeId, VertexId, check};
use crate::report::{Buffer, Check, Outcome, Rejection, Scalar};

/// Cutting wounds on a skin surface.
pub struct Wound;

impl Engine for Wound {
    const NAME: &'static str = "wound";
    const STAGES: &'static [Stage<Self>] = stages::STAGES;
    type Event = WoundEvent;
    type State = State;
    type Control = Control;
    type Work = Work;
    type Patch = Edit;

    fn start(state: &mut State, event: &WoundEvent, seed: u64) -> Start<Work> {
        let pending = match event {
            WoundEvent::Click(_) => None,
            _ => state.control.pending.take(),
        };
        let done = Start::Done(if pending.is_some() { Outcome::Cancelled } else { Outcome::None });
        match event {
            WoundEvent::Camera(change) => state.control.camera.change(change),
            WoundEvent::Mode(mode) => state.control.mode = *mode,
            WoundEvent::Set(values) => state.set(values),
            WoundEvent::Click(at) => return click(state, *at, seed),
            WoundEvent::Cut { from, to } => return begin_cut(state, [*from, *to], seed),
            WoundEvent::Subdivide { at, into } => return begin_subdivision(state, *at, *into),
            WoundEvent::Undo {} | WoundEvent::Redo {} | WoundEvent::Checkpoint(_) => {}
        }
        done
    }

    fn interrupt(state: &mut State, event: &WoundEvent) -> bool {
        !matches!(event.control(), EventControl::Checkpoint(_)) && state.control.pending.take().is_some()
    }

    fn commit(state: &mut State, work: &mut Work) -> Edit {
        Edit { mesh: state.mesh.commit(), painting: work.painting().cloned() }
    }

    fn rollback(state: &mut State, work: &mut Work) {
        let touched = state.mesh.touched_since(state.mesh.beginning());
        state.mesh.rollback();
        follow(state, touched.nodes.into_iter(), touched.faces);
        unpaint(state, work.painting());
    }

    fn revert(state: &mut State, edit: &Edit) {
        state.mesh.revert(&edit.mesh);
        follow(state, edit.mesh.nodes(), edit.mesh.faces().collect());
        unpaint(state, edit.painting.as_ref());
    }

    fn apply(state: &mut State, edit: &Edit) {
        state.mesh.apply(&edit.mesh);
        follow(state, edit.mesh.nodes(), edit.mesh.faces().collect());
        state.paintings.extend(edit.painting.clone());
    }

    fn show(state: &State, work: &Work) -> Shown {
        show::show(state, work)
    }

    fn control(state: &State) -> Control {
        state.control.clone()
    }

    fn set_control(state: &mut State, control: Control) {
        state.control = control;
    }

    fn mode(state: &State) -> &'static str {
        state.control.mode.name()
    }

    fn buffers(state: &State) -> Vec<Buffer> {
        let mesh = &state.mesh;
        let mut buffers = stages::mesh_buffers(mesh, &everything(mesh));
        let mut anchors = Buffer::new("anchors", "n", Scalar::U32, 1);
        (0..mesh.node_count()).for_each(|n| anchors.push_u32(n as u32, &[mesh.anchor(NodeId::of(n)).0]));
        let mut camera = Buffer::new("camera", "c", Scalar::F64, 7);
        let c = &state.control.camera;
        camera.push_f64(0, &[c.target.x, c.target.y, c.target.z, c.azimuth, c.zenith, c.distance, c.fov_y]);
        buffers.extend([anchors, camera]);
        buffers.extend(control_buffers(&state.control));
        buffers.push(paintings_buffer(&state.paintings));
        buffers
    }

    fn check(state: &State) -> Vec<Check> {
        checks::state(state)
    }

    fn mesh(state: &State) -> Option<&Mesh> {
        Some(&state.mesh)
    }

    fn paintings(state: &State) -> &[Arc<Painting>] {
        &state.paintings
    }

    fn orbit(state: &State) -> Option<Orbit> {
        let Camera { azimuth, zenith, distance, .. } = state.control.camera;
        Some(Orbit { azimuth, zenith, distance })
    }

    fn look(state: &mut State, orbit: Orbit) {
        state.control.camera.change(&orbit.into());
    }

    fn frame(state: &State, version: u64, everything: bool) -> Option<FrameJob<'_>> {
        Some(view::frame(state, version, everything))
    }

    fn sizes(state: &State) -> Vec<(&'static str, u64)> {
        let mesh = &state.mesh;
        let sizes = [mesh.face_count(), mesh.node_count(), mesh.edge_count(), mesh.vertex_count()];
        ["faces", "nodes", "edges", "vertices"].into_iter().zip(sizes.map(|size| size as u64)).collect()
    }

    fn counts(state: &State) -> Vec<(&'static str, i64)> {
        let mesh = &state.mesh;
        vec![
            ("faces", mesh.face_count() as i64),
            ("nodes", mesh.node_count() as i64),
            ("edges", mesh.edge_count() as i64),
            ("vertices", mesh.vertex_count() as i64),
            ("boundary_edges", mesh.edges().iter().filter(|e| e.is_boundary()).count() as i64),
            ("euler", check::euler(mesh)),
        ]
    }

    fn state_bytes(state: &State) -> usize {
        // The paintings themselves are shared with the edits that made them, and counted there.
        let list = state.paintings.capacity() * size_of::<Arc<Painting>>();
        state.mesh.bytes() + state.bvh.as_ref().map_or(0, |b| b.bytes()) + list
    }

    fn patch_bytes(edit: &Edit) -> usize {
        edit.mesh.bytes() + edit.painting.as_ref().map_or(0, |painting| painting.bytes())
    }

    fn plant(state: &mut State, buffer: &str, element: u32, ulps: i64) -> Result<(), String> {
        let mesh = &mut state.mesh;
        match buffer {
            "nodes" if (element as usize) < mesh.node_count() => {
                let p = mesh.position(NodeId(element));
                mesh.set_position(NodeId(element), DVec3::new(off_by(p.x, ulps), p.y, p.z));
                Ok(())
            }
            "vertices" if (element as usize) < mesh.vertex_count() => {
                let mut v = mesh.vertex(VertexId(element));
                v.uv.x = f32::from_bits((v.uv.x.to_bits() as i64 + ulps) as u32);
                mesh.set_vertex(VertexId(element), v);
                Ok(())
            }
            "nodes" | "vertices" => Err(format!("{buffer} has no element {element}")),
            _ => Err(format!("nothing can be planted in buffer `{buffer}`; there are nodes and vertices")),
        }
    }
}

/// Mode, pending click and settings, which are in the order of [`SETTINGS`].
fn control_buffers(control: &Control) -> [Buffer; 3] {
    let mut mode = Buffer::new("mode", "m", Scalar::U32, 2);
    mode.push_u32(0, &[control.mode as u32, u32::from(control.pending.is_some())]);
    let mut settings = settings_buffer("settings", control, &SETTINGS[..FIRST]);
    for (i, value) in (FIRST as u32..).zip(control.pending.unwrap_or([f64::NAN; 2])) {
        settings.push_f64(i, &[value]);
    }
    [mode, settings, settings_buffer("look", control, &SETTINGS[FIRST..])]
}

fn settings_buffer(name: &str, control: &Control, settings: &[Setting]) -> Buffer {
    let mut buffer = Buffer::new(name, "s", Scalar::F64, 1);
    for (i, setting) in (0u32..).zip(settings) {
        let value = match control.settings.get(setting.name) {
            Some(Value::Number(v)) => *v,
            Some(Value::Switch(on)) => f64::from(u8::from(*on)),
            None => f64::NAN,
        };
        buffer.push_f64(i, &[value]);
    }
    buffer
}

/// A row for each painting: its digest.
fn paintings_buffer(paintings: &[Arc<Painting>]) -> Buffer {
    let mut buffer = Buffer::new("paintings", "p", Scalar::U32, 8);
    for (i, painting) in (0u32..).zip(paintings) {
        let digest = painting.digest();
        let words = digest.as_chunks::<4>().0.iter().map(|word| u32::from_le_bytes(*word));
        buffer.push_u32(i, &words.collect::<Vec<u32>>());
    }
    buffer
}

fn off_by(value: f64, ulps: i64) -> f64 {
    f64::from_bits((value.to_bits() as i64).wrapping_add(ulps) as u64)
}

fn everything(mesh: &Mesh) -> crate::mesh::Touched {
    mesh.touched_since(Mark::default())
}

/// Brings the hierarchy up to nodes and faces that changed.
fn follow(state: &mut State, nodes: impl Iterator<Item = NodeId>, mut faces: Vec<FaceId>) {
    if state.bvh.is_none() {
        return;
    }
    let mesh = &state.mesh;
    nodes.filter(|&n| mesh.has_node(n)).for_each(|n| faces.extend(mesh.fan(n).map(|(f, _)| f)));
    faces.sort_unstable();
    faces.dedup();
    state.follow(&faces);
}

/// Takes the newest painting off the list, if there was one.
fn unpaint(state: &mut State, painting: Option<&Arc<Painting>>) {
    state.paintings.truncate(state.paintings.len() - usize::from(painting.is_some()));
}

/// The first click waits, if it meets the surface; the second makes the cut.
fn click(state: &mut State, at: [f64; 2], seed: u64) -> Start<Work> {
    match state.control.pending.take() {
        Some(first) => begin_cut(state, [Pick::Pixel(first), Pick::Pixel(at)], seed),
        None => match pick::resolve(state, Pick::Pixel(at)) {
            Ok(_) => {
                state.control.pending = Some(at);
                Start::Done(Outcome::Pending)
            }
            Err(rejection) => Start::Rejected(rejection),
        },
    }
}

fn begin_cut(state: &mut State, picks: [Pick; 2], seed: u64) -> Start<Work> {
    state.mesh.begin();
    Start::Run(Work::Cut(Box::new(Cut {
        mode: state.control.mode,
        seed,
        unpainted: (!state.mesh.is_textured()).then_some("no texture coordinates"),
        eye: state.control.camera.eye(),
        picks,
        picked: None,
        plane: None,
        formed: Default::default(),
        arc: Vec::new(),
        links: Vec::new(),
        patch: None,
        painted: None,
        line: Default::default(),
        refined: Default::default(),
        before_merge: Before::default(),
        carved: Default::default(),
        before_carve: Before::default(),
    })))
}

fn begin_subdivision(state: &mut State, at: [f64; 2], into: u8) -> Start<Work> {
    match plan_subdivision(state, at, into) {
        Ok(plan) => {
            state.mesh.begin();
            Start::Run(Work::Subdivide { plan, refined: Refined::default(), before: Box::default() })
        }
        Err(rejection) => Start::Rejected(rejection),
    }
}

fn plan_subdivision(
    state: &mut State,
    at: [f64; 2],
    into: u8,
) -> Result<crate::mesh::refine::Refinement, Rejection> {
    let miss = || Rejection::new("miss", format!("there is no surface under pixel ({}, {})", at[0], at[1]));
    let camera = state.control.camera;
    let through = camera.through(at).ok_or_else(miss)?;
    let (mesh, bvh) = state.mesh_and_bvh();
    let hit = pick::cast(mesh, bvh, camera.eye(), through).ok_or_else(miss)?;
    subdivide::plan(mesh, hit.face, into)
}
