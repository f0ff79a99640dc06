//! Each check on what is right, and on faults that were planted.

use glam::{Vec2, vec2};

use super::*;
use crate::canvas::look::{Fbm, Wound};

const SIZE: [u32; 2] = [64, 64];

fn patch_job() -> PatchJob {
    let Wound { inner, dark, light, edge, noise, .. } = Wound::default();
    PatchJob { size: [6, 5], offset: [3.0, 4.0], palette: [inner, dark, light], edge, noise }
}

/// A face with corners in texels, all sides open.
fn paint_job(corners: [[f32; 2]; 3]) -> PaintJob {
    let uv = corners.map(|[x, y]| vec2(x / 64.0, 1.0 - y / 64.0));
    PaintJob {
        length: 10.0,
        height: 5.0,
        factor: [0.5; 3],
        offset: [0.0; 2],
        noise: Fbm::default(),
        noise_scale: 1.0,
        faces: vec![PaintFace { face: 3, uv, at: [Vec2::ZERO; 3], open: 0b111 }],
        inner: 1,
    }
}

/// A mixture of the palette times an alpha, as bytes.
fn mixture(weights: [f32; 3], alpha: f32) -> [u8; 4] {
    let palette = patch_job().palette;
    let channel = |k: usize| (0..3).map(|i| weights[i] * palette[i][k]).sum::<f32>() * alpha;
    [channel(0), channel(1), channel(2), alpha].map(|v| (v * 255.0).round() as u8)
}

#[test]
fn a_border_must_be_transparent() {
    let mut image = Image::filled([6, 5], [0; 4]);
    image.texels[8] = [9, 9, 9, 255];
    assert!(border(&image).ok);
    image.texels[6] = [0, 0, 0, 1];
    image.texels[29] = [0, 0, 0, 200];
    let check = border(&image);
    assert!(!check.ok);
    assert_eq!((check.value, check.culprits), (Some(2.0), vec!["t0,1".into(), "t5,4".into()]));
}

#[test]
fn a_colour_must_be_a_mixture() {
    let job = patch_job();
    let mut image = Image::filled(job.size, [0; 4]);
    let mixtures = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.2, 0.5, 0.3], [0.0, 0.4, 0.6]];
    for (k, weights) in mixtures.into_iter().enumerate() {
        for (row, alpha) in [1.0, 0.7, 0.31, 0.02].into_iter().enumerate() {
            image.texels[row * 6 + k] = mixture(weights, alpha);
        }
    }
    assert!(palette(&job, &image).ok, "{:?}", palette(&job, &image));
    // Not premultiplied; brighter than the palette; between black and dark, as a fade to transparent black would be.
    for wrong in [[158, 56, 48, 100], [220, 130, 110, 255], [79, 28, 24, 255]] {
        let mut image = image.clone();
        image.texels[13] = wrong;
        let check = palette(&job, &image);
        assert!(!check.ok, "{wrong:?}");
        assert_eq!(check.culprits, ["t1,2"]);
    }
}

#[test]
fn a_palette_may_be_a_line_or_a_point() {
    let mut job = patch_job();
    job.palette[1] = job.palette[0];
    job.palette[2] = job.palette[0];
    let [r, g, b] = job.palette[0].map(|c| (c * 255.0).round() as u8);
    assert!(palette(&job, &Image::filled([2, 2], [r, g, b, 255])).ok);
    assert!(!palette(&job, &Image::filled([2, 2], [r, g, b + 4, 255])).ok);
}

#[test]
fn what_changes_must_lie_on_the_faces() {
    let job = paint_job([[10.0, 10.0], [30.0, 10.0], [10.0, 30.0]]);
    let mut mask = vec![0; 64 * 64];
    // Another chart begins two texels left of the face.
    (0..64).for_each(|y| mask[y * 64 + 8] = 1);
    let at = |changed: &[[u32; 2]]| within(&job, SIZE, &mask, changed);
    assert!(at(&[]).ok);
    assert!(at(&[[10, 10], [28, 10], [18, 20], [19, 20], [9, 9], [9, 31], [21, 20]]).ok);
    // Within reach of the skirt, but another's; beyond the skirt to the left, below, and beside the slanted side.
    for wrong in [[8, 20], [7, 20], [20, 7], [23, 22], [40, 40]] {
        let check = at(&[[10, 10], wrong]);
        assert!(!check.ok, "{wrong:?}");
        assert_eq!((check.value, check.culprits), (Some(1.0), vec![format!("t{},{}", wrong[0], wrong[1])]));
    }
    let closed = PaintJob { faces: vec![PaintFace { open: 0, ..job.faces[0] }], ..job.clone() };
    assert!(!within(&closed, SIZE, &mask, &[[9, 20]]).ok, "a closed side has no skirt");
}

#[test]
fn maps_repeat_for_what_changes_too() {
    let job = paint_job([[60.0, -4.0], [70.0, -4.0], [60.0, 6.0]]);
    let mask = vec![0; 64 * 64];
    let inside = [[61, 61], [1, 61], [61, 1], [0, 0], [58, 3]];
    assert!(within(&job, SIZE, &mask, &inside).ok);
    assert!(!within(&job, SIZE, &mask, &[[20, 61]]).ok);
}

#[test]
fn faces_without_a_place_allow_nothing() {
    let mask = vec![0; 64 * 64];
    for corners in [
        [[20.0, 20.0]; 3],
        [[f32::NAN, 1.0], [30.0, 1.0], [1.0, 30.0]],
        [[0.0, 0.0], [640.0, 0.0], [0.0, 640.0]],
    ] {
        assert!(!within(&paint_job(corners), SIZE, &mask, &[[20, 20]]).ok, "{corners:?}");
    }
}

#[test]
fn coordinates_must_be_numbers() {
    assert!(finite([([1, 2], [0.0, -3.0])]).ok);
    for wrong in [[f32::NAN, 0.0], [0.0, f32::INFINITY]] {
        let check = finite([([1, 2], [0.0; 2]), ([3, 4], wrong)]);
        assert!(!check.ok);
        assert_eq!(check.culprits, ["t3,4"]);
    }
}
