//! Whole frames: what is skipped, what is switched off, and threads.

use glam::DVec3;

use super::kit::{self, Stage};
use crate::assets::builtin::builtin;
use crate::canvas::RenderError;
use crate::canvas::frame::{Frame, Pass, place_lights};
use crate::canvas::image::Image;
use crate::canvas::look::{Look, Spotlight, Switches};
use crate::mesh::Mesh;
use crate::render::reference::Frames;

/// A head with all there is: three lights and one that misses it, maps, scattering and a discoloured quarter.
fn head() -> Stage {
    let mesh = Mesh::build(&builtin("bust").expect("it is there").mesh).expect("it is a mesh");
    let [lo, hi] = mesh.bounds();
    let (centre, radius) = (0.5 * (lo + hi), 0.5 * (hi - lo).length());
    let light = |azimuth| Spotlight { azimuth, ..Spotlight::default() };
    let aside = Spotlight { target: Some([500.0, 0.0, 0.0]), cone: 0.1, ..Spotlight::default() };
    let look = Look { lights: Some(vec![light(0.7), light(-0.9), aside, light(2.7)]), ..Look::default() };
    let mut stage = Stage::new(mesh);
    stage.view = kit::view([157, 91], 0.0);
    stage.view.eye = centre + DVec3::Z * 3.6 * radius;
    (stage.view.near, stage.view.far) = (2.0 * radius, 5.0 * radius);
    stage.lights = place_lights(&look, centre, radius);
    stage.look = look;
    stage.look.shadows.size = 128;
    stage.switches = Switches::default();
    stage.discolor = Image::filled([64, 64], [0; 4]);
    stage.discolor.texels[..1024].fill([110, 90, 100, 200]);
    stage.maps.color = Image::filled([64, 64], [220, 170, 150, 255]);
    stage.maps.color.texels[2048..3000].fill([200, 140, 110, 0]);
    stage
}

fn pass<'a>(frame: &'a Frame, id: &str) -> &'a Pass {
    frame.passes.iter().find(|pass| pass.id == id).expect("every pass is reported")
}

#[test]
fn skipping_nothing_gives_the_same_bytes() {
    let mut stage = head();
    let mut frames = stage.frames();
    let skipping = stage.render(&mut frames);
    let again = stage.render(&mut frames);
    stage.everything = true;
    let all = stage.render(&mut frames);
    assert!(skipping.image == all.image && again.image == all.image);
    let skips = |frame: &Frame| frame.passes.iter().filter(|pass| pass.skipped.is_some()).count();
    assert_eq!([skips(&skipping), skips(&again), skips(&all)], [1, 4, 0]);
    for id in ["skin", "scatter", "discolor"] {
        assert!(pass(&skipping, id).tiles > 0 && pass(&skipping, id).tiles < pass(&skipping, id).of, "{id}");
        assert_eq!([pass(&all, id).tiles, pass(&all, id).of], [60, 60]);
    }
    assert!(pass(&skipping, "discolor").tiles < pass(&skipping, "scatter").tiles);
}

#[test]
fn shadow_maps_are_drawn_again_when_they_must_be() {
    let mut stage = head();
    let mut frames = stage.frames();
    let mut why = |stage: &Stage| {
        let frame = stage.render(&mut frames);
        [0, 1, 2].map(|i| pass(&frame, &format!("shadow {i}")).skipped.as_deref().map(|why| why.len()))
    };
    let (kept, missed) =
        (Some("neither the light nor the mesh has changed".len()), Some("its cone misses the model".len()));
    assert_eq!(why(&stage), [None, None, missed]);
    assert_eq!(why(&stage), [kept, kept, missed]);
    stage.lights[1].position.x += 0.5;
    assert_eq!(why(&stage), [kept, None, missed]);
    stage.lights[0].color = [0.0, 0.0, 3.0];
    assert_eq!(why(&stage), [kept, kept, missed]);
    stage.version += 1;
    assert_eq!(why(&stage), [None, None, missed]);
    stage.look.shadows.size = 64;
    assert_eq!(why(&stage), [None, None, missed]);
}

#[test]
fn a_kept_shadow_map_is_the_one_that_would_be_drawn() {
    let mut stage = head();
    let mut frames = stage.frames();
    stage.render(&mut frames);
    stage.lights[1].position.x += 3.0;
    stage.lights.swap(0, 3);
    assert!(stage.render(&mut frames).image == stage.frame().image);
}

#[test]
fn any_number_of_threads_gives_the_same_bytes() {
    let stage = head();
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| stage.frame().image.digest())
    };
    assert_eq!([on(1), on(2)], [on(5), on(1)]);
}

#[test]
fn what_is_switched_off_changes_nothing_else() {
    let stage = head();
    let all = stage.layers();
    let without = |turn: fn(&mut Switches)| {
        let mut stage = stage.clone();
        turn(&mut stage.switches);
        stage.layers()
    };
    let matte = without(|s| s.specular = false);
    assert!(matte.diffuse == all.diffuse);
    assert!(matte.specular.iter().all(|s| *s == [0.0; 3]) && all.specular.iter().any(|s| s[0] > 0.1));
    let turns: [fn(&mut Switches); 3] =
        [|s| s.transmittance = false, |s| s.scattering = false, |s| s.discoloration = false];
    for layers in turns.map(without) {
        assert!(layers.specular == all.specular && layers.diffuse != all.diffuse);
    }
    assert!(without(|s| s.normal_map = false).diffuse == all.diffuse, "the map is flat");
    assert!(without(|s| s.occlusion_map = false).diffuse == all.diffuse, "the map is white");
    assert!(without(|s| s.color_map = false).diffuse != all.diffuse);
    assert!(without(|s| s.shadows = false).specular != all.specular);
    assert!(without(|s| s.specular_map = false).specular != all.specular);
}

#[test]
fn the_picture_is_the_sum_before_the_background() {
    let mut stage = Stage::new(kit::sheets(&[kit::square(DVec3::ZERO, 0.5)], crate::mesh::Surface::Skin));
    stage.look.ambient.intensity = 1.0;
    stage.look.ambient.irradiance = [[0.0; 3]; 9];
    stage.look.ambient.irradiance[0] = [1.0; 3];
    let frame = stage.frame();
    let bytes = |color: [f32; 3]| color.map(|c| (255.0 * c).round() as u8);
    let ([r, g, b], [br, bg, bb]) = (bytes(stage.look.skin.albedo), bytes(stage.look.background.0));
    assert_eq!([frame.image.at(32, 24), frame.image.at(0, 0)], [[r, g, b, 255], [br, bg, bb, 255]]);
}

#[test]
fn a_view_beside_the_model_draws_no_shadow_map() {
    let mut stage = head();
    stage.view.eye.x += 1e4;
    let frame = stage.frame();
    for id in ["shadow 0", "skin"] {
        assert_eq!(pass(&frame, id).skipped.as_deref(), Some("nothing is in view"));
    }
    assert!(frame.image.texels.iter().all(|texel| *texel == frame.image.texels[0]));
}

#[test]
fn what_no_memory_holds_is_refused() {
    let mut stage = head();
    let refused = |stage: &Stage| {
        let job = crate::canvas::frame::FrameJob {
            mesh: &stage.mesh,
            version: 0,
            view: stage.view,
            lights: &stage.lights,
            look: &stage.look,
            switches: stage.switches,
            unit_cm: 1.0,
            origin: DVec3::ZERO,
            everything: false,
        };
        let mut frames: Frames = stage.frames();
        matches!(frames.frame(&job, &stage.maps.color, &stage.discolor), Err(RenderError::TooLarge(_)))
    };
    assert!(!refused(&stage));
    for size in [[0, 10], [10, 0], [1 << 20, 1], [u32::MAX, u32::MAX], [16_000, 16_000]] {
        stage.view.size = size;
        assert!(refused(&stage), "{size:?}");
    }
    stage.view.size = [8, 8];
    stage.look.shadows.size = 8192;
    stage.lights = vec![stage.lights[0]; 9];
    assert!(refused(&stage));
}
