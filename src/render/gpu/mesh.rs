//! The mesh on the device: vertices by vertex id, corners by face. A copy here says what is there, so that only what has changed goes over.
//!
//! A vertex is written as its node's position relative to the job's origin, in f32, and its attributes; all as the bits of their
//! floats, so that a NaN equals itself.

use std::ops::Range;

use glam::{DVec3, Vec3};
use wgpu::BufferUsages;

use super::device::Device;
use super::store::Store;
use crate::canvas::RenderError;
use crate::canvas::frame::FrameJob;
use crate::mesh::{Mesh, Vertex};

/// Words of a vertex: position, texture coordinates, normal, tangent, bitangent, surface.
pub(crate) const WORDS: usize = 15;

/// A vertex as it lies in its buffer.
type Row = [u32; WORDS];

/// Rows that are written along although they have not changed, if changed ones lie on both sides: a command costs more than they do.
const GAP: usize = 32;

/// A mesh on the device.
#[derive(Debug)]
pub(crate) struct Surface {
    rows: Vec<Row>,
    corners: Vec<[u32; 3]>,
    vertices: Store,
    indices: Store,
    seen: Option<(u64, DVec3)>,
    bounds: [DVec3; 2],
    revision: u64,
}

/// What went over to the device.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Uploaded {
    /// Vertices, in ranges.
    pub(crate) vertices: Vec<Range<usize>>,
    /// Faces, in ranges.
    pub(crate) faces: Vec<Range<usize>>,
}

impl Uploaded {
    /// Whether nothing did.
    pub(crate) fn is_empty(&self) -> bool {
        self.vertices.is_empty() && self.faces.is_empty()
    }
}

impl Surface {
    /// Of a mesh without any face.
    pub(crate) fn new() -> Self {
        Self {
            rows: Vec::new(),
            corners: Vec::new(),
            vertices: Store::new("vertices", BufferUsages::VERTEX | BufferUsages::STORAGE),
            indices: Store::new("corners of faces", BufferUsages::INDEX | BufferUsages::STORAGE),
            seen: None,
            bounds: [DVec3::ZERO; 2],
            revision: 0,
        }
    }

    /// Makes what is on the device the mesh of a job.
    pub(crate) fn follow(&mut self, device: &Device, job: &FrameJob<'_>) -> Result<Uploaded, RenderError> {
        if self.seen == Some((job.version, job.origin)) {
            return Ok(Uploaded::default());
        }
        // Until all is over there, nothing is known of it.
        self.seen = None;
        let rows = rows(job.mesh, job.origin);
        let corners: Vec<_> = job.mesh.faces().iter().map(|face| face.vertices.map(|v| v.0)).collect();
        let uploaded = Uploaded {
            vertices: self.vertices.follow(device, &self.rows, &rows, GAP)?,
            faces: self.indices.follow(device, &self.corners, &corners, GAP)?,
        };
        (self.rows, self.corners, self.bounds) = (rows, corners, job.mesh.bounds());
        self.revision += u64::from(!uploaded.is_empty());
        self.seen = Some((job.version, job.origin));
        Ok(uploaded)
    }

    /// The corners of the box around it, model units.
    pub(crate) fn bounds(&self) -> [DVec3; 2] {
        self.bounds
    }

    /// Whether there is nothing to draw.
    pub(crate) fn is_empty(&self) -> bool {
        self.corners.is_empty()
    }

    /// Changes whenever something on the device does.
    pub(crate) fn revision(&self) -> u64 {
        self.revision
    }

    /// Its vertices and the corners of its faces, for shaders that look them up. An error before anything was uploaded.
    pub(crate) fn buffers(&self) -> Result<[&wgpu::Buffer; 2], RenderError> {
        let both = self.vertices.buffer().zip(self.indices.buffer());
        both.map(<[_; 2]>::from).ok_or_else(|| RenderError::Refused("no mesh was uploaded".into()))
    }

    /// How many corners its faces have.
    pub(crate) fn corner_count(&self) -> u32 {
        3 * self.corners.len() as u32
    }

    /// Draws all of it, by the positions alone.
    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        let (Some(vertices), Some(indices)) = (self.vertices.buffer(), self.indices.buffer()) else { return };
        pass.set_vertex_buffer(0, vertices.slice(..));
        pass.set_index_buffer(indices.slice(..), wgpu::IndexFormat::Uint32);
        pass.draw_indexed(0..self.corner_count(), 0, 0..1);
    }
}

/// All vertices of a mesh. One that no face has stays at the origin.
fn rows(mesh: &Mesh, origin: DVec3) -> Vec<Row> {
    let mut rows: Vec<Row> = mesh.vertices().iter().map(attributes).collect();
    for face in mesh.faces() {
        for (node, vertex) in face.nodes.iter().zip(face.vertices) {
            let row = &mut rows[vertex.0 as usize];
            row[..3].copy_from_slice(&bits((mesh.position(*node) - origin).as_vec3()));
            row[WORDS - 1] = face.surface as u32;
        }
    }
    rows
}

fn attributes(vertex: &Vertex) -> Row {
    let mut row = [0; WORDS];
    row[3..5].copy_from_slice(&vertex.uv.to_array().map(f32::to_bits));
    for (words, vector) in
        row[5..14].chunks_exact_mut(3).zip([vertex.normal, vertex.tangent, vertex.bitangent])
    {
        words.copy_from_slice(&bits(vector));
    }
    row
}

fn bits(vector: Vec3) -> [u32; 3] {
    vector.to_array().map(f32::to_bits)
}
