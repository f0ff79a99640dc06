//! The maps follow the list of paintings.

use std::sync::Arc;

use glam::{Vec2, vec2};

use super::kit::{middle, patch_job, plain, whole};
use crate::canvas::image::Image;
use crate::canvas::job::Painting;
use crate::render::reference::painter::Painter;

/// Paintings that overlap.
fn paintings() -> Vec<Arc<Painting>> {
    let lines: [[Vec2; 2]; 4] = [
        middle(),
        [vec2(20.0, 6.0), vec2(70.0, 44.0)],
        [vec2(80.0, 10.0), vec2(30.0, 30.0)],
        [vec2(12.0, 40.0), vec2(60.0, 20.0)],
    ];
    let sheet = whole();
    let painting = |(k, line): (u8, &[Vec2; 2])| {
        let mut painting = sheet.painting(*line, 22.0);
        painting.paint.factor = [0.9, 0.6 + 0.05 * f32::from(k), 0.7];
        painting.patch.offset[0] += f32::from(k);
        Arc::new(painting)
    };
    (0..).zip(&lines).map(painting).collect()
}

fn state(painter: &Painter) -> (Image, Image) {
    (painter.color().clone(), painter.discolor().clone())
}

#[test]
fn forth_and_back_restores_every_byte() {
    let all = paintings();
    // Room for everything; for two or three; for none beside the newest.
    for budget in [64 << 20, 400_000, 0] {
        let mut painter = Painter::with_budget(&plain(), &whole().mesh(), budget);
        let mut states = vec![state(&painter)];
        for painting in &all {
            painter.paint(painting);
            states.push(state(&painter));
        }
        assert!(states.windows(2).all(|pair| pair[0].0 != pair[1].0 && pair[0].1 != pair[1].1));
        for n in [3, 1, 4, 2, 2, 0, 4, 0, 3] {
            painter.follow(&all[..n]);
            assert!(state(&painter) == states[n], "{n} paintings, {budget} bytes");
        }
        let kept = painter.journal.len();
        assert!(if budget == 0 { kept == 1 } else { kept >= 2 }, "{kept} kept of {budget} bytes");
    }
}

#[test]
fn another_branch_is_what_it_would_be_alone() {
    let all = paintings();
    let branch = [Arc::clone(&all[0]), Arc::clone(&all[2]), Arc::clone(&all[1])];
    let mut alone = Painter::new(&plain(), &whole().mesh());
    branch.iter().for_each(|painting| alone.paint(painting));
    for budget in [64 << 20, 0] {
        let mut painter = Painter::with_budget(&plain(), &whole().mesh(), budget);
        painter.follow(&all);
        painter.follow(&branch);
        assert!(state(&painter) == state(&alone));
    }
}

#[test]
fn equal_paintings_need_not_be_the_same_to_be_kept() {
    let all = paintings();
    let mut painter = Painter::new(&plain(), &whole().mesh());
    painter.follow(&all);
    let copies: Vec<_> = all.iter().map(|p| Arc::new(Painting::clone(p))).collect();
    painter.follow(&copies[..3]);
    assert_eq!(painter.journal.len(), 3, "the common ones were not carried out again");
    assert!(painter.applied.iter().zip(&all).all(|(a, b)| Arc::ptr_eq(a, b)));
}

#[test]
fn checks_look_at_what_was_done_last() {
    let all = paintings();
    let mut painter = Painter::with_budget(&plain(), &whole().mesh(), 0);
    assert!(painter.check_paint().is_empty() && painter.check_patch(&patch_job([9, 9])).is_empty());
    painter.follow(&all);
    painter.patch(&all[3].patch);
    let checks = [painter.check_patch(&all[3].patch), painter.check_paint()].concat();
    let names: Vec<&str> = checks.iter().map(|check| check.name.as_str()).collect();
    assert_eq!(names, ["border", "palette", "within", "finite"]);
    assert!(checks.iter().all(|check| check.ok), "{checks:?}");
    // A texel far from everything, as a defect would change it.
    *painter.color.as_mut().and_then(|map| map.texels.last_mut()).expect("a texel") = [1, 2, 3, 4];
    assert!(painter.check_paint()[0].ok, "no painting saved that tile, so none changed it");
    let mut wild = Painting::clone(&all[0]);
    wild.paint.faces[30].at[1] = vec2(f32::NAN, 0.0);
    painter.paint(&Arc::new(wild));
    let finite = &painter.check_paint()[1];
    assert!(!finite.ok && !finite.culprits.is_empty(), "{finite:?}");
}

#[test]
fn a_texel_beyond_the_faces_is_found() {
    let painting = &paintings()[0];
    let mut painter = Painter::new(&plain(), &whole().mesh());
    painter.paint(painting);
    // In a tile that the painting saved, above the chart and its skirt.
    painter.color.as_mut().expect("it was painted on").texels[20 * 256 + 40] = [1, 2, 3, 4];
    let within = &painter.check_paint()[0];
    assert_eq!((within.ok, within.culprits.as_slice()), (false, &["t40,20".to_owned()][..]));
}

#[test]
fn the_scenes_own_map_is_not_copied_before_it_is_painted_on() {
    let maps = plain();
    let mut painter = Painter::new(&maps, &whole().mesh());
    assert!(std::ptr::eq(painter.color(), &maps.color) && painter.mask.is_none());
    painter.follow(&paintings()[..1]);
    assert!(painter.color() != &maps.color && painter.mask.is_some());
    assert_eq!(maps.color, plain().color, "the scene's own stays");
}

#[test]
fn threads_change_nothing() {
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| {
            let mut painter = Painter::new(&plain(), &whole().mesh());
            painter.follow(&paintings());
            let patch = painter.patch(&patch_job([150, 53])).clone();
            (patch, state(&painter))
        })
    };
    assert!(run(1) == run(4));
}
