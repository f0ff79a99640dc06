//! The surface mesh: nodes, vertices, edges and faces, with edits that can be taken back.
//!
//! Source: Lam 2016, §3.2.3. A **node** is a point of the surface; the topology is made of nodes. A **vertex** is a node's
//! attributes in one chart (texture coordinates, normal, tangent, bitangent): a node on a seam has several. An **edge** joins two
//! nodes and knows its two faces; a **face** knows three nodes, three vertices and three edges, counter-clockwise from outside.
//!
//! Where we depart from the thesis:
//! - references are typed indices, not pointers, and nothing is ever removed: a split face keeps its id as the first child, a split
//!   edge as its first part. So every id stays valid, and taking an edit back is truncating five arrays;
//! - an edge is stored with a direction, `faces[0]` runs along it and `faces[1]` against it, so that a half-edge needs no search;
//! - a node knows one of its faces (`anchor`), from which its fan is walked;
//! - boundaries are allowed: `faces[1]` of a boundary edge is [`FaceId::NONE`].
//!
//! Promised: after [`Mesh::build`] and after every edit the mesh is a manifold, oriented, with or without boundary, and
//! `check` says so if it is not. Not promised: that it does not intersect itself.

pub mod build;
mod charts;
pub mod check;
mod column;
mod fan;
mod ids;
mod journal;
pub mod raw;
pub mod refine;

use glam::{DVec3, Vec2, Vec3};

pub use build::{BuildError, IndexedMesh};
pub use charts::Union;
use column::Column;
pub use fan::Fan;
pub use ids::{EdgeId, FaceId, NodeId, VertexId};
pub use journal::{Mark, Patch, Touched};

/// A node's attributes in one chart. f32, since they only colour and shade; the texture coordinate has its origin bottom left.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Vertex {
    /// Texture coordinates.
    pub uv: Vec2,
    /// Unit normal.
    pub normal: Vec3,
    /// Unit tangent, along increasing u.
    pub tangent: Vec3,
    /// Unit bitangent, along increasing v.
    pub bitangent: Vec3,
}

/// An edge between two nodes, with the faces on its two sides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Edge {
    /// Its ends.
    pub nodes: [NodeId; 2],
    /// `faces[0]` runs through `nodes[0]`, `nodes[1]` in this order, `faces[1]` in the other; `NONE` across a boundary.
    pub faces: [FaceId; 2],
}

/// Which texture a face's coordinates refer to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(u32)]
pub enum Surface {
    /// The scene's own skin atlas.
    Skin = 0,
    /// The inside of a cut: the gutter's own small texture.
    Gutter = 1,
}

/// A triangle. `edges[i]` joins `nodes[i]` and `nodes[(i + 1) % 3]`; `vertices[i]` are the attributes at `nodes[i]`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Face {
    /// Corners, counter-clockwise from outside.
    pub nodes: [NodeId; 3],
    /// Attributes at the corners.
    pub vertices: [VertexId; 3],
    /// Sides, from each corner to the next.
    pub edges: [EdgeId; 3],
    /// The texture that the face lies in.
    pub surface: Surface,
}

impl Face {
    /// The corner at which a node stands.
    #[inline]
    pub fn corner(&self, node: NodeId) -> Option<usize> {
        self.nodes.iter().position(|&n| n == node)
    }

    /// The side that an edge is.
    #[inline]
    pub fn side(&self, edge: EdgeId) -> Option<usize> {
        self.edges.iter().position(|&e| e == edge)
    }
}

impl Edge {
    /// The other end.
    #[inline]
    pub fn other_node(&self, node: NodeId) -> NodeId {
        if self.nodes[0] == node { self.nodes[1] } else { self.nodes[0] }
    }

    /// The face across, `NONE` over a boundary.
    #[inline]
    pub fn other_face(&self, face: FaceId) -> FaceId {
        if self.faces[0] == face { self.faces[1] } else { self.faces[0] }
    }

    /// Whether the edge has one face only.
    #[inline]
    pub fn is_boundary(&self) -> bool {
        self.faces[1] == FaceId::NONE || self.faces[0] == FaceId::NONE
    }
}

/// A triangle mesh with the topology of its faces, edges and nodes.
#[derive(Clone, Debug)]
pub struct Mesh {
    positions: Column<DVec3>,
    anchors: Column<FaceId>,
    vertices: Column<Vertex>,
    edges: Column<Edge>,
    faces: Column<Face>,
    textured: bool,
}

impl Mesh {
    /// How many nodes there are.
    #[inline]
    pub fn node_count(&self) -> usize {
        self.positions.all().len()
    }

    /// How many vertices there are.
    #[inline]
    pub fn vertex_count(&self) -> usize {
        self.vertices.all().len()
    }

    /// How many edges there are.
    #[inline]
    pub fn edge_count(&self) -> usize {
        self.edges.all().len()
    }

    /// How many faces there are.
    #[inline]
    pub fn face_count(&self) -> usize {
        self.faces.all().len()
    }

    /// Whether the mesh came with texture coordinates.
    pub fn is_textured(&self) -> bool {
        self.textured
    }

    /// Where a node is, in model units.
    #[inline]
    pub fn position(&self, node: NodeId) -> DVec3 {
        self.positions.all()[node.at()]
    }

    /// All positions, by node id.
    #[inline]
    pub fn positions(&self) -> &[DVec3] {
        self.positions.all()
    }

    /// One of the faces around a node.
    #[inline]
    pub fn anchor(&self, node: NodeId) -> FaceId {
        self.anchors.all()[node.at()]
    }

    /// A vertex.
    #[inline]
    pub fn vertex(&self, vertex: VertexId) -> Vertex {
        self.vertices.all()[vertex.at()]
    }

    /// All vertices, by id.
    #[inline]
    pub fn vertices(&self) -> &[Vertex] {
        self.vertices.all()
    }

    /// An edge.
    #[inline]
    pub fn edge(&self, edge: EdgeId) -> Edge {
        self.edges.all()[edge.at()]
    }

    /// All edges, by id.
    #[inline]
    pub fn edges(&self) -> &[Edge] {
        self.edges.all()
    }

    /// A face.
    #[inline]
    pub fn face(&self, face: FaceId) -> &Face {
        &self.faces.all()[face.at()]
    }

    /// All faces, by id.
    #[inline]
    pub fn faces(&self) -> &[Face] {
        self.faces.all()
    }

    /// A face's three corners, counter-clockwise from outside.
    #[inline]
    pub fn triangle(&self, face: FaceId) -> [DVec3; 3] {
        self.face(face).nodes.map(|n| self.position(n))
    }

    /// Whether an id names an element.
    pub fn has_node(&self, node: NodeId) -> bool {
        node.at() < self.node_count()
    }

    /// Whether an id names an element.
    pub fn has_edge(&self, edge: EdgeId) -> bool {
        edge.at() < self.edge_count()
    }

    /// Whether an id names an element.
    pub fn has_face(&self, face: FaceId) -> bool {
        face.at() < self.face_count()
    }

    /// The largest absolute coordinate: what an ulp of a position is measured by.
    pub fn largest_coordinate(&self) -> f64 {
        self.positions().iter().map(|p| p.abs().max_element()).fold(0.0, f64::max)
    }

    /// The corners of the axis-parallel box around all nodes; zero for an empty mesh.
    pub fn bounds(&self) -> [DVec3; 2] {
        let Some(&first) = self.positions().first() else { return [DVec3::ZERO; 2] };
        self.positions().iter().fold([first, first], |[lo, hi], p| [lo.min(*p), hi.max(*p)])
    }

    /// Bytes that the mesh holds on the heap.
    pub fn bytes(&self) -> usize {
        self.positions.bytes()
            + self.anchors.bytes()
            + self.vertices.bytes()
            + self.edges.bytes()
            + self.faces.bytes()
    }

    /// Moves a node.
    pub fn set_position(&mut self, node: NodeId, position: DVec3) {
        self.positions.set(node.at(), position);
    }

    /// Replaces a vertex's attributes.
    pub fn set_vertex(&mut self, vertex: VertexId, value: Vertex) {
        self.vertices.set(vertex.at(), value);
    }

    /// Replaces an edge. The caller keeps the topology whole.
    pub fn set_edge(&mut self, edge: EdgeId, value: Edge) {
        self.edges.set(edge.at(), value);
    }

    /// Replaces a face. The caller keeps the topology whole.
    pub fn set_face(&mut self, face: FaceId, value: Face) {
        self.faces.set(face.at(), value);
    }

    /// Says from which face a node's fan is walked.
    pub fn set_anchor(&mut self, node: NodeId, face: FaceId) {
        if self.anchor(node) != face {
            self.anchors.set(node.at(), face);
        }
    }

    /// Appends a node; its anchor is set when it gets a face.
    pub fn push_node(&mut self, position: DVec3) -> NodeId {
        self.anchors.push(FaceId::NONE);
        NodeId::of(self.positions.push(position))
    }

    /// Appends a vertex.
    pub fn push_vertex(&mut self, vertex: Vertex) -> VertexId {
        VertexId::of(self.vertices.push(vertex))
    }

    /// Appends an edge.
    pub fn push_edge(&mut self, edge: Edge) -> EdgeId {
        EdgeId::of(self.edges.push(edge))
    }

    /// Appends a face.
    pub fn push_face(&mut self, face: Face) -> FaceId {
        FaceId::of(self.faces.push(face))
    }
}
