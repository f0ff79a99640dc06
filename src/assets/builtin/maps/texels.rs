//! An atlas, texel by texel: which place of the surface each texel shows.
//!
//! A texel shows the face that its centre lies in. Around the charts [`PADDING`] texels more are taken for the nearest chart's: they show its nearest face, continued
//! beyond its border. So bilinear sampling at a border, and the skirts of painting, meet what is on the surface, never the blank between the charts.

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use crate::canvas::image::Image;
use crate::mesh::{Face, FaceId, Mesh};

/// Texels around a chart that are painted as if it went on.
pub(super) const PADDING: u32 = 5;
const NONE: u32 = u32::MAX;

/// A place on the surface, as a renderer sees it there.
pub(super) struct Site {
    /// Where it is, model units.
    pub position: DVec3,
    /// The interpolated normal, of length 1.
    pub normal: DVec3,
    /// The interpolated tangent and bitangent.
    pub tangents: [DVec3; 2],
    /// The face that it lies on.
    pub face: FaceId,
    /// How near it is to each of the face's corners; their sum is 1.
    pub weights: [f64; 3],
}

/// The texels of a square atlas.
pub(super) struct Texels<'a> {
    mesh: &'a Mesh,
    side: u32,
    /// The face that each texel shows.
    faces: Vec<u32>,
}

impl<'a> Texels<'a> {
    /// Finds the faces of all texels of an atlas with this side.
    pub(super) fn new(mesh: &'a Mesh, side: u32) -> Self {
        let mut texels = Self { mesh, side, faces: vec![NONE; (side * side) as usize] };
        for f in 0..mesh.face_count() {
            texels.cover(FaceId::of(f));
        }
        texels.pad();
        texels
    }

    /// Images of what `paint` sees at each texel; `blank` where there is nothing.
    pub(super) fn paint<const N: usize>(
        &self,
        blank: [[u8; 4]; N],
        paint: impl Fn(&Site) -> [[u8; 4]; N] + Sync,
    ) -> [Image; N] {
        let at = |i: u32| self.site(i % self.side, i / self.side).map_or(blank, |site| paint(&site));
        let texels: Vec<[[u8; 4]; N]> = (0..self.faces.len() as u32).into_par_iter().map(at).collect();
        std::array::from_fn(|k| Image { size: [self.side; 2], texels: texels.iter().map(|t| t[k]).collect() })
    }

    /// The side of a texel on the surface, on average, model units.
    pub(super) fn texel_size(&self) -> f64 {
        let (mut area, mut atlas) = (0.0, 0.0);
        for f in 0..self.mesh.face_count() {
            let ([a, b, c], [ta, tb, tc]) = (self.mesh.triangle(FaceId::of(f)), self.corners(FaceId::of(f)));
            area += (b - a).cross(c - a).length();
            atlas += (tb - ta).perp_dot(tc - ta).abs();
        }
        (area / atlas).sqrt()
    }

    /// The corners of a face in texels, y downwards; a texel's centre has whole coordinates.
    fn corners(&self, face: FaceId) -> [DVec2; 3] {
        let side = f64::from(self.side);
        self.mesh.face(face).vertices.map(|v| {
            let uv = self.mesh.vertices()[v.at()].uv.as_dvec2();
            DVec2::new(uv.x * side - 0.5, (1.0 - uv.y) * side - 0.5)
        })
    }

    fn cover(&mut self, face: FaceId) {
        let corners = self.corners(face);
        let [low, high] =
            [corners[0].min(corners[1]).min(corners[2]), corners[0].max(corners[1]).max(corners[2])];
        let last = f64::from(self.side - 1);
        let range =
            |low: f64, high: f64| low.ceil().clamp(0.0, last) as u32..=high.floor().clamp(0.0, last) as u32;
        for y in range(low.y, high.y) {
            for x in range(low.x, high.x) {
                let weights = weights(corners, DVec2::new(x.into(), y.into()));
                if weights.iter().all(|&w| w >= 0.0) {
                    self.faces[(y * self.side + x) as usize] = face.0;
                }
            }
        }
    }

    /// Grows every chart by rings of one texel.
    fn pad(&mut self) {
        let mut border: Vec<u32> =
            (0..self.faces.len() as u32).filter(|&i| self.faces[i as usize] != NONE).collect();
        for _ in 0..PADDING {
            let mut ring = Vec::new();
            for &at in &border {
                for next in self.around(at) {
                    if self.faces[next as usize] == NONE {
                        self.faces[next as usize] = self.faces[at as usize];
                        ring.push(next);
                    }
                }
            }
            border = ring;
        }
    }

    /// The up to eight texels around one.
    fn around(&self, at: u32) -> impl Iterator<Item = u32> + use<> {
        let (side, x, y) = (self.side, at % self.side, at / self.side);
        let near = |c: u32| c.saturating_sub(1)..=(c + 1).min(side - 1);
        let columns = near(x);
        near(y).flat_map(move |y| columns.clone().map(move |x| y * side + x))
    }

    fn site(&self, x: u32, y: u32) -> Option<Site> {
        let face = FaceId(self.faces[(y * self.side + x) as usize]);
        if face.0 == NONE {
            return None;
        }
        let weights = weights(self.corners(face), DVec2::new(x.into(), y.into()));
        Some(Site::on(self.mesh, face, weights))
    }
}

impl Site {
    /// The place of a face that lies this near to each of its corners.
    pub(super) fn on(mesh: &Mesh, face: FaceId, weights: [f64; 3]) -> Self {
        let Face { nodes, vertices, .. } = mesh.face(face);
        let mix = |[a, b, c]: [DVec3; 3]| a * weights[0] + b * weights[1] + c * weights[2];
        let corner = |k: usize| &mesh.vertices()[vertices[k].at()];
        let corners = [corner(0), corner(1), corner(2)];
        Self {
            position: mix(nodes.map(|n| mesh.position(n))),
            normal: mix(corners.map(|v| v.normal.as_dvec3())).normalize_or(DVec3::Y),
            tangents: [
                mix(corners.map(|v| v.tangent.as_dvec3())),
                mix(corners.map(|v| v.bitangent.as_dvec3())),
            ],
            face,
            weights,
        }
    }
}

/// How near a point is to each corner of a triangle: negative beyond a side, NaN where it has no area.
fn weights([a, b, c]: [DVec2; 3], p: DVec2) -> [f64; 3] {
    let area = (b - a).perp_dot(c - a);
    let (v, w) = ((p - a).perp_dot(c - a) / area, (b - a).perp_dot(p - a) / area);
    [1.0 - v - w, v, w]
}
