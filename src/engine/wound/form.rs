//! FC: the cutting line on the surface, from exact signs (Lam 2016, §4.1.2, and where it errs, beyond it).
//!
//! The cutting plane Π meets the surface in the **section graph**. Its places are the nodes on Π and the points where edges cross Π;
//! its arcs are the pieces of Π within faces, and edges that lie in Π. Nearly everywhere a place has two neighbours; at a node there can be
//! more, and two picks on it are joined by at most two arcs of a closed curve. The line is the shortest way in this graph from the first pick to
//! the second (Dijkstra), which follows both arcs at once and stops when the shorter arrives; equal lengths are decided by the lower face id.
//!
//! What a place is follows from signs alone: a node is on Π iff its orient3d is zero, an edge crosses iff its nodes' signs are opposite. Algorithm
//! 4.2 of the thesis takes it that a face has one other crossing; through nodes, along edges and over coplanar faces it has not.
//! Coplanar faces are passed along their border.
//!
//! Rounding can still collapse a face that is split: see [`super::settle`].

use std::cmp::Ordering;

use rustc_hash::FxHashSet;

use super::chain::{At, Chain, Link, Point};
use super::plane::CutPlane;
use crate::geometry::predicates::Sign;
use crate::mesh::{EdgeId, FaceId, Mesh, NodeId};
use crate::report::Rejection;

/// A place that was reached, how, and how far it is from the first pick.
#[derive(Clone, Copy, Debug)]
struct Step {
    point: Point,
    previous: u32,
    /// The face of the arc that led here.
    face: FaceId,
    length: f64,
}

const START: u32 = u32::MAX;

/// What a search that does not arrive ran into.
#[derive(Default)]
struct Ends {
    boundary: Option<EdgeId>,
    last: Option<At>,
}

struct Search<'a> {
    mesh: &'a Mesh,
    plane: &'a CutPlane,
    target: Point,
    steps: Vec<Step>,
    /// Places to go on from, by index into `steps`; two, nearly always.
    open: Vec<u32>,
    reached: FxHashSet<At>,
    ends: Ends,
}

/// The line between two picks on a plane, unchecked for what rounding does to it.
pub fn trace(mesh: &Mesh, plane: &CutPlane, from: &Point, to: &Point) -> Result<Chain, Rejection> {
    if from.at == to.at && from.position == to.position {
        return Err(Rejection::new("same-point", format!("both picks are the same point of {}", from.at)));
    }
    if let Some(face) = common_face(mesh, from, to) {
        let uv = [from, to].map(|p| p.uv_in(mesh, face));
        return Ok(Chain { points: vec![*from, *to], links: vec![Link { face, uv }] });
    }
    let mut search = Search {
        mesh,
        plane,
        target: *to,
        steps: Vec::with_capacity(64),
        open: Vec::with_capacity(4),
        reached: FxHashSet::default(),
        ends: Ends::default(),
    };
    match search.run(*from) {
        Some(last) => Ok(search.chain(last)),
        None => Err(search.rejection(from)),
    }
}

/// The face with the lowest id that both points touch.
pub fn common_face(mesh: &Mesh, a: &Point, b: &Point) -> Option<FaceId> {
    let touching = |f: &FaceId| b.touches(mesh, *f);
    match a.at {
        At::Face(f) => Some(f).filter(touching),
        At::Edge(e) => mesh.edge(e).faces.into_iter().filter_map(FaceId::some).filter(touching).min(),
        At::Node(n) => mesh.fan(n).map(|(f, _)| f).filter(touching).min(),
    }
}

impl Search<'_> {
    fn run(&mut self, from: Point) -> Option<u32> {
        self.steps.push(Step { point: from, previous: START, face: FaceId::NONE, length: 0.0 });
        self.open.push(0);
        while let Some(at) = self.nearest() {
            let step = self.steps[at as usize];
            if step.point.at == self.target.at {
                return Some(at);
            }
            if self.reached.insert(step.point.at) {
                self.ends.last = Some(step.point.at);
                self.expand(at, step);
            }
        }
        None
    }

    /// Takes the open place that is nearest to the first pick; of equal ones that with the lower face.
    fn nearest(&mut self) -> Option<u32> {
        let key = |&i: &u32| (self.steps[i as usize].length, self.steps[i as usize].face);
        let order = |a: &(f64, FaceId), b: &(f64, FaceId)| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1));
        let at = (0..self.open.len()).min_by(|&i, &j| order(&key(&self.open[i]), &key(&self.open[j])))?;
        Some(self.open.remove(at))
    }

    fn go(&mut self, from: u32, point: Point, face: FaceId) {
        let step = &self.steps[from as usize];
        let length = step.length + step.point.position.distance(point.position);
        self.open.push(self.steps.len() as u32);
        self.steps.push(Step { point, previous: from, face, length });
    }

    fn side(&self, node: NodeId) -> Sign {
        self.plane.side_of(self.mesh, node)
    }

    fn expand(&mut self, at: u32, step: Step) {
        match step.point.at {
            At::Node(node) => self.around_node(at, node),
            At::Edge(edge) => self.across_edge(at, edge, step.face),
            At::Face(face) => self.out_of_face(at, face),
        }
    }

    /// From a node: through every face whose opposite edge crosses, and along every edge in the plane.
    fn around_node(&mut self, at: u32, node: NodeId) {
        if self.steps[at as usize].previous != START {
            self.ends.boundary = self.ends.boundary.or_else(|| boundary_edge(self.mesh, node));
        }
        for (face, corner) in self.mesh.fan(node) {
            let f = *self.mesh.face(face);
            if self.target.at == At::Face(face) {
                self.go(at, self.target, face);
            }
            let (next, last) = (self.side(f.nodes[(corner + 1) % 3]), self.side(f.nodes[(corner + 2) % 3]));
            if next != Ordering::Equal && next == last.reverse() {
                self.go(at, self.crossing(f.edges[(corner + 1) % 3]), face);
            }
            if next == Ordering::Equal {
                self.along(at, node, f.edges[corner]);
            }
            let before = f.edges[(corner + 2) % 3];
            if last == Ordering::Equal && self.mesh.edge(before).is_boundary() {
                self.along(at, node, before);
            }
        }
    }

    /// Along an edge that lies in the plane, unless it is inside of a coplanar region.
    fn along(&mut self, at: u32, from: NodeId, edge: EdgeId) {
        let e = self.mesh.edge(edge);
        if e.faces.into_iter().all(|f| f == FaceId::NONE || self.is_coplanar(f)) {
            return;
        }
        let face = e.faces[0].min(e.faces[1]);
        if self.target.at == At::Edge(edge) {
            self.go(at, self.target, face);
        }
        self.go(at, Point::node(self.mesh, e.other_node(from)), face);
    }

    fn is_coplanar(&self, face: FaceId) -> bool {
        self.mesh.face(face).nodes.iter().all(|&n| self.side(n) == Ordering::Equal)
    }

    /// From a point of an edge: into the face across, or, on an edge in the plane, towards both ends.
    fn across_edge(&mut self, at: u32, edge: EdgeId, came: FaceId) {
        let e = self.mesh.edge(edge);
        let sides = e.nodes.map(|n| self.side(n));
        if sides == [Ordering::Equal; 2] {
            self.along(at, e.nodes[0], edge);
            self.along(at, e.nodes[1], edge);
            return;
        }
        if e.is_boundary() && came != FaceId::NONE {
            self.ends.boundary = Some(edge);
        }
        for face in e.faces.into_iter().filter(|&f| f != came && f != FaceId::NONE) {
            if self.target.at == At::Face(face) {
                self.go(at, self.target, face);
                continue;
            }
            let f = *self.mesh.face(face);
            let Some(side) = f.side(edge) else { continue };
            let apex = f.nodes[(side + 2) % 3];
            match self.side(apex) {
                Ordering::Equal => self.go(at, Point::node(self.mesh, apex), face),
                sign if sign == self.side(f.nodes[side]) => {
                    self.go(at, self.crossing(f.edges[(side + 1) % 3]), face)
                }
                _ => self.go(at, self.crossing(f.edges[(side + 2) % 3]), face),
            }
        }
    }

    /// From a point inside of a face to where the plane leaves it.
    fn out_of_face(&mut self, at: u32, face: FaceId) {
        let f = *self.mesh.face(face);
        let sides = f.nodes.map(|n| self.side(n));
        if !sides.contains(&Ordering::Less) || !sides.contains(&Ordering::Greater) {
            // The face lies in the plane, or the plane touches it where the pick was rounded to: over the corners that lie in the plane, from where the
            // line goes on along the border. The other way round it comes from there as well.
            let touched = (0..3).filter(|&i| sides[i] == Ordering::Equal);
            touched.for_each(|i| self.go(at, Point::node(self.mesh, f.nodes[i]), face));
            return;
        }
        for i in 0..3 {
            let j = (i + 1) % 3;
            if sides[i] != Ordering::Equal && sides[i] == sides[j].reverse() {
                self.go(at, self.crossing(f.edges[i]), face);
            }
            // Over a node only where the plane passes through it into the face.
            if sides[i] == Ordering::Equal
                && sides[j] != Ordering::Equal
                && sides[j] == sides[(i + 2) % 3].reverse()
            {
                self.go(at, Point::node(self.mesh, f.nodes[i]), face);
            }
        }
    }

    fn crossing(&self, edge: EdgeId) -> Point {
        // A pick on this very edge keeps its own place, which is the same up to rounding.
        if self.target.at == At::Edge(edge) {
            return self.target;
        }
        let [a, b] = self.mesh.edge(edge).nodes.map(|n| self.mesh.position(n));
        let (t, position) = self.plane.crossing(a, b);
        Point { at: At::Edge(edge), position, weights: [1.0 - t, t, 0.0] }
    }

    fn chain(&self, last: u32) -> Chain {
        let mut chain = Chain::default();
        let mut at = last;
        while at != START {
            let step = &self.steps[at as usize];
            chain.points.push(step.point);
            if step.previous != START {
                let from = self.steps[step.previous as usize].point;
                let uv = [from, step.point].map(|p| p.uv_in(self.mesh, step.face));
                chain.links.push(Link { face: step.face, uv });
            }
            at = step.previous;
        }
        chain.points.reverse();
        chain.links.reverse();
        chain
    }

    /// Why the second pick was not reached.
    fn rejection(&self, from: &Point) -> Rejection {
        let ended = self.ends.last.map_or_else(String::new, |at| format!("; it ended at {at}"));
        if self.steps.len() == 1 {
            return Rejection::new(
                "grazing",
                format!("{} lies in the cutting plane, which has no line through it", from.at),
            );
        }
        let (a, b) = (some_node(self.mesh, from.at), some_node(self.mesh, self.target.at));
        if !connected(self.mesh, a, b) {
            return Rejection::new(
                "other-component",
                format!("{} and {} are not connected{ended}", from.at, self.target.at),
            );
        }
        if let Some(edge) = self.ends.boundary {
            return Rejection::new(
                "boundary",
                format!("the line from {} runs into the boundary at {edge}", from.at),
            );
        }
        let detail =
            format!("the section through {} does not pass through {}{ended}", from.at, self.target.at);
        Rejection::new("silhouette", detail)
    }
}

/// An edge of the boundary at a node, if it lies there.
fn boundary_edge(mesh: &Mesh, node: NodeId) -> Option<EdgeId> {
    let edges = mesh
        .fan(node)
        .flat_map(|(face, corner)| [corner, (corner + 2) % 3].map(|k| mesh.face(face).edges[k]));
    edges.into_iter().find(|&e| mesh.edge(e).is_boundary())
}

fn some_node(mesh: &Mesh, at: At) -> NodeId {
    match at {
        At::Node(n) => n,
        At::Edge(e) => mesh.edge(e).nodes[0],
        At::Face(f) => mesh.face(f).nodes[0],
    }
}

/// Whether two nodes belong to one component.
fn connected(mesh: &Mesh, a: NodeId, b: NodeId) -> bool {
    let mut seen = vec![false; mesh.face_count()];
    let mut open = vec![mesh.anchor(a)];
    while let Some(face) = open.pop() {
        if std::mem::replace(&mut seen[face.at()], true) {
            continue;
        }
        if mesh.face(face).corner(b).is_some() {
            return true;
        }
        let across = mesh.face(face).edges.into_iter().filter_map(|e| mesh.edge(e).other_face(face).some());
        open.extend(across.filter(|f| !seen[f.at()]));
    }
    false
}
