//! The rasterizer: which pixels a triangle covers, and how deep it lies there. For the eye and for lights.
//!
//! **Coverage** is exact, and as on maps: see [`spans`]. Triangles that share a side cover each pixel along it once.
//!
//! **Depth** is taken as 1/Z, which is linear over the picture. It comes from the face as it is, not from its rounded corners; where
//! these reach beyond it, 1/Z stays within that of its corners.
//!
//! Work is shared out by bands of [`BAND`] rows: within one triangles come in the order of their faces, so that the first of two equally near
//! ones wins, and no result depends on how many threads there are.

use std::ops::Range;

use glam::DVec3;
use rayon::prelude::*;

use super::clip::{GUARD, Polygon};
use super::lens::Lens;
use crate::mesh::{Face, FaceId, Mesh};
use crate::render::spans::{self, Corners, PARTS, Window};

/// Rows in a band, and the sides of a tile.
pub(crate) const BAND: usize = 16;

/// A triangle in a picture.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Triangle {
    /// The face that it is a part of.
    pub(crate) face: u32,
    /// In 1/256 of a pixel, from the upper left.
    corners: Corners,
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
    /// With these corners, in pixels; `None` if it covers none of a picture's.
    fn new(face: u32, corners: [[f64; 2]; 3], inverse: Inverse, size: [u32; 2]) -> Option<Self> {
        // Clipping has rounded too: what it left is within the guard, or nearly.
        let corners = corners.map(|corner| corner.map(|x| spans::round(x.clamp(-2.0 * GUARD, 2.0 * GUARD))));
        let centres = [0, 1].map(|axis| !extent(corners, axis, size[axis]).is_empty());
        let covers = spans::doubled_area(corners) != 0 && centres == [true; 2];
        covers.then_some(Self { face, corners, inverse })
    }

    /// Whether the eye is behind the face.
    pub(crate) fn behind(&self) -> bool {
        self.inverse.behind
    }
}

/// The columns (axis 0) or rows (axis 1) of a picture whose centres lie within the bounds of these corners.
fn extent(corners: Corners, axis: usize, side: u32) -> Range<i64> {
    let [least, most] = spans::bounds(corners);
    let before = |x: i64| (x + PARTS / 2).div_euclid(PARTS);
    before(least[axis] - 1).max(0)..before(most[axis]).min(side.into())
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
        let part = |(first, faces): (usize, &[Face])| {
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

    /// Some faces of a mesh as a lens sees them.
    pub(crate) fn of_faces(mesh: &Mesh, lens: &Lens, faces: impl IntoIterator<Item = FaceId>) -> Self {
        let mut triangles = Vec::new();
        for face in faces {
            cover(&mut triangles, face.0, mesh.triangle(face).map(|p| lens.see(p)), lens);
        }
        Self::of(lens, triangles)
    }

    fn of(lens: &Lens, triangles: Vec<Triangle>) -> Self {
        let mut bands = vec![Vec::new(); (lens.size[1] as usize).div_ceil(BAND)];
        for (i, triangle) in (0..).zip(&triangles) {
            let rows = extent(triangle.corners, 1, lens.size[1]);
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
        let top = (band * BAND) as u32;
        let window = Window { from: [0, top], to: [width, height.min(top + BAND as u32)] };
        for &index in &self.bands[band] {
            let triangle = self.triangle(index);
            spans::spans(triangle.corners, window, |row, columns| {
                let start = (row - top) as usize * width as usize;
                for column in columns {
                    let ray = self.lens.ray(column as usize, row as usize);
                    plot(start + column as usize, index, triangle.inverse.at(ray));
                }
            });
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
        let corners = [place(first), place(&pair[0]), place(&pair[1])];
        triangles.extend(Triangle::new(face, corners, inverse, lens.size));
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
