//! From an indexed face set to the topology (Lam 2016, §3.3.2), in linear time.
//!
//! Edges are found through a list per node, so their ids follow the order in which the faces name them. Normals are averaged
//! over the faces of a node, weighted by area; tangents follow the texture coordinates (Lengyel), averaged per vertex.
//!
//! Nothing is repaired here: what is not an oriented manifold is refused, with the element named. Repair is the readers' work.

use std::fmt;

use glam::{DVec3, Vec2, Vec3};

use super::column::Column;
use super::{Edge, EdgeId, Face, FaceId, Mesh, NodeId, Surface, Vertex, VertexId};

/// A face set as files know it: positions, and triangles that index them, with texture coordinates of their own.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct IndexedMesh {
    /// Node positions, in model units.
    pub positions: Vec<DVec3>,
    /// Triangles, counter-clockwise from outside; indices into `positions`.
    pub faces: Vec<[u32; 3]>,
    /// Texture coordinates, origin bottom left; empty for a mesh without.
    pub uvs: Vec<Vec2>,
    /// For each face the indices into `uvs` of its corners; empty for a mesh without, else as long as `faces`.
    pub face_uvs: Vec<[u32; 3]>,
    /// The texture of each face; empty when all are skin.
    pub surfaces: Vec<Surface>,
}

/// Beyond this areas and volumes would overflow.
pub const LARGEST_COORDINATE: f64 = 1e50;

/// Why a face set is not a mesh. Indices are those of the [`IndexedMesh`].
#[derive(Clone, Debug, PartialEq, Eq)]
#[allow(missing_docs, reason = "the fields are what the message says")]
pub enum BuildError {
    /// There is no face.
    Empty,
    /// More elements than a 32-bit id can name.
    TooLarge { faces: usize },
    /// The lengths of `faces`, `face_uvs` and `surfaces` differ.
    Ragged,
    /// An index points nowhere.
    Index { face: usize },
    /// A coordinate is NaN, infinite, or beyond [`LARGEST_COORDINATE`].
    NotFinite { node: usize },
    /// A node that no face uses.
    Unused { node: usize },
    /// Two corners are the same node.
    Degenerate { face: usize },
    /// Three faces or more share an edge.
    NonManifoldEdge { nodes: [usize; 2], face: usize },
    /// Two neighbours run through their edge in the same direction.
    Orientation { nodes: [usize; 2], face: usize },
    /// The faces around a node are not one fan.
    NonManifoldNode { node: usize },
}

impl fmt::Display for BuildError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty => write!(f, "the mesh has no face"),
            Self::TooLarge { faces } => write!(f, "{faces} faces are more than 32-bit ids can name"),
            Self::Ragged => write!(f, "the face lists differ in length"),
            Self::Index { face } => {
                write!(f, "face {face} names a node or texture coordinate that does not exist")
            }
            Self::NotFinite { node } => {
                write!(f, "node {node} has a coordinate that is not finite, or beyond {LARGEST_COORDINATE:e}")
            }
            Self::Unused { node } => write!(f, "node {node} belongs to no face"),
            Self::Degenerate { face } => write!(f, "face {face} uses a node twice"),
            Self::NonManifoldEdge { nodes: [a, b], face } => {
                write!(f, "face {face} is the third at the edge between nodes {a} and {b}")
            }
            Self::Orientation { nodes: [a, b], face } => {
                write!(
                    f,
                    "face {face} and its neighbour run through the edge between nodes {a} and {b} in the same direction"
                )
            }
            Self::NonManifoldNode { node } => write!(f, "the faces around node {node} are not one fan"),
        }
    }
}

impl std::error::Error for BuildError {}

impl Mesh {
    /// Builds the topology of a face set. Linear in its size.
    pub fn build(input: &IndexedMesh) -> Result<Self, BuildError> {
        validate(input)?;
        let (vertices, face_vertices) = make_vertices(input);
        let (edges, face_edges) = make_edges(input)?;
        let faces: Vec<Face> = (0..input.faces.len())
            .map(|f| Face {
                nodes: input.faces[f].map(NodeId),
                vertices: face_vertices[f].map(VertexId),
                edges: face_edges[f],
                surface: input.surfaces.get(f).copied().unwrap_or(Surface::Skin),
            })
            .collect();
        drop((face_vertices, face_edges));
        let anchors = make_anchors(input)?;
        let mut mesh = Self {
            positions: Column::new(input.positions.clone()),
            anchors: Column::new(anchors),
            vertices: Column::new(vertices),
            edges: Column::new(edges),
            faces: Column::new(faces),
            textured: !input.face_uvs.is_empty(),
        };
        mesh.require_fans()?;
        mesh.compute_frames();
        Ok(mesh)
    }

    /// The mesh as a face set: positions by node, texture coordinates by vertex.
    pub fn to_indexed(&self) -> IndexedMesh {
        let uvs = if self.textured { self.vertices().iter().map(|v| v.uv).collect() } else { Vec::new() };
        let face_uvs = if self.textured {
            self.faces().iter().map(|f| f.vertices.map(|v| v.0)).collect()
        } else {
            Vec::new()
        };
        IndexedMesh {
            positions: self.positions().to_vec(),
            faces: self.faces().iter().map(|f| f.nodes.map(|n| n.0)).collect(),
            uvs,
            face_uvs,
            surfaces: self.faces().iter().map(|f| f.surface).collect(),
        }
    }

    /// Every node's fan must hold all of its faces.
    fn require_fans(&self) -> Result<(), BuildError> {
        let mut incident = vec![0u32; self.node_count()];
        for face in self.faces() {
            face.nodes.iter().for_each(|n| incident[n.at()] += 1);
        }
        for (node, &count) in incident.iter().enumerate() {
            if self.fan(NodeId::of(node)).count() != count as usize {
                return Err(BuildError::NonManifoldNode { node });
            }
        }
        Ok(())
    }

    fn compute_frames(&mut self) {
        let normals = self.node_normals();
        let (tangents, bitangents) = self.vertex_tangents();
        for id in 0..self.vertex_count() {
            let mut v = self.vertex(VertexId::of(id));
            (v.tangent, v.bitangent) = (tangents[id], bitangents[id]);
            self.vertices.set(id, v);
        }
        for f in 0..self.face_count() {
            let Face { nodes, vertices, .. } = *self.face(FaceId::of(f));
            for (n, v) in nodes.into_iter().zip(vertices) {
                let mut vertex = self.vertex(v);
                vertex.normal = normals[n.at()];
                self.vertices.set(v.at(), vertex);
            }
        }
        for id in 0..self.vertex_count() {
            let v = self.vertex(VertexId::of(id));
            self.vertices.set(id, orthonormal(v));
        }
    }

    fn node_normals(&self) -> Vec<Vec3> {
        let mut sums = vec![DVec3::ZERO; self.node_count()];
        for f in 0..self.face_count() {
            let [a, b, c] = self.triangle(FaceId::of(f));
            let normal = (b - a).cross(c - a);
            self.face(FaceId::of(f)).nodes.iter().for_each(|n| sums[n.at()] += normal);
        }
        sums.into_iter().map(|n| n.try_normalize().unwrap_or(DVec3::Y).as_vec3()).collect()
    }

    /// Directions of growing u and v, summed over the faces of each vertex; zero where there are no texture coordinates.
    fn vertex_tangents(&self) -> (Vec<Vec3>, Vec<Vec3>) {
        let mut sums = vec![(Vec3::ZERO, Vec3::ZERO); self.vertex_count()];
        for (f, face) in self.faces().iter().enumerate() {
            let [a, b, c] = self.triangle(FaceId::of(f));
            let [ua, ub, uc] = face.vertices.map(|v| self.vertex(v).uv.as_dvec2());
            let (e1, e2, d1, d2) = (b - a, c - a, ub - ua, uc - ua);
            let orientation = d1.perp_dot(d2).signum();
            let t = ((e1 * d2.y - e2 * d1.y) * orientation).try_normalize().unwrap_or(DVec3::ZERO).as_vec3();
            let s = ((e2 * d1.x - e1 * d2.x) * orientation).try_normalize().unwrap_or(DVec3::ZERO).as_vec3();
            for v in face.vertices {
                sums[v.at()].0 += t;
                sums[v.at()].1 += s;
            }
        }
        sums.into_iter().unzip()
    }
}

/// Makes tangent and bitangent orthogonal to the normal and to each other, keeping the bitangent's side; any frame where the
/// texture coordinates give none.
pub(crate) fn orthonormal(mut v: Vertex) -> Vertex {
    let n = v.normal;
    let any = if n.x.abs() < 0.9 { Vec3::X } else { Vec3::Y };
    let project = |d: Vec3| (d - n * n.dot(d)).try_normalize();
    v.tangent = project(v.tangent).or_else(|| project(any)).unwrap_or(Vec3::X);
    let b = n.cross(v.tangent);
    v.bitangent = if b.dot(v.bitangent) < 0.0 { -b } else { b };
    v
}

fn validate(input: &IndexedMesh) -> Result<(), BuildError> {
    let IndexedMesh { positions, faces, uvs, face_uvs, surfaces } = input;
    if faces.is_empty() {
        return Err(BuildError::Empty);
    }
    // An edit appends to the ids, so half of them are kept free.
    if faces.len() > (u32::MAX / 8) as usize || positions.len() > (u32::MAX / 8) as usize {
        return Err(BuildError::TooLarge { faces: faces.len() });
    }
    if !(face_uvs.is_empty() || face_uvs.len() == faces.len())
        || !(surfaces.is_empty() || surfaces.len() == faces.len())
    {
        return Err(BuildError::Ragged);
    }
    for (f, face) in faces.iter().enumerate() {
        let uv_outside = face_uvs.get(f).is_some_and(|t| t.iter().any(|&i| i as usize >= uvs.len()));
        if uv_outside || face.iter().any(|&i| i as usize >= positions.len()) {
            return Err(BuildError::Index { face: f });
        }
        if face[0] == face[1] || face[1] == face[2] || face[2] == face[0] {
            return Err(BuildError::Degenerate { face: f });
        }
    }
    let is_usable = |p: &DVec3| p.is_finite() && p.abs().max_element() <= LARGEST_COORDINATE;
    match positions.iter().position(|p| !is_usable(p)) {
        Some(node) => Err(BuildError::NotFinite { node }),
        None => Ok(()),
    }
}

/// One vertex for each pair of node and texture coordinate that a face names; ids in the order of first use.
fn make_vertices(input: &IndexedMesh) -> (Vec<Vertex>, Vec<[u32; 3]>) {
    let blank = |uv| Vertex { uv, ..Vertex::default() };
    if input.face_uvs.is_empty() {
        return (vec![blank(Vec2::ZERO); input.positions.len()], input.faces.clone());
    }
    // Chained by a hash of node and texture coordinate: a pole may have as many of these as it has faces.
    let bits = input.positions.len().next_power_of_two().ilog2();
    let mut first = vec![u32::MAX; 1 << bits];
    let mut vertices: Vec<Vertex> = Vec::with_capacity(input.uvs.len());
    let mut next: Vec<u32> = Vec::with_capacity(input.uvs.len());
    let mut corner = |node: u32, uv: u32| {
        let uv = input.uvs[uv as usize] + Vec2::ZERO;
        let bucket = bucket_of(node, uv, bits);
        let mut at = first[bucket];
        // Within a list equal coordinates are those of one node, see `bucket_of`.
        while at != u32::MAX && vertices[at as usize].uv != uv {
            at = next[at as usize];
        }
        if at == u32::MAX {
            at = vertices.len() as u32;
            vertices.push(blank(uv));
            next.push(first[bucket]);
            first[bucket] = at;
        }
        at
    };
    let faces = input.faces.iter().zip(&input.face_uvs);
    let face_vertices =
        faces.map(|(n, t)| [corner(n[0], t[0]), corner(n[1], t[1]), corner(n[2], t[2])]).collect();
    (vertices, face_vertices)
}

/// Where a node's vertex is looked for among 2^bits lists. Most nodes have one vertex, so the node leads and neighbours stay
/// neighbours; the texture coordinate scatters the others. With one coordinate, different nodes have different lists.
fn bucket_of(node: u32, uv: Vec2, bits: u32) -> usize {
    let mixed =
        (u64::from(uv.x.to_bits()) << 32 | u64::from(uv.y.to_bits())).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let spread = if bits == 0 { 0 } else { (mixed >> (64 - bits)) as usize };
    (node as usize ^ spread) & ((1 << bits) - 1)
}

/// The edges, and each face's three. Every edge is listed at the end that has fewer faces, which keeps the lists short even at
/// the tip of a cone.
fn make_edges(input: &IndexedMesh) -> Result<(Vec<Edge>, Vec<[EdgeId; 3]>), BuildError> {
    let mut first = vec![u32::MAX; input.positions.len()];
    let mut next: Vec<u32> = Vec::with_capacity(input.faces.len() * 3 / 2 + 64);
    let mut edges: Vec<Edge> = Vec::with_capacity(input.faces.len() * 3 / 2 + input.faces.len() / 16 + 128);
    let mut face_edges = vec![[EdgeId::NONE; 3]; input.faces.len()];
    let mut valence = vec![0u32; input.positions.len()];
    input.faces.iter().flatten().for_each(|&n| valence[n as usize] += 1);
    for (f, face) in input.faces.iter().enumerate() {
        for side in 0..3 {
            let (a, b) = (face[side], face[(side + 1) % 3]);
            let nodes = [NodeId(a), NodeId(b)];
            let (home, other) =
                if (valence[a as usize], a) < (valence[b as usize], b) { (a, b) } else { (b, a) };
            let mut at = first[home as usize];
            while at != u32::MAX && !edges[at as usize].nodes.contains(&NodeId(other)) {
                at = next[at as usize];
            }
            if at == u32::MAX {
                at = edges.len() as u32;
                edges.push(Edge { nodes, faces: [FaceId::of(f), FaceId::NONE] });
                next.push(first[home as usize]);
                first[home as usize] = at;
            } else {
                let edge = &mut edges[at as usize];
                let named = [a as usize, b as usize];
                if edge.faces[1] != FaceId::NONE {
                    return Err(BuildError::NonManifoldEdge { nodes: named, face: f });
                }
                if edge.nodes == nodes {
                    return Err(BuildError::Orientation { nodes: named, face: f });
                }
                edge.faces[1] = FaceId::of(f);
            }
            face_edges[f][side] = EdgeId(at);
        }
    }
    Ok((edges, face_edges))
}

fn make_anchors(input: &IndexedMesh) -> Result<Vec<FaceId>, BuildError> {
    let mut anchors = vec![FaceId::NONE; input.positions.len()];
    for (f, face) in input.faces.iter().enumerate().rev() {
        face.iter().for_each(|&n| anchors[n as usize] = FaceId::of(f));
    }
    match anchors.iter().position(|&f| f == FaceId::NONE) {
        Some(node) => Err(BuildError::Unused { node }),
        None => Ok(anchors),
    }
}
