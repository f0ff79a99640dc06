//! What single texels are, by the formulas.

use std::sync::Arc;

use glam::vec2;

use super::kit::{SIZE, maps, middle, patch_job, plain, whole};
use crate::canvas::image::Image;
use crate::canvas::job::{Painting, PatchJob};
use crate::render::reference::painter::noise::{fbm, perlin};
use crate::render::reference::painter::{Painter, paint, patch};

/// GP's formula, written out in f64 for one texel; the noise is f32 as everywhere. `None` where a layer begins within a hair.
fn formula(job: &PatchJob, [i, j]: [u32; 2]) -> Option<[f64; 4]> {
    let [x, y] = [(i, 0), (j, 1)].map(|(k, axis)| f64::from(k) / f64::from(job.size[axis] - 1));
    let [ox, oy] = job.offset.map(f64::from);
    let (across, aside) = (2.0 * x - 1.0, (y - 0.5).abs());
    let noise = f64::from(perlin([((x + ox) * f64::from(job.edge[0])) as f32, 0.5]));
    let inner = (f64::from(job.edge[1]) * noise).max(0.05) * (0.45 - 0.5 * across * across);
    let faded = (inner + 0.05) * (1.0 - across * across);
    let outer = 0.25 - 0.3 * across * across * across * across;
    let [of_inner, dark, light] = job.palette.map(|c| c.map(f64::from));
    let mix = |a: [f64; 3], b: [f64; 3], t: f64| [0, 1, 2].map(|k| a[k] * (1.0 - t) + b[k] * t);
    let c = |y: f64| {
        let noise = f64::from(fbm([[(x + ox) as f32, (y + oy) as f32]], &job.noise)[0]);
        mix(dark, light, (0.5 + noise).clamp(0.0, 1.0))
    };
    let side = if y > 0.5 { 1.0 } else { -1.0 };
    let central = (x - 0.5).abs() < 0.475;
    if [inner, faded, outer, outer + 0.05].iter().any(|edge| (aside - edge).abs() < 1e-5) {
        return None;
    }
    let (rgb, alpha) = if central && aside < inner {
        (of_inner, 1.0)
    } else if central && aside < faded {
        (mix(of_inner, c(0.5 + side * faded), (aside - inner) / (faded - inner)), 1.0)
    } else if aside < outer {
        (c(y), 1.0)
    } else if aside < outer + 0.05 {
        (c(0.5 + side * outer), 1.0 - (aside - outer) / 0.05)
    } else {
        ([0.0; 3], 0.0)
    };
    Some([rgb[0] * alpha, rgb[1] * alpha, rgb[2] * alpha, alpha].map(|v| v * 255.0))
}

#[test]
fn a_patch_is_what_the_formula_says() {
    for (size, offset) in [([150, 53], [12.5, 77.25]), ([41, 22], [99.0, 0.5]), ([8, 4], [3.75, 50.0])] {
        let job = PatchJob { offset, ..patch_job(size) };
        let image = patch::patch(&job);
        let mut kinds = [0; 3];
        for texel in (0..size[1]).flat_map(|j| (0..size[0]).map(move |i| [i, j])) {
            let Some(expected) = formula(&job, texel) else { continue };
            let found = image.at(texel[0], texel[1]);
            let near = |k: usize| (f64::from(found[k]) - expected[k]).abs() < 0.51;
            assert!((0..4).all(near), "{texel:?} of {size:?}: {found:?}, not {expected:?}");
            kinds[if found[3] == 0 { 0 } else { 1 + usize::from(found[3] == 255) }] += 1;
        }
        assert!(size[0] < 40 || kinds.iter().all(|n| *n > 20), "{kinds:?}");
    }
}

#[test]
fn a_patch_is_dark_within_and_ends_in_nothing() {
    let job = patch_job([150, 53]);
    let image = patch::patch(&job);
    assert_eq!(image.at(75, 26), [107, 13, 13, 255], "the inner layer's own colour");
    let [r, g, b, a] = image.at(75, 15);
    assert!(a == 255 && r > 150 && g > 50 && b > 40, "the outer layer is lighter");
    assert!((0..150).all(|x| image.at(x, 0) == [0; 4] && image.at(x, 52) == [0; 4]));
    assert!((0..53).all(|y| image.at(0, y) == [0; 4] && image.at(149, y) == [0; 4]));
}

fn painted(painter: &mut Painter, paintings: &[&Arc<Painting>]) -> (Image, Image) {
    painter.follow(&paintings.iter().map(|p| Arc::clone(p)).collect::<Vec<_>>());
    (painter.color().clone(), painter.discolor().clone())
}

#[test]
fn the_stronger_discoloration_stays() {
    let sheet = whole();
    let with = |line, factor: [f32; 3]| {
        let mut painting = sheet.painting(line, 24.0);
        painting.paint.factor = factor;
        Arc::new(painting)
    };
    let crossing = [vec2(48.0, 4.0), vec2(50.0, 44.0)];
    let (a, b) = (with(middle(), [0.9, 0.7, 0.65]), with(crossing, [0.9, 0.7, 0.65]));
    let mut painter = Painter::new(&plain(), &sheet.mesh());
    let [of_a, of_b] = [painted(&mut painter, &[&a]).1, painted(&mut painter, &[&b]).1];
    let both = painted(&mut painter, &[&a, &b]).1;
    assert_eq!(both, painted(&mut painter, &[&b, &a]).1, "with one factor the order does not matter");
    let mut meet = 0;
    for (k, texel) in both.texels.iter().enumerate() {
        let [a, b] = [of_a.texels[k], of_b.texels[k]];
        assert_eq!(*texel, if b[3] > a[3] { b } else { a });
        meet += usize::from(a[3] > 0 && b[3] > 0 && a != b);
    }
    assert!(meet > 200, "they overlap: {meet}");
    // With two factors the stronger one's colour stays, and of equals the first.
    let c = with(crossing, [0.85, 0.6, 0.8]);
    let of_c = painted(&mut painter, &[&c]).1;
    let mixed = painted(&mut painter, &[&a, &c]).1;
    for (k, texel) in mixed.texels.iter().enumerate() {
        let [a, c] = [of_a.texels[k], of_c.texels[k]];
        assert_eq!(*texel, if c[3] > a[3] { c } else { a });
    }
}

#[test]
fn the_colour_maps_alpha_stays() {
    let texels = (0..SIZE[0] * SIZE[1]).map(|k| [200, 150, 140, (k % 251) as u8]).collect();
    let maps = maps(Image { size: SIZE, texels });
    let sheet = whole();
    let mut painter = Painter::new(&maps, &sheet.mesh());
    painter.paint(&Arc::new(sheet.painting(middle(), 24.0)));
    let pairs = || painter.color().texels.iter().zip(&maps.color.texels);
    assert!(pairs().all(|(now, before)| now[3] == before[3]));
    assert!(pairs().filter(|(now, before)| now != before).count() > 500);
}

#[test]
fn texels_are_what_their_coordinates_say() {
    let sheet = whole();
    let painting = sheet.painting(middle(), 24.0);
    let job = &painting.paint;
    let mut painter = Painter::new(&plain(), &sheet.mesh());
    painter.paint(&Arc::new(painting.clone()));
    let patch = patch::patch(&painting.patch);
    let mask = crate::render::mask::covered(&sheet.mesh(), SIZE);
    let [length, height] = [job.length, job.height].map(f64::from);
    for ([x, y], at) in paint::used(job, &mask, SIZE) {
        // (s, d) by the sheet itself: a texel is a unit.
        let p = vec2(x as f32 + 0.5 - 20.25, y as f32 + 0.5 - 30.25) - middle()[0];
        let along = (middle()[1] - middle()[0]).normalize();
        let [s, d] = [along.dot(p), along.perp_dot(p)].map(f64::from);
        assert!((s - f64::from(at[0])).abs() < 1e-3 && (d - f64::from(at[1])).abs() < 1e-3, "{x}, {y}");
        color(&patch, [(0.025 + 0.95 * s / length), 0.5 - d / height], painter.color().at(x, y));
        let t = 2.0 * (s / length).clamp(0.0, 1.0) - 1.0;
        let radius = 0.5 * height * (1.0 - 0.5 * t * t);
        let away = d.hypot_to((-s).max(s - length).max(0.0));
        let most = 1.0 - away / (2.0 * radius);
        let place = [s, d].map(|v| v as f32 * job.noise_scale);
        let noise = f64::from(fbm([[place[0] + job.offset[0], place[1] + job.offset[1]]], &job.noise)[0]);
        let alpha = (noise.max(0.0).min(most) + (1.1 - away / radius).max(0.0)).clamp(0.0, 1.0);
        let found = painter.discolor().at(x, y);
        let expected = if most > 0.0 { 255.0 * alpha } else { 0.0 };
        assert!((f64::from(found[3]) - expected).abs() < 0.8, "{x}, {y}: {found:?}, not {expected}");
        assert!(found[3] == 0 || found[..3] == [115, 89, 83], "half the factors: {found:?}");
    }
}

trait Hypot {
    fn hypot_to(self, other: f64) -> f64;
}

impl Hypot for f64 {
    fn hypot_to(self, other: f64) -> f64 {
        (self * self + other * other).sqrt()
    }
}

/// A texel of the plain map is the patch, bilinear, over its colour.
fn color(patch: &Image, at: [f64; 2], found: [u8; 4]) {
    let under = plain().color.at(0, 0).map(f64::from);
    let expected = if at.iter().all(|v| (0.0..=1.0).contains(v)) {
        let [x, y] = [0, 1].map(|k| at[k] * f64::from(patch.size[k] - 1));
        let weight = |i: u32, j: u32| {
            let [w, h] = [x - f64::from(i), y - f64::from(j)].map(|v| (1.0 - v.abs()).max(0.0));
            w * h
        };
        let near = |v: f64, n: u32| (v as u32)..(v as u32 + 2).min(n);
        let mut sum = [0.0; 4];
        for (i, j) in near(y, patch.size[1]).flat_map(|j| near(x, patch.size[0]).map(move |i| (i, j))) {
            let texel = patch.at(i, j).map(f64::from);
            (0..4).for_each(|k| sum[k] += weight(i, j) * texel[k]);
        }
        [0, 1, 2].map(|k| sum[k] + (1.0 - sum[3] / 255.0) * under[k])
    } else {
        [under[0], under[1], under[2]]
    };
    let off = (0..3).map(|k| (f64::from(found[k]) - expected[k]).abs()).fold(0.0, f64::max);
    assert!(off < 0.8, "{found:?}, not {expected:?} at {at:?}");
}

#[test]
fn a_job_that_makes_no_sense_paints_nothing_and_does_not_panic() {
    let sheet = whole();
    let good = sheet.painting(middle(), 24.0);
    let mut wild = vec![good.clone(); 5];
    wild[0].paint.length = 0.0;
    wild[1].paint.height = f32::NAN;
    wild[2].patch.size = [0, 7];
    wild[3].patch.size = [1, 1];
    wild[4].paint.faces.clear();
    for painting in wild {
        let mut painter = Painter::new(&plain(), &sheet.mesh());
        painter.paint(&Arc::new(painting));
        painter.follow(&[]);
        assert_eq!(painter.color(), &plain().color);
    }
}
