//! SD: the face under a pixel, divided into three, four or six (Lam 2016, §6.3).

use super::chain::{At, Point};
use super::settle::shape;
use crate::mesh::refine::{FaceSplit, Refinement, Site};
use crate::mesh::{EdgeId, FaceId, Mesh};
use crate::report::Rejection;

/// The refinement that divides a face: into 3 around its centre, into 4 between the middles of its sides, into 6 by both.
pub fn plan(mesh: &Mesh, face: FaceId, into: u8) -> Result<Refinement, Rejection> {
    let f = *mesh.face(face);
    let mut points: Vec<Point> = Vec::new();
    if into != 3 {
        points.extend(f.edges.map(|e| middle(mesh, e)));
    }
    if into != 4 {
        points.push(center(mesh, face));
    }
    let sites = points.iter().map(|p| match p.at {
        At::Edge(e) => (Site::Edge(e, 0.5), p.position),
        _ => (Site::Face(face, p.weights), p.position),
    });
    let mut refinement = Refinement { points: sites.collect(), faces: Vec::new() };
    let mut faces = vec![face];
    if into != 3 {
        faces.extend(f.edges.iter().filter_map(|&e| mesh.edge(e).other_face(face).some()));
        faces.sort_unstable();
        faces.dedup();
    }
    for id in faces {
        refinement.faces.push(split(mesh, id, &points)?);
    }
    Ok(refinement)
}

fn split(mesh: &Mesh, face: FaceId, points: &[Point]) -> Result<FaceSplit, Rejection> {
    let (mine, there): (Vec<u32>, Vec<&Point>) =
        (0u32..).zip(points).filter(|(_, p)| p.touches(mesh, face)).unzip();
    let shape = shape(mesh, face, there.into_iter());
    let children = shape.divide().filter(|c| c.iter().all(|&c| shape.is_sound(c)));
    let children = children
        .ok_or_else(|| Rejection::new("below-resolution", format!("{face} is too small to be divided")))?;
    Ok(FaceSplit { face, points: mine, children })
}

fn middle(mesh: &Mesh, edge: EdgeId) -> Point {
    let [a, b] = mesh.edge(edge).nodes.map(|n| mesh.position(n));
    Point { at: At::Edge(edge), position: a + (b - a) * 0.5, weights: [0.5, 0.5, 0.0] }
}

fn center(mesh: &Mesh, face: FaceId) -> Point {
    let [a, b, c] = mesh.triangle(face);
    let third = 1.0 / 3.0;
    Point { at: At::Face(face), position: a + ((b - a) + (c - a)) * third, weights: [third; 3] }
}
