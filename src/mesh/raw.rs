//! A mesh as its bare columns: what a cache keeps. No formats, no files; a reader and a writer are passed in.
//!
//! Layout, little-endian: whether it is textured (one byte), then for positions, anchors, vertices, edges and faces the count
//! (u64) and the rows, fields in the order of their declaration, ids and surface as u32. What was read is a [`RawMesh`] until
//! [`RawMesh::validate`] has looked at every index. That the topology is whole is not looked at: whoever keeps columns guards them
//! with a checksum.

use std::io::{self, Read, Write};

use glam::{DVec3, Vec2, Vec3};

use super::column::Column;
use super::{Edge, EdgeId, Face, FaceId, Mesh, NodeId, Surface, Vertex, VertexId};

/// Rows are moved in blocks of so many.
const BLOCK: usize = 2048;

/// Columns as they were read; not yet a mesh.
#[derive(Clone, Debug)]
pub struct RawMesh(Mesh);

/// An index that points nowhere, or columns that do not fit together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RawError;

/// An element of a column as bytes.
trait Row: Sized {
    const BYTES: usize;
    fn put(&self, bytes: &mut [u8]);
    /// `None` for bytes that stand for nothing.
    fn get(bytes: &[u8]) -> Option<Self>;
}

impl Row for DVec3 {
    const BYTES: usize = 24;

    fn put(&self, bytes: &mut [u8]) {
        let slots = bytes.as_chunks_mut::<8>().0.iter_mut();
        slots.zip(self.to_array()).for_each(|(slot, v)| *slot = v.to_le_bytes());
    }

    fn get(bytes: &[u8]) -> Option<Self> {
        let [x, y, z] = *bytes.as_chunks::<8>().0 else { return None };
        Some(Self::new(f64::from_le_bytes(x), f64::from_le_bytes(y), f64::from_le_bytes(z)))
    }
}

/// Rows of 32-bit words.
fn put_words<const N: usize>(bytes: &mut [u8], words: [u32; N]) {
    bytes.as_chunks_mut::<4>().0.iter_mut().zip(words).for_each(|(slot, w)| *slot = w.to_le_bytes());
}

fn get_words<const N: usize>(bytes: &[u8]) -> Option<[u32; N]> {
    let words: &[[u8; 4]; N] = bytes.as_chunks::<4>().0.try_into().ok()?;
    Some(words.map(u32::from_le_bytes))
}

impl Row for FaceId {
    const BYTES: usize = 4;

    fn put(&self, bytes: &mut [u8]) {
        put_words(bytes, [self.0]);
    }

    fn get(bytes: &[u8]) -> Option<Self> {
        get_words(bytes).map(|[id]| Self(id))
    }
}

impl Row for Vertex {
    const BYTES: usize = 44;

    fn put(&self, bytes: &mut [u8]) {
        let Self { uv, normal: n, tangent: t, bitangent: b } = *self;
        put_words(bytes, [uv.x, uv.y, n.x, n.y, n.z, t.x, t.y, t.z, b.x, b.y, b.z].map(f32::to_bits));
    }

    fn get(bytes: &[u8]) -> Option<Self> {
        let [u, v, nx, ny, nz, tx, ty, tz, bx, by, bz] = get_words(bytes)?.map(f32::from_bits);
        let [normal, tangent, bitangent] =
            [Vec3::new(nx, ny, nz), Vec3::new(tx, ty, tz), Vec3::new(bx, by, bz)];
        Some(Self { uv: Vec2::new(u, v), normal, tangent, bitangent })
    }
}

impl Row for Edge {
    const BYTES: usize = 16;

    fn put(&self, bytes: &mut [u8]) {
        let ([a, b], [f, g]) = (self.nodes, self.faces);
        put_words(bytes, [a.0, b.0, f.0, g.0]);
    }

    fn get(bytes: &[u8]) -> Option<Self> {
        let [a, b, f, g] = get_words(bytes)?;
        Some(Self { nodes: [NodeId(a), NodeId(b)], faces: [FaceId(f), FaceId(g)] })
    }
}

impl Row for Face {
    const BYTES: usize = 40;

    fn put(&self, bytes: &mut [u8]) {
        let ([a, b, c], [u, v, w], [e, f, g]) = (self.nodes, self.vertices, self.edges);
        put_words(bytes, [a.0, b.0, c.0, u.0, v.0, w.0, e.0, f.0, g.0, self.surface as u32]);
    }

    fn get(bytes: &[u8]) -> Option<Self> {
        let [a, b, c, u, v, w, e, f, g, surface] = get_words(bytes)?;
        let surface = match surface {
            0 => Surface::Skin,
            1 => Surface::Gutter,
            _ => return None,
        };
        let (nodes, vertices, edges) =
            ([a, b, c].map(NodeId), [u, v, w].map(VertexId), [e, f, g].map(EdgeId));
        Some(Self { nodes, vertices, edges, surface })
    }
}

impl Mesh {
    /// Writes the columns.
    pub fn write_raw(&self, out: &mut impl Write) -> io::Result<()> {
        out.write_all(&[u8::from(self.textured)])?;
        write_rows(self.positions.all(), out)?;
        write_rows(self.anchors.all(), out)?;
        write_rows(self.vertices.all(), out)?;
        write_rows(self.edges.all(), out)?;
        write_rows(self.faces.all(), out)
    }

    /// Reads columns from an input that has `limit` bytes; a count that does not fit into them is refused before anything is
    /// allocated for it.
    pub fn read_raw(input: &mut impl Read, limit: u64) -> io::Result<RawMesh> {
        let mut textured = [0];
        input.read_exact(&mut textured)?;
        let positions: Vec<DVec3> = read_rows(input, limit)?;
        let mesh = Self {
            positions: Column::new(positions),
            anchors: Column::new(read_rows(input, limit)?),
            vertices: Column::new(read_rows(input, limit)?),
            edges: Column::new(read_rows(input, limit)?),
            faces: Column::new(read_rows(input, limit)?),
            textured: textured[0] != 0,
        };
        Ok(RawMesh(mesh))
    }
}

impl RawMesh {
    /// Looks at every index, and makes it a mesh.
    pub fn validate(self) -> Result<Mesh, RawError> {
        let mesh = self.0;
        let (nodes, vertices) = (mesh.node_count() as u32, mesh.vertex_count() as u32);
        let (edges, faces) = (mesh.edge_count() as u32, mesh.face_count() as u32);
        let edge_fits = |e: &Edge| {
            e.nodes.iter().all(|n| n.0 < nodes)
                && e.faces[0].0 < faces
                && (e.faces[1].0 < faces || e.faces[1] == FaceId::NONE)
        };
        let face_fits = |f: &Face| {
            f.nodes.iter().all(|n| n.0 < nodes)
                && f.vertices.iter().all(|v| v.0 < vertices)
                && f.edges.iter().all(|e| e.0 < edges)
        };
        let fits = faces > 0
            && mesh.anchors.all().len() == nodes as usize
            && mesh.anchors.all().iter().all(|f| f.0 < faces)
            && mesh.edges().iter().all(edge_fits)
            && mesh.faces().iter().all(face_fits);
        if fits { Ok(mesh) } else { Err(RawError) }
    }
}

fn write_rows<T: Row>(rows: &[T], out: &mut impl Write) -> io::Result<()> {
    out.write_all(&(rows.len() as u64).to_le_bytes())?;
    let mut buffer = vec![0; BLOCK * T::BYTES];
    for block in rows.chunks(BLOCK) {
        let bytes = &mut buffer[..block.len() * T::BYTES];
        bytes.chunks_exact_mut(T::BYTES).zip(block).for_each(|(slot, row)| row.put(slot));
        out.write_all(bytes)?;
    }
    Ok(())
}

fn read_rows<T: Row>(input: &mut impl Read, limit: u64) -> io::Result<Vec<T>> {
    let damaged = || io::Error::from(io::ErrorKind::InvalidData);
    let mut count = [0; 8];
    input.read_exact(&mut count)?;
    let count = u64::from_le_bytes(count);
    if count > u64::from(u32::MAX) || count.saturating_mul(T::BYTES as u64) > limit {
        return Err(damaged());
    }
    let count = count as usize;
    let mut rows = Vec::with_capacity(Column::<FaceId>::roomy(count));
    let mut buffer = vec![0; BLOCK * T::BYTES];
    while rows.len() < count {
        let bytes = &mut buffer[..BLOCK.min(count - rows.len()) * T::BYTES];
        input.read_exact(bytes)?;
        for row in bytes.chunks_exact(T::BYTES) {
            rows.push(T::get(row).ok_or_else(damaged)?);
        }
    }
    Ok(rows)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::IndexedMesh;

    fn bytes() -> Vec<u8> {
        let strip = IndexedMesh {
            positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::ONE],
            faces: vec![[0, 1, 2], [1, 3, 2]],
            uvs: vec![Vec2::X],
            face_uvs: vec![[0; 3]; 2],
            surfaces: vec![Surface::Skin, Surface::Gutter],
        };
        let mut bytes = Vec::new();
        Mesh::build(&strip).expect("a strip").write_raw(&mut bytes).expect("to memory");
        bytes
    }

    fn read(bytes: &[u8]) -> Option<Mesh> {
        Mesh::read_raw(&mut &*bytes, bytes.len() as u64).ok()?.validate().ok()
    }

    #[test]
    fn columns_come_back() {
        let mesh = read(&bytes()).expect("a mesh");
        let mut again = Vec::new();
        mesh.write_raw(&mut again).expect("to memory");
        assert_eq!(again, bytes());
        assert!(mesh.is_textured() && mesh.face(FaceId(1)).surface == Surface::Gutter);
    }

    #[test]
    fn an_index_that_points_nowhere_is_refused() {
        // Faces are last: two rows of ten words; a surface may be 0 or 1, everything else counts to six at most.
        let (whole, rows) = (bytes(), 2 * 10);
        for word in 0..rows {
            let mut damaged = whole.clone();
            let at = whole.len() - 4 * (rows - word);
            damaged[at] = 7;
            assert!(read(&damaged).is_none(), "word {word} of the faces");
        }
    }

    #[test]
    fn a_count_beyond_the_input_is_refused() {
        let mut damaged = bytes();
        damaged[1..9].copy_from_slice(&u64::MAX.to_le_bytes());
        assert!(read(&damaged).is_none());
        damaged[1..9].copy_from_slice(&5u64.to_le_bytes());
        assert!(read(&damaged).is_none());
        assert!((0..bytes().len()).all(|end| read(&bytes()[..end]).is_none()));
    }
}
