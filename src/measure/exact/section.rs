//! The plane, and its section with the surface: which nodes lie where, which edges cross, and the graph of places and arcs.
//!
//! Notation: e the eye, a and b the points on the rays, n = (a − e) × (b − e), and h(p) = n · (p − e) the height of p, all of them integers. A node is in
//! the plane iff h = 0; an edge from p to q crosses iff h(p) and h(q) have opposite signs, at (h(p) q − h(q) p) / (h(p) − h(q)). The ray e + s (a − e) meets
//! the plane of a face with normal m through c at s = m · (c − e) / m · (a − e).

use std::cmp::Ordering;
use std::collections::BTreeMap;

use glam::DVec3;
use num_bigint::BigInt;

use super::number::{ExactPoint, Unit, Vector, combine, cross, dot, is_zero, sub};
use super::{Datum, Place, Question, Refusal};
use crate::engine::wound::chain::At;
use crate::mesh::{Edge, EdgeId, FaceId, Mesh, NodeId};

/// A way from one place to the next, within or along a face.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Arc {
    pub(super) to: At,
    pub(super) face: FaceId,
}

/// The section of the plane of a question with a mesh.
#[derive(Clone, Debug)]
pub struct Section<'a> {
    pub(super) mesh: &'a Mesh,
    pub(super) unit: Unit,
    eye: Vector,
    normal: Vector,
    nodes: Vec<Vector>,
    heights: Vec<BigInt>,
    pub(super) picks: [Place; 2],
    arcs: BTreeMap<At, Vec<Arc>>,
}

impl<'a> Section<'a> {
    /// The section of a question. Refused: a plane that is none, and picks that do not lie where they say they do.
    pub fn of(mesh: &'a Mesh, question: &Question) -> Result<Self, Refusal> {
        let through = question.picks.map(|pick| pick.through);
        let points = through.into_iter().chain([question.eye]);
        let unit = Unit::of(points.chain(mesh.positions().iter().copied()));
        let (eye, [a, b]) = (unit.vector(question.eye), through.map(|p| unit.vector(p)));
        let normal = cross(&sub(&a, &eye), &sub(&b, &eye));
        if is_zero(&normal) {
            return Err(Refusal::DegeneratePlane);
        }
        let nodes: Vec<Vector> = mesh.positions().iter().map(|&p| unit.vector(p)).collect();
        let heights = nodes.iter().map(|p| dot(&normal, &sub(p, &eye))).collect();
        let nowhere = question.picks.map(|d| Place { at: d.at, point: unit.point(1.into(), eye.clone()) });
        let mut section =
            Self { mesh, unit, eye, normal, nodes, heights, picks: nowhere, arcs: BTreeMap::new() };
        for (i, datum) in question.picks.iter().enumerate() {
            let point = section.locate(datum).ok_or(Refusal::NotPosed(datum.at))?;
            section.picks[i].point = point;
        }
        section.connect();
        Ok(section)
    }

    /// On which side of the plane a node lies.
    pub fn side(&self, node: NodeId) -> Ordering {
        self.heights[node.at()].cmp(&BigInt::ZERO)
    }

    /// Whether the plane passes through the inside of an edge.
    pub fn crosses(&self, edge: EdgeId) -> bool {
        let [a, b] = self.mesh.edge(edge).nodes.map(|n| self.side(n));
        a != Ordering::Equal && a == b.reverse()
    }

    fn lies_in(&self, edge: &Edge) -> bool {
        edge.nodes.iter().all(|&n| self.side(n) == Ordering::Equal)
    }

    fn is_coplanar(&self, face: FaceId) -> bool {
        self.mesh.face(face).nodes.iter().all(|&n| self.side(n) == Ordering::Equal)
    }

    /// The exact point of a place; `None` where the plane has none there.
    pub fn point(&self, at: At) -> Option<ExactPoint> {
        if let Some(pick) = self.picks.iter().find(|pick| pick.at == at) {
            return Some(pick.point.clone());
        }
        match at {
            At::Node(n) => (self.side(n) == Ordering::Equal).then(|| self.node(n)),
            At::Edge(e) => self.crosses(e).then(|| self.crossing(e)),
            At::Face(_) => None,
        }
    }

    fn node(&self, node: NodeId) -> ExactPoint {
        self.unit.point(1.into(), self.nodes[node.at()].clone())
    }

    fn crossing(&self, edge: EdgeId) -> ExactPoint {
        let [p, q] = self.mesh.edge(edge).nodes.map(NodeId::at);
        let (hp, hq) = (&self.heights[p], &self.heights[q]);
        self.unit.point(hp - hq, combine(&self.nodes[q], hp, &self.nodes[p], &-hq))
    }

    /// Where a pick lies exactly, if it lies where it says.
    fn locate(&self, datum: &Datum) -> Option<ExactPoint> {
        let through = self.unit.vector(datum.through);
        match datum.at {
            At::Node(n) => (self.side(n) == Ordering::Equal).then(|| self.node(n)),
            At::Edge(e) if self.crosses(e) => Some(self.crossing(e)),
            At::Edge(e) => self.lies_in(&self.mesh.edge(e)).then(|| self.along(e, &through)).flatten(),
            At::Face(f) => self.inside(f, &through),
        }
    }

    /// The point of an edge in the plane where the ray meets it, or else the foot of the ray's second point; inside of the edge.
    fn along(&self, edge: EdgeId, through: &Vector) -> Option<ExactPoint> {
        let [p, q] = self.mesh.edge(edge).nodes.map(|n| &self.nodes[n.at()]);
        let (u, d) = (sub(q, p), sub(through, &self.eye));
        let turn = cross(&u, &d);
        // p + s u = e + r d: across d, seen along the plane's normal.
        let (s, over) = if is_zero(&turn) {
            (dot(&u, &sub(through, p)), dot(&u, &u))
        } else {
            (dot(&cross(&sub(&self.eye, p), &d), &turn), dot(&turn, &turn))
        };
        let rest = &over - &s;
        let inside = s > BigInt::ZERO && rest > BigInt::ZERO;
        inside.then(|| self.unit.point(over, combine(p, &rest, q, &s)))
    }

    /// The point inside a face where the ray meets it; on a ray along the face its second point.
    fn inside(&self, face: FaceId, through: &Vector) -> Option<ExactPoint> {
        let corners = self.mesh.face(face).nodes.map(|n| &self.nodes[n.at()]);
        let m = cross(&sub(corners[1], corners[0]), &sub(corners[2], corners[0]));
        let d = sub(through, &self.eye);
        let (fall, s) = (dot(&m, &d), dot(&m, &sub(corners[0], &self.eye)));
        let point = if fall != BigInt::ZERO {
            let x = combine(&self.eye, &fall, &d, &s);
            self.unit.point(fall, x)
        } else if s == BigInt::ZERO {
            self.unit.point(1.into(), through.clone())
        } else {
            return None;
        };
        let turns = [0, 1, 2].map(|i| turn(&m, corners[i], corners[(i + 1) % 3], &point));
        turns.iter().all(|t| *t == Ordering::Greater).then_some(point)
    }

    /// The arcs that leave a place.
    pub(super) fn arcs(&self, at: At) -> &[Arc] {
        self.arcs.get(&at).map_or(&[], Vec::as_slice)
    }

    /// Makes the graph.
    fn connect(&mut self) {
        for face in (0..self.mesh.face_count()).map(FaceId::of) {
            self.connect_face(face);
        }
        for edge in (0..self.mesh.edge_count()).map(EdgeId::of) {
            self.connect_edge(edge);
        }
    }

    fn connect_face(&mut self, face: FaceId) {
        let f = *self.mesh.face(face);
        let nodes = f.nodes.into_iter().filter(|&n| self.side(n) == Ordering::Equal).map(At::Node);
        let edges = f.edges.into_iter().filter(|&e| self.crosses(e)).map(At::Edge);
        let border: Vec<At> = nodes.chain(edges).collect();
        let pick = self.picks.iter().map(|pick| pick.at).find(|&at| at == At::Face(face));
        match (pick, &border[..]) {
            // Straight on, unless along an edge.
            (None, &[a, b @ At::Edge(_)]) => self.join(a, b, face),
            // A pick divides what it lies on; in a coplanar face it is joined with the corners.
            (Some(pick), border) => border.iter().for_each(|&at| self.join(pick, at, face)),
            _ => {}
        }
    }

    fn connect_edge(&mut self, edge: EdgeId) {
        let e = self.mesh.edge(edge);
        let leaves = |f: FaceId| f != FaceId::NONE && !self.is_coplanar(f);
        if !self.lies_in(&e) || !e.faces.into_iter().any(leaves) {
            return;
        }
        let (face, [a, b]) = (e.faces[0].min(e.faces[1]), e.nodes.map(At::Node));
        match self.picks.iter().map(|pick| pick.at).find(|&at| at == At::Edge(edge)) {
            None => self.join(a, b, face),
            Some(pick) => [a, b].into_iter().for_each(|end| self.join(end, pick, face)),
        }
    }

    fn join(&mut self, a: At, b: At, face: FaceId) {
        self.arcs.entry(a).or_default().push(Arc { to: b, face });
        self.arcs.entry(b).or_default().push(Arc { to: a, face });
    }

    /// How far a position is from the plane.
    pub(super) fn off_plane(&self, position: DVec3) -> f64 {
        let eye = self.unit.point(1.into(), self.eye.clone());
        off(&eye, &self.normal, position)
    }

    /// How far an element is from the plane: nothing where the plane meets it, else what its nearest node is.
    pub fn apart(&self, at: At) -> f64 {
        let height = |n: NodeId| self.off_plane(self.mesh.position(n));
        match at {
            _ if self.point(at).is_some() => 0.0,
            At::Node(n) => height(n),
            At::Edge(e) => self.mesh.edge(e).nodes.map(height).into_iter().fold(f64::INFINITY, f64::min),
            At::Face(f) => self.mesh.face(f).nodes.map(height).into_iter().fold(f64::INFINITY, f64::min),
        }
    }

    /// How far a position is from the node, from the line of the edge or from the plane of the face.
    pub(super) fn off_element(&self, at: At, position: DVec3) -> f64 {
        match at {
            At::Node(n) => self.node(n).distance(position),
            At::Edge(e) => {
                let [p, q] = self.mesh.edge(e).nodes;
                let (offset, unit) = self.node(p).offset(position);
                let u = sub(&self.nodes[q.at()], &self.nodes[p.at()]);
                let away = cross(&offset, &u);
                root_of_ratio(&dot(&away, &away), &dot(&u, &u), unit)
            }
            At::Face(f) => {
                let [a, b, c] = self.mesh.face(f).nodes;
                let [u, v] = [b, c].map(|n| sub(&self.nodes[n.at()], &self.nodes[a.at()]));
                off(&self.node(a), &cross(&u, &v), position)
            }
        }
    }
}

/// How far a position is from the plane through a point with a normal.
fn off(origin: &ExactPoint, normal: &Vector, position: DVec3) -> f64 {
    let (offset, unit) = origin.offset(position);
    let h = dot(normal, &offset);
    root_of_ratio(&(&h * &h), &dot(normal, normal), unit)
}

/// √(numerator / denominator), in a unit.
fn root_of_ratio(numerator: &BigInt, denominator: &BigInt, unit: Unit) -> f64 {
    // 2^256 keeps the digits of a root that is less than one unit.
    let root = ((numerator << 256u64) / denominator.max(&BigInt::from(1))).sqrt();
    unit.ratio(&root, &(BigInt::from(1) << 128u64))
}

/// How a, b and a point turn as seen against a normal.
fn turn(normal: &Vector, a: &Vector, b: &Vector, point: &ExactPoint) -> Ordering {
    let to_point = [0, 1, 2].map(|k| &point.x[k] - &a[k] * &point.over);
    dot(normal, &cross(&sub(b, a), &to_point)).cmp(&BigInt::ZERO)
}
