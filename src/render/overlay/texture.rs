//! What is drawn over a map, in texture space: where a face's corners have their texture coordinates, v up, maps repeating.
//!
//! Only the skin's faces lie on the map; the inside of a cut has a texture of its own. A seam lies in two places, once for either side, and so does
//! what is marked on it. What reports show in space, lines and points, has no place here.

use glam::{DVec2, Vec2, dvec2};

use super::marked::Marked;
use super::{Drawing, FACES, Ink, LINE, MARK, Radii, WIRE, chart_colours, disc, share};
use crate::canvas::image::Image;
use crate::mesh::{Edge, EdgeId, Face, FaceId, Mesh, NodeId, Surface, VertexId};
use crate::render::overlay::ink::blend;
use crate::render::spans::{COPIES, FARTHEST, Window, each_copy, place, spans};
use crate::report::Overlay;

/// Texels that a side must have on average to be drawn at full strength.
const ROOMY: f64 = 8.0;

/// Draws over a map of a mesh, in order.
pub fn draw_uv(image: &mut Image, mesh: &Mesh, drawings: &[Drawing<'_>]) {
    if !mesh.is_textured() || image.texels.is_empty() {
        return;
    }
    let sheet = Sheet { mesh, size: image.size, radii: Radii::new(1) };
    let mut colours = FACES.iter().cycle();
    for drawing in drawings {
        match drawing {
            Drawing::Wire => sheet.wire().lay(image, WIRE),
            Drawing::Charts => sheet.charts(image),
            Drawing::Marked(ids) => sheet.marked(&Marked::of(mesh, ids)).lay(image, MARK),
            Drawing::Shown(Overlay::Faces { faces, .. }) => {
                sheet.faces(faces).lay(image, *colours.next().unwrap_or(&LINE));
            }
            Drawing::Shown(Overlay::Line { .. } | Overlay::Points { .. }) => {}
        }
    }
}

/// A mesh on a map.
struct Sheet<'a> {
    mesh: &'a Mesh,
    size: [u32; 2],
    radii: Radii,
}

impl Sheet<'_> {
    /// All edges, and stronger those that charts end at.
    fn wire(&self) -> Ink {
        let [w, h] = self.size.map(f64::from);
        let side = libm::sqrt(w * h / self.mesh.face_count().max(1) as f64);
        let faint = (f64::from(share::WIRE) * (side / ROOMY).clamp(0.25, 1.0)) as u8;
        let mut ink = Ink::none(self.size);
        for (i, edge) in self.mesh.edges().iter().enumerate() {
            let whole = self.is_whole(edge);
            let share = if whole { faint } else { share::SEAM };
            let sides = if whole { &edge.faces[..1] } else { &edge.faces[..] };
            self.edge(EdgeId::of(i), sides, self.radii.line, |at| ink.ask(at, share));
        }
        ink
    }

    /// Whether the map goes on across an edge.
    fn is_whole(&self, edge: &Edge) -> bool {
        !edge.is_boundary() && !self.mesh.is_seam(edge)
    }

    fn charts(&self, image: &mut Image) {
        let colours = chart_colours(self.mesh);
        let mut seen = vec![FaceId::NONE; image.texels.len()];
        (0..self.mesh.face_count()).map(FaceId::of).for_each(|face| self.fill(face, |at| seen[at] = face));
        for (texel, face) in image.texels.iter_mut().zip(seen) {
            if let Some(face) = face.some() {
                blend(texel, colours[face.at()], share::FACE);
            }
        }
    }

    fn faces(&self, faces: &[u32]) -> Ink {
        let mut ink = Ink::none(self.size);
        let there = faces.iter().map(|face| FaceId(*face)).filter(|face| self.mesh.has_face(*face));
        there.for_each(|face| self.fill(face, |at| ink.ask(at, share::FACE)));
        ink
    }

    fn marked(&self, marked: &Marked) -> Ink {
        let mut ink = Ink::none(self.size);
        for &face in &marked.faces {
            self.fill(face, |at| ink.ask(at, share::FACE));
            for id in self.mesh.face(face).edges {
                let edge = self.mesh.edge(id);
                if marked.is_outline(&edge) || !self.is_whole(&edge) {
                    self.edge(id, &[face], self.radii.mark, |at| ink.ask(at, share::FULL));
                }
            }
        }
        for &edge in &marked.edges {
            self.edge(edge, &self.mesh.edge(edge).faces, self.radii.mark, |at| ink.ask(at, share::FULL));
        }
        let of_nodes = marked.nodes.iter().flat_map(|node| self.vertices(*node));
        for vertex in of_nodes.chain(marked.vertices.iter().copied()) {
            self.dot(self.mesh.vertex(vertex).uv, |at| ink.ask(at, share::FULL));
        }
        ink
    }

    /// A node's vertices on the skin.
    fn vertices(&self, node: NodeId) -> Vec<VertexId> {
        let corners = self.mesh.fan(node).map(|(face, corner)| (self.mesh.face(face), corner));
        let skin = corners.filter(|(face, _)| face.surface == Surface::Skin);
        skin.map(|(face, corner)| face.vertices[corner]).collect()
    }

    /// Tells of the texels whose centres a face covers.
    fn fill(&self, face: FaceId, mut each: impl FnMut(usize)) {
        let Some(face) = self.skin(face) else { return };
        let Some(corners) = place(face.vertices.map(|v| self.mesh.vertex(v).uv), self.size) else { return };
        each_copy(corners, self.size, |corners| {
            spans(corners, Window::whole(self.size), |row, columns| {
                let start = row as usize * self.size[0] as usize;
                columns.for_each(|column| each(start + column as usize));
            });
        });
    }

    /// Tells of the texels of an edge, as these of its faces have it.
    fn edge(&self, edge: EdgeId, faces: &[FaceId], radius: i64, mut each: impl FnMut(usize)) {
        for face in faces.iter().filter_map(|face| self.skin(*face)) {
            if let Some(side) = face.side(edge) {
                let ends = [side, (side + 1) % 3].map(|corner| self.mesh.vertex(face.vertices[corner]).uv);
                self.stroke(ends, radius, &mut each);
            }
        }
    }

    fn skin(&self, face: FaceId) -> Option<&Face> {
        let face = self.mesh.face(face.some()?);
        (face.surface == Surface::Skin).then_some(face)
    }

    /// Where texture coordinates are, in texels; none so far out that texels are not told apart.
    fn place(&self, uv: Vec2) -> Option<DVec2> {
        let [w, h] = self.size.map(f64::from);
        // A NaN is not within.
        let within = uv.x.abs() <= FARTHEST && uv.y.abs() <= FARTHEST;
        within.then(|| dvec2(f64::from(uv.x) * w, (1.0 - f64::from(uv.y)) * h))
    }

    fn stroke(&self, ends: [Vec2; 2], radius: i64, mut each: impl FnMut(usize)) {
        let [Some(p), Some(q)] = ends.map(|uv| self.place(uv)) else { return };
        let steps = (q - p).abs().max_element().ceil().max(1.0);
        if steps > COPIES as f64 * self.size[0].max(self.size[1]) as f64 {
            return;
        }
        for step in 0..=steps as u32 {
            self.blot(p.lerp(q, f64::from(step) / steps), radius, &mut each);
        }
    }

    fn dot(&self, uv: Vec2, mut each: impl FnMut(usize)) {
        if let Some(at) = self.place(uv) {
            self.blot(at, self.radii.point, &mut each);
        }
    }

    fn blot(&self, at: DVec2, radius: i64, each: &mut impl FnMut(usize)) {
        let middle = at.floor().to_array().map(|v| v as i64);
        disc(middle, radius).map(|texel| self.wrapped(texel)).for_each(each);
    }

    fn wrapped(&self, [x, y]: [i64; 2]) -> usize {
        let [w, h] = self.size.map(i64::from);
        (y.rem_euclid(h) * w + x.rem_euclid(w)) as usize
    }
}
