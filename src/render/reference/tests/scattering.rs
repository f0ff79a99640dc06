//! Scattering and discoloration.

use glam::DVec3;

use super::kit::{self, Stage};
use crate::canvas::image::Image;
use crate::mesh::Surface;
use crate::render::kernel;

/// A wall in even light.
fn even() -> Stage {
    let mut stage = Stage::new(kit::wall());
    stage.look.ambient.intensity = 1.0;
    stage.look.ambient.irradiance = [[0.0; 3]; 9];
    stage.look.ambient.irradiance[0] = [0.8, 0.7, 0.6];
    stage
}

#[test]
fn even_light_stays_as_it_is() {
    let mut stage = even();
    let before = stage.layers().diffuse;
    stage.switches.scattering = true;
    for (before, after) in before.iter().zip(stage.layers().diffuse) {
        (0..3).for_each(|c| kit::close(after[c], before[c].into(), 2e-6));
    }
}

#[test]
fn discoloration_dims_the_centre_once() {
    let mut stage = even();
    let before = stage.layers().diffuse[24 * 64 + 32];
    (stage.switches.scattering, stage.switches.discoloration) = (true, true);
    stage.discolor = Image::filled([4, 4], [102, 51, 153, 204]);
    let after = stage.layers().diffuse[24 * 64 + 32];
    let taps = kernel::kernel(&stage.look.scattering);
    for c in 0..3 {
        let centre = f64::from(taps[taps.len() / 2].weight[c]);
        let kept = 1.0 + 0.8 * (2.0 * [0.4, 0.2, 0.6][c] - 1.0);
        kit::close(after[c], f64::from(before[c]) * (1.0 - centre + centre * kept), 1e-5);
    }
}

#[test]
fn light_spreads_by_the_kernel_across_and_down() {
    // A colour map of one bright texel row between dark ones, a wall wide enough for the kernel to be many pixels wide.
    let mut stage = even();
    stage.switches.color_map = true;
    let dark = [40, 40, 40, 255];
    let mut map = Image::filled([512, 512], dark);
    map.texels[512 * 256..512 * 264].fill([250, 250, 250, 255]);
    stage.maps.color = map.clone();
    stage.look.scattering.width_cm = 1.0;
    let flat = stage.layers().diffuse;
    stage.switches.scattering = true;
    let across_nothing = stage.layers().diffuse;
    // Rows are even, so the pass across changes nothing, and the one down takes bilinear samples of the column.
    let (pixels, taps) = (48.0 / (2.0 * 5.0 * libm::tan(0.3)), kernel::kernel(&stage.look.scattering));
    for y in [20, 24, 30] {
        let column = |at: f64| {
            let (i, f) = (at.floor() as usize, at - at.floor());
            f64::from(flat[i * 64 + 32][0]) * (1.0 - f) + f64::from(flat[(i + 1) * 64 + 32][0]) * f
        };
        let expected: f64 = taps
            .iter()
            .map(|tap| f64::from(tap.weight[0]) * column(y as f64 + f64::from(tap.offset) * pixels))
            .sum();
        kit::close(across_nothing[y * 64 + 32][0], expected, 1e-4);
    }
    // Turned by a right angle, the picture's columns become rows.
    stage.maps.color.texels = (0..512 * 512).map(|i| map.texels[(i % 512) * 512 + i / 512]).collect();
    let turned = stage.layers().diffuse;
    for i in 14..34 {
        kit::close(turned[24 * 64 + 8 + i][0], across_nothing[i * 64 + 32][0].into(), 1e-4);
    }
}

#[test]
fn light_does_not_jump_between_near_and_far() {
    let sheets = [kit::square(DVec3::new(-4.0, 0.0, 0.0), 4.0), kit::square(DVec3::new(4.0, 0.0, -3.0), 8.0)];
    let mut stage = even();
    stage.mesh = kit::sheets(&sheets, Surface::Skin);
    stage.switches.color_map = true;
    // Left of the picture's middle all is dark, right of it, three centimetres further away, bright.
    stage.lights = vec![kit::light(DVec3::new(3.0, 0.0, 0.0), DVec3::new(3.0, 0.0, -3.0))];
    let before = stage.layers().diffuse;
    stage.switches.scattering = true;
    let after = stage.layers().diffuse;
    for (x, sample) in (28..31).map(|x| (x, 24 * 64 + x)) {
        let lifted = after[sample][0] / before[sample][0];
        assert!((lifted - 1.0).abs() < 1e-4, "pixel {x} took {lifted} of light from behind");
    }
}
