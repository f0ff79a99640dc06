//! A closed triangle mesh refined by newest-vertex bisection until it has as many faces as wanted, finer where asked.
//!
//! Idea (Mitchell 1991; Rivara 1984): every triangle `[a, b, c]` is bisected across its refinement edge `ab`, the one opposite its
//! newest node `c`; before, the neighbour across `ab` is bisected until `ab` is its refinement edge too, so the mesh always fits
//! together. If both sides of every refinement edge of the start agree on it, this ends, and what must be split for a given size
//! is the same in whatever order it is done: a symmetric start stays symmetric.
//!
//! Texture coordinates are averaged within each chart, so they stay affine in the triangles of the start: no chart can fold.

use glam::{DVec3, Vec2};

use crate::mesh::IndexedMesh;

/// The surface that is refined: where its points are known by a `Site`.
pub(super) trait Surface {
    /// What a node remembers about its place on the surface.
    type Site: Copy;
    /// The site half way between two neighbours.
    fn between(&self, a: &Self::Site, b: &Self::Site) -> Self::Site;
    /// Where a site lies.
    fn position(&self, site: &mut Self::Site) -> DVec3;
    /// The edge length wanted around a point.
    fn edge_length(&self, p: DVec3) -> f64;
}

/// A coarse closed mesh: the start. Faces are counter-clockwise from outside, their first side is the refinement edge.
pub(super) struct Start<Site> {
    /// The nodes.
    pub sites: Vec<Site>,
    /// Three nodes a face.
    pub faces: Vec<[u32; 3]>,
    /// Texture coordinates.
    pub uvs: Vec<Vec2>,
    /// Three texture coordinates a face.
    pub face_uvs: Vec<[u32; 3]>,
}

/// Refines until there are at least `faces` faces; by a few per cent more, since a whole size class is split at a time.
pub(super) fn refine<S: Surface>(surface: &S, start: Start<S::Site>, faces: usize) -> IndexedMesh {
    /// Size classes in an octave of squared edge length.
    const STEP: f64 = 0.957_603_280_698_573_6; // 2^(−1/16)
    let mut grown = Grown::new(surface, start, faces);
    let mut limit = grown.excess.iter().copied().fold(0.0, f64::max);
    while grown.mesh.faces.len() < faces {
        limit *= STEP;
        grown.split_above(limit);
    }
    grown.mesh
}

/// The mesh while it grows.
struct Grown<'a, S: Surface> {
    surface: &'a S,
    mesh: IndexedMesh,
    sites: Vec<S::Site>,
    /// Across the side from corner i to the next.
    neighbours: Vec<[u32; 3]>,
    /// Squared length of the longest side over the squared length wanted.
    excess: Vec<f64>,
}

impl<'a, S: Surface> Grown<'a, S> {
    fn new(surface: &'a S, start: Start<S::Site>, faces: usize) -> Self {
        let Start { mut sites, faces: first, uvs, face_uvs } = start;
        let neighbours = neighbours(&first);
        let positions = sites.iter_mut().map(|s| surface.position(s)).collect();
        let mut mesh = IndexedMesh { positions, faces: first, uvs, face_uvs, surfaces: Vec::new() };
        let more = (faces + faces / 8).saturating_sub(mesh.faces.len());
        mesh.faces.reserve(more);
        mesh.face_uvs.reserve(more);
        let mut grown = Self { surface, mesh, sites, neighbours, excess: Vec::with_capacity(more) };
        grown.excess = (0..grown.mesh.faces.len()).map(|t| grown.excess_of(t)).collect();
        grown
    }

    fn split_above(&mut self, limit: f64) {
        let mut t = 0;
        while t < self.mesh.faces.len() {
            while self.excess[t] > limit {
                self.bisect(t);
            }
            t += 1;
        }
    }

    /// Bisects a face, and before it what must be bisected for the mesh to fit together.
    fn bisect(&mut self, t: usize) {
        loop {
            let other = self.neighbours[t][0] as usize;
            if self.neighbours[other][0] as usize == t {
                return self.bisect_pair(t, other);
            }
            self.bisect(other);
        }
    }

    /// `t` and `o` share their refinement edge. Each keeps its id as the child at its first corner.
    fn bisect_pair(&mut self, t: usize, o: usize) {
        let [a, b, _] = self.mesh.faces[t];
        let ([ta, tb, _], [ob, oa, _]) = (self.mesh.face_uvs[t], self.mesh.face_uvs[o]);
        let node = self.add_node(a, b);
        let t_uv = self.add_uv(ta, tb);
        let o_uv = if (ta, tb) == (oa, ob) { t_uv } else { self.add_uv(oa, ob) };
        let (t2, o2) = (self.mesh.faces.len() as u32, self.mesh.faces.len() as u32 + 1);
        self.halve(t, node, t_uv, t2, [o as u32, o2]);
        self.halve(o, node, o_uv, o2, [t as u32, t2]);
    }

    /// Cuts the face `[a, b, c]` into `[c, a, m]`, which keeps its id, and `[b, c, m]`, which is `second`. `across` are the halves
    /// of the neighbour over the refinement edge: at its first corner (our `b`) and at its second (our `a`).
    fn halve(&mut self, t: usize, m: u32, m_uv: u32, second: u32, across: [u32; 2]) {
        let ([a, b, c], [ua, ub, uc]) = (self.mesh.faces[t], self.mesh.face_uvs[t]);
        let [_, bc, ca] = self.neighbours[t];
        self.mesh.faces[t] = [c, a, m];
        self.mesh.face_uvs[t] = [uc, ua, m_uv];
        self.neighbours[t] = [ca, across[1], second];
        self.mesh.faces.push([b, c, m]);
        self.mesh.face_uvs.push([ub, uc, m_uv]);
        self.neighbours.push([bc, t as u32, across[0]]);
        if let Some(back) = self.neighbours[bc as usize].iter_mut().find(|n| **n as usize == t) {
            *back = second;
        }
        self.excess[t] = self.excess_of(t);
        self.excess.push(self.excess_of(second as usize));
    }

    fn add_node(&mut self, a: u32, b: u32) -> u32 {
        let mut site = self.surface.between(&self.sites[a as usize], &self.sites[b as usize]);
        self.mesh.positions.push(self.surface.position(&mut site));
        self.sites.push(site);
        self.sites.len() as u32 - 1
    }

    fn add_uv(&mut self, a: u32, b: u32) -> u32 {
        let uv = (self.mesh.uvs[a as usize] + self.mesh.uvs[b as usize]) * 0.5;
        self.mesh.uvs.push(uv);
        self.mesh.uvs.len() as u32 - 1
    }

    fn excess_of(&self, t: usize) -> f64 {
        let [a, b, c] = self.mesh.faces[t].map(|n| self.mesh.positions[n as usize]);
        let wanted = self.surface.edge_length((a + b + c) / 3.0);
        let longest = a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a));
        longest / (wanted * wanted)
    }
}

/// Who lies across each side of each face. The mesh is closed.
fn neighbours(faces: &[[u32; 3]]) -> Vec<[u32; 3]> {
    let sides = || (0..faces.len()).flat_map(|t| (0..3).map(move |i| (t, i)));
    let ends = |(t, i): (usize, usize)| (faces[t][i], faces[t][(i + 1) % 3]);
    let owner: std::collections::BTreeMap<(u32, u32), u32> = sides().map(|s| (ends(s), s.0 as u32)).collect();
    let mut found = vec![[0; 3]; faces.len()];
    for (t, i) in sides() {
        let (a, b) = ends((t, i));
        found[t][i] = owner[&(b, a)];
    }
    found
}
