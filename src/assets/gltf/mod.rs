//! glTF 2.0 and GLB: the triangles of every mesh that the default scene shows, where its nodes put them.
//!
//! The crate `gltf` reads and checks the document; the numbers are read here, since an accessor of a hostile file can point
//! anywhere and the crate's own iterators trust it. Triangles, strips and fans are read, points and lines passed over with a note. Texture
//! coordinates are those of set 0; glTF has its origin top left, so v becomes 1 − v. A transform that mirrors turns its triangles over. Skins and
//! morph targets are not applied: a mesh is taken as it rests. Sparse accessors are refused.

mod accessor;
mod buffers;

use glam::{DMat4, DVec3, Vec2};
use gltf::json::validation::Checked;
use gltf::mesh::Mode;
use gltf::{Document, Gltf, Node, Primitive, Semantic};

use super::Notes;
use super::error::{Fault, FaultKind};
use super::soup::{NO_UV, Polygons, Soup, Unit};
pub(super) use buffers::{Uri, buffer_uris};

/// Faces and nodes that a byte of a file and its buffers may come to. A byte is a face at most (of a strip), so a mesh may be shown that often; more is
/// not what a person meant, and without a bound a small file could fill any memory.
const MOST_A_BYTE: usize = 64;

/// Reads a glTF or GLB file, its buffers given by index (that of a GLB is in the file itself).
pub(super) fn read(bytes: &[u8], buffers: &[Vec<u8>]) -> Result<Soup, Fault> {
    let document = parse(bytes)?.document;
    let size = bytes.len() + buffers.iter().map(Vec::len).sum::<usize>();
    let mut collector = Collector { buffers, most: size.saturating_mul(MOST_A_BYTE), ..Collector::new() };
    collector.scene(&document)?;
    let Collector { positions, uvs, polygons, passed_over, .. } = collector;
    let mut soup = Soup::new(positions, uvs, &polygons, Unit::Face)?;
    if passed_over > 0 {
        soup.notes.note("primitive-without-faces", passed_over, "points and lines were passed over".into());
    }
    Ok(soup)
}

fn parse(bytes: &[u8]) -> Result<Gltf, Fault> {
    check_head(bytes)?;
    let invalid = |error: gltf::Error| Fault::whole(FaultKind::Syntax, error.to_string());
    let Gltf { document, blob } = Gltf::from_slice_without_validation(bytes).map_err(invalid)?;
    let root = document.into_json();
    check_positions(&root)?;
    Ok(Gltf { document: Document::from_json(root).map_err(invalid)?, blob })
}

/// The crate subtracts a GLB's head from the length that the head says, whatever that is.
fn check_head(bytes: &[u8]) -> Result<(), Fault> {
    const HEAD: u32 = 12;
    let length = bytes.get(8..12).and_then(|length| length.try_into().ok()).map(u32::from_le_bytes);
    match length.filter(|&length| bytes.starts_with(b"glTF") && length < HEAD) {
        None => Ok(()),
        Some(length) => {
            let detail = format!("the file says that it is {length} bytes long, less than its own head");
            Err(Fault::byte(8, FaultKind::Syntax, detail))
        }
    }
}

/// The crate's validation takes it that the accessor of positions exists, and panics where it does not.
fn check_positions(root: &gltf::json::Root) -> Result<(), Fault> {
    let key = Checked::Valid(Semantic::Positions);
    for (number, mesh) in root.meshes.iter().enumerate() {
        let positions = mesh.primitives.iter().filter_map(|p| p.attributes.get(&key));
        if let Some(accessor) = positions.map(|i| i.value()).find(|&i| i >= root.accessors.len()) {
            let detail = format!("mesh {number} names accessor {accessor}, which does not exist");
            return Err(Fault::whole(FaultKind::Index, detail));
        }
    }
    Ok(())
}

struct Collector<'a> {
    buffers: &'a [Vec<u8>],
    /// Faces, and nodes, that the file may come to.
    most: usize,
    positions: Vec<DVec3>,
    uvs: Vec<Vec2>,
    polygons: Polygons,
    passed_over: usize,
}

impl Collector<'_> {
    fn new() -> Self {
        Self {
            buffers: &[],
            most: 0,
            positions: Vec::new(),
            uvs: Vec::new(),
            polygons: Polygons::default(),
            passed_over: 0,
        }
    }

    /// Walks over the default scene's nodes, or the first scene's; a document without scenes shows nothing.
    fn scene(&mut self, document: &Document) -> Result<(), Fault> {
        let Some(scene) = document.default_scene().or_else(|| document.scenes().next()) else {
            return Err(Fault::whole(FaultKind::Empty, "there is no scene in it"));
        };
        let mut seen = vec![false; document.nodes().len()];
        let mut open: Vec<(Node<'_>, DMat4)> = scene.nodes().map(|n| (n, DMat4::IDENTITY)).collect();
        open.reverse();
        while let Some((node, above)) = open.pop() {
            if std::mem::replace(&mut seen[node.index()], true) {
                let detail = format!("node {} is reached twice", node.index());
                return Err(Fault::whole(FaultKind::Syntax, detail));
            }
            let here = above * matrix(&node);
            for primitive in node.mesh().iter().flat_map(|m| m.primitives()) {
                self.primitive(&primitive, &here)?;
            }
            let children: Vec<_> = node.children().map(|n| (n, here)).collect();
            open.extend(children.into_iter().rev());
        }
        Ok(())
    }

    fn primitive(&mut self, primitive: &Primitive<'_>, placed: &DMat4) -> Result<(), Fault> {
        let mode = primitive.mode();
        if !matches!(mode, Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan) {
            self.passed_over += 1;
            return Ok(());
        }
        let Some(positions) = primitive.get(&Semantic::Positions) else {
            self.passed_over += 1;
            return Ok(());
        };
        let points = accessor::reals::<3>(&positions, self.buffers)?;
        self.admit(points.len().saturating_add(self.positions.len()))?;
        let first = u32::try_from(self.positions.len()).unwrap_or(u32::MAX);
        let place = |p: &[f32; 3]| placed.transform_point3(DVec3::from(p.map(f64::from))) + DVec3::ZERO;
        self.positions.extend(points.iter().map(place));
        let first_uv = self.texture_coordinates(primitive, points.len())?;
        let indices = match primitive.indices() {
            Some(indices) => accessor::indices(&indices, self.buffers)?,
            None => (0..points.len() as u32).collect(),
        };
        if let Some(&bad) = indices.iter().find(|i| **i as usize >= points.len()) {
            let detail =
                format!("index {bad} (from 0) names nothing, the primitive has {} nodes", points.len());
            return Err(Fault::whole(FaultKind::Index, detail));
        }
        self.admit(indices.len().saturating_add(self.polygons.ends.len()))?;
        let mirrored = placed.determinant() < 0.0;
        triangles(mode, &indices, |[a, b, c]| {
            self.triangle(first, first_uv, if mirrored { [a, c, b] } else { [a, b, c] });
        });
        Ok(())
    }

    /// Refuses more than the file's size justifies.
    fn admit(&self, count: usize) -> Result<(), Fault> {
        if count <= self.most {
            return Ok(());
        }
        let detail = format!(
            "its meshes are shown so often that they come to {count} nodes or corners, more than {}",
            self.most
        );
        Err(Fault::whole(FaultKind::TooLarge, detail))
    }

    /// Appends set 0; says where it starts.
    fn texture_coordinates(&mut self, primitive: &Primitive<'_>, nodes: usize) -> Result<Option<u32>, Fault> {
        let Some(accessor) = primitive.get(&Semantic::TexCoords(0)) else { return Ok(None) };
        let uvs = accessor::reals::<2>(&accessor, self.buffers)?;
        if uvs.len() != nodes {
            let detail = format!("{} texture coordinates for {nodes} nodes", uvs.len());
            return Err(Fault::whole(FaultKind::Syntax, detail));
        }
        let first = self.uvs.len() as u32;
        self.uvs.extend(uvs.iter().map(|&[u, v]| Vec2::new(u, 1.0 - v) + Vec2::ZERO));
        Ok(Some(first))
    }

    fn triangle(&mut self, first: u32, first_uv: Option<u32>, corners: [u32; 3]) {
        let number = u32::try_from(self.polygons.ends.len()).unwrap_or(u32::MAX);
        let uv = |c: u32| first_uv.map_or(NO_UV, |f| f.saturating_add(c));
        self.polygons.corners.extend(corners.map(|c| [first.saturating_add(c), uv(c)]));
        self.polygons.close(number);
    }
}

/// A node's place under its parent.
fn matrix(node: &Node<'_>) -> DMat4 {
    DMat4::from_cols_array_2d(&node.transform().matrix().map(|column| column.map(f64::from)))
}

/// The triangles of a list, strip or fan; corners left over at the end of a list make none.
fn triangles(mode: Mode, indices: &[u32], mut each: impl FnMut([u32; 3])) {
    match mode {
        Mode::TriangleStrip => indices.windows(3).enumerate().for_each(|(i, w)| {
            each(if i % 2 == 0 { [w[0], w[1], w[2]] } else { [w[1], w[0], w[2]] });
        }),
        Mode::TriangleFan => {
            let pairs = indices.get(1..).unwrap_or_default().windows(2);
            pairs.for_each(|w| each([indices[0], w[0], w[1]]));
        }
        _ => indices.as_chunks::<3>().0.iter().for_each(|t| each(*t)),
    }
}

#[cfg(test)]
mod tests;
