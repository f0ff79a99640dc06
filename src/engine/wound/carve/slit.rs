//! Cutting the mesh open along the line: the inner nodes are doubled, and nothing moves yet (Lam 2016, §4.3.1.2).
//!
//! Around an inner node the faces counter-clockwise from the edge that arrives to the edge that leaves lie on the right of the line. They get the right
//! copy of the node, of its vertices and of the line's edges; the left side keeps what was there. No face is searched for: the right
//! fan is walked.

use std::ops::RangeInclusive;

use super::super::merge::Line;
use crate::mesh::{Edge, EdgeId, FaceId, Mesh, NodeId, VertexId};
use crate::report::Rejection;

/// The slit: for every node of the opened part its right copy (the ends are their own), and the edges on both sides.
#[derive(Clone, Debug, Default)]
pub struct Slit {
    /// The opened part of the line: the left rim.
    pub left: Vec<NodeId>,
    /// The right rim.
    pub right: Vec<NodeId>,
    /// Edges of the left rim.
    pub left_edges: Vec<EdgeId>,
    /// Edges of the right rim.
    pub right_edges: Vec<EdgeId>,
    /// The faces beside the right rim's edges.
    pub right_faces: Vec<FaceId>,
}

/// Slits the part of the line between two of its nodes, which stay closed.
pub fn slit(mesh: &mut Mesh, line: &Line, range: &RangeInclusive<usize>) -> Result<Slit, Rejection> {
    let (start, end) = (*range.start(), *range.end());
    let left = line.nodes[start..=end].to_vec();
    let left_edges = line.edges[start..end].to_vec();
    let mut slit = Slit { right: left.clone(), left, left_edges, ..Slit::default() };
    slit.right_faces =
        (0..slit.left_edges.len()).map(|i| right_face(mesh, slit.left_edges[i], slit.left[i])).collect();
    // All fans are walked before anything changes.
    let fans: Vec<Vec<(FaceId, usize)>> = (1..slit.left.len() - 1)
        .map(|i| right_fan(mesh, &slit, i))
        .collect::<Option<_>>()
        .ok_or_else(torn)?;
    for (i, fan) in fans.iter().enumerate() {
        slit.right[i + 1] = double_node(mesh, slit.left[i + 1], fan);
    }
    part_edges(mesh, &mut slit);
    for (i, fan) in fans.iter().enumerate() {
        rename_spokes(mesh, slit.left[i + 1], slit.right[i + 1], fan);
    }
    for i in 1..slit.left.len() - 1 {
        let edge = mesh.edge(slit.left_edges[i]);
        let on_left = edge.faces[usize::from(edge.nodes[0] != slit.left[i])];
        mesh.set_anchor(slit.left[i], on_left);
        mesh.set_anchor(slit.right[i], slit.right_faces[i]);
    }
    Ok(slit)
}

fn torn() -> Rejection {
    Rejection::new("boundary", "the faces on the right of the line are not one fan")
}

/// The face on the right of an edge as one walks away from `from`.
fn right_face(mesh: &Mesh, edge: EdgeId, from: NodeId) -> FaceId {
    let e = mesh.edge(edge);
    e.faces[usize::from(e.nodes[0] == from)]
}

/// The faces on the right of an inner node, counter-clockwise, with the corner at which it stands.
fn right_fan(mesh: &Mesh, slit: &Slit, i: usize) -> Option<Vec<(FaceId, usize)>> {
    let (node, last) = (slit.left[i], slit.right_faces[i]);
    let mut face = slit.right_faces[i - 1];
    let mut fan = Vec::with_capacity(8);
    loop {
        let corner = mesh.face(face.some()?).corner(node)?;
        fan.push((face, corner));
        if face == last {
            return Some(fan);
        }
        if fan.len() > mesh.face_count() {
            return None;
        }
        face = mesh.edge(mesh.face(face).edges[(corner + 2) % 3]).other_face(face);
    }
}

/// Makes the right copy of a node and of its vertices, and hands the fan over to them.
fn double_node(mesh: &mut Mesh, node: NodeId, fan: &[(FaceId, usize)]) -> NodeId {
    let copy = mesh.push_node(mesh.position(node));
    let mut copies: Vec<(VertexId, VertexId)> = Vec::with_capacity(2);
    for &(id, corner) in fan {
        let mut face = *mesh.face(id);
        let old = face.vertices[corner];
        let new = match copies.iter().find(|c| c.0 == old) {
            Some(&(_, new)) => new,
            None => {
                let new = mesh.push_vertex(mesh.vertex(old));
                copies.push((old, new));
                new
            }
        };
        (face.nodes[corner], face.vertices[corner]) = (copy, new);
        mesh.set_face(id, face);
    }
    copy
}

/// Gives the right side its own copies of the line's edges.
fn part_edges(mesh: &mut Mesh, slit: &mut Slit) {
    for i in 0..slit.left_edges.len() {
        let (id, right) = (slit.left_edges[i], slit.right_faces[i]);
        let mut edge = mesh.edge(id);
        let side = usize::from(edge.nodes[0] == slit.left[i]);
        edge.faces[side] = FaceId::NONE;
        mesh.set_edge(id, edge);
        let nodes = [slit.right[i + 1], slit.right[i]];
        let copy = mesh.push_edge(Edge { nodes, faces: [right, FaceId::NONE] });
        let mut face = *mesh.face(right);
        face.edges = face.edges.map(|e| if e == id { copy } else { e });
        mesh.set_face(right, face);
        slit.right_edges.push(copy);
    }
}

/// The edges between the faces of the right fan end at the right copy from now on.
fn rename_spokes(mesh: &mut Mesh, from: NodeId, to: NodeId, fan: &[(FaceId, usize)]) {
    for &(face, corner) in &fan[..fan.len() - 1] {
        let id = mesh.face(face).edges[(corner + 2) % 3];
        let mut edge = mesh.edge(id);
        edge.nodes = edge.nodes.map(|n| if n == from { to } else { n });
        mesh.set_edge(id, edge);
    }
}
