//! The device's painter against the CPU's, its journal, and its shaders against naga.

mod kit;
mod shaders;

use glam::{Vec2, vec2};

use super::journal::blocks;
use super::*;
use crate::canvas::image::Image;
use crate::render::gpu::tests::kit::device;
use crate::render::layout::tiles_of;
use crate::report::Check;
use kit::{HERE, both, cut, gap, moved, painters, sheet, touched};

/// Part of the texels that may differ by more than one: a bit of noise near a layer's edge may put a texel on its other side.
const OUTLIERS_PER_MILLE: usize = 1;

fn broken(checks: &[Check]) -> Vec<&str> {
    checks.iter().filter(|check| !check.ok).map(|check| check.name.as_str()).collect()
}

fn assert_close(what: &str, ours: &Image, reference: &Image, touched: usize) {
    let gap = gap(ours, reference);
    eprintln!("{what}: {gap:?} of {touched} touched");
    assert!(touched > 200, "{what}: {touched}");
    assert!(gap.more * 1000 <= touched * OUTLIERS_PER_MILLE, "{what}: {gap:?} of {touched}");
}

#[test]
fn a_patch_is_the_reference_s() {
    let Some(device) = device() else { return };
    let (mut painter, mut reference) = painters(&device, [64, 64], HERE);
    for (octaves, size) in [(4, [160, 55]), (2, [97, 39]), (0, [8, 5]), (5, [700, 150])] {
        let mut job = cut(vec2(0.3, 0.5), vec2(0.7, 0.5), 0.2, size, octaves).patch.clone();
        job.noise.octaves = octaves;
        painter.patch(&job).expect("a patch");
        let made = painter.made.as_ref().expect("the patch").read(&device).expect("its texels");
        let wanted = reference.patch(&job);
        let gap = gap(&made, wanted);
        eprintln!("patch {size:?}: {gap:?}");
        assert!(gap.more * 1000 <= made.texels.len() * OUTLIERS_PER_MILLE, "{size:?}: {gap:?}");
        assert!(made.texels.iter().any(|texel| texel[3] == 255), "a wound has an inside");
        assert_eq!(broken(&painter.check_patch(&job).expect("checks")), Vec::<&str>::new());
    }
}

/// Paints with both, the charts moved by this, and compares.
fn compare(what: &str, size: [u32; 2], by: Vec2, cuts: &[Arc<Painting>]) {
    let Some(device) = device() else { return };
    let (mut painter, mut reference) = painters(&device, size, by);
    let [plain, clear] = both(&painter);
    for cut in &cuts.iter().map(|cut| moved(cut, by)).collect::<Vec<_>>() {
        painter.paint(cut).expect("a painting");
        reference.paint(cut);
        assert_eq!(broken(&painter.check_paint().expect("checks")), Vec::<&str>::new());
    }
    let [color, discolor] = both(&painter);
    assert_close(&format!("{what}, colour"), &color, reference.color(), touched(&plain, &color));
    assert_close(&format!("{what}, discolour"), &discolor, reference.discolor(), touched(&clear, &discolor));
}

#[test]
fn a_painting_is_the_reference_s() {
    compare("one chart", [512, 512], HERE, &[cut(vec2(0.2, 0.3), vec2(0.75, 0.6), 0.3, [200, 65], 0)]);
}

#[test]
fn a_painting_across_a_seam_is_the_reference_s() {
    compare("seam", [700, 700], HERE, &[cut(vec2(0.7, 0.45), vec2(1.4, 0.55), 0.3, [230, 71], 1)]);
}

#[test]
fn overlapping_discolorations_are_the_reference_s() {
    let cuts = [
        cut(vec2(0.3, 0.2), vec2(0.6, 0.8), 0.35, [180, 60], 2),
        cut(vec2(0.2, 0.6), vec2(0.8, 0.5), 0.25, [200, 65], 3),
        cut(vec2(0.25, 0.55), vec2(1.2, 0.5), 0.15, [300, 85], 4),
    ];
    compare("overlap", [512, 512], HERE, &cuts);
}

#[test]
fn maps_need_not_be_whole_tiles() {
    compare("odd", [300, 200], HERE, &[cut(vec2(0.5, 0.5), vec2(1.9, 0.6), 0.4, [230, 71], 5)]);
}

#[test]
fn charts_may_reach_over_the_map_s_border() {
    let cuts = [cut(vec2(0.3, 0.5), vec2(1.7, 0.6), 0.3, [230, 71], 6)];
    compare("border", [300, 200], vec2(0.55, -1.4), &cuts);
}

#[test]
fn tiles_painted_a_few_at_a_time_are_the_same() {
    let Some(device) = device() else { return };
    let (maps, sheet) = (kit::maps([300, 400]), sheet(HERE));
    let cuts = [
        cut(vec2(0.3, 0.2), vec2(0.6, 0.8), 0.35, [180, 60], 2),
        cut(vec2(0.25, 0.55), vec2(1.2, 0.5), 0.15, [300, 85], 4),
    ];
    let mut few = Painter::within(device.clone(), &Arc::default(), &maps, &sheet, Room { tiles: 3, ..ROOM })
        .expect("a painter");
    let mut all = Painter::new(device, &maps, &sheet).expect("a painter");
    for count in [2, 1, 0, 2] {
        few.follow(&cuts[..count]).expect("maps that follow");
        all.follow(&cuts[..count]).expect("maps that follow");
        assert!(both(&few) == both(&all), "{count} paintings");
    }
    assert_eq!(broken(&few.check_paint().expect("checks")), Vec::<&str>::new());
}

#[test]
fn painting_forth_and_back_restores_every_byte() {
    let Some(device) = device() else { return };
    let (mut painter, _) = painters(&device, [300, 200], HERE);
    let cuts = [
        cut(vec2(0.1, 0.4), vec2(0.9, 0.6), 0.3, [100, 40], 0),
        cut(vec2(0.8, 0.2), vec2(1.5, 0.7), 0.3, [120, 44], 1),
        cut(vec2(0.3, 0.8), vec2(0.9, 0.2), 0.2, [90, 36], 2),
    ];
    let mut states = vec![both(&painter)];
    for cut in &cuts {
        painter.paint(cut).expect("a painting");
        states.push(both(&painter));
    }
    for count in [3, 2, 3, 0, 1, 3, 1, 0, 2] {
        painter.follow(&cuts[..count]).expect("maps that follow");
        assert!(both(&painter) == states[count], "{count} paintings");
    }
    // Another history that begins the same.
    painter.follow(&[cuts[0].clone(), cuts[2].clone()]).expect("maps that follow");
    let other = both(&painter);
    painter.follow(&[]).expect("maps that follow");
    painter.paint(&cuts[0]).expect("a painting");
    painter.paint(&cuts[2]).expect("a painting");
    assert!(both(&painter) == other && other != states[2]);
}

#[test]
fn beyond_the_budget_the_maps_are_made_again() {
    let Some(device) = device() else { return };
    let (maps, sheet) = (kit::maps([256, 256]), sheet(HERE));
    let cuts: Vec<_> =
        (0..4).map(|k| cut(vec2(0.2, 0.2 + 0.1 * k as f32), vec2(0.9, 0.5), 0.2, [90, 36], k)).collect();
    let room = Room { journal: 1, ..ROOM };
    let mut small = Painter::within(device.clone(), &Arc::default(), &maps, &sheet, room).expect("a painter");
    let mut large = Painter::new(device, &maps, &sheet).expect("a painter");
    for painter in [&mut small, &mut large] {
        painter.follow(&cuts).expect("maps that follow");
    }
    assert!(small.journal.back_to(3).is_some(), "the newest is kept");
    assert!(small.journal.back_to(2).is_none(), "older ones are dropped");
    for count in [3, 1, 4, 0] {
        small.follow(&cuts[..count]).expect("maps that follow");
        large.follow(&cuts[..count]).expect("maps that follow");
        assert!(both(&small) == both(&large), "{count} paintings");
    }
}

#[test]
fn a_planted_defect_breaks_its_check() {
    let Some(device) = device() else { return };
    let (mut painter, _) = painters(&device, [256, 256], HERE);
    let painting = cut(vec2(0.2, 0.5), vec2(0.8, 0.5), 0.2, [90, 36], 0);
    painter.paint(&painting).expect("a painting");
    assert_eq!(broken(&painter.check_paint().expect("checks")), Vec::<&str>::new());

    // A texel of a touched tile, left of the chart.
    let [.., height] = painter.maps.size();
    let at = wgpu::Origin3d { x: 1, y: height / 2, z: 0 };
    let into = wgpu::TexelCopyTextureInfo { origin: at, ..painter.maps.color.as_image_copy() };
    let layout = wgpu::TexelCopyBufferLayout::default();
    device.queue.write_texture(into, &[1, 2, 3, 4], layout, wgpu::Extent3d::default());
    let checks = painter.check_paint().expect("checks");
    assert_eq!(broken(&checks), ["within"]);
    assert_eq!(checks[0].culprits, [format!("t1,{}", height / 2)]);

    // The patch's corner in a colour that is no skin's.
    let made = painter.made.as_mut().expect("the patch");
    let mut texels = made.read(&device).expect("its texels").texels;
    texels[0] = [9, 255, 9, 255];
    let usage = BufferUsages::STORAGE | BufferUsages::COPY_SRC;
    made.texels = device.filled("planted", texels.as_flattened(), usage).expect("a buffer");
    assert_eq!(broken(&painter.check_patch(&painting.patch).expect("checks")), ["border", "palette"]);
}

#[test]
fn what_is_no_number_is_not_painted_and_told() {
    let Some(device) = device() else { return };
    let (mut painter, _) = painters(&device, [256, 256], HERE);
    let mut painting = Painting::clone(&cut(vec2(0.2, 0.5), vec2(0.8, 0.5), 0.2, [90, 36], 0));
    for face in &mut painting.paint.faces {
        face.at[1].x = f32::NAN;
    }
    let before = both(&painter);
    painter.paint(&Arc::new(painting)).expect("a painting");
    assert_eq!(broken(&painter.check_paint().expect("checks")), ["finite"]);
    assert!(both(&painter) == before);
}

#[test]
fn a_patch_beyond_the_device_is_an_error() {
    let Some(device) = device() else { return };
    let (mut painter, _) = painters(&device, [64, 64], HERE);
    let mut painting = Painting::clone(&cut(vec2(0.2, 0.5), vec2(0.8, 0.5), 0.2, [90, 36], 0));
    painting.patch.size = [u32::MAX, u32::MAX];
    assert!(matches!(painter.patch(&painting.patch), Err(RenderError::TooLarge(_))));
    assert!(matches!(painter.paint(&Arc::new(painting)), Err(RenderError::TooLarge(_))));
    assert_eq!(painter.journal.common(&[]), 0);
    assert!(painter.journal.last().is_none(), "what failed is not in the journal");
}

#[test]
fn runs_are_the_tiles_of_a_map_and_overlap_nowhere() {
    for size in [[300, 200], [64, 64], [1, 1], [5000, 2100]] {
        let tiles: Vec<u32> = (0..tiles_of(size).iter().product()).filter(|k| k % 7 != 3).collect();
        let mut texels = 0;
        for block in blocks(&tiles, size, 100) {
            let mut end = 0;
            for run in &block.runs {
                assert!((0..2).all(|k| run.origin[k] + run.size[k] <= size[k]));
                assert!(run.target[0] + run.size[0] <= journal::ACROSS * TILE);
                assert!(run.target[1] < block.rows() * TILE && run.at == end && run.at % 256 == 0);
                (end, texels) =
                    (run.discolor_at() + run.region().padded(), texels + run.size[0] * run.size[1]);
            }
            assert!(block.bytes() == end && end <= 8 * 100 * u64::from(TILE * TILE));
        }
        let windows = tiles.iter().map(|tile| crate::render::layout::tile_window(*tile, size));
        let wanted: u32 = windows.map(|w| (w.to[0] - w.from[0]) * (w.to[1] - w.from[1])).sum();
        assert_eq!(texels, wanted, "{size:?}");
    }
}
