//! From face to face along the plane (Lam 2016, Algorithm 4.2), with an ε.

use std::collections::BTreeSet;

use glam::DVec3;

use super::scalar::{Vector, along, cross, distance, dot, length, sub, vector, wide};
use super::{BaselineChain, Failure, Scalar};
use crate::engine::wound::chain::At;
use crate::engine::wound::pick::Picked;
use crate::mesh::{EdgeId, FaceId, Mesh, NodeId};

/// A point that was found: what it is incident to, and where it is.
#[derive(Clone, Copy)]
struct Found<S> {
    at: At,
    position: Vector<S>,
    /// The face that led there.
    face: FaceId,
}

struct Walk<'a, S> {
    mesh: &'a Mesh,
    eye: Vector<S>,
    normal: Vector<S>,
    epsilon: S,
    target: Found<S>,
    way: Vec<Found<S>>,
    visited: BTreeSet<At>,
}

/// The shorter way that arrives, of the one towards the second pick and the one away from it.
pub(super) fn walk<S: Scalar>(
    mesh: &Mesh,
    eye: DVec3,
    picks: &[Picked; 2],
    epsilon: f64,
) -> Result<BaselineChain, Failure> {
    let (origin, epsilon) = (vector::<S>(eye), S::of(epsilon));
    let [a, b] = picks.map(|p| sub(vector::<S>(p.through), origin));
    let normal = cross(a, b);
    let size = length(normal);
    let [from, to] = picks.map(|p| incident(mesh, &p, epsilon));
    let chord = sub(to.position, from.position);
    let attempt = |towards: Vector<S>| {
        let mut walk = Walk {
            mesh,
            eye: origin,
            normal: normal.map(|v| v / size),
            epsilon,
            target: to,
            way: vec![from],
            visited: BTreeSet::from([from.at]),
        };
        walk.run(towards).map(|()| walk.chain())
    };
    match (attempt(chord), attempt(chord.map(|v| -v))) {
        (Ok(one), Ok(other)) => Ok(if other.length() < one.length() { other } else { one }),
        (Err(_), Ok(other)) => Ok(other),
        (one, _) => one,
    }
}

impl BaselineChain {
    /// Arc length.
    pub fn length(&self) -> f64 {
        self.places.windows(2).map(|w| w[0].1.distance(w[1].1)).sum()
    }
}

/// What a pick is incident to, up to ε: a node or an edge of the face that it met, or the face.
fn incident<S: Scalar>(mesh: &Mesh, pick: &Picked, epsilon: S) -> Found<S> {
    let face = match pick.point.at {
        At::Node(n) => mesh.anchor(n),
        At::Edge(e) => mesh.edge(e).faces[0],
        At::Face(f) => f,
    };
    let f = mesh.face(face);
    let position = vector::<S>(pick.point.position);
    let place = |n: NodeId| vector::<S>(mesh.position(n));
    let node = f.nodes.into_iter().find(|&n| distance(place(n), position) <= epsilon);
    let edge = f.edges.into_iter().find(|&e| {
        let [a, b] = mesh.edge(e).nodes.map(place);
        let t = dot(sub(position, a), sub(b, a)) / dot(sub(b, a), sub(b, a));
        t > S::of(0.0) && t < S::of(1.0) && distance(along(a, b, t), position) <= epsilon
    });
    let at = node.map(At::Node).or(edge.map(At::Edge)).unwrap_or(At::Face(face));
    Found { at, position: node.map_or(position, place), face }
}

fn touches(mesh: &Mesh, at: At, face: FaceId) -> bool {
    match at {
        At::Node(n) => mesh.face(face).corner(n).is_some(),
        At::Edge(e) => mesh.face(face).side(e).is_some(),
        At::Face(f) => f == face,
    }
}

/// The faces beside a place.
fn faces_at(mesh: &Mesh, at: At) -> Vec<FaceId> {
    match at {
        At::Node(n) => mesh.fan(n).map(|(face, _)| face).collect(),
        At::Edge(e) => mesh.edge(e).faces.into_iter().filter_map(FaceId::some).collect(),
        At::Face(f) => vec![f],
    }
}

impl<S: Scalar> Walk<'_, S> {
    fn run(&mut self, mut towards: Vector<S>) -> Result<(), Failure> {
        // Places are visited once, so this ends; the bound is for what cannot be.
        for _ in 0..2 * self.mesh.face_count() + 2 {
            let Some(&here) = self.way.last() else { break };
            let faces = faces_at(self.mesh, here.at);
            if let Some(&face) = faces.iter().filter(|&&f| touches(self.mesh, self.target.at, f)).min() {
                self.way.push(Found { face, ..self.target });
                return Ok(());
            }
            let next = self.next(here, &faces, towards)?;
            towards = sub(next.position, here.position);
            self.visited.insert(next.at);
            self.way.push(next);
        }
        Err(Failure::Loops)
    }

    /// Where the plane leads from here: of several places the one farthest ahead.
    fn next(&self, here: Found<S>, faces: &[FaceId], towards: Vector<S>) -> Result<Found<S>, Failure> {
        let came = if self.way.len() > 1 { here.face } else { FaceId::NONE };
        let ways = faces.iter().filter(|&&face| face != came || matches!(here.at, At::Node(_)));
        let all: Vec<Found<S>> = ways.flat_map(|&face| self.crossings(here.at, face)).collect();
        let ahead = |found: &Found<S>| dot(sub(found.position, here.position), towards);
        let mut best: Option<(S, Found<S>)> = None;
        for found in all.iter().filter(|found| !self.visited.contains(&found.at)) {
            let far = ahead(found);
            if best.is_none_or(|(least, _)| far > least) {
                best = Some((far, *found));
            }
        }
        let at_boundary = matches!(here.at, At::Edge(e) if self.mesh.edge(e).is_boundary());
        best.map(|(_, found)| found).ok_or(match (all.is_empty(), at_boundary) {
            (true, true) => Failure::DoesNotArrive,
            (true, false) => Failure::NoNextCrossing,
            (false, _) => Failure::Loops,
        })
    }

    /// Where the plane meets the edges of a face, but for where one is.
    fn crossings(&self, at: At, face: FaceId) -> Vec<Found<S>> {
        let edges = self.mesh.face(face).edges.into_iter().filter(|&e| At::Edge(e) != at);
        let places = edges.filter_map(|e| self.crossing(e)).filter(|place| place.0 != at);
        places.map(|(at, position)| Found { at, position, face }).collect()
    }

    fn crossing(&self, edge: EdgeId) -> Option<(At, Vector<S>)> {
        let nodes = self.mesh.edge(edge).nodes;
        let [a, b] = nodes.map(|n| vector::<S>(self.mesh.position(n)));
        let [ha, hb] = [a, b].map(|p| dot(self.normal, sub(p, self.eye)));
        if ha == hb {
            return None;
        }
        let (t, size) = (ha / (ha - hb), distance(a, b));
        // Said so that a NaN is none.
        let on_edge = t * size >= -self.epsilon && (t - S::of(1.0)) * size <= self.epsilon;
        if !on_edge {
            return None;
        }
        let position = along(a, b, t);
        let near = [a, b].iter().position(|&end| distance(end, position) <= self.epsilon);
        Some(match near {
            Some(end) => (At::Node(nodes[end]), [a, b][end]),
            None => (At::Edge(edge), position),
        })
    }

    fn chain(&self) -> BaselineChain {
        BaselineChain {
            places: self.way.iter().map(|found| (found.at, wide(found.position))).collect(),
            faces: self.way.iter().skip(1).map(|found| found.face).collect(),
        }
    }
}
