//! Skirts by their definition, the order of drawing, tiles, and what is left out.

use glam::{Vec2, vec2};

use super::*;
use crate::canvas::look::Fbm;
use crate::render::spans::{Window, spans};

const SIZE: [u32; 2] = [256, 192];

/// A job on one face with corners in texels; (s, d) are its texels from (100, 100).
fn job(corners: [[f32; 2]; 3], open: u8) -> PaintJob {
    let uv = corners.map(|[x, y]| vec2(x / SIZE[0] as f32, 1.0 - y / SIZE[1] as f32));
    let at = corners.map(|[x, y]| vec2(x - 100.0, y - 100.0));
    PaintJob {
        length: 60.0,
        height: 20.0,
        factor: [0.9, 0.7, 0.7],
        offset: [0.0; 2],
        noise: Fbm::default(),
        noise_scale: 0.1,
        faces: vec![PaintFace { face: 0, uv, at, open }],
        inner: 1,
    }
}

const FACE: [[f32; 2]; 3] = [[100.0, 90.0], [130.0, 95.0], [110.0, 120.0]];

/// The texels that triangles cover.
fn texels<'a>(triangles: impl IntoIterator<Item = &'a Triangle>) -> Vec<[u32; 2]> {
    let mut all = Vec::new();
    for triangle in triangles {
        spans(corners(triangle), Window::whole(SIZE), |y, columns| all.extend(columns.map(|x| [x, y])));
    }
    all
}

#[test]
fn skirts_come_before_faces() {
    let mut job = job(FACE, 0b101);
    job.faces.push(PaintFace { open: 0b010, ..job.faces[0] });
    let skirts: Vec<bool> = lay_out(&job, SIZE).triangles.iter().map(|t| t.skirt).collect();
    assert_eq!(skirts, [true, true, true, true, true, true, false, false]);
}

#[test]
fn a_skirt_is_two_texels_around_its_side() {
    for face in [FACE, [FACE[0], FACE[2], FACE[1]]] {
        for side in 0..3 {
            let layout = lay_out(&job(face, 1 << side), SIZE);
            let found = texels(layout.triangles.iter().filter(|t| t.skirt));
            let [a, b, c] = [0, 1, 2].map(|k| Vec2::from(face[(side + k) % 3]));
            let along = (b - a).normalize();
            let out = (c - a).reject_from_normalized(along).normalize() * -1.0;
            let all = (60..150).flat_map(|y| (60..170).map(move |x| [x, y]));
            for texel in all {
                let p = vec2(texel[0] as f32 + 0.5, texel[1] as f32 + 0.5) - a;
                let (ahead, aside) = (along.dot(p), out.dot(p));
                let past = [-aside, aside - SKIRT, -ahead - SKIRT, ahead - a.distance(b) - SKIRT];
                let past = past.into_iter().fold(f32::MIN, f32::max);
                // Within a sixtieth of a texel of its border rounding decides.
                if past.abs() > 0.016 {
                    assert_eq!(found.contains(&texel), past < 0.0, "{texel:?} beside side {side}");
                }
            }
        }
    }
}

#[test]
fn coordinates_go_on_over_the_skirts() {
    let layout = lay_out(&job(FACE, 0b111), SIZE);
    assert_eq!(layout.triangles.len(), 7);
    for triangle in &layout.triangles {
        for ([x, y], [s, d]) in triangle.corners.iter().zip(triangle.at) {
            assert!((x - 100.0 - s).abs() < 1e-4 && (y - 100.0 - d).abs() < 1e-4, "{triangle:?}");
        }
    }
}

#[test]
fn only_tiles_in_reach_are_listed() {
    // It covers the whole map, but the painting is 60 + 2 · 20 texels long and 40 high.
    let all = [[-10.0, -10.0], [500.0, -10.0], [-10.0, 500.0]];
    let tiles = lay_out(&job(all, 0), SIZE).tiles;
    assert_eq!(tiles, [5, 6], "columns 80 to 180 lie in tiles 1 and 2, rows 80 to 120 in row 1");
    assert_eq!(lay_out(&job(FACE, 0), SIZE).tiles, [5, 6]);
    let far = job([[10.0, 10.0], [40.0, 10.0], [10.0, 40.0]], 0b111);
    assert!(lay_out(&far, SIZE).tiles.is_empty());
}

#[test]
fn what_reaches_over_the_border_is_there_on_both_sides() {
    let mut job = job([[250.0, 90.0], [262.0, 90.0], [250.0, 100.0]], 0);
    job.faces[0].at = [[0.0, 0.0], [12.0, 0.0], [0.0, 10.0]].map(Vec2::from);
    let layout = lay_out(&job, SIZE);
    assert_eq!(
        layout.triangles.iter().map(|t| t.corners[0]).collect::<Vec<_>>(),
        [[250.0, 90.0], [-6.0, 90.0]]
    );
    assert_eq!(layout.tiles, [4, 7]);
    assert_eq!(layout.triangles[0].at, layout.triangles[1].at);
}

#[test]
fn nothing_becomes_of_what_has_no_area_or_no_place() {
    let mut none = job([[100.0, 90.0], [110.0, 100.0], [120.0, 110.0]], 0b111);
    assert_eq!(lay_out(&none, SIZE), Layout::default(), "no area");
    for uv in [f32::NAN, f32::INFINITY, 4.5] {
        none = job(FACE, 0b111);
        none.faces[0].uv[1].x = uv;
        assert_eq!(lay_out(&none, SIZE), Layout::default(), "{uv}");
    }
}

#[test]
fn tiles_are_counted_row_by_row_and_end_with_the_map() {
    let size = [130, 70];
    assert_eq!(tiles_of(size), [3, 2]);
    assert_eq!(tile_index([2, 1], size), 5);
    assert_eq!(tile_window(5, size), Window { from: [128, 64], to: [130, 70] });
    assert_eq!(tile_window(1, size), Window { from: [64, 0], to: [128, 64] });
}
