//! What rounding would collapse is caught before it does.
//!
//! The line's points are exact constructs; their positions are rounded. So every child of every face that the line divides is tested
//! exactly: it must have area, and face as its parent does. Where a child fails, an end of the line has been rounded onto a node or an
//! edge: the end moves there (**snapped**; the node counts as lying on the plane from then on, from which it is at most four ulps away), and the line is
//! formed anew. A child thinner than four ulps is treated the same where there is something to snap to, since the next operation on
//! it would be the one that fails. If a child still fails, the cut is rejected `below-resolution`.

use std::cmp::Ordering;

use glam::DVec3;

use super::chain::{At, Chain, Point};
use super::form::{common_face, trace};
use super::pattern::{Child, Shape, altitude};
use super::pick::Picked;
use super::plane::CutPlane;
use crate::geometry::{fine_distance_to_segment, ulp};
use crate::mesh::refine::{FaceSplit, Refinement, Site};
use crate::mesh::{EdgeId, FaceId, Mesh};
use crate::report::Rejection;

/// How far, in ulps of the largest coordinate, an end may move to the node or edge that it was rounded onto (DESIGN: four).
pub const SNAP_ULPS: f64 = 4.0;

/// A line that can be merged: the chain, and the refinement that merges it.
#[derive(Clone, Debug, Default)]
pub struct Formed {
    /// The line.
    pub chain: Chain,
    /// The faces that it divides, and how.
    pub refinement: Refinement,
    /// For each point of the chain its place in the refinement; `None` at a node.
    pub made_at: Vec<Option<u32>>,
}

/// Forms the line between two picks so that merging it leaves no face without area.
pub fn form(
    mesh: &Mesh,
    plane: &mut CutPlane,
    picks: [Picked; 2],
    largest: f64,
) -> Result<Formed, Rejection> {
    let resolution = SNAP_ULPS * ulp(largest);
    let mut ends = picks.map(|p| p.point);
    // Each round snaps at least one node or moves an end to a smaller place, so this ends; the bound is for what cannot be.
    for _ in 0..10_000 {
        if common_face(mesh, &ends[0], &ends[1]).is_none() {
            for end in &mut ends {
                *end = place(mesh, plane, end, resolution)?;
            }
        }
        let chain = trace(mesh, plane, &ends[0], &ends[1])?;
        let formed = divide(mesh, chain)?;
        let faults = faults(mesh, &formed, resolution);
        if faults.is_empty() {
            return Ok(formed);
        }
        let mut snapped = false;
        for fault in &faults {
            snapped |= snap(mesh, plane, &formed.chain, &mut ends, fault, resolution);
        }
        if !snapped {
            return match faults.iter().find(|f| f.collapsed) {
                None => Ok(formed),
                Some(f) => Err(Rejection::new(
                    "below-resolution",
                    format!("a part of {} has no area once it is rounded", f.face),
                )),
            };
        }
    }
    Err(Rejection::new("below-resolution", "the line does not settle"))
}

/// Where a pick on an edge lies once the plane is known.
///
/// The edge's nodes are on different sides of it, or both on it. Where neither holds the edge is within rounding of the plane: its
/// nodes are snapped, or the pick moves to the node that it was rounded onto.
fn place(mesh: &Mesh, plane: &mut CutPlane, end: &Point, resolution: f64) -> Result<Point, Rejection> {
    let At::Edge(edge) = end.at else { return Ok(*end) };
    let nodes = mesh.edge(edge).nodes;
    let [a, b] = nodes.map(|n| plane.side_of(mesh, n));
    if a == b.reverse() {
        return Ok(*end);
    }
    let is_near = |p: DVec3| p.distance(end.position) <= resolution && plane.distance(p) <= resolution;
    if let Some(node) = nodes.into_iter().find(|&n| is_near(mesh.position(n))) {
        plane.snap(node);
        return Ok(Point::node(mesh, node));
    }
    if nodes.iter().all(|&n| plane.distance(mesh.position(n)) <= resolution) {
        nodes.into_iter().for_each(|n| {
            plane.snap(n);
        });
        return Ok(*end);
    }
    Err(Rejection::new(
        "below-resolution",
        format!("{edge} is within rounding of the cutting plane, and does not cross it"),
    ))
}

/// The faces that a line divides, with the line's points in or on them (indices into the chain).
fn divided_faces(mesh: &Mesh, chain: &Chain) -> Vec<(FaceId, Vec<usize>)> {
    let mut faces: Vec<(FaceId, Vec<usize>)> = Vec::with_capacity(chain.links.len() + 2);
    for (i, point) in chain.points.iter().enumerate() {
        // Neighbouring points share faces; only the last point can come back to the first one's.
        let recent = if i + 1 == chain.points.len() { usize::MAX } else { 4 };
        let mut add = |face: FaceId| {
            let known = faces.iter().rev().take(recent).position(|f| f.0 == face);
            match known {
                Some(back) => {
                    let at = faces.len() - 1 - back;
                    faces[at].1.push(i);
                }
                None => faces.push((face, vec![i])),
            }
        };
        match point.at {
            At::Node(_) => {}
            At::Edge(e) => mesh.edge(e).faces.into_iter().filter_map(FaceId::some).for_each(&mut add),
            At::Face(f) => add(f),
        }
    }
    faces
}

/// How the faces under a line fall into triangles.
fn divide(mesh: &Mesh, chain: Chain) -> Result<Formed, Rejection> {
    let mut refinement = Refinement::default();
    let made_at: Vec<Option<u32>> = chain.points.iter().map(|p| add_point(&mut refinement, p)).collect();
    for (face, points) in divided_faces(mesh, &chain) {
        let shape = shape(mesh, face, points.iter().map(|&i| &chain.points[i]));
        let children = shape.divide().ok_or_else(|| {
            Rejection::new("below-resolution", format!("the line passes through {face} more than once"))
        })?;
        let points = points.iter().filter_map(|&i| made_at[i]).collect();
        refinement.faces.push(FaceSplit { face, points, children });
    }
    Ok(Formed { chain, refinement, made_at })
}

fn add_point(refinement: &mut Refinement, point: &Point) -> Option<u32> {
    let site = match point.at {
        At::Node(_) => return None,
        At::Edge(e) => Site::Edge(e, point.weights[1]),
        At::Face(f) => Site::Face(f, point.weights),
    };
    refinement.points.push((site, point.position));
    Some(refinement.points.len() as u32 - 1)
}

/// A face and the new points in and on it, in the order given.
pub fn shape<'a>(mesh: &Mesh, face: FaceId, points: impl Iterator<Item = &'a Point>) -> Shape {
    let f = mesh.face(face);
    let mut shape = Shape { at: mesh.triangle(face).to_vec(), sides: Default::default(), inner: Vec::new() };
    let mut along = Vec::new();
    for point in points {
        let local = shape.at.len() as u8;
        shape.at.push(point.position);
        match point.at {
            At::Edge(edge) => {
                along.extend(f.side(edge).map(|side| (side, direction(mesh, face, side, edge, point), local)))
            }
            _ => shape.inner.push(local),
        }
    }
    along.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    along.into_iter().for_each(|(side, _, local)| shape.sides[side].push(local));
    shape
}

/// How far along a face's side a point of its edge lies.
fn direction(mesh: &Mesh, face: FaceId, side: usize, edge: EdgeId, point: &Point) -> f64 {
    if mesh.edge(edge).nodes[0] == mesh.face(face).nodes[side] { point.weights[1] } else { point.weights[0] }
}

/// A child that rounding collapses, or nearly.
struct Fault {
    face: FaceId,
    /// Points of the chain that are corners of it.
    points: Vec<usize>,
    collapsed: bool,
}

fn faults(mesh: &Mesh, formed: &Formed, resolution: f64) -> Vec<Fault> {
    let mut faults = Vec::new();
    for split in &formed.refinement.faces {
        let mut at = mesh.triangle(split.face).to_vec();
        at.extend(split.points.iter().map(|&p| formed.refinement.points[p as usize].1));
        let shape = Shape { at, sides: Default::default(), inner: Vec::new() };
        for &child in &split.children {
            let collapsed = !shape.is_sound(child);
            if collapsed || altitude(shape.child(child)) < resolution {
                let points = corners_on_line(formed, split, child);
                faults.push(Fault { face: split.face, points, collapsed });
            }
        }
    }
    faults
}

fn corners_on_line(formed: &Formed, split: &FaceSplit, child: Child) -> Vec<usize> {
    let made = child.into_iter().filter(|&c| c >= 3).map(|c| split.points[c as usize - 3]);
    made.filter_map(|p| formed.made_at.iter().position(|&m| m == Some(p))).collect()
}

/// Moves the ends of the line in a faulty child to what they were rounded onto; false if there is nothing near enough.
fn snap(
    mesh: &Mesh,
    plane: &mut CutPlane,
    chain: &Chain,
    ends: &mut [Point; 2],
    fault: &Fault,
    resolution: f64,
) -> bool {
    fault.points.iter().any(|&i| match chain.points[i].at {
        At::Node(_) => false,
        At::Edge(edge) => snap_to_node(mesh, plane, edge, &chain.points[i], resolution),
        At::Face(face) => {
            let end = &mut ends[usize::from(i != 0)];
            match onto_border(mesh, plane, face, end, resolution) {
                Some(moved) => {
                    // The line can only end at a node that counts as lying on the plane.
                    if let At::Node(node) = moved.at {
                        plane.snap(node);
                    }
                    *end = moved;
                    true
                }
                None => false,
            }
        }
    })
}

/// Snaps the edge's node that is within rounding of the plane, the one nearer to the point first.
fn snap_to_node(mesh: &Mesh, plane: &mut CutPlane, edge: EdgeId, point: &Point, resolution: f64) -> bool {
    let mut nodes = mesh.edge(edge).nodes;
    let distance = |n| mesh.position(n).distance(point.position);
    if distance(nodes[1]) < distance(nodes[0]) {
        nodes.swap(0, 1);
    }
    let near = nodes.into_iter().find(|&n| {
        plane.side_of(mesh, n) != Ordering::Equal && plane.distance(mesh.position(n)) <= resolution
    });
    near.is_some_and(|n| plane.snap(n))
}

/// The node or edge of a face that a point inside of it was rounded onto. An edge only where the plane crosses it, or it lies in the plane.
fn onto_border(mesh: &Mesh, plane: &CutPlane, face: FaceId, point: &Point, resolution: f64) -> Option<Point> {
    let f = mesh.face(face);
    let is_near = |p: DVec3| p.distance(point.position) <= resolution && plane.distance(p) <= resolution;
    if let Some(&node) = f.nodes.iter().find(|&&n| is_near(mesh.position(n))) {
        return Some(Point::node(mesh, node));
    }
    let near = f.edges.into_iter().find(|&e| {
        let nodes = mesh.edge(e).nodes;
        let [a, b] = nodes.map(|n| mesh.position(n));
        let sides = nodes.map(|n| plane.side_of(mesh, n));
        sides[0] == sides[1].reverse() && fine_distance_to_segment(point.position, a, b) <= resolution
    })?;
    let [a, b] = mesh.edge(near).nodes.map(|n| mesh.position(n));
    let t = ((point.position - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
    Some(Point { at: At::Edge(near), position: point.position, weights: [1.0 - t, t, 0.0] })
}
