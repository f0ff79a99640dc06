//! Charts, seams, and maps that repeat.

use std::sync::Arc;

use glam::{Vec2, vec2};

use super::kit::{Chart, SIZE, Sheet, maps, middle, plain, whole};
use crate::canvas::image::Image;
use crate::render::reference::painter::{Painter, paint};

/// Two charts, the second turned by a right angle and elsewhere, on the same grid of texels.
fn seamed() -> Sheet {
    Sheet::of(&[
        Chart { from: [0, 0], to: [6, 6], texel: first },
        Chart { from: [6, 0], to: [12, 6], texel: second },
    ])
}

fn first(p: Vec2) -> Vec2 {
    p + vec2(20.25, 30.25)
}

fn second(p: Vec2) -> Vec2 {
    vec2(150.0 - p.y - 0.25, 40.0 + p.x - 48.0 + 0.25)
}

fn painted(sheet: &Sheet, height: f32) -> Painter {
    let mut painter = Painter::new(&plain(), &sheet.mesh());
    painter.paint(&Arc::new(sheet.painting(middle(), height)));
    assert!(painter.check_paint().iter().all(|check| check.ok), "{:?}", painter.check_paint());
    painter
}

/// The four texels around a place on the map, and how far it is between them.
fn around(at: Vec2) -> ([[u32; 2]; 4], [f32; 2]) {
    let corner = (at - 0.5).floor();
    let [x, y] = [corner.x as u32, corner.y as u32];
    ([[x, y], [x + 1, y], [x, y + 1], [x + 1, y + 1]], (at - 0.5 - corner).to_array())
}

fn bilinear(map: &Image, at: Vec2) -> [f32; 4] {
    let (texels, [tx, ty]) = around(at);
    let [a, b, c, d] = texels.map(|[x, y]| map.at(x, y).map(f32::from));
    let mix = |a: f32, b: f32, t: f32| a + (b - a) * t;
    [0, 1, 2, 3].map(|k| mix(mix(a[k], b[k], tx), mix(c[k], d[k], tx), ty))
}

#[test]
fn both_charts_show_the_same_at_a_seam() {
    let painter = painted(&seamed(), 28.0);
    let unpainted = painter.maps.color.at(0, 0).map(f32::from);
    let mut seen = 0;
    for map in [painter.color(), painter.discolor()] {
        for p in (0..480).map(|k| vec2(48.0, k as f32 * 0.1)) {
            let (here, there) = (bilinear(map, first(p)), bilinear(map, second(p)));
            for (a, b) in here.iter().zip(there) {
                assert!((a - b).abs() <= 2.0, "{here:?} and {there:?} at {p}");
            }
            seen += usize::from(here != unpainted && here != [0.0; 4]);
        }
    }
    assert!(seen > 300, "the seam lies in the wound: {seen}");
}

#[test]
fn a_seam_changes_nothing_within_a_chart() {
    let (one, two) = (painted(&whole(), 28.0), painted(&seamed(), 28.0));
    for p in (0..48).flat_map(|j| (0..48).map(move |i| vec2(i as f32 + 0.25, j as f32 + 0.25))) {
        let [x, y] = first(p).to_array().map(|v| v as u32);
        assert_eq!(one.color().at(x, y), two.color().at(x, y), "{x}, {y}");
        assert_eq!(one.discolor().at(x, y), two.discolor().at(x, y), "{x}, {y}");
    }
}

#[test]
fn no_sample_picks_up_an_unpainted_texel() {
    // Slanted charts with corners of every kind; the painting is large enough to reach all of them.
    let slanted = |p: Vec2| vec2(60.0 + 0.8 * p.x - 0.5 * p.y, 12.0 + 0.45 * p.x + 0.9 * p.y);
    let sharp = |p: Vec2| vec2(150.0 + 0.9 * p.x, 100.0 + 0.7 * p.x + 0.4 * p.y);
    let sheet = Sheet::of(&[
        Chart { from: [0, 0], to: [4, 5], texel: slanted },
        Chart { from: [2, 5], to: [7, 6], texel: slanted },
        Chart { from: [8, 0], to: [11, 3], texel: sharp },
    ]);
    let painting = sheet.painting(middle(), 200.0);
    let mask = crate::render::mask::covered(&sheet.mesh(), SIZE);
    let mut has = vec![false; mask.len()];
    for ([x, y], _) in paint::used(&painting.paint, &mask, SIZE) {
        has[(y * SIZE[0] + x) as usize] = true;
    }
    let weights =
        (0..=24u8).flat_map(|i| (0..=24 - i).map(move |j| [i, j, 24 - i - j].map(|w| f32::from(w) / 24.0)));
    for [a, b, c] in weights {
        for (_, corners, _) in &sheet.faces {
            let at = corners[0] * a + corners[1] * b + corners[2] * c;
            for [x, y] in around(at).0 {
                assert!(has[(y * SIZE[0] + x) as usize], "texel {x}, {y} is missing at {at}");
            }
        }
    }
}

#[test]
fn skirts_do_not_reach_into_other_charts() {
    // The second chart lies one texel beside the first, and is not painted on.
    let near = |p: Vec2| p + vec2(21.25, 30.25);
    let sheet = Sheet::of(&[
        Chart { from: [0, 0], to: [6, 6], texel: first },
        Chart { from: [6, 0], to: [12, 6], texel: near },
    ]);
    let mut painting = sheet.painting(middle(), 28.0);
    painting.paint.faces.truncate(72);
    let mut painter = Painter::new(&plain(), &sheet.mesh());
    painter.paint(&Arc::new(painting));
    let columns =
        |x: u32| (30..78).filter(|y| painter.color().at(x, *y) != painter.maps.color.at(0, 0)).count();
    assert_eq!(
        [columns(67) > 10, columns(68) > 10, columns(69) > 0, columns(70) > 0],
        [true, true, false, false]
    );
    assert!(painter.check_paint().iter().all(|check| check.ok));
}

#[test]
fn of_two_faces_the_later_has_a_texel_and_a_face_before_any_skirt() {
    let sheet = Sheet::of(&[
        Chart { from: [0, 0], to: [6, 6], texel: first },
        Chart { from: [6, 0], to: [12, 6], texel: second },
    ]);
    let mesh = sheet.mesh();
    let mask = crate::render::mask::covered(&mesh, SIZE);
    let mut painting = sheet.painting(middle(), 28.0);
    let before = paint::used(&painting.paint, &mask, SIZE);
    // The first face once more, with coordinates of its own and open sides.
    let mut again = painting.paint.faces[40];
    again.at = again.at.map(|p| p + vec2(0.0, 1.0));
    again.open = 0b111;
    painting.paint.faces.push(again);
    let after = paint::used(&painting.paint, &mask, SIZE);
    assert_eq!(before.len(), after.len());
    let moved = before.iter().zip(&after).filter(|(a, b)| a != b);
    let inside = |[x, y]: [u32; 2]| {
        let sums = again.uv.map(|c| vec2(c.x * SIZE[0] as f32, (1.0 - c.y) * SIZE[1] as f32));
        let [from, to] = [sums[0].min(sums[1]).min(sums[2]), sums[0].max(sums[1]).max(sums[2])];
        let centre = vec2(x as f32 + 0.5, y as f32 + 0.5);
        centre.clamp(from, to) == centre
    };
    let moved: Vec<_> =
        moved.inspect(|(a, b)| assert!((a.1[1] + 1.0 - b.1[1]).abs() < 1e-5)).map(|(a, _)| a.0).collect();
    assert!((28..=36).contains(&moved.len()) && moved.iter().all(|t| inside(*t)), "{moved:?}");
}

#[test]
fn paintings_wrap_around_the_map() {
    let color = |shift: u32| {
        let texels = (0..SIZE[0] * SIZE[1]).map(|k| [k % SIZE[0], k / SIZE[0]]);
        let texel = |[x, y]: [u32; 2]| [((x + SIZE[0] - shift) % SIZE[0]) as u8, y as u8, 90, 255];
        Image { size: SIZE, texels: texels.map(texel).collect() }
    };
    let paint = |texel: fn(Vec2) -> Vec2, color: Image| {
        let sheet = Sheet::of(&[Chart { from: [0, 0], to: [12, 6], texel }]);
        let mut painter = Painter::new(&maps(color), &sheet.mesh());
        painter.paint(&Arc::new(sheet.painting(middle(), 28.0)));
        assert!(painter.check_paint().iter().all(|check| check.ok));
        painter
    };
    let here = paint(|p| p + vec2(20.25, 30.25), color(0));
    // 200 texels further right it reaches over the border; and two maps left and one down it is the same.
    let over = paint(|p| p + vec2(220.25, 30.25), color(200));
    let away = paint(|p| p + vec2(220.25 - 512.0, 30.25 + 192.0), color(200));
    assert_eq!((over.color(), over.discolor()), (away.color(), away.discolor()));
    for (x, y) in (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| (x, y))) {
        let there = (x + 200) % SIZE[0];
        assert_eq!(here.color().at(x, y), over.color().at(there, y), "{x}, {y}");
        assert_eq!(here.discolor().at(x, y), over.discolor().at(there, y), "{x}, {y}");
    }
}
