//! Half-edges in order, and sets that grow together: what welding and repair are made of.

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

/// Disjoint sets; a set is named by its lowest member.
#[derive(Debug)]
pub(super) struct Union(Vec<u32>);

impl Union {
    pub(super) fn new(len: usize) -> Self {
        Self((0..len as u32).collect())
    }

    pub(super) fn find(&mut self, mut at: u32) -> u32 {
        while self.0[at as usize] != at {
            let above = self.0[self.0[at as usize] as usize];
            self.0[at as usize] = above;
            at = above;
        }
        at
    }

    pub(super) fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.find(a), self.find(b));
        self.0[a.max(b) as usize] = a.min(b);
    }

    /// The name of each member.
    pub(super) fn names(mut self) -> Vec<u32> {
        (0..self.0.len() as u32).map(|i| self.find(i)).collect()
    }
}
