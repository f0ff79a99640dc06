//! The cuts that are tried.
//!
//! Random picks alone never meet what breaks a cutter: a line that runs exactly through a node or along an edge, a pick a hair beside a corner,
//! both picks in one face, an eye in the cutting plane's own degenerate place, the floor of an earlier cut. These are drawn on purpose.

use glam::DVec3;

use crate::engine::wound::camera::Camera;
use crate::engine::wound::{CameraChange, Mode, Pick, State, WoundEvent};
use crate::measure::Random;
use crate::mesh::{EdgeId, FaceId, Mesh, NodeId};

/// Which fifth a cut belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Kind {
    /// Between random pixels.
    Random,
    /// Through nodes, along edges, with hostile values.
    Degenerate,
    /// Over earlier cuts.
    Earlier,
}

impl Kind {
    pub(super) const ALL: [Self; 3] = [Self::Random, Self::Degenerate, Self::Earlier];

    pub(super) fn title(self) -> &'static str {
        match self {
            Self::Random => "between random pixels",
            Self::Degenerate => "through nodes, along edges",
            Self::Earlier => "over earlier cuts",
        }
    }

    /// Three fifths, a fifth and a fifth; over earlier cuts only where there are any.
    pub(super) fn draw(past: &Past, random: &mut Random) -> Self {
        match random.below(5) {
            3 => Self::Degenerate,
            4 if !past.lines.is_empty() => Self::Earlier,
            4 => Self::Degenerate,
            _ => Self::Random,
        }
    }
}

/// What earlier cuts left behind.
#[derive(Debug, Default)]
pub(super) struct Past {
    /// The rims and floors of each line, in order along it.
    pub(super) lines: Vec<Vec<NodeId>>,
    /// Faces of gutters.
    pub(super) gutter: Vec<FaceId>,
    /// The picks of each line, and where from.
    pub(super) picks: Vec<(CameraChange, [Pick; 2])>,
}

/// Where one looks from: all around, now and then from a pole, along an axis, from near by or from within.
pub(super) fn camera(fitting: f64, random: &mut Random) -> CameraChange {
    use std::f64::consts::{FRAC_PI_2, PI};
    let zenith = match random.below(16) {
        0 => 0.0,
        1 => PI,
        2 => FRAC_PI_2,
        _ => libm::acos(random.within(-1.0, 1.0)),
    };
    let azimuth = match random.below(16) {
        0 => 0.0,
        1 => FRAC_PI_2,
        _ => random.within(-PI, PI),
    };
    let share = match random.below(16) {
        0 => 0.05,
        1 | 2 => 0.4,
        3 => 20.0,
        _ => 1.0,
    };
    CameraChange { azimuth: Some(azimuth), zenith: Some(zenith), distance: Some(fitting * share) }
}

/// The events of a cut: its view, how far it goes, and the picks.
pub(super) fn draw(
    kind: Kind,
    state: &State,
    past: &Past,
    fitting: f64,
    random: &mut Random,
) -> [WoundEvent; 3] {
    let mode = if random.once_in(3) { Mode::Merge } else { Mode::Carve };
    let again = (kind == Kind::Earlier && random.once_in(4)).then(|| random.below(past.picks.len()));
    let (change, picks) = match again.and_then(|i| past.picks.get(i)) {
        Some((change, picks)) => (*change, Some(*picks)),
        None => (camera(fitting, random), None),
    };
    // The picks are drawn for the view that they will be seen from.
    let mut camera = state.control.camera;
    camera.change(&change);
    let mut dice = Dice { mesh: &state.mesh, camera, past, random };
    let [from, to] = match (picks, kind) {
        (Some(picks), _) => dice.again(picks),
        (None, Kind::Random) => dice.pixels(),
        (None, Kind::Degenerate) => dice.degenerate(),
        (None, Kind::Earlier) => dice.over_earlier(),
    };
    [WoundEvent::Camera(change), WoundEvent::Mode(mode), WoundEvent::Cut { from, to }]
}

struct Dice<'a> {
    mesh: &'a Mesh,
    camera: Camera,
    past: &'a Past,
    random: &'a mut Random,
}

impl Dice<'_> {
    fn node(&mut self) -> NodeId {
        NodeId::of(self.random.below(self.mesh.node_count()))
    }

    fn edge(&mut self) -> EdgeId {
        EdgeId::of(self.random.below(self.mesh.edge_count()))
    }

    fn face(&mut self) -> FaceId {
        FaceId::of(self.random.below(self.mesh.face_count()))
    }

    /// The same picks again, the other way round, or a hair off.
    fn again(&mut self, [from, to]: [Pick; 2]) -> [Pick; 2] {
        match self.random.below(3) {
            0 => [from, to],
            1 => [to, from],
            _ => [from, to].map(|pick| match pick {
                Pick::Pixel(at) => Pick::Pixel(at.map(|v| v + self.random.within(-1e-9, 1e-9))),
                other => other,
            }),
        }
    }

    /// A pixel with surface under it, most likely.
    fn pixel(&mut self) -> Pick {
        let [width, height] = self.camera.viewport.map(f64::from);
        if self.random.once_in(24) {
            return Pick::Pixel([self.random.within(0.0, width), self.random.within(0.0, height)]);
        }
        let face = self.face();
        let (u, v) = self.weights();
        let [a, b, c] = self.mesh.triangle(face);
        self.pixel_of(a + (b - a) * u + (c - a) * v)
    }

    /// Where a point is seen.
    fn pixel_of(&self, point: DVec3) -> Pick {
        Pick::Pixel(self.camera.project(point).unwrap_or([0.0, 0.0]))
    }

    /// A pixel not far from another.
    fn pixel_near(&mut self, pick: Pick) -> Pick {
        let Pick::Pixel([x, y]) = pick else { return self.pixel() };
        let reach = self.random.one_of(&[1e-6, 0.5, 5.0, 40.0, 120.0]).unwrap_or(40.0);
        Pick::Pixel([x + self.random.within(-reach, reach), y + self.random.within(-reach, reach)])
    }

    fn pixels(&mut self) -> [Pick; 2] {
        let from = self.pixel();
        let to = if self.random.once_in(2) { self.pixel_near(from) } else { self.pixel() };
        [from, to]
    }

    /// A parameter along an edge, often a hostile one.
    fn parameter(&mut self) -> f64 {
        let hostile =
            [0.0, 1.0, 0.5, 0.25, 5e-324, 1e-300, 1e-17, 1e-9, 1.0 - f64::EPSILON / 2.0, 1.0 - 1e-9];
        match self.random.once_in(2) {
            true => self.random.unit(),
            false => self.random.one_of(&hostile).unwrap_or(0.5),
        }
    }

    /// Weights of a face's second and third corner, inside.
    fn weights(&mut self) -> (f64, f64) {
        let (u, v) = (self.random.unit(), self.random.unit());
        if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) }
    }

    /// The same, often hostile.
    fn hostile_weights(&mut self) -> (f64, f64) {
        let u = self.parameter();
        let v = match self.random.below(3) {
            0 => 1.0 - u,
            1 => self.parameter(),
            _ => 1e-300,
        };
        if u + v <= 1.0 { (u, v) } else { (u, 0.0) }
    }

    fn face_pick(&mut self, face: FaceId) -> Pick {
        let (u, v) = if self.random.once_in(2) { self.weights() } else { self.hostile_weights() };
        Pick::Face(face, u, v)
    }

    /// From a node along edges, as straight as the mesh allows.
    fn walk(&mut self, from: NodeId) -> NodeId {
        let mesh = self.mesh;
        let steps = 1 + self.random.below(8);
        let start = mesh.face(mesh.anchor(from));
        let Some(first) = start.nodes.into_iter().find(|&n| n != from) else { return from };
        let direction = mesh.position(first) - mesh.position(from);
        (1..steps).fold(first, |node, _| straight_on(mesh, node, direction))
    }

    /// A pick within an element of a face, or at one.
    fn in_or_on(&mut self, face: FaceId) -> Pick {
        let (corner, t) = (self.random.below(3), self.parameter());
        let f = self.mesh.face(face);
        match self.random.below(3) {
            0 => Pick::Node(f.nodes[corner]),
            1 => Pick::Edge(f.edges[corner], t),
            _ => self.face_pick(face),
        }
    }

    fn any(&mut self) -> Pick {
        let face = self.face();
        if self.random.once_in(4) { self.pixel() } else { self.in_or_on(face) }
    }

    fn degenerate(&mut self) -> [Pick; 2] {
        let (node, face) = (self.node(), self.face());
        match self.random.below(9) {
            0 | 1 => [Pick::Node(node), Pick::Node(self.walk(node))],
            2 => [self.in_or_on(face), self.in_or_on(face)],
            3 => {
                let next = self.neighbour(face);
                [self.in_or_on(face), self.in_or_on(next)]
            }
            4 => [self.face_pick(face), self.face_pick(face)],
            5 => [Pick::Edge(self.edge(), 0.5), Pick::Edge(self.edge(), 0.5)],
            6 => self.collinear(node),
            7 => {
                let from = self.pixel_of(self.mesh.position(node));
                let other = self.walk(node);
                [from, self.pixel_of(self.mesh.position(other))]
            }
            _ => [self.any(), self.any()],
        }
    }

    /// Two picks that leave the cutting plane open, or nearly: the same one twice, or one behind the other.
    fn collinear(&mut self, node: NodeId) -> [Pick; 2] {
        let pixel = self.pixel_of(self.mesh.position(node));
        match self.random.below(3) {
            0 => [Pick::Node(node), Pick::Node(node)],
            1 => [Pick::Node(node), pixel],
            _ => [pixel, self.pixel_near(pixel)],
        }
    }

    fn neighbour(&mut self, face: FaceId) -> FaceId {
        let edge = self.mesh.face(face).edges[self.random.below(3)];
        self.mesh.edge(edge).other_face(face).some().unwrap_or(face)
    }

    fn over_earlier(&mut self) -> [Pick; 2] {
        match self.random.below(6) {
            0 => self.across(),
            1 => [self.on_line(), self.any()],
            2 => [self.on_line(), self.on_line()],
            3 => [self.in_gutter(), self.in_gutter()],
            4 => {
                let from = self.in_gutter();
                [from, self.pixel()]
            }
            _ => self.line_nodes().map(Pick::Node),
        }
    }

    /// So many nodes of one earlier line; any node where there is none.
    fn line_nodes<const N: usize>(&mut self) -> [NodeId; N] {
        let i = self.random.below(self.past.lines.len());
        let line = self.past.lines.get(i).map_or(&[][..], Vec::as_slice);
        [(); N].map(|()| self.random.one_of(line).unwrap_or_else(|| self.node()))
    }

    fn on_line(&mut self) -> Pick {
        let [node] = self.line_nodes();
        let face = self.mesh.anchor(node);
        if self.random.once_in(2) { Pick::Node(node) } else { self.in_or_on(face) }
    }

    fn in_gutter(&mut self) -> Pick {
        match self.random.one_of(&self.past.gutter) {
            Some(face) => self.in_or_on(face),
            None => self.on_line(),
        }
    }

    /// From one side of a line to the other.
    fn across(&mut self) -> [Pick; 2] {
        let [node] = self.line_nodes();
        let Pick::Pixel([x, y]) = self.pixel_of(self.mesh.position(node)) else { return self.pixels() };
        let (reach, angle) = (self.random.within(2.0, 80.0), self.random.within(0.0, 6.3));
        let (dy, dx) = libm::sincos(angle);
        [1.0, -self.random.within(0.2, 1.0)].map(|s| Pick::Pixel([x + s * reach * dx, y + s * reach * dy]))
    }
}

/// The neighbour of a node that lies nearest to a direction.
fn straight_on(mesh: &Mesh, node: NodeId, direction: DVec3) -> NodeId {
    let here = mesh.position(node);
    let along = |n: NodeId| (mesh.position(n) - here).normalize_or_zero().dot(direction);
    let neighbours = mesh.fan(node).flat_map(|(face, _)| mesh.face(face).nodes).filter(|&n| n != node);
    neighbours.max_by(|&a, &b| along(a).total_cmp(&along(b)).then(b.cmp(&a))).unwrap_or(node)
}
