//! Light at a point, against the formulas in f64.

use glam::DVec3;

use super::kit::{self, Stage, close, linear};
use crate::canvas::frame::Light;
use crate::canvas::image::Image;
use crate::canvas::look::Law;
use crate::mesh::Surface;

const PIXELS: [(usize, usize); 6] = [(32, 24), (5, 7), (60, 3), (20, 40), (63, 47), (0, 0)];

/// The wall with one light from the upper right, and the point of it that a pixel shows.
fn lit() -> Stage {
    let mut stage = Stage::new(kit::wall());
    stage.lights = vec![kit::light(DVec3::new(2.0, 1.5, 4.0), DVec3::new(0.3, 0.0, 0.0))];
    stage
}

fn shown(stage: &Stage, (x, y): (usize, usize)) -> DVec3 {
    stage.view.eye + stage.ray(x, y) * stage.view.eye.z
}

/// l and I.
fn arriving(light: &Light, point: DVec3) -> (DVec3, DVec3) {
    let to = light.position - point;
    let l = to / to.length();
    let t =
        ((-l.dot(light.basis[2]) - light.cos_outer) / (light.cos_inner - light.cos_outer)).clamp(0.0, 1.0);
    let fade = t * t * (3.0 - 2.0 * t) * light.distance * light.distance / to.length_squared();
    (l, DVec3::from(light.color.map(f64::from)) * fade)
}

#[test]
fn a_wall_reflects_what_the_formula_says() {
    let stage = lit();
    let layers = stage.layers();
    let mut fades = 0;
    for pixel in PIXELS {
        let (l, light) = arriving(&stage.lights[0], shown(&stage, pixel));
        fades += usize::from(light.x < 0.5);
        for c in 0..3 {
            let albedo = linear(stage.look.skin.albedo[c].into());
            close(layers.diffuse[pixel.1 * 64 + pixel.0][c], albedo * light[c] * l.z, 1e-5);
        }
    }
    assert!(fades > 0, "the cone's border is looked at too");
}

#[test]
fn specular_reflection_is_the_closed_form() {
    let mut stage = lit();
    stage.switches.specular = true;
    stage.look.skin.specular = 0.8;
    // The second lights the wall at a grazing angle, where Fresnel's term rises.
    let lights = [stage.lights[0], kit::light(DVec3::new(6.0, 2.0, 0.9), DVec3::ZERO)];
    for (roughness, light) in [0.02, 0.15, 0.35, 0.9].into_iter().flat_map(|m| lights.map(|light| (m, light)))
    {
        stage.look.skin.roughness = roughness;
        stage.lights = vec![light];
        let (layers, m) = (stage.layers(), f64::from(roughness).max(0.05_f32.into()));
        for pixel in PIXELS {
            let point = shown(&stage, pixel);
            let (l, light) = arriving(&stage.lights[0], point);
            let view = (stage.view.eye - point).normalize();
            let between = l + view;
            let half = between.normalize();
            let (c2, square) = (half.z * half.z, between.length_squared());
            let away = 1.0 - view.dot(half);
            let fresnel = 0.028 + 0.972 * away * away * away * away * away;
            let part = 0.8 * 0.6 * fresnel / square * l.z;
            let lobe = libm::exp(-(1.0 - c2) / (c2 * m * m)) / (m * m * c2 * c2);
            let off = crate::render::beckmann::ERROR / (m * m) * part;
            for c in 0..3 {
                let found = f64::from(layers.specular[pixel.1 * 64 + pixel.0][c]);
                let expected = lobe * part * light[c];
                assert!(
                    (found - expected).abs() < off * light[c] + 1e-4 * expected + 1e-12,
                    "{found} {expected}"
                );
            }
        }
    }
}

#[test]
fn ambient_light_depends_on_the_bumped_normal_and_the_occlusion() {
    let mut stage = Stage::new(kit::wall());
    stage.look.ambient.intensity = 0.7;
    stage.look.ambient.irradiance =
        std::array::from_fn(|i| [0.1 * i as f32 + 0.2, 0.3, 0.9 - 0.1 * i as f32]);
    stage.look.skin.bumpiness = 1.5;
    (stage.switches.normal_map, stage.switches.occlusion_map) = (true, true);
    stage.maps.normal = Image::filled([1, 1], [200, 90, 0, 0]);
    stage.maps.occlusion = Image::filled([2, 2], [102, 0, 0, 0]);
    let (x, y) = (400.0 / 255.0 - 1.0, 180.0 / 255.0 - 1.0);
    let flat: f64 = 1.0 - x * x - y * y;
    let n = DVec3::new(1.5 * x, 1.5 * y, flat.sqrt()).normalize();
    let basis =
        [1.0, n.y, n.z, n.x, n.x * n.y, n.y * n.z, 3.0 * n.z * n.z - 1.0, n.x * n.z, n.x * n.x - n.y * n.y];
    let diffuse = stage.layers().diffuse[24 * 64 + 32];
    for c in 0..3 {
        let harmonics = stage.look.ambient.irradiance.iter().map(|color| f64::from(color[c]));
        let sum: f64 = harmonics.zip(basis).map(|(color, b)| color * b).sum();
        close(diffuse[c], linear(stage.look.skin.albedo[c].into()) * 0.7 * 0.4 * sum, 1e-5);
    }
}

#[test]
fn a_face_is_lit_on_the_side_from_which_it_is_seen() {
    let mut stage = lit();
    let front = stage.layers().diffuse;
    stage.mesh = kit::sheets(&[[DVec3::new(-4.0, -4.0, 0.0), DVec3::Y * 8.0, DVec3::X * 8.0]], Surface::Skin);
    assert!(stage.mesh.vertices()[0].normal.z < -0.99);
    assert!(stage.layers().diffuse == front);
}

#[test]
fn the_inside_of_a_cut_goes_from_rim_to_bottom_and_scatters_nothing() {
    let mut stage = Stage::new(kit::sheets(&[kit::square(DVec3::ZERO, 1.0)], Surface::Gutter));
    stage.switches = crate::canvas::look::Switches::default();
    stage.look.ambient.intensity = 1.0;
    stage.look.ambient.irradiance = [[0.0; 3]; 9];
    stage.look.ambient.irradiance[0] = [1.0; 3];
    let (frame, layers) = (stage.frame(), stage.layers());
    for y in [14, 24, 33] {
        let v = 0.5 * (1.0 + shown(&stage, (32, y)).y);
        let [rim, middle, bottom] = stage.look.wound.tissue.map(|c| DVec3::from(c.map(f64::from)));
        let color = if v > 0.5 { middle.lerp(rim, 2.0 * v - 1.0) } else { bottom.lerp(middle, 2.0 * v) };
        for c in 0..3 {
            close(layers.diffuse[y * 64 + 32][c], linear(color[c]) * (0.25 + 0.75 * v), 1e-5);
        }
        assert_eq!(layers.diffuse[y * 64 + 32][3], 0.0);
    }
    let scatter = frame.passes.iter().find(|pass| pass.id == "scatter").expect("it is reported");
    assert_eq!(scatter.skipped.as_deref(), Some("no skin is in view"));
}

/// A slab, lit from behind: what comes through follows T of its thickness.
#[test]
fn light_comes_through_as_the_gaussians_say() {
    let profile = [
        (0.0064, [0.233, 0.455, 0.649]),
        (0.0484, [0.100, 0.336, 0.344]),
        (0.1870, [0.118, 0.198, 0.000]),
        (0.5670, [0.113, 0.007, 0.007]),
        (1.9900, [0.358, 0.004, 0.000]),
        (7.4100, [0.078, 0.000, 0.000]),
    ];
    let thickness_cm = 0.45;
    let back = kit::square(DVec3::Z * -thickness_cm, 4.0);
    let mut stage =
        Stage::new(kit::sheets(&[kit::square(DVec3::ZERO, 4.0), [back[0], back[2], back[1]]], Surface::Skin));
    stage.lights = vec![kit::light(DVec3::new(0.0, 0.0, -5.0), DVec3::ZERO)];
    stage.switches.transmittance = true;
    stage.look.scattering.translucency = 0.5;
    for (law, per) in [(Law::Published, 1.0), (Law::Derived, 2.0)] {
        stage.look.scattering.law = law;
        let diffuse = stage.layers().diffuse[24 * 64 + 32];
        let (l, light) = arriving(&stage.lights[0], shown(&stage, (32, 24)));
        // One millimetre of it lies before Q.
        let s = 0.5 * (10.0 * thickness_cm - 1.0);
        for c in 0..3 {
            let through: f64 = profile.iter().map(|(v, w)| w[c] * libm::exp(-s * s / (per * v))).sum();
            let wrapped = (0.3 - l.z).clamp(0.0, 1.0);
            close(diffuse[c], linear(stage.look.skin.albedo[c].into()) * light[c] * through * wrapped, 2e-3);
        }
    }
}
