//! The table of stages.

use super::carve::{Place, carve};
use super::event::Mode;
use super::merge::{follow_refinement, merge};
use super::paint::{Place as PaintPlace, paint};
use super::plane::CutPlane;
use super::state::{Before, Cut, State, Work};
use super::surface::{arc_lengths, skin_links};
use super::{Wound, chain::At};
use super::{checks, patch, pick, settle};
use crate::engine::{Job, Part, Stage};
use crate::mesh::refine::Refinement;
use crate::mesh::{Mesh, Touched};
use crate::report::{Buffer, Rejection, Scalar};

/// FC, GP, PP, MC and CI for a cut, SD for a subdivision.
pub(super) const STAGES: &[Stage<Wound>] = &[
    Stage {
        id: "FC",
        title: "form cutting line",
        part: |work| part(work, Mode::Patch),
        run: |state, work| on_cut(work, |cut| form(state, cut)),
        job: |_| None,
        buffers: |state, work| cut_of(work).map_or_else(Vec::new, |cut| line_buffers(state, cut)),
        check: |state, work| cut_of(work).map_or_else(Vec::new, |cut| checks::form(state, cut)),
    },
    Stage {
        id: "GP",
        title: "generate wound patch",
        part: painting_part,
        run: |state, work| on_cut(work, |cut| run_patch(state, cut)),
        job: |work| cut_of(work)?.patch.as_ref().map(|patch| Job::Patch(&patch.job)),
        buffers: |_, work| {
            cut_of(work).and_then(|cut| cut.patch.as_ref()).map_or_else(Vec::new, |p| vec![p.job.buffer()])
        },
        check: |state, work| cut_of(work).map_or_else(Vec::new, |cut| checks::patch(state, cut)),
    },
    Stage {
        id: "PP",
        title: "paint wound patch",
        part: painting_part,
        run: |state, work| on_cut(work, |cut| run_paint(state, cut)),
        job: |work| work.painting().map(Job::Paint),
        buffers: |_, work| work.painting().map_or_else(Vec::new, |painting| painting.paint.buffers().into()),
        check: |state, work| cut_of(work).map_or_else(Vec::new, |cut| checks::paint(state, cut)),
    },
    Stage {
        id: "MC",
        title: "merge cutting line",
        part: |work| part(work, Mode::Merge),
        run: |state, work| on_cut(work, |cut| run_merge(state, cut)),
        job: |_| None,
        buffers: |state, work| cut_of(work).map_or_else(Vec::new, |cut| changes(state, &cut.before_merge)),
        check: |state, work| cut_of(work).map_or_else(Vec::new, |cut| checks::merge(state, cut)),
    },
    Stage {
        id: "CI",
        title: "carve incision",
        part: |work| part(work, Mode::Carve),
        run: |state, work| on_cut(work, |cut| run_carve(state, cut)),
        job: |_| None,
        buffers: |state, work| cut_of(work).map_or_else(Vec::new, |cut| changes(state, &cut.before_carve)),
        check: |state, work| cut_of(work).map_or_else(Vec::new, |cut| checks::carve(state, cut)),
    },
    Stage {
        id: "SD",
        title: "subdivide face",
        part: |work| if matches!(work, Work::Subdivide { .. }) { Part::Run } else { Part::Absent },
        run: |state, work| run_subdivision(state, work),
        job: |_| None,
        buffers: |state, work| match work {
            Work::Subdivide { before, .. } => changes(state, before),
            Work::Cut(_) => Vec::new(),
        },
        check: |state, work| match work {
            Work::Subdivide { refined, before, .. } => checks::subdivision(state, refined, before),
            Work::Cut(_) => Vec::new(),
        },
    },
];

fn part(work: &Work, least: Mode) -> Part {
    match work {
        Work::Cut(cut) if cut.mode as u8 >= least as u8 => Part::Run,
        Work::Cut(_) => Part::Skip("mode"),
        Work::Subdivide { .. } => Part::Absent,
    }
}

/// GP and PP take part in every cut, unless there is nothing to paint on.
fn painting_part(work: &Work) -> Part {
    match (part(work, Mode::Patch), cut_of(work).and_then(|cut| cut.unpainted)) {
        (Part::Run, Some(reason)) => Part::Skip(reason),
        (part, _) => part,
    }
}

fn cut_of(work: &Work) -> Option<&Cut> {
    match work {
        Work::Cut(cut) => Some(cut),
        Work::Subdivide { .. } => None,
    }
}

fn on_cut(work: &mut Work, run: impl FnOnce(&mut Cut) -> Result<(), Rejection>) -> Result<(), Rejection> {
    match work {
        Work::Cut(cut) => run(cut),
        Work::Subdivide { .. } => Ok(()),
    }
}

fn form(state: &mut State, cut: &mut Cut) -> Result<(), Rejection> {
    let [from, to] = cut.picks;
    let picked = [pick::resolve(state, from)?, pick::resolve(state, to)?];
    cut.picked = Some(picked);
    let mut plane = CutPlane::through([cut.eye, picked[0].through, picked[1].through]).ok_or_else(|| {
        Rejection::new(
            "degenerate-plane",
            "the eye and the two picks lie on one line, so they span no cutting plane",
        )
    })?;
    cut.formed = settle::form(&state.mesh, &mut plane, picked, state.largest)?;
    cut.plane = Some(plane);
    cut.arc = arc_lengths(&cut.formed.chain);
    cut.links = skin_links(&state.mesh, &cut.formed.chain, &cut.arc, state.largest);
    cut.unpainted = cut.unpainted.or_else(|| unpaintable(cut));
    Ok(())
}

/// Why a line cannot be painted along.
fn unpaintable(cut: &Cut) -> Option<&'static str> {
    // Jobs are in f32; beyond this a length, or the square of one, would be none.
    let length = cut.arc.last().copied().unwrap_or(0.0);
    match (cut.links.is_empty(), (1e-15..1e15).contains(&length)) {
        (true, _) => Some("no skin along the line"),
        (_, false) => Some("no length that a job can hold"),
        _ => None,
    }
}

fn run_patch(state: &State, cut: &mut Cut) -> Result<(), Rejection> {
    let look = &state.look.wound;
    cut.patch = Some(patch::plan(&state.mesh, &cut.formed.chain, &cut.links, state.map_size, look, cut.seed));
    Ok(())
}

fn run_paint(state: &mut State, cut: &mut Cut) -> Result<(), Rejection> {
    let Some(patch) = &cut.patch else { return Ok(()) };
    let (mesh, formed, arc, links, map) =
        (&state.mesh, &cut.formed, &cut.arc[..], &cut.links[..], state.map_size);
    let painted = paint(&PaintPlace { mesh, formed, arc, links, patch, map }, &state.look.wound, cut.seed);
    state.paintings.push(painted.painting.clone());
    cut.painted = Some(painted);
    Ok(())
}

fn run_merge(state: &mut State, cut: &mut Cut) -> Result<(), Rejection> {
    cut.before_merge = before(&state.mesh, &cut.formed.refinement);
    (cut.line, cut.refined) = merge(&mut state.mesh, state.bvh.as_mut(), &cut.formed)?;
    Ok(())
}

fn run_carve(state: &mut State, cut: &mut Cut) -> Result<(), Rejection> {
    cut.before_carve = Before::now(&state.mesh);
    let Some(plane) = &cut.plane else { return Ok(()) };
    let (unit_cm, largest) = (state.unit_cm, state.largest);
    let (mesh, bvh) = state.parts();
    cut.carved = carve(&mut Place { mesh, bvh, plane, unit_cm, largest }, cut.line.clone())?;
    Ok(())
}

fn run_subdivision(state: &mut State, work: &mut Work) -> Result<(), Rejection> {
    let Work::Subdivide { plan, refined, before: then } = work else { return Ok(()) };
    **then = before(&state.mesh, plan);
    *refined = state.mesh.refine(plan);
    if let Some(bvh) = &mut state.bvh {
        follow_refinement(&state.mesh, bvh, refined);
    }
    Ok(())
}

fn before(mesh: &Mesh, plan: &Refinement) -> Before {
    let parents = plan.faces.iter().map(|s| (*mesh.face(s.face), mesh.triangle(s.face)));
    Before { parents: parents.collect(), ..Before::now(mesh) }
}

fn changes(state: &State, before: &Before) -> Vec<Buffer> {
    mesh_buffers(&state.mesh, &state.mesh.touched_since(before.mark))
}

/// Elements of the mesh as buffers.
pub(super) fn mesh_buffers(mesh: &Mesh, touched: &Touched) -> Vec<Buffer> {
    let mut nodes = Buffer::new("nodes", "n", Scalar::F64, 3);
    touched.nodes.iter().for_each(|n| nodes.push_f64(n.0, &mesh.position(*n).to_array()));
    let mut vertices = Buffer::new("vertices", "v", Scalar::F32, 11);
    for &v in &touched.vertices {
        let value = mesh.vertex(v);
        let mut row = [0.0; 11];
        row[..2].copy_from_slice(&value.uv.to_array());
        row[2..5].copy_from_slice(&value.normal.to_array());
        row[5..8].copy_from_slice(&value.tangent.to_array());
        row[8..].copy_from_slice(&value.bitangent.to_array());
        vertices.push_f32(v.0, &row);
    }
    let mut edges = Buffer::new("edges", "e", Scalar::U32, 4);
    for &e in &touched.edges {
        let value = mesh.edge(e);
        edges.push_u32(e.0, &[value.nodes[0].0, value.nodes[1].0, value.faces[0].0, value.faces[1].0]);
    }
    let mut faces = Buffer::new("faces", "f", Scalar::U32, 10);
    for &f in &touched.faces {
        let value = mesh.face(f);
        let ids = [value.nodes.map(|n| n.0), value.vertices.map(|v| v.0), value.edges.map(|e| e.0)];
        let mut row = [value.surface as u32; 10];
        row[..9].copy_from_slice(ids.as_flattened());
        faces.push_u32(f.0, &row);
    }
    vec![nodes, vertices, edges, faces]
}

/// FC's line: where its points are, and where they lie. And what it changed in the mesh, which is nothing.
fn line_buffers(state: &State, cut: &Cut) -> Vec<Buffer> {
    let mut points = Buffer::new("points", "p", Scalar::F64, 6);
    let mut places = Buffer::new("places", "p", Scalar::U32, 2);
    for (i, p) in (0u32..).zip(&cut.formed.chain.points) {
        let (x, w) = (p.position, p.weights);
        points.push_f64(i, &[x.x, x.y, x.z, w[0], w[1], w[2]]);
        places.push_u32(
            i,
            &match p.at {
                At::Node(n) => [0, n.0],
                At::Edge(e) => [1, e.0],
                At::Face(f) => [2, f.0],
            },
        );
    }
    let mut links = Buffer::new("links", "l", Scalar::U32, 1);
    let mut uvs = Buffer::new("uvs", "l", Scalar::F32, 4);
    for (i, link) in (0u32..).zip(&cut.formed.chain.links) {
        links.push_u32(i, &[link.face.0]);
        uvs.push_f32(i, &[link.uv[0].x, link.uv[0].y, link.uv[1].x, link.uv[1].y]);
    }
    let mut buffers = vec![points, places, links, uvs];
    buffers.extend(mesh_buffers(&state.mesh, &state.mesh.touched_since(state.mesh.beginning())));
    buffers
}
