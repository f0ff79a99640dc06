//! CI: the line is opened, and the gutter made (Lam 2016, §4.3).
//!
//! Notation: the line has nodes m₀ … m_k at arc lengths s₀ = 0 … s_k = L. Opening doubles its inner nodes into a left copy lᵢ, which keeps
//! the id, and a right copy rᵢ, and moves them apart along ±û, the cutting plane's normal. The gutter joins both rims to the
//! bottom nodes gᵢ. The ends m₀ and m_k stay where they are and are shared.
//!
//! ```text
//!        l1 --- l2 --- l3
//!      / | \    | \    |  \
//!    m0  g1 --- g2 --- g3  m4      seen from outside; g lies below
//!      \ | /    | /    |  /
//!        r1 --- r2 --- r3
//! ```
//!
//! Where we depart from the thesis: the width goes by arc length, not by index, and there is always a node at half of it; the opening is
//! spread over the neighbourhood so that no face folds over ([`opening`]); the depth goes along the local normal, bounded by
//! the tissue below, and the gutter crosses nothing ([`gutter`]), so cuts across, along and over earlier cuts are made; the gutter is a chart of
//! its own, with its own normals.

pub mod gutter;
pub mod opening;
pub mod slit;

use glam::DVec3;

use super::chain::{At, Point};
use super::merge::{Line, face_box, follow_refinement};
use super::plane::CutPlane;
use super::settle::shape;
use crate::geometry::bvh::Bvh;
use crate::geometry::{double, ulp};
use crate::mesh::refine::{FaceSplit, Refinement, Site};
use crate::mesh::{EdgeId, FaceId, Mark, Mesh, NodeId};
use crate::report::Rejection;

/// An opening, or a depth, below this many ulps of the largest coordinate would be rounded away (DESIGN: eight).
pub const LEAST_ULPS: f64 = 8.0;

/// What surrounds an incision.
pub struct Place<'a> {
    /// The mesh, in an open transaction.
    pub mesh: &'a mut Mesh,
    /// The hierarchy over its faces.
    pub bvh: &'a mut Bvh,
    /// The cutting plane.
    pub plane: &'a CutPlane,
    /// Centimetres in a model unit.
    pub unit_cm: f64,
    /// The largest coordinate.
    pub largest: f64,
}

/// What an incision did.
#[derive(Clone, Debug, Default)]
pub struct Carved {
    /// The whole line, with its middle node.
    pub line: Line,
    /// Arc length of the line, model units.
    pub length: f64,
    /// The width that the middle is to have, model units.
    pub cod: f64,
    /// The depth that the gutter is to have, model units.
    pub depth: f64,
    /// The opened part of the line, its two ends included.
    pub opened: Vec<Opened>,
    /// Which of `opened` is at half the arc length.
    pub middle: usize,
    /// Whether the middle is not as wide as planned.
    pub middle_narrowed: bool,
    /// Nodes beside the line that may have moved, and where they were.
    pub moved: Vec<(NodeId, DVec3)>,
    /// The skin faces that moved, and how they lay.
    pub stretched: Vec<(FaceId, [DVec3; 3])>,
    /// The gutter's faces.
    pub gutter: Vec<FaceId>,
    /// Nodes whose opening is narrower than planned, because a face would fold over.
    pub narrowed: usize,
    /// Nodes of the line that stay closed, because there is no room for an opening at or beyond them.
    pub closed: usize,
    /// Bottom nodes that are less deep than planned, because there is less tissue.
    pub shallowed: usize,
}

/// One node of the opened line. At the two ends left, right and bottom are the node itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Opened {
    /// Where the node was.
    pub at: DVec3,
    /// Arc length from the line's start.
    pub s: f64,
    /// Left copy.
    pub left: NodeId,
    /// Right copy.
    pub right: NodeId,
    /// Bottom node.
    pub bottom: NodeId,
    /// Half of the width here.
    pub half_width: f64,
    /// Depth here.
    pub depth: f64,
}

/// Why a part of the line cannot be opened.
pub(super) struct Obstacle {
    /// The opened nodes at which it is, by index.
    nodes: Vec<usize>,
    /// What to say if nothing else can be opened either.
    why: Rejection,
}

/// Carves along a merged line.
///
/// Where the tissue leaves no room for an opening, or none for a gutter, the line stays closed: then the longest part between such places
/// is opened. Only where there is none the cut is rejected.
pub fn carve(place: &mut Place<'_>, line: Line) -> Result<Carved, Rejection> {
    require_inside(place.mesh, &line)?;
    let line = with_middle(place, line)?;
    let mut widths = opening::Widths::along(place, &line)?;
    loop {
        let mark = place.mesh.mark();
        match open(place, &line, &widths) {
            Ok(carved) => return Ok(carved),
            Err(Obstacle { nodes, why }) => {
                take_back(place, mark);
                widths.close(nodes).ok_or(why)?;
            }
        }
    }
}

/// Opens one part of a line.
fn open(place: &mut Place<'_>, line: &Line, widths: &opening::Widths) -> Result<Carved, Obstacle> {
    let inward = gutter::inward(place, line, &widths.range, widths.depth);
    let slit =
        slit::slit(place.mesh, line, &widths.range).map_err(|why| Obstacle { nodes: Vec::new(), why })?;
    let mut carved = widths.start(line.clone(), &slit);
    let opening = opening::Opening::make(place, &mut carved)?;
    gutter::dig(place, &mut carved, opening, &slit, &inward)?;
    Ok(carved)
}

/// Takes an attempt back, in the mesh and in the hierarchy.
fn take_back(place: &mut Place<'_>, mark: Mark) {
    let touched = place.mesh.touched_since(mark);
    place.mesh.rollback_to(mark);
    let mesh = &*place.mesh;
    let bounds = |f: u32| face_box(mesh, f);
    place.bvh.truncate(mesh.face_count(), &bounds);
    let around =
        touched.nodes.into_iter().filter(|&n| mesh.has_node(n)).flat_map(|n| mesh.fan(n).map(|(f, _)| f.0));
    place.bvh.update(around, &bounds);
}

/// A line that touches the boundary between its ends would tear it.
fn require_inside(mesh: &Mesh, line: &Line) -> Result<(), Rejection> {
    if let Some(&e) = line.edges.iter().find(|&&e| mesh.edge(e).is_boundary()) {
        return Err(Rejection::new("boundary", format!("the line runs along the boundary at {e}")));
    }
    let inner = &line.nodes[1..line.nodes.len().max(2) - 1];
    match inner.iter().find(|&&n| mesh.is_boundary_node(n)) {
        Some(n) => {
            Err(Rejection::new("boundary", format!("the line touches the boundary at {n}, between its ends")))
        }
        None => Ok(()),
    }
}

/// Arc lengths of a line's nodes.
pub fn arc_lengths(mesh: &Mesh, nodes: &[NodeId]) -> Vec<f64> {
    let mut s = 0.0;
    let steps = nodes.windows(2).map(|w| mesh.position(w[0]).distance(mesh.position(w[1])));
    std::iter::once(0.0)
        .chain(steps.map(|d| {
            s += d;
            s
        }))
        .collect()
}

/// Splits the line at half its arc length where no node lies there.
fn with_middle(place: &mut Place<'_>, mut line: Line) -> Result<Line, Rejection> {
    let s = arc_lengths(place.mesh, &line.nodes);
    let length = s[s.len() - 1];
    let half = length * 0.5;
    let i = s.partition_point(|&v| v <= half).clamp(1, s.len() - 1) - 1;
    let t = (half - s[i]) / (s[i + 1] - s[i]);
    // A node nearer than this is the middle: the split would only make slivers.
    let near = 1e-6 * length;
    let is_inner = |k: usize| k > 0 && k + 1 < s.len();
    if (is_inner(i) && half - s[i] <= near) || (is_inner(i + 1) && s[i + 1] - half <= near) {
        return Ok(line);
    }
    let Some(plan) = split_plan(place.mesh, line.edges[i], line.nodes[i], t) else {
        return if line.edges.len() > 1 {
            Ok(line)
        } else {
            Err(Rejection::new(
                "too-short-to-open",
                format!("the line is one link of {length:e}, too short to be split"),
            ))
        };
    };
    let refined = place.mesh.refine(&plan);
    follow_refinement(place.mesh, place.bvh, &refined);
    let node = refined.nodes[0];
    let parts =
        [(line.nodes[i], node), (node, line.nodes[i + 1])].map(|(a, b)| place.mesh.edge_between(a, b));
    let [Some(first), Some(second)] = parts else {
        return Err(Rejection::new("too-short-to-open", "the line could not be split in its middle"));
    };
    line.nodes.insert(i + 1, node);
    line.edges.splice(i..=i, [first, second]);
    Ok(line)
}

/// The refinement that puts a node on an edge at `t` from `from`; `None` where a child would have no area.
fn split_plan(mesh: &Mesh, edge: EdgeId, from: NodeId, t: f64) -> Option<Refinement> {
    let nodes = mesh.edge(edge).nodes;
    let t = if nodes[0] == from { t } else { 1.0 - t };
    let [a, b] = nodes.map(|n| mesh.position(n));
    let point =
        Point { at: At::Edge(edge), position: double::blend(a, [(b, t)]), weights: [1.0 - t, t, 0.0] };
    let mut plan = Refinement { points: vec![(Site::Edge(edge, t), point.position)], faces: Vec::new() };
    for face in mesh.edge(edge).faces.into_iter().filter_map(FaceId::some) {
        let shape = shape(mesh, face, std::iter::once(&point));
        let children = shape.divide()?;
        if !children.iter().all(|&c| shape.is_sound(c)) {
            return None;
        }
        plan.faces.push(FaceSplit { face, points: vec![0], children });
    }
    Some(plan)
}

/// The smallest length that survives rounding here.
pub fn least(largest: f64) -> f64 {
    LEAST_ULPS * ulp(largest)
}
