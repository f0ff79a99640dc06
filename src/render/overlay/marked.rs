//! Elements of a mesh by their printed ids.

use rustc_hash::{FxHashMap, FxHashSet};

use crate::mesh::{Edge, EdgeId, FaceId, Mesh, NodeId, VertexId};

/// Elements that there are.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Marked {
    pub(super) faces: FxHashSet<FaceId>,
    pub(super) edges: Vec<EdgeId>,
    pub(super) nodes: Vec<NodeId>,
    pub(super) vertices: Vec<VertexId>,
}

impl Marked {
    /// Those of some ids that a mesh has.
    pub(super) fn of(mesh: &Mesh, ids: &[String]) -> Self {
        let mut marked = Self::default();
        for (letter, index) in ids.iter().filter_map(|id| parse(id)) {
            match letter {
                'f' if mesh.has_face(FaceId(index)) => drop(marked.faces.insert(FaceId(index))),
                'e' if mesh.has_edge(EdgeId(index)) => marked.edges.push(EdgeId(index)),
                'n' if mesh.has_node(NodeId(index)) => marked.nodes.push(NodeId(index)),
                'v' if (index as usize) < mesh.vertex_count() => marked.vertices.push(VertexId(index)),
                _ => {}
            }
        }
        marked
    }

    /// Whether an edge of a marked face is its outline: what is across is not marked.
    pub(super) fn is_outline(&self, edge: &Edge) -> bool {
        !edge.faces.iter().all(|face| self.faces.contains(face))
    }

    /// The marked nodes, and those that marked vertices are at.
    pub(super) fn all_nodes(&self, mesh: &Mesh) -> Vec<NodeId> {
        if self.vertices.is_empty() {
            return self.nodes.clone();
        }
        let wanted: FxHashSet<_> = self.vertices.iter().copied().collect();
        let corners = mesh.faces().iter().flat_map(|face| face.vertices.into_iter().zip(face.nodes));
        let found: FxHashMap<_, _> = corners.filter(|(vertex, _)| wanted.contains(vertex)).collect();
        let at = self.vertices.iter().filter_map(|vertex| found.get(vertex).copied());
        self.nodes.iter().copied().chain(at).collect()
    }
}

/// The first of some ids that is no element of a mesh.
pub fn missing<'a>(mesh: &Mesh, ids: &'a [String]) -> Option<&'a str> {
    let is_missing = |id: &&String| Marked::of(mesh, std::slice::from_ref(*id)) == Marked::default();
    ids.iter().find(is_missing).map(String::as_str)
}

/// A letter and a number.
fn parse(id: &str) -> Option<(char, u32)> {
    let mut rest = id.chars();
    let letter = rest.next()?;
    let digits = rest.as_str();
    digits.bytes().all(|b| b.is_ascii_digit()).then(|| digits.parse().ok().map(|index| (letter, index)))?
}
