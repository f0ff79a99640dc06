//! Parts of a mesh: which faces hang together, and where texture coordinates are torn.
//!
//! A **seam edge** has two faces, but not the same vertices on both sides. A **chart** is a set of faces that are joined over edges that are no seams;
//! what the faces of a cut's inside and the skin around it share is a seam too, so the inside is a chart of its own.

use super::{Edge, FaceId, Mesh, NodeId};

/// Disjoint sets; a set is named by its lowest member.
#[derive(Debug)]
pub struct Union(Vec<u32>);

impl Union {
    /// As many sets as members.
    pub fn new(len: usize) -> Self {
        Self((0..len as u32).collect())
    }

    /// The name of the set that a member is in.
    pub fn find(&mut self, mut at: u32) -> u32 {
        while self.0[at as usize] != at {
            let above = self.0[self.0[at as usize] as usize];
            self.0[at as usize] = above;
            at = above;
        }
        at
    }

    /// Makes two members' sets one.
    pub fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.find(a), self.find(b));
        self.0[a.max(b) as usize] = a.min(b);
    }

    /// The name of each member's set.
    pub fn names(mut self) -> Vec<u32> {
        (0..self.0.len() as u32).map(|i| self.find(i)).collect()
    }
}

impl Mesh {
    /// The parts that the faces form when joined over the edges that `joins` says yes to: for each face the lowest face of its part.
    pub fn parts(&self, joins: impl Fn(&Edge) -> bool) -> Vec<u32> {
        let mut union = Union::new(self.face_count());
        for edge in self.edges().iter().filter(|e| !e.is_boundary() && joins(e)) {
            union.join(edge.faces[0].0, edge.faces[1].0);
        }
        union.names()
    }

    /// Whether the two faces of an edge have different vertices at one of its ends; no boundary edge does.
    pub fn is_seam(&self, edge: &Edge) -> bool {
        let vertex = |face: FaceId, node: NodeId| {
            let face = self.face(face);
            face.corner(node).map(|c| face.vertices[c])
        };
        !edge.is_boundary()
            && edge.nodes.iter().any(|&n| vertex(edge.faces[0], n) != vertex(edge.faces[1], n))
    }

    /// The charts: for each face the lowest face of its chart.
    pub fn charts(&self) -> Vec<u32> {
        self.parts(|edge| !self.is_seam(edge))
    }
}

#[cfg(test)]
mod tests {
    use glam::{DVec3, Vec2};

    use super::*;
    use crate::mesh::IndexedMesh;

    /// Two triangles of a square, which share their vertices along the diagonal or do not.
    fn square(torn: bool) -> Mesh {
        let corners = [(0., 0.), (1., 0.), (1., 1.), (0., 1.)];
        let uvs = [0.0, 2.0].map(|by| corners.map(|(x, y)| Vec2::new(x + by, y))).concat();
        let second = if torn { [4, 6, 7] } else { [0, 2, 3] };
        Mesh::build(&IndexedMesh {
            positions: corners.map(|(x, y)| DVec3::new(x.into(), y.into(), 0.0)).to_vec(),
            faces: vec![[0, 1, 2], [0, 2, 3]],
            uvs,
            face_uvs: vec![[0, 1, 2], second],
            ..IndexedMesh::default()
        })
        .expect("a square")
    }

    #[test]
    fn a_chart_ends_at_a_seam() {
        assert_eq!(square(false).charts(), [0, 0]);
        let torn = square(true);
        assert_eq!(torn.charts(), [0, 1]);
        assert_eq!(torn.parts(|_| true), [0, 0]);
        assert_eq!(torn.edges().iter().filter(|e| torn.is_seam(e)).count(), 1);
    }
}
