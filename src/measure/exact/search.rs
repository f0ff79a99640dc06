//! The shortest way through a section (Dijkstra 1959), with lengths to 192 bits.

use std::collections::{BTreeMap, BTreeSet};

use num_bigint::BigInt;

use super::number::{dot, sub};
use super::{ExactPoint, Line, Place, Refusal, Section};
use crate::engine::wound::chain::At;
use crate::mesh::{FaceId, Mesh, NodeId};

/// Lengths are cut off so many bits below the largest coordinate.
const BITS: u64 = 192;

/// How a place was reached.
struct Reached {
    length: BigInt,
    from: Option<(At, FaceId)>,
}

impl Section<'_> {
    /// The line between the picks.
    pub fn line(&self) -> Result<Line, Refusal> {
        let [from, to] = &self.picks;
        if from.at == to.at && from.point == to.point {
            return Err(Refusal::SamePoint);
        }
        if let Some(face) = common_face(self.mesh, from.at, to.at) {
            return Ok(Line { places: self.picks.to_vec(), faces: vec![face] });
        }
        let reached = self.explore(from.at, to.at);
        if reached.contains_key(&to.at) { Ok(self.walk_back(&reached)) } else { Err(self.refusal(&reached)) }
    }

    /// All places that are no farther than the second pick.
    fn explore(&self, from: At, to: At) -> BTreeMap<At, Reached> {
        let (mut reached, mut open) = (BTreeMap::new(), BTreeSet::from([(BigInt::ZERO, from)]));
        let mut best = BTreeMap::from([(from, Reached { length: BigInt::ZERO, from: None })]);
        while let Some((length, at)) = open.pop_first() {
            let Some(here) = best.remove(&at) else { continue };
            reached.insert(at, here);
            if at == to {
                break;
            }
            for arc in self.arcs(at).iter().filter(|arc| !reached.contains_key(&arc.to)) {
                let length = &length + self.distance(at, arc.to);
                if best.get(&arc.to).is_none_or(|known| length < known.length) {
                    open.insert((length.clone(), arc.to));
                    best.insert(arc.to, Reached { length, from: Some((at, arc.face)) });
                }
            }
        }
        reached
    }

    fn walk_back(&self, reached: &BTreeMap<At, Reached>) -> Line {
        let mut line = Line { places: Vec::new(), faces: Vec::new() };
        let mut next = Some(self.picks[1].at);
        while let Some(at) = next {
            line.places.extend(self.point(at).map(|point| Place { at, point }));
            next = reached.get(&at).and_then(|step| step.from.as_ref()).map(|(before, face)| {
                line.faces.push(*face);
                *before
            });
        }
        line.places.reverse();
        line.faces.reverse();
        line
    }

    /// Between two places, in units of 2^−[`Section::shift`].
    pub(super) fn distance(&self, a: At, b: At) -> BigInt {
        match (self.point(a), self.point(b)) {
            (Some(a), Some(b)) => self.between(&a, &b),
            _ => BigInt::ZERO,
        }
    }

    fn between(&self, a: &ExactPoint, b: &ExactPoint) -> BigInt {
        let scaled = |p: &ExactPoint, over: &BigInt| p.x.each_ref().map(|x| x * over);
        let d = sub(&scaled(a, &b.over), &scaled(b, &a.over));
        (dot(&d, &d) << (2 * self.shift())).sqrt() / (&a.over * &b.over)
    }

    /// Bits that lengths have beyond the unit.
    pub(super) fn shift(&self) -> u64 {
        let largest = self.picks.iter().flat_map(|pick| pick.point.x.iter().map(BigInt::bits)).max();
        BITS.saturating_sub(largest.unwrap_or(0))
    }

    /// The length of a way through given places; each link is less than one too short.
    pub(super) fn length(&self, way: &[At]) -> BigInt {
        way.windows(2).map(|ends| self.distance(ends[0], ends[1])).sum()
    }

    fn refusal(&self, reached: &BTreeMap<At, Reached>) -> Refusal {
        let [from, to] = self.picks.each_ref().map(|pick| pick.at);
        if self.arcs(from).is_empty() {
            Refusal::Grazing
        } else if !connected(self.mesh, from, to) {
            Refusal::OtherComponent
        } else if reached.keys().any(|&at| at != from && is_on_boundary(self.mesh, at)) {
            Refusal::Boundary
        } else {
            Refusal::Silhouette
        }
    }
}

/// The lowest face that has both elements.
fn common_face(mesh: &Mesh, a: At, b: At) -> Option<FaceId> {
    (0..mesh.face_count()).map(FaceId::of).find(|&f| touches(mesh, f, a) && touches(mesh, f, b))
}

fn touches(mesh: &Mesh, face: FaceId, at: At) -> bool {
    match at {
        At::Node(n) => mesh.face(face).nodes.contains(&n),
        At::Edge(e) => mesh.face(face).edges.contains(&e),
        At::Face(f) => f == face,
    }
}

fn is_on_boundary(mesh: &Mesh, at: At) -> bool {
    let mut edges = mesh.edges().iter().filter(|e| e.faces.contains(&FaceId::NONE));
    match at {
        At::Node(n) => edges.any(|e| e.nodes.contains(&n)),
        At::Edge(e) => mesh.edge(e).faces.contains(&FaceId::NONE),
        At::Face(_) => false,
    }
}

/// Whether two elements belong to one piece of surface: the smallest node that each is connected to is the same.
fn connected(mesh: &Mesh, a: At, b: At) -> bool {
    let mut lowest: Vec<u32> = (0..mesh.node_count() as u32).collect();
    loop {
        let before = lowest.clone();
        for edge in mesh.edges() {
            let [p, q] = edge.nodes.map(NodeId::at);
            let least = lowest[p].min(lowest[q]);
            (lowest[p], lowest[q]) = (least, least);
        }
        if before == lowest {
            let root = |at: At| lowest[some_node(mesh, at).at()];
            return root(a) == root(b);
        }
    }
}

fn some_node(mesh: &Mesh, at: At) -> NodeId {
    match at {
        At::Node(n) => n,
        At::Edge(e) => mesh.edge(e).nodes[0],
        At::Face(f) => mesh.face(f).nodes[0],
    }
}
