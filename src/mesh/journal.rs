//! Transactions: an edit is rolled back without trace, or committed as a [`Patch`] that undo and redo walk along.

use glam::DVec3;

use super::column::{ColumnMark, ColumnPatch};
use super::{Edge, EdgeId, Face, FaceId, Mesh, NodeId, Vertex, VertexId};

/// What one committed transaction changed. Patches are taken back newest first, and done again in their order.
#[derive(Clone, Debug, PartialEq)]
pub struct Patch {
    positions: ColumnPatch<DVec3>,
    anchors: ColumnPatch<FaceId>,
    vertices: ColumnPatch<Vertex>,
    edges: ColumnPatch<Edge>,
    faces: ColumnPatch<Face>,
}

impl Patch {
    /// Bytes that the patch holds on the heap.
    pub fn bytes(&self) -> usize {
        self.positions.bytes()
            + self.anchors.bytes()
            + self.vertices.bytes()
            + self.edges.bytes()
            + self.faces.bytes()
    }

    /// Whether nothing was changed.
    pub fn is_empty(&self) -> bool {
        self.positions.is_empty()
            && self.vertices.is_empty()
            && self.edges.is_empty()
            && self.faces.is_empty()
    }

    /// The nodes that were written or appended, ascending.
    pub fn nodes(&self) -> impl Iterator<Item = NodeId> + '_ {
        self.positions.touched().map(NodeId)
    }

    /// The faces that were written or appended, ascending.
    pub fn faces(&self) -> impl Iterator<Item = FaceId> + '_ {
        self.faces.touched().map(FaceId)
    }
}

/// A moment within an open transaction.
#[derive(Clone, Copy, Debug, Default)]
pub struct Mark {
    positions: ColumnMark,
    anchors: ColumnMark,
    vertices: ColumnMark,
    edges: ColumnMark,
    faces: ColumnMark,
}

/// The elements that were written or appended between a [`Mark`] and now: each list ascending, each id once.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Touched {
    /// Nodes whose position was written.
    pub nodes: Vec<NodeId>,
    /// Vertices.
    pub vertices: Vec<VertexId>,
    /// Edges.
    pub edges: Vec<EdgeId>,
    /// Faces.
    pub faces: Vec<FaceId>,
}

impl Mesh {
    /// Opens a transaction. They do not nest.
    pub fn begin(&mut self) {
        self.positions.begin();
        self.anchors.begin();
        self.vertices.begin();
        self.edges.begin();
        self.faces.begin();
    }

    /// Takes back everything since [`Self::begin`], bit for bit, and closes the transaction.
    pub fn rollback(&mut self) {
        self.positions.rollback();
        self.anchors.rollback();
        self.vertices.rollback();
        self.edges.rollback();
        self.faces.rollback();
    }

    /// Takes back everything since a mark, bit for bit; the transaction stays open.
    pub fn rollback_to(&mut self, mark: Mark) {
        self.positions.rollback_to(mark.positions);
        self.anchors.rollback_to(mark.anchors);
        self.vertices.rollback_to(mark.vertices);
        self.edges.rollback_to(mark.edges);
        self.faces.rollback_to(mark.faces);
    }

    /// Closes the transaction and keeps what it did.
    pub fn commit(&mut self) -> Patch {
        Patch {
            positions: self.positions.commit(),
            anchors: self.anchors.commit(),
            vertices: self.vertices.commit(),
            edges: self.edges.commit(),
            faces: self.faces.commit(),
        }
    }

    /// Takes a committed edit back, the allocators of the ids included.
    pub fn revert(&mut self, patch: &Patch) {
        self.positions.revert(&patch.positions);
        self.anchors.revert(&patch.anchors);
        self.vertices.revert(&patch.vertices);
        self.edges.revert(&patch.edges);
        self.faces.revert(&patch.faces);
    }

    /// Does an edit again that was taken back.
    pub fn apply(&mut self, patch: &Patch) {
        self.positions.apply(&patch.positions);
        self.anchors.apply(&patch.anchors);
        self.vertices.apply(&patch.vertices);
        self.edges.apply(&patch.edges);
        self.faces.apply(&patch.faces);
    }

    /// Remembers this moment of the open transaction.
    pub fn mark(&self) -> Mark {
        Mark {
            positions: self.positions.mark(),
            anchors: self.anchors.mark(),
            vertices: self.vertices.mark(),
            edges: self.edges.mark(),
            faces: self.faces.mark(),
        }
    }

    /// The beginning of the open transaction.
    pub fn beginning(&self) -> Mark {
        Mark {
            positions: self.positions.beginning(),
            anchors: self.anchors.beginning(),
            vertices: self.vertices.beginning(),
            edges: self.edges.beginning(),
            faces: self.faces.beginning(),
        }
    }

    /// What the open transaction touched since a mark.
    pub fn touched_since(&self, mark: Mark) -> Touched {
        Touched {
            nodes: self.positions.touched_since(mark.positions).into_iter().map(NodeId).collect(),
            vertices: self.vertices.touched_since(mark.vertices).into_iter().map(VertexId).collect(),
            edges: self.edges.touched_since(mark.edges).into_iter().map(EdgeId).collect(),
            faces: self.faces.touched_since(mark.faces).into_iter().map(FaceId).collect(),
        }
    }
}
