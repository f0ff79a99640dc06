//! Walking around a node.

use super::{EdgeId, FaceId, Mesh, NodeId};

/// The faces around a node, counter-clockwise from outside. At a boundary node the walk starts at the face behind the
/// clockwise-most boundary edge, so it is complete there too.
///
/// Each step gives the face and the corner at which the node stands in it.
#[derive(Clone, Debug)]
pub struct Fan<'a> {
    mesh: &'a Mesh,
    node: NodeId,
    first: FaceId,
    next: FaceId,
    /// Faces yet to come at most: a damaged mesh must not hang the walk.
    budget: usize,
}

impl Mesh {
    /// The faces around a node; none for a node without a face.
    pub fn fan(&self, node: NodeId) -> Fan<'_> {
        let anchor = self.anchor(node);
        let first = if anchor == FaceId::NONE { anchor } else { self.clockwise_end(node, anchor) };
        Fan { mesh: self, node, first, next: first, budget: self.face_count() }
    }

    /// The last face clockwise around a node before a boundary; `start` itself where there is none.
    fn clockwise_end(&self, node: NodeId, start: FaceId) -> FaceId {
        let mut face = start;
        for _ in 0..self.face_count() {
            let Some(corner) = self.face(face).corner(node) else { return start };
            let across = self.edge(self.face(face).edges[corner]).other_face(face);
            if across == FaceId::NONE {
                return face;
            }
            if across == start {
                return start;
            }
            face = across;
        }
        start
    }

    /// Whether a node lies on a boundary.
    pub fn is_boundary_node(&self, node: NodeId) -> bool {
        self.fan(node).any(|(face, corner)| {
            let f = self.face(face);
            self.edge(f.edges[corner]).is_boundary() || self.edge(f.edges[(corner + 2) % 3]).is_boundary()
        })
    }

    /// The edge between two nodes.
    pub fn edge_between(&self, a: NodeId, b: NodeId) -> Option<EdgeId> {
        self.fan(a).find_map(|(face, corner)| {
            let f = self.face(face);
            if f.nodes[(corner + 1) % 3] == b {
                Some(f.edges[corner])
            } else if f.nodes[(corner + 2) % 3] == b {
                Some(f.edges[(corner + 2) % 3])
            } else {
                None
            }
        })
    }
}

impl Iterator for Fan<'_> {
    type Item = (FaceId, usize);

    fn next(&mut self) -> Option<Self::Item> {
        if self.next == FaceId::NONE || self.budget == 0 {
            return None;
        }
        self.budget -= 1;
        let face = self.next;
        let corner = self.mesh.face(face).corner(self.node)?;
        let across = self.mesh.edge(self.mesh.face(face).edges[(corner + 2) % 3]).other_face(face);
        self.next = if across == self.first { FaceId::NONE } else { across };
        Some((face, corner))
    }
}
