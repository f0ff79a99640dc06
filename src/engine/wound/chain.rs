//! The cutting line as a chain of links (Lam 2016, §4.1.2 and §4.2.1).
//!
//! Notation of the thesis: a link ℓ = ⟨f, p₀, p₁, x₀, x₁⟩ is the part of the line in one face f, from p₀ to p₁, with texture
//! coordinates x₀ and x₁. Each end lies at a node (N), inside an edge (E) or inside a face (F): nine configurations.

use glam::{DVec2, DVec3, Vec2};

use crate::mesh::{EdgeId, FaceId, Mesh, NodeId};

/// Where a point of the line lies, exactly.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum At {
    /// At a node.
    Node(NodeId),
    /// Inside an edge.
    Edge(EdgeId),
    /// Inside a face.
    Face(FaceId),
}

impl At {
    /// N, E or F.
    pub fn letter(self) -> char {
        match self {
            Self::Node(_) => 'N',
            Self::Edge(_) => 'E',
            Self::Face(_) => 'F',
        }
    }
}

impl std::fmt::Display for At {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Node(n) => n.fmt(f),
            Self::Edge(e) => e.fmt(f),
            Self::Face(face) => face.fmt(f),
        }
    }
}

/// A point of the line: its exact place, and the rounded cache of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Where it lies.
    pub at: At,
    /// Its position.
    pub position: DVec3,
    /// On an edge: `[1 − t, t, 0]`, t from the edge's first node. In a face: the weights of its corners. At a node: unused.
    pub weights: [f64; 3],
}

impl Point {
    /// A node.
    pub fn node(mesh: &Mesh, node: NodeId) -> Self {
        Self { at: At::Node(node), position: mesh.position(node), weights: [1.0, 0.0, 0.0] }
    }

    /// Whether the point lies in a face or on its border.
    pub fn touches(&self, mesh: &Mesh, face: FaceId) -> bool {
        match self.at {
            At::Node(n) => mesh.face(face).corner(n).is_some(),
            At::Edge(e) => mesh.face(face).side(e).is_some(),
            At::Face(f) => f == face,
        }
    }

    /// Its weights with respect to the corners of a face that it touches.
    pub fn weights_in(&self, mesh: &Mesh, face: FaceId) -> [f64; 3] {
        let f = mesh.face(face);
        let mut weights = [0.0; 3];
        match self.at {
            At::Node(n) => f.corner(n).into_iter().for_each(|c| weights[c] = 1.0),
            At::Edge(e) => {
                for (node, w) in mesh.edge(e).nodes.into_iter().zip(self.weights) {
                    f.corner(node).into_iter().for_each(|c| weights[c] = w);
                }
            }
            At::Face(_) => weights = self.weights,
        }
        weights
    }

    /// Its texture coordinates in the chart of a face that it touches.
    pub fn uv_in(&self, mesh: &Mesh, face: FaceId) -> Vec2 {
        let uvs = mesh.face(face).vertices.map(|v| mesh.vertex(v).uv.as_dvec2());
        let weights = self.weights_in(mesh, face);
        uvs.iter().zip(weights).fold(DVec2::ZERO, |sum, (uv, w)| sum + *uv * w).as_vec2()
    }
}

/// The part of the line in one face. A link along an edge lies in the edge's face with the lower id.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Link {
    /// The face.
    pub face: FaceId,
    /// Texture coordinates of its ends in the face's chart.
    pub uv: [Vec2; 2],
}

/// The whole line: link `i` joins points `i` and `i + 1`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Chain {
    /// Its points, from the first pick to the second.
    pub points: Vec<Point>,
    /// Its links.
    pub links: Vec<Link>,
}

impl Chain {
    /// Where the two ends of a link lie, such as `FE`.
    pub fn configuration(&self, link: usize) -> String {
        [link, link + 1].map(|i| self.points[i].at.letter()).iter().collect()
    }

    /// Arc length, model units.
    pub fn length(&self) -> f64 {
        self.points.windows(2).map(|w| w[0].position.distance(w[1].position)).sum()
    }

    /// Whether a link runs along an edge of the mesh rather than through its face.
    pub fn is_along_edge(&self, mesh: &Mesh, link: usize) -> bool {
        common_edge(mesh, self.links[link].face, self.points[link].at, self.points[link + 1].at).is_some()
    }
}

/// The side of a face on which two places both lie.
pub fn common_edge(mesh: &Mesh, face: FaceId, a: At, b: At) -> Option<EdgeId> {
    mesh.face(face).edges.into_iter().find(|&e| on_edge(mesh, e, a) && on_edge(mesh, e, b))
}

fn on_edge(mesh: &Mesh, edge: EdgeId, at: At) -> bool {
    match at {
        At::Node(n) => mesh.edge(edge).nodes.contains(&n),
        At::Edge(e) => e == edge,
        At::Face(_) => false,
    }
}
