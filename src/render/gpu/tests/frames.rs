//! Frames against the CPU reference, and with every switch.

use super::kit::{Gap, OnDevice, Scene, device, gap};
use crate::canvas::look::{Law, Switches};

/// Sets the switch of this number.
fn switch(switches: &mut Switches, number: usize, on: bool) {
    let all = [
        &mut switches.shadows,
        &mut switches.transmittance,
        &mut switches.specular,
        &mut switches.scattering,
        &mut switches.discoloration,
        &mut switches.color_map,
        &mut switches.normal_map,
        &mut switches.occlusion_map,
        &mut switches.specular_map,
    ];
    if let Some(switch) = all.into_iter().nth(number) {
        *switch = on;
    }
}

/// All on, each alone off, all off, each alone on.
fn combinations() -> Vec<Switches> {
    let all = |on: bool| {
        let mut switches = Switches::default();
        (0..9).for_each(|i| switch(&mut switches, i, on));
        switches
    };
    let but = |on: bool| {
        (0..9).map(move |i| {
            let mut switches = all(on);
            switch(&mut switches, i, !on);
            switches
        })
    };
    [all(true), all(false)].into_iter().chain(but(true)).chain(but(false)).collect()
}

/// A hundredth of a byte on average, and a pixel of a thousand. On lavapipe it is a fifth of that, and no channel is off by more than one.
fn is_close(gap: &Gap) -> bool {
    gap.mean < 0.01 && gap.outliers < 0.001
}

fn assert_close(what: &str, gap: &Gap) {
    eprintln!("{what}: {gap:?}");
    assert!(gap.mean < 0.5, "{what}: {gap:?}");
    assert!(is_close(gap), "{what}: {gap:?}");
}

#[test]
fn a_frame_is_the_reference_s() {
    let Some(device) = device() else { return };
    let mut scene = Scene::bust([320, 180]);
    let mut ours = OnDevice::new(&device, &scene);
    for azimuth in [0.5, 2.6] {
        scene.turn(azimuth);
        let (frame, reference) = (ours.frame(&scene), scene.reference());
        assert_close(&format!("azimuth {azimuth}"), &gap(&frame.image, &reference.image));
        let differing = frame.image.texels.iter().filter(|texel| **texel != frame.image.texels[0]).count();
        assert!(differing > 4000, "there is something to see: {differing}");
    }
}

#[test]
fn with_any_switch_a_frame_is_the_reference_s() {
    let Some(device) = device() else { return };
    let mut scene = Scene::bust([96, 64]);
    let mut ours = OnDevice::new(&device, &scene);
    for switches in combinations() {
        scene.switches = switches;
        let gap = gap(&ours.frame(&scene).image, &scene.reference().image);
        assert!(is_close(&gap), "{switches:?}: {gap:?}");
    }
}

/// What a look says arrives at the pixels.
#[test]
fn with_another_look_a_frame_is_the_reference_s() {
    let Some(device) = device() else { return };
    let mut scene = Scene::bust([96, 64]);
    let mut ours = OnDevice::new(&device, &scene);
    let plain = scene.reference().image;
    let look = &mut scene.look;
    look.ambient.irradiance[4..].fill([0.05, 0.03, 0.02]);
    (look.shadows.size, look.shadows.filter) = (300, 6);
    (look.skin.bumpiness, look.skin.reflectance, look.skin.specular) = (1.7, 0.1, 1.4);
    let scattering = &mut look.scattering;
    (scattering.samples, scattering.width_cm, scattering.law) = (25, 1.1, Law::Derived);
    (scattering.strength, scattering.translucency) = ([0.9, 0.6, 0.3], 0.95);
    look.background.0 = [0.4, 0.1, 0.7];
    let gaps = [&ours.frame(&scene).image, &plain].map(|image| gap(image, &scene.reference().image));
    assert_close("another look", &gaps[0]);
    assert!(gaps[1].mean > 10.0, "it is another: {gaps:?}");
}

/// The near plane cuts the head open: faces are seen from behind, and in part.
#[test]
fn from_inside_a_frame_is_the_reference_s() {
    let Some(device) = device() else { return };
    let mut scene = Scene::bust([96, 64]);
    scene.view.near = 0.5 * (scene.view.near + scene.view.far);
    let gap = gap(&OnDevice::new(&device, &scene).frame(&scene).image, &scene.reference().image);
    assert_close("from inside", &gap);
}

#[test]
fn the_inside_of_a_cut_is_the_reference_s() {
    let Some(device) = device() else { return };
    let mut scene = Scene::bust([96, 64]);
    let plain = scene.reference().image;
    scene.open_a_chart();
    let reference = scene.reference().image;
    assert!(gap(&plain, &reference).outliers > 0.02, "it is in view");
    assert_close("tissue", &gap(&OnDevice::new(&device, &scene).frame(&scene).image, &reference));
}
