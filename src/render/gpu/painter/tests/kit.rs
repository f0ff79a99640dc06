//! A sheet of two charts with a seam in its middle, cuts along it, and both painters.

use std::sync::Arc;

use glam::{DVec3, Vec2, vec2};

use crate::canvas::image::{Image, MapId, Maps};
use crate::canvas::job::{PaintFace, PaintJob, Painting, PatchJob};
use crate::canvas::look::{Fbm, Wound};
use crate::mesh::Mesh;
use crate::mesh::build::IndexedMesh;
use crate::render::gpu::device::Device;
use crate::render::gpu::painter::Painter;
use crate::render::reference::painter::Painter as Reference;

/// Quads along a side of a chart.
const SIDE: u32 = 12;

/// What is left as it was made, where a test moves nothing.
pub(super) const HERE: Vec2 = Vec2::ZERO;

/// Where a place of the sheet, 0 … 2 across and 0 … 1 up, lies in the atlas. The right chart stands upright beside the left one.
fn uv(chart: u32, p: Vec2) -> Vec2 {
    match chart {
        0 => vec2(0.03 + 0.55 * p.x, 0.08 + 0.52 * p.y),
        _ => vec2(0.97 - 0.31 * p.y, 0.05 + 0.83 * (p.x - 1.0)),
    }
}

/// Corners of the grid are moved aside, so that nothing lies on the texels' grid, but for those on borders.
fn grid(i: u32, j: u32) -> Vec2 {
    let aside = |k: u32, span: u32| if k.is_multiple_of(span) { 0.0 } else { 0.3 };
    let wave = |k: u32| (k * 7 % 5) as f32 / 5.0 - 0.4;
    vec2(i as f32 + aside(i, SIDE) * wave(i + 3 * j), j as f32 + aside(j, SIDE) * wave(j + 2 * i))
        / SIDE as f32
}

/// A face of the sheet: its corners, its chart and which of its sides are borders of the chart.
struct Piece {
    corners: [[u32; 2]; 3],
    chart: u32,
    open: u8,
}

fn pieces() -> Vec<Piece> {
    let quads = (0..SIDE).flat_map(|j| (0..2 * SIDE).map(move |i| [i, j]));
    quads
        .flat_map(|[i, j]| {
            let [a, b, c, d] = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]];
            [[a, b, c], [a, c, d]].map(|corners| Piece { corners, chart: i / SIDE, open: open(corners) })
        })
        .collect()
}

/// Borders lie where both ends have the same coordinate, a multiple of the chart's side.
fn open(corners: [[u32; 2]; 3]) -> u8 {
    let border = |side: usize| {
        let (p, q) = (corners[side], corners[(side + 1) % 3]);
        (0..2).any(|k| p[k] == q[k] && p[k] % SIDE == 0)
    };
    (0..3).filter(|side| border(*side)).map(|side| 1 << side).sum()
}

/// The sheet, two units wide and one high; its charts are moved by this in the atlas.
pub(super) fn sheet(by: Vec2) -> Mesh {
    let columns = 2 * SIDE + 1;
    let nodes = (0..=SIDE).flat_map(|j| (0..columns).map(move |i| grid(i, j)));
    let mut input = IndexedMesh {
        positions: nodes.map(|p| DVec3::new(p.x.into(), p.y.into(), 0.0)).collect(),
        ..IndexedMesh::default()
    };
    for piece in pieces() {
        let first = input.uvs.len() as u32;
        input.uvs.extend(piece.corners.map(|[i, j]| uv(piece.chart, grid(i, j)) + by));
        input.faces.push(piece.corners.map(|[i, j]| j * columns + i));
        input.face_uvs.push([first, first + 1, first + 2]);
    }
    Mesh::build(&input).expect("a sheet")
}

/// A cut from one place of the sheet to another, c_h being its height; `key` decides its randomness.
pub(super) fn cut(from: Vec2, to: Vec2, height: f32, texels: [u32; 2], key: u32) -> Arc<Painting> {
    let look = Wound::default();
    let offset = vec2(13.7, 71.3) * (1 + key) as f32 % 100.0;
    let length = from.distance(to);
    let along = (to - from) / length;
    let faces: Vec<PaintFace> = pieces()
        .iter()
        .zip(0..)
        .map(|(piece, face)| {
            let places = piece.corners.map(|[i, j]| grid(i, j));
            let at = places.map(|p| vec2(along.dot(p - from), along.perp_dot(p - from)));
            PaintFace { face, uv: places.map(|p| uv(piece.chart, p)), at, open: piece.open }
        })
        .filter(|face| near(face, length, height))
        .collect();
    let (offset, inner) = (offset.to_array(), faces.len());
    Arc::new(Painting {
        patch: PatchJob {
            size: texels,
            offset,
            palette: [look.inner, look.dark, look.light],
            edge: look.edge,
            noise: look.noise,
        },
        paint: PaintJob {
            length,
            height,
            factor: [0.91, 0.66, 0.72],
            offset,
            noise: Fbm { frequency: 32.0, ..Fbm::default() },
            noise_scale: 0.5,
            faces,
            inner,
        },
    })
}

/// The same cut with its charts moved in the atlas.
pub(super) fn moved(cut: &Painting, by: Vec2) -> Arc<Painting> {
    let mut cut = cut.clone();
    cut.paint.faces.iter_mut().for_each(|face| face.uv = face.uv.map(|uv| uv + by));
    Arc::new(cut)
}

fn near(face: &PaintFace, length: f32, height: f32) -> bool {
    let range = |k: fn(&Vec2) -> f32| {
        let all = face.at.iter().map(k);
        (all.clone().fold(f32::INFINITY, f32::min), all.fold(f32::NEG_INFINITY, f32::max))
    };
    let ((left, right), (low, high)) = (range(|p| p.x), range(|p| p.y));
    right > -height && left < length + height && high > -height && low < height
}

/// Maps of a size; no two texels side by side are the same.
pub(super) fn maps(size: [u32; 2]) -> Arc<Maps> {
    let mut color = Image::filled(size, [0; 4]);
    for (k, texel) in (0u32..).zip(&mut color.texels) {
        let noise = k.wrapping_mul(2_654_435_761) >> 20;
        *texel = [180 + (noise & 31) as u8, 130 + (noise >> 5 & 31) as u8, 120, (noise & 255) as u8];
    }
    let one = Image::filled([1, 1], [128, 128, 255, 255]);
    Arc::new(Maps { color, normal: one.clone(), occlusion: one.clone(), specular: one })
}

/// Both painters of the sheet.
pub(super) fn painters(device: &Arc<Device>, size: [u32; 2], by: Vec2) -> (Painter, Reference) {
    let (maps, sheet) = (maps(size), sheet(by));
    (Painter::new(device.clone(), &maps, &sheet).expect("a painter"), Reference::new(&maps, &sheet))
}

/// Colour and discolour map of a painter.
pub(super) fn both(painter: &Painter) -> [Image; 2] {
    [MapId::Color, MapId::Discolor].map(|map| painter.map(map).expect("a map"))
}

/// How two images differ: texels that differ at all, those by more than one, and the most that a channel does.
#[derive(Debug, Default, PartialEq, Eq)]
pub(super) struct Gap {
    pub(super) any: usize,
    pub(super) more: usize,
    pub(super) most: u8,
}

pub(super) fn gap(a: &Image, b: &Image) -> Gap {
    assert_eq!(a.size, b.size);
    let worst =
        |(p, q): (&[u8; 4], &[u8; 4])| p.iter().zip(q).map(|(p, q)| p.abs_diff(*q)).max().unwrap_or(0);
    a.texels.iter().zip(&b.texels).map(worst).fold(Gap::default(), |gap, by| Gap {
        any: gap.any + usize::from(by > 0),
        more: gap.more + usize::from(by > 1),
        most: gap.most.max(by),
    })
}

/// How many texels differ at all.
pub(super) fn touched(a: &Image, b: &Image) -> usize {
    gap(a, b).any
}
