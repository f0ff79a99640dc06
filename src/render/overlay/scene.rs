//! Where lines, points and faces lie in a view, and whether the surface hides them.
//!
//! The nearest face at each pixel comes from the reference's rasterizer. A line is followed pixel by pixel in seen space, where 1/Z is linear, and is
//! hidden where it lies behind the nearest surface by more than a thousandth of its depth: lines lie on the surface, and must not be hidden by the
//! faces that they lie on. A stroke wider than a pixel is hidden where its middle is.

use glam::DVec3;
use rayon::prelude::*;
use rustc_hash::FxHashSet;

use super::ink::blend;
use super::marked::Marked;
use super::{Ink, Radii, chart_colours, disc, share};
use crate::canvas::frame::View;
use crate::canvas::image::Image;
use crate::mesh::{FaceId, Mesh};
use crate::render::reference::lens::Lens;
use crate::render::reference::raster::{BAND, Drawing as Raster};

/// How far behind the surface a line may lie and still be seen, as a share of its depth.
const HIDDEN: f64 = 1e-3;
/// Pixels that a seen face must have on average for its edges to be drawn at full strength.
const ROOMY: usize = 24;

/// The nearest face at a pixel, and its depth.
#[derive(Clone, Copy)]
struct Nearest {
    face: FaceId,
    inverse: f32,
}

fn nearest(mesh: &Mesh, lens: &Lens) -> Vec<Nearest> {
    let [width, height] = lens.size.map(|side| side as usize);
    let raster = Raster::new(mesh, lens);
    let mut all = vec![Nearest { face: FaceId::NONE, inverse: 0.0 }; width * height];
    all.par_chunks_mut((width * BAND).max(1)).enumerate().for_each(|(band, pixels)| {
        raster.draw(band, |at, triangle, inverse| {
            if inverse > pixels[at].inverse {
                pixels[at] = Nearest { face: FaceId(raster.triangle(triangle).face), inverse };
            }
        });
    });
    all
}

/// A mesh as a view sees it.
pub(super) struct Scene<'a> {
    mesh: &'a Mesh,
    lens: Lens,
    nearest: Vec<Nearest>,
    radii: Radii,
}

impl<'a> Scene<'a> {
    pub(super) fn new(view: &View, mesh: &'a Mesh, factor: u32) -> Self {
        let lens = Lens::of_view(view);
        Self { mesh, lens, nearest: nearest(mesh, &lens), radii: Radii::new(factor) }
    }

    /// The edges of the faces that are seen, fainter where these are too small to be told apart.
    pub(super) fn wire(&self) -> Ink {
        let mut faces: Vec<FaceId> = self.nearest.iter().filter_map(|n| n.face.some()).collect();
        let pixels = faces.len();
        faces.par_sort_unstable();
        faces.dedup();
        let room = (pixels * usize::from(share::WIRE)) / (faces.len() * ROOMY).max(1);
        let share = room.clamp(usize::from(share::WIRE / 4), usize::from(share::WIRE)) as u8;
        let mut edges: Vec<_> = faces.iter().flat_map(|f| self.mesh.face(*f).edges).collect();
        edges.par_sort_unstable();
        edges.dedup();
        let mut ink = self.ink();
        for edge in edges {
            let ends = self.mesh.edge(edge).nodes.map(|n| self.mesh.position(n));
            self.stroke(ends, self.radii.line, |at, seen| ink.ask(at, if seen { share } else { 0 }));
        }
        ink
    }

    /// Every face in its chart's colour.
    pub(super) fn charts(&self, image: &mut Image) {
        let colours = chart_colours(self.mesh);
        for (texel, nearest) in image.texels.iter_mut().zip(&self.nearest) {
            if let Some(face) = nearest.face.some() {
                blend(texel, colours[face.at()], share::FACE);
            }
        }
    }

    /// Faces, where they are nearest.
    pub(super) fn faces(&self, faces: &[u32]) -> Ink {
        let faces: FxHashSet<FaceId> = faces.iter().copied().map(FaceId).collect();
        let mut ink = self.ink();
        for (at, nearest) in self.nearest.iter().enumerate() {
            if faces.contains(&nearest.face) {
                ink.ask(at, share::FACE);
            }
        }
        ink
    }

    /// A line through points.
    pub(super) fn polyline(&self, points: &[[f64; 3]]) -> Ink {
        let mut ink = self.ink();
        for ends in points.windows(2) {
            let ends = [ends[0], ends[1]].map(DVec3::from);
            self.stroke(ends, self.radii.line, |at, seen| {
                ink.ask(at, if seen { share::FULL } else { 0 });
            });
        }
        ink
    }

    /// Points.
    pub(super) fn points(&self, points: &[[f64; 3]]) -> Ink {
        let mut ink = self.ink();
        for point in points {
            self.dot((*point).into(), |at, seen| ink.ask(at, if seen { share::FULL } else { 0 }));
        }
        ink
    }

    /// What is selected, fainter where it is hidden.
    pub(super) fn marked(&self, marked: &Marked) -> Ink {
        let mut ink = self.ink();
        self.fill(marked, &mut ink);
        let line = |seen: bool| if seen { share::FULL } else { share::HIDDEN_LINE };
        let sides = marked.faces.iter().flat_map(|face| self.mesh.face(*face).edges);
        let outline = sides.filter(|edge| marked.is_outline(&self.mesh.edge(*edge)));
        for edge in outline.chain(marked.edges.iter().copied()) {
            let ends = self.mesh.edge(edge).nodes.map(|n| self.mesh.position(n));
            self.stroke(ends, self.radii.mark, |at, seen| ink.ask(at, line(seen)));
        }
        for node in marked.all_nodes(self.mesh) {
            self.dot(self.mesh.position(node), |at, seen| ink.ask(at, line(seen)));
        }
        ink
    }

    /// The marked faces' pixels, hidden ones too.
    fn fill(&self, marked: &Marked, ink: &mut Ink) {
        let raster = Raster::of_faces(self.mesh, &self.lens, marked.faces.iter().copied());
        let width = self.lens.size[0] as usize;
        for band in 0..(self.lens.size[1] as usize).div_ceil(BAND) {
            let start = band * BAND * width;
            raster.draw(band, |at, triangle, _| {
                let seen = self.nearest[start + at].face.0 == raster.triangle(triangle).face;
                ink.ask(start + at, if seen { share::FACE } else { share::HIDDEN_FACE });
            });
        }
    }

    /// The face that is seen at a pixel.
    #[cfg(test)]
    pub(super) fn face(&self, pixel: [i64; 2]) -> Option<FaceId> {
        self.nearest[self.index(pixel)?].face.some()
    }

    fn ink(&self) -> Ink {
        Ink::none(self.lens.size)
    }

    /// Tells of each pixel of a line, and whether it is seen.
    fn stroke(&self, ends: [DVec3; 2], radius: i64, mut each: impl FnMut(usize, bool)) {
        let Some([a, b]) = self.before_the_eye(ends.map(|p| self.lens.see(p))) else { return };
        let (Some(p), Some(q)) = (self.lens.place(a), self.lens.place(b)) else { return };
        let Some([from, to]) = self.within(p, q) else { return };
        let steps = ((q[0] - p[0]).abs().max((q[1] - p[1]).abs()) * (to - from)).ceil().max(1.0);
        let (near, far) = (1.0 / a.z, 1.0 / b.z);
        for step in 0..=steps as u32 {
            let t = from + (to - from) * (f64::from(step) / steps);
            let place = [p[0] + (q[0] - p[0]) * t, p[1] + (q[1] - p[1]) * t];
            self.blot(place, near + (far - near) * t, radius, &mut each);
        }
    }

    /// Tells of each pixel of a point.
    fn dot(&self, point: DVec3, mut each: impl FnMut(usize, bool)) {
        let seen = self.lens.see(point);
        if let Some(place) = self.lens.place(seen).filter(|_| seen.z >= self.lens.near) {
            self.blot(place, 1.0 / seen.z, self.radii.point, &mut each);
        }
    }

    /// Tells of the pixels around a place at a depth, if it is in the picture.
    fn blot(&self, place: [f64; 2], inverse: f64, radius: i64, each: &mut impl FnMut(usize, bool)) {
        let middle = place.map(|v| v.floor() as i64);
        let Some(at) = self.index(middle) else { return };
        let seen = inverse * (1.0 + HIDDEN) >= f64::from(self.nearest[at].inverse);
        disc(middle, radius).filter_map(|pixel| self.index(pixel)).for_each(|at| each(at, seen));
    }

    fn index(&self, [x, y]: [i64; 2]) -> Option<usize> {
        let [width, height] = self.lens.size.map(i64::from);
        ((0..width).contains(&x) && (0..height).contains(&y)).then(|| (y * width + x) as usize)
    }

    /// The part of a line that lies farther away than the nearest depth.
    fn before_the_eye(&self, [a, b]: [DVec3; 2]) -> Option<[DVec3; 2]> {
        let cut = |p: DVec3, q: DVec3| p + (q - p) * ((self.lens.near - p.z) / (q.z - p.z));
        match (a.z >= self.lens.near, b.z >= self.lens.near) {
            (true, true) => Some([a, b]),
            (true, false) => Some([a, cut(b, a)]),
            (false, true) => Some([cut(a, b), b]),
            (false, false) => None,
        }
    }

    /// The part of a line that lies in the picture (Liang and Barsky 1984), as shares of the line.
    fn within(&self, p: [f64; 2], q: [f64; 2]) -> Option<[f64; 2]> {
        let (mut from, mut to) = (0.0_f64, 1.0_f64);
        for axis in 0..2 {
            let (start, along) = (p[axis], q[axis] - p[axis]);
            for (distance, towards) in [(start, -along), (f64::from(self.lens.size[axis]) - start, along)] {
                match towards {
                    0.0 if distance < 0.0 => return None,
                    0.0 => {}
                    v if v > 0.0 => to = to.min(distance / v),
                    v => from = from.max(distance / v),
                }
            }
        }
        (from <= to).then_some([from, to])
    }
}
