//! Surface coordinates: how far along the line and how far from it every corner of the faces around it lies, measured on the skin.
//!
//! **Notation.** (s, d) as in [`canvas::job`](crate::canvas::job): s the arc length along the line, d the signed distance, positive to its left as
//! seen from outside. On the plane of (s, d) the line is the segment from (0, 0) to (L, 0).
//!
//! **The idea.** The skin around the line is unrolled onto that plane, face by face. In a link's own face the coordinates are exact: s runs
//! along the link and on beyond its ends, d is measured across. From there a front goes outward over the edges, the nearest to the line first,
//! ties by the lower face id; the third corner of each next face is found by laying the face down beside the known side, with its true edge
//! lengths ([`unfold`]). A node gets its coordinates once, so they are continuous wherever charts meet.
//!
//! **Exactness.** Where the skin is developable and the line straight on it, these are the coordinates of the unrolled plane, but for rounding.
//! Where the line bends on the surface by an angle β (the section of a plane is seldom a geodesic), nodes near the bend go by the nearest
//! link, the earlier of two at the same distance: at a distance r outside of the bend s is off by at most r β, and d by r (1 − cos β). Inside of
//! the bend what two links claim is folded into one row of faces. Where the skin curves, each face keeps its shape as laid down, and what
//! does not fit is taken up by the faces in which parts of the front meet.
//!
//! **Fronts that meet.** Behind an obstacle, such as the far side of a finger, two parts of the front bring coordinates that have nothing to do with
//! each other. A face whose third corner is known, but not where the face would lay it, keeps its own; such nodes are
//! [`Walk::torn`]. Where the skin curves strongly the front may be led back towards the line, though the way there is long. A face that would lie
//! nearer to the line than the side over which one comes to it is refused from there ([`Walk::refused`]) if a tear led to it, or if its corner would
//! lie at less than half of its straight distance in space; and so is one whose corner would lie beside the line, though it is beyond the patch.
//!
//! The thesis (Lam 2016, §5.3.2.1) collects faces by the texture distance of their corners from the centre of a link, recursively and twice; here both
//! radii come out of one walk. It never goes over a gutter or a boundary, its work is that of the faces found, and it is done when the front is
//! beyond the radius.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use glam::{DVec2, DVec3};
use rustc_hash::{FxHashMap, FxHashSet};

use super::chain::{At, Chain, Point};
use super::flat::{Flat, sides_to_line, to_line, triangle_to_line, unfold};
use super::settle::SNAP_ULPS;
use crate::geometry::{distance_to_segment, ulp, unit_normal};
use crate::mesh::{EdgeId, FaceId, Mesh, NodeId, Surface};

/// The part of a line in one skin face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SkinLink {
    /// Which link of the chain it is.
    pub link: usize,
    /// The face: the link's own, or the one across where a link runs along the border of a gutter.
    pub face: FaceId,
    /// Arc length at its beginning.
    pub start: f64,
    /// Its length.
    pub length: f64,
}

/// Arc length at every point of a chain.
pub fn arc_lengths(chain: &Chain) -> Vec<f64> {
    let mut total = 0.0;
    let steps = chain.points.windows(2).map(|w| w[0].position.distance(w[1].position));
    std::iter::once(0.0)
        .chain(steps.map(|step| {
            total += step;
            total
        }))
        .collect()
}

/// The links that lie in skin and are longer than what rounding makes of a point: shorter ones have neither a direction nor a density.
pub fn skin_links(mesh: &Mesh, chain: &Chain, arc: &[f64], largest: f64) -> Vec<SkinLink> {
    let least = SNAP_ULPS * ulp(largest);
    let skin = |link: usize| {
        let length = chain.points[link].position.distance(chain.points[link + 1].position);
        let face = skin_face(mesh, chain, link)?;
        (length > least).then_some(SkinLink { link, face, start: arc[link], length })
    };
    (0..chain.links.len()).filter_map(skin).collect()
}

fn skin_face(mesh: &Mesh, chain: &Chain, link: usize) -> Option<FaceId> {
    let is_skin = |f: &FaceId| mesh.face(*f).surface == Surface::Skin;
    let own = chain.links[link].face;
    let [a, b] = [link, link + 1].map(|i| chain.points[i].at);
    let across = || {
        let edge = super::chain::common_edge(mesh, own, a, b)?;
        mesh.edge(edge).other_face(own).some()
    };
    Some(own).filter(is_skin).or_else(|| across().filter(is_skin))
}

/// A face laid down on the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placed {
    /// The face.
    pub face: FaceId,
    /// (s, d) of its corners.
    pub at: Flat,
    /// How far its part of the plane is from the line.
    pub distance: f64,
    /// The same of its sides, from each corner to the next.
    pub sides: [f64; 3],
    /// Whether it was laid down beside, or is itself, a face with coordinates of its own.
    pub torn: bool,
}

/// The skin around a line.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Walk {
    /// The faces within the radius, in the order in which the front came over them.
    pub faces: Vec<Placed>,
    /// Nodes that have other coordinates in some of their faces, since fronts meet there; ascending.
    pub torn: Vec<NodeId>,
    /// Faces that would have been folded back over others, or that lie beyond sides of no direction; ascending.
    pub refused: Vec<FaceId>,
}

/// Lays down every face within a radius of a line, beginning with its links.
pub fn walk(mesh: &Mesh, chain: &Chain, links: &[SkinLink], length: f64, radius: f64) -> Walk {
    let nodes = around_links(mesh, chain, links);
    let mut front = Front::new(mesh, chain, length, radius, nodes);
    front.begin(links);
    while front.step() {}
    let mut torn: Vec<NodeId> = front.torn.into_iter().collect();
    torn.sort_unstable();
    let mut refused: Vec<FaceId> = front.refused.difference(&front.seen).copied().collect();
    refused.sort_unstable();
    Walk { faces: front.faces, torn, refused }
}

/// The coordinates of the nodes of the links' faces: each by the link nearest to it, the line's own nodes by their arc length.
fn around_links(mesh: &Mesh, chain: &Chain, links: &[SkinLink]) -> FxHashMap<NodeId, DVec2> {
    let mut nearest: FxHashMap<NodeId, (f64, DVec2)> = FxHashMap::default();
    for link in links {
        let Some(frame) = LinkFrame::new(mesh, chain, link) else { continue };
        for node in mesh.face(link.face).nodes {
            let (distance, at) = frame.place(mesh.position(node));
            let known = nearest.entry(node).or_insert((f64::INFINITY, at));
            if distance < known.0 {
                *known = (distance, at);
            }
        }
    }
    let mut nodes: FxHashMap<NodeId, DVec2> = nearest.into_iter().map(|(n, (_, at))| (n, at)).collect();
    for link in links {
        let arc = [link.start, link.start + link.length];
        for (i, s) in arc.into_iter().enumerate() {
            if let At::Node(node) = chain.points[link.link + i].at {
                nodes.insert(node, DVec2::new(s, 0.0));
            }
        }
    }
    nodes
}

/// A link's own coordinates in its face.
struct LinkFrame {
    origin: DVec3,
    start: f64,
    length: f64,
    along: DVec3,
    left: DVec3,
}

impl LinkFrame {
    fn new(mesh: &Mesh, chain: &Chain, link: &SkinLink) -> Option<Self> {
        let normal = unit_normal(mesh.triangle(link.face))?;
        let [from, to] = [link.link, link.link + 1].map(|i| chain.points[i].position);
        // Scaled first: the square of a tiny normal would underflow.
        let scaled = |v: DVec3| (v / v.abs().max_element()).try_normalize();
        let along = scaled(to - from)?;
        let left = scaled(normal.cross(along))?;
        Some(Self { origin: from, start: link.start, length: link.length, along, left })
    }

    /// How far a point of the face's plane is from the link, and its coordinates.
    fn place(&self, point: DVec3) -> (f64, DVec2) {
        let from = point - self.origin;
        let at = DVec2::new(from.dot(self.along), from.dot(self.left));
        (to_line(at, self.length), DVec2::new(self.start + at.x, at.y))
    }
}

/// A side over which the front may go: its distance (as ordered bits), the face beyond, the face before and its side.
type Step = Reverse<(u64, FaceId, u32, u8)>;

struct Front<'a> {
    mesh: &'a Mesh,
    line: Vec<DVec3>,
    /// Edges on which the line has a point: they are at no distance from it, however they are laid down.
    on_line: FxHashSet<EdgeId>,
    length: f64,
    radius: f64,
    nodes: FxHashMap<NodeId, DVec2>,
    seen: FxHashSet<FaceId>,
    steps: BinaryHeap<Step>,
    faces: Vec<Placed>,
    torn: FxHashSet<NodeId>,
    refused: FxHashSet<FaceId>,
}

impl<'a> Front<'a> {
    fn new(mesh: &'a Mesh, chain: &Chain, length: f64, radius: f64, nodes: FxHashMap<NodeId, DVec2>) -> Self {
        let line = chain.points.iter().map(|p| p.position).collect();
        let on_edge = |p: &Point| if let At::Edge(e) = p.at { Some(e) } else { None };
        let on_line = chain.points.iter().filter_map(on_edge).collect();
        let (seen, steps, torn, refused) = Default::default();
        Self { mesh, line, on_line, length, radius, nodes, seen, steps, faces: Vec::new(), torn, refused }
    }

    /// Lays down the links' faces.
    fn begin(&mut self, links: &[SkinLink]) {
        for link in links {
            let corners = self.mesh.face(link.face).nodes.map(|n| self.nodes.get(&n).copied());
            if let [Some(a), Some(b), Some(c)] = corners
                && self.seen.insert(link.face)
            {
                let sides = sides_to_line(&[a, b, c], self.length);
                self.faces.push(Placed { face: link.face, at: [a, b, c], distance: 0.0, sides, torn: false });
            }
        }
        for i in 0..self.faces.len() {
            self.push_sides(i);
        }
    }

    /// Goes over the nearest side. False when there is none left.
    fn step(&mut self) -> bool {
        let Some(Reverse((_, face, from, side))) = self.steps.pop() else { return false };
        if !self.seen.contains(&face)
            && let Some(placed) = self.place(face, from as usize, side as usize)
        {
            self.seen.insert(face);
            self.faces.push(placed);
            self.push_sides(self.faces.len() - 1);
        }
        true
    }

    /// Lays a face down beside one that lies there.
    fn place(&mut self, face: FaceId, from: usize, side: usize) -> Option<Placed> {
        let before = &self.faces[from];
        let edge = self.mesh.face(before.face).edges[side];
        let f = self.mesh.face(face);
        let first = f.side(edge)?;
        let [second, third] = [(first + 1) % 3, (first + 2) % 3];
        let mut at = [DVec2::ZERO; 3];
        // The neighbour runs along the edge the other way.
        (at[first], at[second]) = (before.at[(side + 1) % 3], before.at[side]);
        let corners = [first, second, third].map(|i| self.mesh.position(f.nodes[i]));
        let Some(own) = unfold(corners, [at[first], at[second]]) else {
            self.refused.insert(face);
            return None;
        };
        let node = f.nodes[third];
        let known = self.nodes.get(&node).copied();
        let fitting = known.filter(|known| *known == own || fits(corners, *known, own, self.length));
        at[third] = fitting.unwrap_or(own);
        let torn = before.torn || (known.is_some() && fitting.is_none());
        let sides = sides_to_line(&at, self.length);
        let distance = triangle_to_line(&at, sides);
        let comes_back = distance < before.sides[side];
        // The known side may be one of a link's face, which is laid down as its link says, wherever that is in space.
        let laid = [at[first], at[second], at[third]];
        let is_lost = corners.iter().zip(laid).any(|(&corner, at)| self.is_lost(corner, at));
        if comes_back && (torn || self.is_far(corners[2], at[third])) || is_lost {
            self.refused.insert(face);
            return None;
        }
        self.nodes.entry(node).or_insert(own);
        if known.is_some() && fitting.is_none() {
            self.torn.insert(node);
        }
        self.note_tears(f.nodes, at);
        Some(Placed { face, at, distance, sides, torn })
    }

    /// Whether a corner is laid less than half as far from the line as it is on the straightest way.
    fn is_far(&self, corner: DVec3, at: DVec2) -> bool {
        to_line(at, self.length) < 0.5 * self.straight(corner)
    }

    /// Whether a corner is laid beside the line, though it lies beyond the patch, or nearly.
    fn is_lost(&self, corner: DVec3, at: DVec2) -> bool {
        let (laid, half) = (to_line(at, self.length), 0.5 * self.radius);
        laid < 0.2 * half && self.straight(corner).min(half) - laid > 0.8 * half
    }

    /// Distance from the line in space.
    fn straight(&self, corner: DVec3) -> f64 {
        let away = self.line.windows(2).map(|w| distance_to_segment(corner, w[0], w[1]));
        away.fold(f64::INFINITY, f64::min)
    }

    /// What a face has of its own goes on into the faces behind it.
    fn note_tears(&mut self, nodes: [NodeId; 3], at: Flat) {
        if self.torn.is_empty() {
            return;
        }
        let torn = nodes.into_iter().zip(at).filter(|(n, at)| self.nodes.get(n) != Some(at));
        self.torn.extend(torn.map(|(n, _)| n));
    }

    fn push_sides(&mut self, from: usize) {
        let Placed { face, sides, .. } = self.faces[from];
        for side in 0..3 {
            let edge = self.mesh.face(face).edges[side];
            let Some(beyond) = self.mesh.edge(edge).other_face(face).some() else { continue };
            if self.seen.contains(&beyond) || self.mesh.face(beyond).surface == Surface::Gutter {
                continue;
            }
            let distance = if self.on_line.contains(&edge) { 0.0 } else { sides[side] };
            if distance <= self.radius {
                // The bits of floats that are not negative are in the order of the floats.
                self.steps.push(Reverse((distance.to_bits(), beyond, from as u32, side as u8)));
            }
        }
    }
}

/// Whether a corner may take the place that its node has, instead of the one where its own face would lay it.
///
/// The two may differ by what curvature and bends do to neighbouring faces, half of the face's longest side. Where they differ by more
/// than half of its shortest side, they must also be nearer to each other than to the line: around a thin finger they are not.
fn fits([a, b, c]: [DVec3; 3], known: DVec2, own: DVec2, length: f64) -> bool {
    let sides = [a.distance(b), b.distance(c), c.distance(a)];
    let [shortest, longest] =
        [sides.iter().copied().fold(f64::INFINITY, f64::min), sides.iter().copied().fold(0.0, f64::max)];
    let apart = known.distance(own);
    let far = to_line(known, length) + to_line(own, length);
    apart <= 0.5 * longest && (apart <= 0.5 * shortest || apart <= 0.5 * far)
}
