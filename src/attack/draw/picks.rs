//! Pairs of picks that have something to do with each other: in one face or in neighbours, in line with a node, all but equal.

use glam::DVec3;

use super::Dice;
use crate::engine::wound::Pick;
use crate::geometry::predicates::orient3d;
use crate::mesh::{Edge, EdgeId, FaceId, Mesh, NodeId};

/// What a pick is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Class {
    Node,
    Edge,
    Face,
}

const CLASSES: [Class; 3] = [Class::Node, Class::Edge, Class::Face];

/// Places along an edge.
const ALONG: [f64; 8] = [0.5, 0.25, 0.75, 0.125, 1.0 / 3.0, 1e-9, 1.0 - f64::EPSILON / 2.0, 1.0 - 1e-12];
/// Weights of a face's second and third corner.
const WITHIN: [[f64; 2]; 8] = [
    [0.25, 0.25],
    [0.5, 0.25],
    [0.25, 0.5],
    [0.125, 0.125],
    [1.0 / 3.0, 1.0 / 3.0],
    [1e-9, 0.5],
    [0.75, 0.125],
    [1e-12, 1e-12],
];
/// How near picks are that are nearly equal, in edges.
const NEARLY: [f64; 3] = [1e-10, 1.0 / 1_099_511_627_776.0, 1e-13];

/// Draws pairs of picks on a mesh as it is now.
pub(super) struct Picker<'a, 'b> {
    pub(super) mesh: &'a Mesh,
    pub(super) gutter: &'a [FaceId],
    pub(super) eye: DVec3,
    pub(super) dice: &'a mut Dice<'b>,
}

impl Picker<'_, '_> {
    pub(super) fn pair(&mut self) -> [Pick; 2] {
        let classes = [(); 2].map(|()| self.dice.one_of(CLASSES));
        let face = self.face();
        match self.dice.below(12) {
            0..=2 => self.in_both(classes, [face, face]),
            10 | 11 => {
                let face = self.edge_on().unwrap_or(face);
                self.in_both(classes, [face, face])
            }
            3 => {
                let next = self.neighbour(face);
                self.in_both(classes, [face, next])
            }
            4 => self.nearly_equal(classes, face),
            5 | 6 => self.through_a_node(classes[0], face),
            7 => self.in_line(face),
            _ => {
                let other = self.face();
                self.in_both(classes, [face, other])
            }
        }
    }

    fn in_both(&mut self, [a, b]: [Class; 2], faces: [FaceId; 2]) -> [Pick; 2] {
        [self.pick(a, faces[0]), self.pick(b, faces[1])]
    }

    /// Any face, or one of a kind that there are few of.
    fn face(&mut self) -> FaceId {
        let any = FaceId::of(self.dice.below(self.mesh.face_count()));
        match self.dice.below(8) {
            0 | 1 if !self.gutter.is_empty() => self.dice.any_of(self.gutter).unwrap_or(any),
            2 => self.thinnest(),
            3 => self.at_an_edge(|mesh, edge| edge.is_boundary() || mesh.is_seam(edge)).unwrap_or(any),
            4 | 5 => self.edge_on().unwrap_or(any),
            _ => any,
        }
    }

    /// A face that is seen edge-on: every cut within it lies in its plane.
    fn edge_on(&mut self) -> Option<FaceId> {
        let (first, count) = (self.dice.below(self.mesh.face_count()), self.mesh.face_count());
        let is_edge_on = |f: &FaceId| {
            let [a, b, c] = self.mesh.triangle(*f);
            orient3d(a, b, c, self.eye).is_eq()
        };
        (0..count).map(|i| FaceId::of((first + i) % count)).find(is_edge_on)
    }

    fn thinnest(&self) -> FaceId {
        let all = (0..self.mesh.face_count()).map(FaceId::of);
        all.min_by(|&f, &g| flatness(self.mesh, f).total_cmp(&flatness(self.mesh, g))).unwrap_or(FaceId(0))
    }

    /// A face beside an edge that is wanted.
    fn at_an_edge(&mut self, wanted: impl Fn(&Mesh, &Edge) -> bool) -> Option<FaceId> {
        let first = self.dice.below(self.mesh.edge_count());
        let edges = self.mesh.edges();
        let found = edges[first..].iter().chain(&edges[..first]).find(|edge| wanted(self.mesh, edge))?;
        found.faces.into_iter().find_map(FaceId::some)
    }

    fn neighbour(&mut self, face: FaceId) -> FaceId {
        let edge = self.mesh.face(face).edges[self.dice.below(3)];
        self.mesh.edge(edge).other_face(face).some().unwrap_or(face)
    }

    pub(super) fn pick(&mut self, class: Class, face: FaceId) -> Pick {
        let f = self.mesh.face(face);
        match class {
            Class::Node => Pick::Node(f.nodes[self.dice.below(3)]),
            Class::Edge => Pick::Edge(f.edges[self.dice.below(3)], self.along()),
            Class::Face => {
                let [u, v] = self.within();
                Pick::Face(face, u, v)
            }
        }
    }

    fn along(&mut self) -> f64 {
        match self.dice.below(4) {
            0 => self.dice.unit(),
            1 => self.dice.inside(),
            _ => self.dice.one_of(ALONG),
        }
    }

    fn within(&mut self) -> [f64; 2] {
        let [u, v] = match self.dice.below(4) {
            0 => [self.dice.unit(), self.dice.unit()],
            1 => [self.dice.inside(), self.dice.inside()],
            _ => self.dice.one_of(WITHIN),
        };
        // Both halves of the square of u and v are the face.
        if u + v > 1.0 { [1.0 - u, 1.0 - v] } else { [u, v] }
    }

    /// Two picks around one corner of a face, one edge or one place in it, next to each other.
    fn nearly_equal(&mut self, [a, b]: [Class; 2], face: FaceId) -> [Pick; 2] {
        let (near, corner) = (self.dice.one_of(NEARLY), self.dice.below(3));
        let f = self.mesh.face(face);
        let (node, out, back) = (f.nodes[corner], f.edges[corner], f.edges[(corner + 2) % 3]);
        let beside = |corner: usize, near: f64| {
            // All weight at a corner but for `near` at each of the others.
            let mut weights = [near; 3];
            weights[corner] = 1.0 - 2.0 * near;
            Pick::Face(face, weights[1], weights[2])
        };
        let on = |edge: EdgeId, near: f64| {
            Pick::Edge(edge, if self.mesh.edge(edge).nodes[0] == node { near } else { 1.0 - near })
        };
        match (a, b) {
            (Class::Node, Class::Node) => self.shortest_edge().nodes.map(Pick::Node),
            (Class::Node, Class::Edge) => [Pick::Node(node), on(out, near)],
            (Class::Edge, Class::Node) => [on(back, near), Pick::Node(node)],
            (Class::Node, Class::Face) => [Pick::Node(node), beside(corner, near)],
            (Class::Face, Class::Node) => [beside(corner, near), Pick::Node(node)],
            (Class::Edge, Class::Edge) if self.dice.once_in(2) => [on(out, near), on(out, 2.0 * near)],
            (Class::Edge, Class::Edge) => [on(back, near), on(out, near)],
            (Class::Edge, Class::Face) => [on(out, near), beside(corner, near)],
            (Class::Face, Class::Edge) => [beside(corner, near), on(back, near)],
            (Class::Face, Class::Face) => {
                let [u, v] = self.within();
                [Pick::Face(face, u, v), Pick::Face(face, u * (1.0 - near), v)]
            }
        }
    }

    fn shortest_edge(&self) -> Edge {
        let length = |e: &Edge| self.mesh.position(e.nodes[0]).distance(self.mesh.position(e.nodes[1]));
        let all = self.mesh.edges().iter().copied();
        all.min_by(|a, b| length(a).total_cmp(&length(b))).unwrap_or(self.mesh.edge(EdgeId(0)))
    }

    /// From a pick in or on a face through a corner of it, to what lies across.
    fn through_a_node(&mut self, class: Class, face: FaceId) -> [Pick; 2] {
        let corner = self.dice.below(3);
        let (f, share) = (*self.mesh.face(face), self.dice.one_of([0.25, 0.5, 0.125]));
        let from = match class {
            Class::Node => Pick::Node(f.nodes[(corner + 1) % 3]),
            Class::Edge => Pick::Edge(f.edges[(corner + 1) % 3], share),
            Class::Face => {
                let mut weights = [0.25; 3];
                weights[(corner + 1) % 3] = share;
                weights[corner] = 0.75 - share;
                Pick::Face(face, weights[1], weights[2])
            }
        };
        let length = self.dice.one_of([1.0, 0.5, 0.25, 2.0]);
        let node = f.nodes[corner];
        let beyond = place(self.mesh, from).and_then(|p| {
            let at = self.mesh.position(node);
            located(self.mesh, node, at + (at - p) * length)
        });
        match beyond {
            Some(to) => [from, to],
            None => {
                let other = self.face();
                [from, self.pick(Class::Node, other)]
            }
        }
    }

    /// From node to node along edges, as straight as there are any.
    fn in_line(&mut self, face: FaceId) -> [Pick; 2] {
        let f = self.mesh.face(face);
        let corner = self.dice.below(3);
        let [from, mut to] = [f.nodes[corner], f.nodes[(corner + 1) % 3]];
        let direction = self.mesh.position(to) - self.mesh.position(from);
        for _ in 0..self.dice.below(4) {
            to = straight_on(self.mesh, to, direction);
        }
        [Pick::Node(from), Pick::Node(to)]
    }
}

/// Height over the longest side.
fn flatness(mesh: &Mesh, face: FaceId) -> f64 {
    let [a, b, c] = mesh.triangle(face);
    let sides = [a.distance_squared(b), b.distance_squared(c), c.distance_squared(a)];
    (b - a).cross(c - a).length() / sides.into_iter().fold(0.0, f64::max)
}

/// Where a pick by ids lies.
fn place(mesh: &Mesh, pick: Pick) -> Option<DVec3> {
    Some(match pick {
        Pick::Node(n) => mesh.position(n),
        Pick::Edge(e, t) => {
            let [a, b] = mesh.edge(e).nodes.map(|n| mesh.position(n));
            a + (b - a) * t
        }
        Pick::Face(f, u, v) => {
            let [a, b, c] = mesh.triangle(f);
            a + (b - a) * u + (c - a) * v
        }
        Pick::Pixel(_) => return None,
    })
}

/// A point in one of the faces around a node, or on the border of one, if it lies there exactly.
fn located(mesh: &Mesh, node: NodeId, point: DVec3) -> Option<Pick> {
    mesh.fan(node).find_map(|(face, _)| {
        let [a, b, c] = mesh.triangle(face);
        let (normal, p) = ((b - a).cross(c - a), point - a);
        let area = normal.length_squared();
        let u = p.cross(c - a).dot(normal) / area;
        let v = (b - a).cross(p).dot(normal) / area;
        let inside = u >= 0.0 && v >= 0.0 && u + v <= 1.0 && a + (b - a) * u + (c - a) * v == point;
        inside.then_some(Pick::Face(face, u, v))
    })
}

/// The neighbour of a node that lies nearest to a direction.
fn straight_on(mesh: &Mesh, node: NodeId, direction: DVec3) -> NodeId {
    let here = mesh.position(node);
    let along = |n: NodeId| (mesh.position(n) - here).normalize_or_zero().dot(direction);
    let neighbours = mesh.fan(node).flat_map(|(face, _)| mesh.face(face).nodes).filter(|&n| n != node);
    neighbours.max_by(|&a, &b| along(a).total_cmp(&along(b)).then(b.cmp(&a))).unwrap_or(node)
}
