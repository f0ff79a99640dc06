//! The cuts that are made on every rung: drawn once, on the scene as it is, and told by elements rather than pixels, so that they stay
//! the same cuts wherever the scene goes.
//!
//! Only cuts that have a line are taken, as rational arithmetic sees it: what fails on the way up fails for the rung.

use glam::DVec3;

use crate::engine::wound::camera::Camera;
use crate::engine::wound::chain::At;
use crate::engine::wound::pick::resolve;
use crate::engine::wound::{CameraChange, Mode, Pick, State, WoundEvent};
use crate::measure::Random;
use crate::measure::exact::{Question, line};
use crate::mesh::{EdgeId, FaceId, Mesh, NodeId};

/// A cut, and where it is looked at from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Sample {
    pub(super) eye: DVec3,
    pub(super) mode: Mode,
    pub(super) picks: [Pick; 2],
}

/// How often another cut is tried where one has no line, for each that is wanted.
const TRIES: usize = 50;

/// Draws so many cuts; fewer where hardly any has a line.
pub(super) fn draw(state: &State, count: usize, random: &mut Random) -> Vec<Sample> {
    let tries = (0..count * TRIES).filter_map(|_| one(&mut state.clone(), random));
    tries.take(count).collect()
}

fn one(state: &mut State, random: &mut Random) -> Option<Sample> {
    let camera = &mut state.control.camera;
    camera.change(&view(camera.distance, random));
    let (camera, eye) = (*camera, camera.eye());
    let picks = pair(&state.mesh, &camera, random);
    let picked = [resolve(state, picks[0]).ok()?, resolve(state, picks[1]).ok()?];
    line(&state.mesh, &Question::of(eye, &picked)).ok()?;
    let mode = if random.once_in(2) { Mode::Merge } else { Mode::Carve };
    let picks = picked.map(|p| match p.point.at {
        At::Node(n) => Pick::Node(n),
        At::Edge(e) => Pick::Edge(e, p.point.weights[1]),
        At::Face(f) => Pick::Face(f, p.point.weights[1], p.point.weights[2]),
    });
    Some(Sample { eye, mode, picks })
}

/// From anywhere, or along an axis, where whole rows of a grid lie in a plane.
fn view(distance: f64, random: &mut Random) -> CameraChange {
    use std::f64::consts::{FRAC_PI_2, PI};
    let (azimuth, zenith) = match random.below(2) {
        0 => (0.0, FRAC_PI_2),
        _ => (random.within(-PI, PI), libm::acos(random.within(-1.0, 1.0))),
    };
    CameraChange { azimuth: Some(azimuth), zenith: Some(zenith), distance: Some(distance) }
}

/// Two picks: of faces under pixels, of nodes in a row, of edges, or of any two elements.
fn pair(mesh: &Mesh, camera: &Camera, random: &mut Random) -> [Pick; 2] {
    let mut pixel = || {
        let [a, b, c] = mesh.triangle(FaceId::of(random.below(mesh.face_count())));
        let (u, v) = (random.unit(), random.unit());
        let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
        Pick::Pixel(camera.project(a + (b - a) * u + (c - a) * v).unwrap_or_default())
    };
    let pixels = [pixel(), pixel()];
    let mut node = || NodeId::of(random.below(mesh.node_count()));
    let nodes = [node(), node()];
    match random.below(4) {
        0 | 1 => pixels,
        2 => row(mesh, nodes[0], random).map(Pick::Node),
        _ => [Pick::Node(nodes[0]), Pick::Edge(EdgeId::of(random.below(mesh.edge_count())), random.unit())],
    }
}

/// A node, and one that is reached from it along edges, as straight as the mesh allows.
fn row(mesh: &Mesh, from: NodeId, random: &mut Random) -> [NodeId; 2] {
    let around = |n: NodeId| mesh.fan(n).map(move |(face, corner)| mesh.face(face).nodes[(corner + 1) % 3]);
    let Some(first) = around(from).nth(random.below(around(from).count())) else { return [from; 2] };
    let direction = mesh.position(first) - mesh.position(from);
    let straight = |node: NodeId| {
        let along = |n: NodeId| (mesh.position(n) - mesh.position(node)).normalize_or_zero().dot(direction);
        around(node).max_by(|&a, &b| along(a).total_cmp(&along(b)).then(b.cmp(&a))).unwrap_or(node)
    };
    [from, (0..1 + random.below(7)).fold(first, |node, _| straight(node))]
}

impl Sample {
    /// The events of the cut, seen from an eye that has gone where the scene has.
    pub(super) fn events(&self, eye: DVec3, target: DVec3) -> [WoundEvent; 3] {
        let offset = eye - target;
        let distance = offset.length();
        let up = offset / distance;
        let change = CameraChange {
            azimuth: Some(libm::atan2(up.x, up.z)),
            zenith: Some(libm::acos(up.y.clamp(-1.0, 1.0))),
            distance: Some(distance),
        };
        let [from, to] = self.picks;
        [WoundEvent::Camera(change), WoundEvent::Mode(self.mode), WoundEvent::Cut { from, to }]
    }
}
