//! Half-edges in order: what welding and repair are made of.

/// One side of a face, named so that both sides of an edge have the same key.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct HalfEdge {
    /// Its ends, the lower first.
    pub(super) key: [u32; 2],
    /// Three times the face, and the side in it.
    at: u32,
    /// Whether it runs from the lower to the higher end.
    pub(super) forward: bool,
}

impl HalfEdge {
    /// The face that it belongs to.
    pub(super) fn face(&self) -> usize {
        self.at as usize / 3
    }

    /// Which side of that face it is.
    pub(super) fn side(&self) -> usize {
        self.at as usize % 3
    }
}

/// All half-edges, each node under a name; those of one edge stand together, in the order of the faces.
pub(super) fn half_edges(faces: &[[u32; 3]], names: &[u32]) -> Vec<HalfEdge> {
    let mut all = Vec::with_capacity(3 * faces.len());
    for (f, face) in faces.iter().enumerate() {
        let [a, b, c] = face.map(|n| names[n as usize]);
        for (side, (from, to)) in [(a, b), (b, c), (c, a)].into_iter().enumerate() {
            let key = [from.min(to), from.max(to)];
            all.push(HalfEdge { key, at: (3 * f + side) as u32, forward: from < to });
        }
    }
    all.sort_unstable();
    all
}

/// The half-edges edge by edge.
pub(super) fn grouped(sorted: &[HalfEdge]) -> impl Iterator<Item = &[HalfEdge]> {
    sorted.chunk_by(|a, b| a.key == b.key)
}
