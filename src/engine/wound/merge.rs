//! MC: the line becomes edges of the mesh (Lam 2016, §4.2).
//!
//! The thesis splits face by face and leaves a dangling node until the neighbour is split too. Here the refinement that FC planned and
//! tested is applied as one edit, dangling neighbours included, and the chain turns into a path of nodes and edges.

use super::chain::At;
use super::settle::Formed;
use crate::geometry::bvh::{Aabb, Bvh};
use crate::mesh::refine::Refined;
use crate::mesh::{EdgeId, FaceId, Mesh, NodeId};
use crate::report::Rejection;

/// The line as a path in the mesh: edge `i` joins nodes `i` and `i + 1`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Line {
    /// Its nodes, from the first pick to the second.
    pub nodes: Vec<NodeId>,
    /// Its edges.
    pub edges: Vec<EdgeId>,
}

/// Merges a line. The hierarchy, where there is one, follows.
pub fn merge(mesh: &mut Mesh, bvh: Option<&mut Bvh>, formed: &Formed) -> Result<(Line, Refined), Rejection> {
    let refined = mesh.refine(&formed.refinement);
    if let Some(bvh) = bvh {
        follow_refinement(mesh, bvh, &refined);
    }
    let nodes: Vec<NodeId> = formed
        .chain
        .points
        .iter()
        .zip(&formed.made_at)
        .filter_map(|(point, made)| match (point.at, made) {
            (At::Node(n), _) => Some(n),
            (_, Some(m)) => refined.nodes.get(*m as usize).copied(),
            (_, None) => None,
        })
        .collect();
    let mut edges = Vec::with_capacity(nodes.len());
    for pair in nodes.windows(2) {
        let edge = mesh.edge_between(pair[0], pair[1]).ok_or_else(|| {
            Rejection::new(
                "below-resolution",
                format!("no edge joins {} and {} of the line", pair[0], pair[1]),
            )
        })?;
        edges.push(edge);
    }
    Ok((Line { nodes, edges }, refined))
}

/// The box of a face.
pub fn face_box(mesh: &Mesh, face: u32) -> Aabb {
    Aabb::around(&mesh.triangle(FaceId(face)))
}

/// Brings a hierarchy up to a refinement: each parent shrinks to its first child, the others go beside it.
pub fn follow_refinement(mesh: &Mesh, bvh: &mut Bvh, refined: &Refined) {
    let bounds = |f: u32| face_box(mesh, f);
    for (first, rest) in refined.children.iter().filter_map(|c| c.split_first()) {
        rest.iter().for_each(|_| bvh.insert(first.0, &bounds));
    }
    bvh.update(refined.children.iter().filter_map(|c| c.first()).map(|f| f.0), &bounds);
}
