//! What a reader hands on: triangles that index nodes, and for each the place in the file that it came from.

use glam::{DVec3, Vec2};

use super::error::{Fault, FaultKind, Place};
use super::polygon::{self, Triangulator};
use super::{Note, Notes};
use crate::mesh::IndexedMesh;

/// "No texture coordinate" at a corner.
pub(super) const NO_UV: u32 = u32::MAX;

/// What [`Soup::origin`] counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Unit {
    /// Lines of the file, from 1.
    Line,
    /// Faces of the file, from 0.
    Face,
}

/// Polygons as a file lists them: flat corners of (node, texture coordinate).
#[derive(Debug, Default)]
pub(super) struct Polygons {
    /// Node and texture coordinate of each corner.
    pub(super) corners: Vec<[u32; 2]>,
    /// For each polygon where its corners end, and its place in the file.
    pub(super) ends: Vec<(u32, u32)>,
}

impl Polygons {
    /// Ends a polygon: it has the corners pushed since the last one.
    pub(super) fn close(&mut self, origin: u32) {
        self.ends.push((self.corners.len() as u32, origin));
    }
}

/// Triangles with their places in the file.
#[derive(Debug)]
pub(super) struct Soup {
    pub(super) mesh: IndexedMesh,
    /// Line or number in the file, for each face.
    pub(super) origin: Vec<u32>,
    pub(super) unit: Unit,
    pub(super) notes: Vec<Note>,
}

impl Soup {
    /// Triangulates a file's polygons, each index checked.
    pub(super) fn new(
        positions: Vec<DVec3>,
        uvs: Vec<Vec2>,
        polygons: &Polygons,
        unit: Unit,
    ) -> Result<Self, Fault> {
        let mesh = IndexedMesh { positions, uvs, ..IndexedMesh::default() };
        let mut soup = Self { mesh, origin: Vec::new(), unit, notes: Vec::new() };
        soup.check_sizes(polygons)?;
        soup.reserve(polygons);
        soup.add_all(polygons)?;
        soup.complete_uvs(polygons);
        Ok(soup)
    }

    /// Where a face stands in the file.
    pub(super) fn place(&self, face: usize) -> Place {
        place(self.unit, self.origin.get(face).copied().unwrap_or_default())
    }

    /// The same, to be read.
    pub(super) fn says(&self, face: usize) -> String {
        self.place(face).to_string()
    }

    /// Keeps the faces that `keep` says yes to, in order.
    pub(super) fn retain_faces(&mut self, keep: &[bool]) {
        let mut flags = keep.iter().copied();
        let mut next = || flags.next().unwrap_or(true);
        self.mesh.faces.retain(|_| next());
        let mut flags = keep.iter().copied();
        self.origin.retain(|_| flags.next().unwrap_or(true));
        let mut flags = keep.iter().copied();
        self.mesh.face_uvs.retain(|_| flags.next().unwrap_or(true));
    }

    /// Turns a face over.
    pub(super) fn flip(&mut self, face: usize) {
        self.mesh.faces[face].swap(1, 2);
        if let Some(uvs) = self.mesh.face_uvs.get_mut(face) {
            uvs.swap(1, 2);
        }
    }

    /// Drops the nodes that no face uses; says how many there were.
    pub(super) fn compact(&mut self) -> usize {
        let IndexedMesh { positions, faces, .. } = &mut self.mesh;
        let mut new_id = vec![u32::MAX; positions.len()];
        faces.iter().flatten().for_each(|&n| new_id[n as usize] = 0);
        let mut count = 0;
        for id in new_id.iter_mut().filter(|id| **id == 0) {
            *id = count;
            count += 1;
        }
        let unused = positions.len() - count as usize;
        if unused > 0 {
            faces.iter_mut().flatten().for_each(|n| *n = new_id[*n as usize]);
            let mut ids = new_id.iter();
            positions.retain(|_| ids.next().is_some_and(|&id| id != u32::MAX));
        }
        unused
    }

    fn check_sizes(&self, polygons: &Polygons) -> Result<(), Fault> {
        let limit = (u32::MAX / 8) as usize;
        let largest = self.mesh.positions.len().max(self.mesh.uvs.len()).max(polygons.corners.len() / 3);
        if largest < limit {
            return Ok(());
        }
        Err(Fault::whole(
            FaultKind::TooLarge,
            format!("{largest} elements are more than 32-bit ids can name"),
        ))
    }

    fn reserve(&mut self, polygons: &Polygons) {
        let triangles = polygons.corners.len().saturating_sub(2 * polygons.ends.len());
        self.mesh.faces.reserve_exact(triangles);
        self.origin.reserve_exact(triangles);
        if polygons.corners.iter().any(|c| c[1] != NO_UV) {
            self.mesh.face_uvs.reserve_exact(triangles);
        }
    }

    fn add_all(&mut self, polygons: &Polygons) -> Result<(), Fault> {
        let textured = self.mesh.face_uvs.capacity() > 0;
        let mut triangulator = Triangulator::default();
        let (mut start, mut twisted) = (0, Vec::new());
        for &(end, origin) in &polygons.ends {
            let corners = &polygons.corners[start..end as usize];
            start = end as usize;
            self.check_corners(corners, origin)?;
            let simple = self.add(corners, origin, textured, &mut triangulator)?;
            if !simple {
                twisted.push(origin);
            }
        }
        if let Some(&first) = twisted.first() {
            let detail = format!("polygons that cross themselves, the first at {}", place(self.unit, first));
            self.notes.note("polygon-not-simple", twisted.len(), detail);
        }
        Ok(())
    }

    fn check_corners(&self, corners: &[[u32; 2]], origin: u32) -> Result<(), Fault> {
        let (nodes, uvs) = (self.mesh.positions.len(), self.mesh.uvs.len());
        let fault = |what: &str, id: u32, count: usize| {
            let detail = format!("{what} {id} (from 0) does not exist, there are {count}");
            Err(Fault::new(place(self.unit, origin), FaultKind::Index, detail))
        };
        for &[node, uv] in corners {
            if node as usize >= nodes {
                return fault("node", node, nodes);
            }
            if uv != NO_UV && uv as usize >= uvs {
                return fault("texture coordinate", uv, uvs);
            }
        }
        Ok(())
    }

    fn add(
        &mut self,
        corners: &[[u32; 2]],
        origin: u32,
        textured: bool,
        triangulator: &mut Triangulator,
    ) -> Result<bool, Fault> {
        let positions = &self.mesh.positions;
        let outline = corners.iter().map(|c| positions[c[0] as usize]);
        let simple = triangulator.run(outline).map_err(|polygon::TooComplex| {
            let detail = format!("a concave polygon of {} corners takes too long to cut up", corners.len());
            Fault::new(place(self.unit, origin), FaultKind::TooLarge, detail)
        })?;
        for triangle in &triangulator.triangles {
            self.mesh.faces.push(triangle.map(|i| corners[i as usize][0]));
            self.origin.push(origin);
            if textured {
                self.mesh.face_uvs.push(triangle.map(|i| corners[i as usize][1]));
            }
        }
        Ok(simple)
    }

    /// Corners without a texture coordinate, in a file that has some, get (0, 0).
    fn complete_uvs(&mut self, polygons: &Polygons) {
        let missing = polygons.corners.iter().filter(|c| c[1] == NO_UV).count();
        if self.mesh.face_uvs.is_empty() {
            self.mesh.uvs.clear();
        } else if missing > 0 {
            let origin = self.mesh.uvs.len() as u32;
            self.mesh.uvs.push(Vec2::ZERO);
            let corners = self.mesh.face_uvs.iter_mut().flatten();
            corners.filter(|c| **c == NO_UV).for_each(|c| *c = origin);
            let detail = "corners without a texture coordinate got (0, 0)";
            self.notes.note("texture-coordinate-missing", missing, detail.into());
        }
    }
}

/// A place from what a reader counted.
pub(super) fn place(unit: Unit, origin: u32) -> Place {
    match unit {
        Unit::Line => Place::Line(origin.into()),
        Unit::Face => Place::Face(origin.into()),
    }
}
