//! A flat sheet of 96 × 48 units in charts, a line on it, and what is painted there.

use std::sync::Arc;

use glam::{DVec3, Vec2, vec2};

use crate::canvas::image::{Image, Maps};
use crate::canvas::job::{PaintFace, PaintJob, Painting, PatchJob};
use crate::canvas::look::{Fbm, Wound};
use crate::mesh::{IndexedMesh, Mesh};

pub(super) const SIZE: [u32; 2] = [256, 192];

/// Units along a side of a cell; a unit is a texel.
const CELL: f32 = 8.0;

/// A rectangle of cells, and where its points lie on the map, in texels.
pub(super) struct Chart {
    pub from: [u32; 2],
    pub to: [u32; 2],
    pub texel: fn(Vec2) -> Vec2,
}

/// Charts' faces, those in the corner of a cell towards the origin first.
#[derive(Default)]
pub(super) struct Sheet {
    /// Corners on the sheet and on the map, and which sides are open.
    pub faces: Vec<([Vec2; 3], [Vec2; 3], u8)>,
}

impl Sheet {
    pub(super) fn of(charts: &[Chart]) -> Self {
        let mut sheet = Self::default();
        charts.iter().for_each(|chart| sheet.add(chart));
        sheet
    }

    fn add(&mut self, chart: &Chart) {
        for j in chart.from[1]..chart.to[1] {
            for i in chart.from[0]..chart.to[0] {
                let corner = |x: u32, y: u32| vec2((i + x) as f32, (j + y) as f32) * CELL;
                let [a, b, c, d] = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
                let open = |at_border: bool, side: u8| u8::from(at_border) << side;
                let [left, right] = [i == chart.from[0], i + 1 == chart.to[0]];
                let [low, high] = [j == chart.from[1], j + 1 == chart.to[1]];
                let mut face =
                    |corners: [Vec2; 3], open| self.faces.push((corners, corners.map(chart.texel), open));
                face([a, b, d], open(low, 0) | open(left, 2));
                face([b, c, d], open(right, 0) | open(high, 1));
            }
        }
    }

    /// The mesh that these faces are, each by itself: of it only the texture coordinates matter.
    pub(super) fn mesh(&self) -> Mesh {
        let mut mesh = IndexedMesh::default();
        for (k, (corners, _, _)) in (0u32..).zip(&self.faces) {
            mesh.positions.extend(corners.map(|p| DVec3::new(p.x.into(), p.y.into(), 0.0)));
            mesh.faces.push([3 * k, 3 * k + 1, 3 * k + 2]);
        }
        mesh.uvs = self.faces.iter().flat_map(|(_, texels, _)| texels.map(uv)).collect();
        mesh.face_uvs.clone_from(&mesh.faces);
        Mesh::build(&mesh).expect("single triangles")
    }

    /// A painting around the line between two points of the sheet.
    pub(super) fn painting(&self, [from, to]: [Vec2; 2], height: f32) -> Painting {
        let length = from.distance(to);
        let along = (to - from) / length;
        let at = |p: Vec2| vec2(along.dot(p - from), along.perp_dot(p - from));
        let face = |(k, (corners, texels, open)): (u32, &([Vec2; 3], [Vec2; 3], u8))| PaintFace {
            face: k,
            uv: texels.map(uv),
            at: corners.map(at),
            open: *open,
        };
        let faces: Vec<PaintFace> = (0..).zip(&self.faces).map(face).collect();
        let paint = PaintJob {
            length,
            height,
            factor: [0.9, 0.7, 0.65],
            offset: [17.5, 80.25],
            noise: Fbm { frequency: 8.0, ..Fbm::default() },
            noise_scale: 1.0 / 256.0,
            inner: faces.len(),
            faces,
        };
        Painting { patch: patch_job([length.ceil() as u32, height.ceil() as u32]), paint }
    }
}

fn uv(texel: Vec2) -> Vec2 {
    vec2(texel.x / SIZE[0] as f32, 1.0 - texel.y / SIZE[1] as f32)
}

pub(super) fn patch_job(size: [u32; 2]) -> PatchJob {
    let Wound { inner, dark, light, edge, noise, .. } = Wound::default();
    PatchJob { size, offset: [12.5, 77.25], palette: [inner, dark, light], edge, noise }
}

/// Maps of one colour.
pub(super) fn plain() -> Arc<Maps> {
    maps(Image::filled(SIZE, [204, 158, 135, 255]))
}

pub(super) fn maps(color: Image) -> Arc<Maps> {
    let one = |texel| Image::filled([1, 1], texel);
    let [normal, occlusion, specular] = [one([128, 128, 255, 255]), one([255; 4]), one([150, 90, 0, 255])];
    Arc::new(Maps { color, normal, occlusion, specular })
}

/// The whole sheet as one chart.
pub(super) fn whole() -> Sheet {
    Sheet::of(&[Chart { from: [0, 0], to: [12, 6], texel: |p| p + vec2(20.25, 30.25) }])
}

/// A line along the sheet's middle.
pub(super) fn middle() -> [Vec2; 2] {
    [vec2(10.0, 24.0), vec2(86.0, 25.0)]
}
