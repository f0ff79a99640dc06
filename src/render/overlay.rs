//! What is drawn over a frame: edges, lines, points and sets of faces, hidden where the surface hides them.
//!
//! The nearest face at each pixel comes from the reference's rasterizer. Faces are tinted where they are that face. A line is followed pixel by pixel
//! in seen space, where 1/Z is linear, and is hidden where it lies behind the nearest surface by more than a thousandth of its depth: lines
//! lie on the surface, and must not be hidden by the faces that they lie on.

use glam::DVec3;
use rustc_hash::FxHashSet;

use super::reference::lens::Lens;
use super::reference::raster::{BAND, Drawing as Raster};
use crate::canvas::frame::View;
use crate::canvas::image::Image;
use crate::mesh::{FaceId, Mesh};
use crate::report::Overlay;

/// Something to draw.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Drawing<'a> {
    /// The edges of the mesh.
    Wire,
    /// What a report has to show.
    Shown(&'a Overlay),
}

/// Colours for sets of faces, by their order, after the palette of Okabe and Ito, which colour-blind people can tell apart.
const FACES: [[u8; 3]; 8] = [
    [230, 159, 0],
    [86, 180, 233],
    [0, 158, 115],
    [240, 228, 66],
    [0, 114, 178],
    [213, 94, 0],
    [204, 121, 167],
    [200, 200, 200],
];
const LINE: [u8; 3] = [255, 235, 60];
const POINT: [u8; 3] = [255, 255, 255];
const WIRE: [u8; 3] = [30, 60, 90];
/// How far behind the surface a line may lie and still be seen, as a share of its depth.
const HIDDEN: f64 = 1e-3;
/// Half a point's side in pixels.
const RADIUS: i64 = 3;

/// Draws over a frame of a view of a mesh, in order.
pub fn draw(image: &mut Image, view: &View, mesh: &Mesh, drawings: &[Drawing<'_>]) {
    if drawings.is_empty() {
        return;
    }
    let lens = Lens::of_view(view);
    let mut sheet = Sheet { nearest: nearest(mesh, &lens), lens, image };
    let mut colours = FACES.iter().cycle();
    for drawing in drawings {
        match drawing {
            Drawing::Wire => sheet.wire(mesh),
            Drawing::Shown(Overlay::Faces { faces, .. }) => {
                sheet.tint(faces, *colours.next().unwrap_or(&LINE))
            }
            Drawing::Shown(Overlay::Line { points, .. }) => {
                points.windows(2).for_each(|ends| sheet.line([ends[0].into(), ends[1].into()], LINE, 1.0));
            }
            Drawing::Shown(Overlay::Points { points, .. }) => {
                points.iter().for_each(|point| sheet.point((*point).into()));
            }
        }
    }
}

/// The nearest face at a pixel, and its depth.
#[derive(Clone, Copy)]
struct Nearest {
    face: u32,
    inverse: f32,
}

fn nearest(mesh: &Mesh, lens: &Lens) -> Vec<Nearest> {
    let [width, height] = lens.size.map(|side| side as usize);
    let raster = Raster::new(mesh, lens);
    let mut all = vec![Nearest { face: u32::MAX, inverse: 0.0 }; width * height];
    for (band, pixels) in all.chunks_mut(width * BAND).enumerate() {
        raster.draw(band, |at, triangle, inverse| {
            if inverse > pixels[at].inverse {
                pixels[at] = Nearest { face: raster.triangle(triangle).face, inverse };
            }
        });
    }
    all
}

/// A frame that is drawn over.
struct Sheet<'a> {
    image: &'a mut Image,
    lens: Lens,
    nearest: Vec<Nearest>,
}

impl Sheet<'_> {
    fn tint(&mut self, faces: &[u32], colour: [u8; 3]) {
        let faces: FxHashSet<u32> = faces.iter().copied().collect();
        for (texel, nearest) in self.image.texels.iter_mut().zip(&self.nearest) {
            if faces.contains(&nearest.face) {
                blend(texel, colour, 0.55);
            }
        }
    }

    /// The edges of the faces that are seen.
    fn wire(&mut self, mesh: &Mesh) {
        let mut faces: Vec<u32> = self.nearest.iter().map(|n| n.face).filter(|f| *f != u32::MAX).collect();
        faces.sort_unstable();
        faces.dedup();
        let mut edges: Vec<_> = faces.iter().flat_map(|f| mesh.face(FaceId(*f)).edges).collect();
        edges.sort_unstable();
        edges.dedup();
        edges.iter().for_each(|e| self.line(mesh.edge(*e).nodes.map(|n| mesh.position(n)), WIRE, 0.45));
    }

    /// A line, as wide as a pixel.
    fn line(&mut self, ends: [DVec3; 2], colour: [u8; 3], share: f64) {
        let Some([a, b]) = self.before_the_eye(ends.map(|p| self.lens.see(p))) else { return };
        let (Some(p), Some(q)) = (self.lens.place(a), self.lens.place(b)) else { return };
        let Some([from, to]) = self.within(p, q) else { return };
        let steps = ((q[0] - p[0]).abs().max((q[1] - p[1]).abs()) * (to - from)).ceil().max(1.0);
        let (near, far) = (1.0 / a.z, 1.0 / b.z);
        for step in 0..=steps as u32 {
            let t = from + (to - from) * (f64::from(step) / steps);
            let place = [p[0] + (q[0] - p[0]) * t, p[1] + (q[1] - p[1]) * t];
            self.dot(place.map(|v| v.floor() as i64), near + (far - near) * t, colour, share);
        }
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

    fn point(&mut self, point: DVec3) {
        let seen = self.lens.see(point);
        let Some(place) = self.lens.place(seen).filter(|_| seen.z >= self.lens.near) else { return };
        let [x, y] = place.map(|v| v.floor() as i64);
        for (dx, dy) in (-RADIUS..=RADIUS).flat_map(|dx| (-RADIUS..=RADIUS).map(move |dy| (dx, dy))) {
            if dx * dx + dy * dy <= RADIUS * RADIUS {
                self.dot([x.saturating_add(dx), y.saturating_add(dy)], 1.0 / seen.z, POINT, 1.0);
            }
        }
    }

    /// A pixel at a depth, if it is in the picture and not hidden.
    fn dot(&mut self, [x, y]: [i64; 2], inverse: f64, colour: [u8; 3], share: f64) {
        let [width, height] = self.lens.size.map(i64::from);
        if (0..width).contains(&x) && (0..height).contains(&y) {
            let at = (y * width + x) as usize;
            if inverse * (1.0 + HIDDEN) >= f64::from(self.nearest[at].inverse) {
                blend(&mut self.image.texels[at], colour, share);
            }
        }
    }
}

fn blend(texel: &mut [u8; 4], colour: [u8; 3], share: f64) {
    for (value, over) in texel.iter_mut().zip(colour) {
        *value = (f64::from(*value) * (1.0 - share) + f64::from(over) * share).round() as u8;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::IndexedMesh;

    /// Two squares that face the eye, the smaller one 2 units nearer.
    fn mesh() -> Mesh {
        let square = |z: f64, r: f64| [(-r, -r), (r, -r), (r, r), (-r, r)].map(|(x, y)| DVec3::new(x, y, z));
        let positions = [square(0.0, 2.0), square(2.0, 0.5)].concat();
        let faces = vec![[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]];
        Mesh::build(&IndexedMesh { positions, faces, ..IndexedMesh::default() }).expect("a mesh")
    }

    fn view() -> View {
        View {
            eye: DVec3::new(0.0, 0.0, 10.0),
            basis: [DVec3::X, DVec3::Y, DVec3::NEG_Z],
            fov_y: 0.5,
            size: [80, 60],
            near: 1.0,
            far: 20.0,
        }
    }

    fn drawn(drawings: &[Drawing<'_>]) -> Image {
        let mut image = Image::filled([80, 60], [10, 10, 10, 255]);
        draw(&mut image, &view(), &mesh(), drawings);
        image
    }

    #[test]
    fn a_line_is_hidden_where_something_is_before_it() {
        let line = Overlay::Line { name: "line".into(), points: vec![[-1.9, 0.0, 0.0], [1.9, 0.0, 0.0]] };
        let image = drawn(&[Drawing::Shown(&line)]);
        let row: Vec<bool> = (0..80).map(|x| image.at(x, 30)[..3] == LINE).collect();
        assert!(row[25] && row[55], "beside the nearer square it is seen");
        assert!(!row[40], "behind it it is not");
        assert!(!row[5] && !row[75], "it ends where it ends");
    }

    #[test]
    fn faces_are_tinted_where_they_are_nearest() {
        let faces = Overlay::Faces { name: "back".into(), faces: vec![0, 1] };
        let image = drawn(&[Drawing::Shown(&faces)]);
        assert_ne!(image.at(25, 30), [10, 10, 10, 255]);
        assert_eq!(image.at(40, 30), [10, 10, 10, 255]);
        assert_eq!(image.at(2, 2), [10, 10, 10, 255]);
    }

    #[test]
    fn nothing_far_out_or_behind_the_eye_is_drawn_and_nothing_panics() {
        let far = [[1e300, -1e300, 0.0], [-1e300, 1e300, 5.0], [0.0, 0.0, 11.0], [f64::NAN, 0.0, 0.0]];
        let line = Overlay::Line { name: "line".into(), points: far.to_vec() };
        let points = Overlay::Points { name: "picks".into(), points: far.to_vec() };
        drawn(&[Drawing::Wire, Drawing::Shown(&line), Drawing::Shown(&points)]);
    }

    #[test]
    fn wires_are_the_edges() {
        let image = drawn(&[Drawing::Wire]);
        let changed = image.texels.iter().filter(|t| **t != [10, 10, 10, 255]).count();
        assert!((100..600).contains(&changed), "{changed} pixels");
    }
}
