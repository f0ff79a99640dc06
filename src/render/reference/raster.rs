//! The rasterizer: which pixels a triangle covers, and how deep it lies there. For the eye and for lights.
//!
//! **Coverage** is exact: corners are rounded to 1/256 of a pixel, and from there on whole numbers decide. A pixel belongs to a triangle if its
//! centre lies inside, or on a top or left side (Pineda 1988, and the rule of every GPU): triangles that share a side cover each pixel
//! along it once. In a row the covered pixels are one span, whose ends are three divisions.
//!
//! **Depth** is taken as 1/Z, which is linear over the picture. It comes from the face as it is, not from its rounded corners; where
//! these reach beyond it, 1/Z stays within that of its corners.
//!
//! Work is shared out by bands of [`BAND`] rows: within one triangles come in the order of their faces, so that the first of two equally near
//! ones wins, and no result depends on how many threads there are.

use glam::DVec3;
use rayon::prelude::*;

use super::clip::{GUARD, Polygon};
use super::lens::Lens;
use crate::mesh::Mesh;

/// Rows in a band, and the sides of a tile.
pub(crate) const BAND: usize = 16;

/// Parts of a pixel that corners are rounded to.
const SUBPIXEL: f64 = 256.0;

/// A triangle in a picture.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Triangle {
    /// The face that it is a part of.
    pub(crate) face: u32,
    /// In 1/256 of a pixel from the upper left, so turned that the area is positive.
    corners: [[i64; 2]; 3],
    inverse: Inverse,
}

/// 1/Z over the picture.
#[derive(Clone, Copy, Debug)]
struct Inverse {
    /// By the ray through a pixel: its scalar product with this.
    plane: DVec3,
    least: f64,
    most: f64,
    /// Whether the eye is behind the face.
    behind: bool,
}

impl Inverse {
    /// Of a face, kept within that of the corners of its visible part.
    fn new([a, b, c]: [DVec3; 3], visible: &[DVec3]) -> Self {
        let (least, most) = visible
            .iter()
            .map(|p| 1.0 / p.z)
            .fold((f64::INFINITY, 0.0_f64), |(least, most), i| (least.min(i), most.max(i)));
        let normal = (b - a).cross(c - a);
        let away = a.dot(normal);
        let plane = normal / away;
        // The eye lies in the face's plane: it is seen as a line.
        let plane = if plane.is_finite() { plane } else { DVec3::new(0.0, 0.0, most) };
        Self { plane, least, most, behind: away > 0.0 }
    }

    #[inline]
    fn at(&self, ray: DVec3) -> f32 {
        self.plane.dot(ray).max(self.least).min(self.most) as f32
    }
}

impl Triangle {
    /// With these corners, in pixels; `None` if it has no area.
    fn new(face: u32, corners: [[f64; 2]; 3], inverse: Inverse) -> Option<Self> {
        // Clipping has rounded too: what it left is within the guard, or nearly.
        let round = |x: f64| (x.clamp(-2.0 * GUARD, 2.0 * GUARD) * SUBPIXEL + 0.5).floor() as i64;
        let [a, b, c] = corners.map(|corner| corner.map(round));
        let area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
        let corners = if area > 0 { [a, b, c] } else { [a, c, b] };
        (area != 0).then_some(Self { face, corners, inverse })
    }

    /// Whether the eye is behind the face.
    pub(crate) fn behind(&self) -> bool {
        self.inverse.behind
    }

    /// The rows, or the columns, whose centres lie within its bounds.
    fn extent(&self, axis: usize, side: u32) -> std::ops::Range<i64> {
        let [a, b, c] = self.corners.map(|corner| corner[axis]);
        let (least, most) = (a.min(b).min(c), a.max(b).max(c));
        let first = (least - 128 + 255).div_euclid(256);
        let last = (most - 128).div_euclid(256);
        first.max(0)..(last + 1).min(side.into())
    }

    /// The columns that it covers in a row, among the first `width`.
    fn span(&self, row: i64, width: u32) -> std::ops::Range<i64> {
        let (mut first, mut end) = (0, i64::from(width));
        for i in 0..3 {
            let (a, b) = (self.corners[i], self.corners[(i + 1) % 3]);
            let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
            // Twice the area of the triangle that the side makes with the centre of the row's pixel 0. On the side counts as inside
            // for top and left sides only.
            let top_left = dy < 0 || (dy == 0 && dx > 0);
            let inside = dx * (256 * row + 128 - a[1]) - dy * (128 - a[0]) - i64::from(!top_left);
            // It loses 256 dy with every pixel to the right.
            match dy {
                0 if inside < 0 => return 0..0,
                0 => {}
                1.. => end = end.min(inside.div_euclid(256 * dy) + 1),
                _ => first = first.max(-inside.div_euclid(-256 * dy)),
            }
        }
        first..end
    }
}

/// The triangles of a picture, by bands.
pub(crate) struct Drawing {
    lens: Lens,
    triangles: Vec<Triangle>,
    /// For each band the triangles that reach into it, in order.
    bands: Vec<Vec<u32>>,
}

impl Drawing {
    /// A mesh as a lens sees it.
    pub(crate) fn new(mesh: &Mesh, lens: &Lens) -> Self {
        let seen: Vec<DVec3> = mesh.positions().par_iter().map(|p| lens.see(*p)).collect();
        let part = |(first, faces): (usize, &[crate::mesh::Face])| {
            let mut triangles = Vec::new();
            for (i, face) in faces.iter().enumerate() {
                let corners = face.nodes.map(|node| seen[node.at()]);
                cover(&mut triangles, (first * PART + i) as u32, corners, lens);
            }
            triangles
        };
        let parts: Vec<Vec<Triangle>> = mesh.faces().par_chunks(PART).enumerate().map(part).collect();
        Self::of(lens, parts.concat())
    }

    fn of(lens: &Lens, triangles: Vec<Triangle>) -> Self {
        let mut bands = vec![Vec::new(); (lens.size[1] as usize).div_ceil(BAND)];
        for (i, triangle) in (0..).zip(&triangles) {
            let rows = triangle.extent(1, lens.size[1]);
            let (first, last) = (rows.start as usize / BAND, (rows.end - 1) as usize / BAND);
            bands[first..=last].iter_mut().for_each(|band| band.push(i));
        }
        Self { lens: *lens, triangles, bands }
    }

    /// Whether there is no triangle in the picture.
    pub(crate) fn is_empty(&self) -> bool {
        self.triangles.is_empty()
    }

    /// What sees it.
    pub(crate) fn lens(&self) -> &Lens {
        &self.lens
    }

    /// A triangle.
    pub(crate) fn triangle(&self, index: u32) -> &Triangle {
        &self.triangles[index as usize]
    }

    /// Tells of every pixel of a band that a triangle covers: the pixel's place in the band, row by row, the triangle, and 1/Z.
    #[inline]
    pub(crate) fn draw(&self, band: usize, mut plot: impl FnMut(usize, u32, f32)) {
        let [width, height] = self.lens.size;
        let top = (band * BAND) as i64;
        for &index in &self.bands[band] {
            let triangle = self.triangle(index);
            let rows = triangle.extent(1, height);
            for row in rows.start.max(top)..rows.end.min(top + BAND as i64) {
                let start = (row - top) as usize * width as usize;
                for column in triangle.span(row, width) {
                    let ray = self.lens.ray(column as usize, row as usize);
                    plot(start + column as usize, index, triangle.inverse.at(ray));
                }
            }
        }
    }
}

/// Faces that are prepared at once.
const PART: usize = 2048;

/// Adds the triangles of a face, as it is seen: none if it is out of sight, several if it is clipped.
fn cover(triangles: &mut Vec<Triangle>, face: u32, corners: [DVec3; 3], lens: &Lens) {
    if out_of_sight(&corners, lens) {
        return;
    }
    let polygon = Polygon::clipped(corners, lens.near);
    let [first, rest @ ..] = polygon.corners() else { return };
    let (inverse, [cx, cy]) = (Inverse::new(corners, polygon.corners()), lens.centre());
    let place = |p: &DVec3| [cx + p.x / p.z, cy + p.y / p.z];
    for pair in rest.windows(2) {
        let triangle = Triangle::new(face, [place(first), place(&pair[0]), place(&pair[1])], inverse);
        triangles.extend(triangle.filter(|t| (0..2).all(|axis| !t.extent(axis, lens.size[axis]).is_empty())));
    }
}

/// Whether all corners lie beyond the same side of what is seen, or one is not a point at all.
fn out_of_sight(corners: &[DVec3; 3], lens: &Lens) -> bool {
    let [cx, cy] = lens.centre();
    let beyond = |outside: &dyn Fn(&DVec3) -> bool| corners.iter().all(outside);
    !corners.iter().all(|p| p.is_finite())
        || beyond(&|p| p.z < lens.near)
        || beyond(&|p| p.z > lens.far)
        || beyond(&|p| p.x > (cx + 1.0) * p.z)
        || beyond(&|p| -p.x > (cx + 1.0) * p.z)
        || beyond(&|p| p.y > (cy + 1.0) * p.z)
        || beyond(&|p| -p.y > (cy + 1.0) * p.z)
}
