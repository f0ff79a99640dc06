//! Shadow maps.

use glam::DVec3;

use super::kit::{self, Stage};
use crate::mesh::{IndexedMesh, Mesh, Surface};
use crate::render::reference::shadow::{Key, ShadowMap};

#[test]
fn a_triangle_casts_its_shadow_on_a_wall() {
    let corners = [DVec3::new(-0.6, -0.5, 2.0), DVec3::new(0.7, -0.3, 2.5), DVec3::new(0.0, 0.8, 1.5)];
    let wall = [DVec3::new(-4.0, -4.0, 0.0), DVec3::new(4.0, -4.0, 0.0), DVec3::new(0.0, 6.0, 0.0)];
    let positions = wall.into_iter().chain(corners).collect();
    let mesh =
        Mesh::build(&IndexedMesh { positions, faces: vec![[0, 1, 2], [3, 4, 5]], ..IndexedMesh::default() });
    let mut stage = Stage::new(mesh.expect("two triangles"));
    stage.lights = vec![kit::light(DVec3::new(2.0, 1.0, 6.0), DVec3::new(0.0, 0.0, 2.0))];
    stage.look.shadows.size = 512;
    let bare = stage.layers();
    stage.switches.shadows = true;
    let shaded = stage.layers();
    let (mut dark, mut bright) = (0, 0);
    for at in (0..64 * 48).filter(|at| (bare.depth[*at] - 5.0).abs() < 1e-4 && bare.diffuse[*at][0] > 1e-3) {
        let point = stage.view.eye + stage.ray(at % 64, at / 64) * 5.0;
        // How far inside the triangle the ray to the light passes, by its barycentric coordinates; the filter reaches 0.03.
        let (to, [a, b, c]) = (stage.lights[0].position - point, corners);
        let volume = |a: DVec3, b: DVec3, c: DVec3| {
            to.dot((a - point).cross(b - point)) / (c - point).dot((a - point).cross(b - point))
        };
        let parts = [volume(a, b, c), volume(b, c, a), volume(c, a, b)];
        let inside = parts.iter().copied().fold(f64::INFINITY, f64::min) / parts.iter().sum::<f64>();
        let part = shaded.diffuse[at][0] / bare.diffuse[at][0];
        if inside > 0.05 {
            assert_eq!(part, 0.0, "in the shadow, at {point}");
            dark += 1;
        } else if inside < -0.05 {
            assert!((part - 1.0).abs() < 1e-5, "out of it, at {point}: {part}");
            bright += 1;
        }
    }
    assert!(dark > 20 && bright > 500, "{dark} {bright}");
}

#[test]
fn nothing_shades_itself() {
    let mut stage = Stage::new(kit::wall());
    stage.lights = vec![kit::light(DVec3::new(3.0, 1.5, 8.0), DVec3::ZERO)];
    stage.look.shadows.size = 64;
    let bare = stage.layers().diffuse;
    stage.switches.shadows = true;
    for (at, (bare, shaded)) in bare.iter().zip(stage.layers().diffuse).enumerate() {
        assert!((shaded[0] - bare[0]).abs() <= 1e-6 * bare[0], "pixel {at}: {} of {}", shaded[0], bare[0]);
    }
}

#[test]
fn filtering_lets_the_part_through_that_lies_off_the_edge() {
    // The left half of what the light sees is covered, up to the border of two texels.
    let blind = [DVec3::new(-5.0, -5.0, 2.0), DVec3::X * 5.0, DVec3::Y * 10.0];
    let mesh = kit::sheets(&[blind, kit::square(DVec3::ZERO, 9.0)], Surface::Skin);
    let light = kit::light(DVec3::Z * 6.0, DVec3::ZERO);
    let map = ShadowMap::new(&mesh, Key::new(&light, 0, 128));
    let texel = 2.0 * 6.0 * light.tan_half / 128.0;
    // Right of the light's view is left or right of ours.
    let side = light.basis[0].x.signum();
    for filter in [1, 2, 3, 5, 9] {
        for step in -30..=30 {
            let off = 0.2 * f64::from(step) * side;
            // The place is taken 1.5 texels nearer to the light, where the same point lies further out.
            let point = DVec3::new(off * texel * (6.0 - 1.5 * texel) / 6.0, 0.1, 0.0);
            let expected = (0.5 + off / f64::from(filter)).clamp(0.0, 1.0);
            let found = f64::from(map.around(DVec3::ZERO).lit(point, DVec3::Z, filter));
            assert!((found - expected).abs() < 1e-4, "filter {filter}, {off} texels: {found} {expected}");
        }
    }
}

#[test]
fn outside_of_the_map_all_is_lit_and_nothing_comes_through() {
    let mesh = kit::sheets(&[kit::square(DVec3::Z, 9.0), kit::square(DVec3::ZERO, 9.0)], Surface::Skin);
    let light = kit::light(DVec3::Z * 6.0, DVec3::ZERO);
    let map = ShadowMap::new(&mesh, Key::new(&light, 0, 64));
    let beside = DVec3::new(4.0, 0.0, 0.0);
    assert_eq!(
        [
            map.around(DVec3::ZERO).lit(DVec3::ZERO, DVec3::Z, 3),
            map.around(DVec3::ZERO).lit(beside, DVec3::Z, 3)
        ],
        [0.0, 1.0]
    );
    assert_eq!(map.around(DVec3::ZERO).lit(DVec3::Z * 9.0, DVec3::Z, 3), 1.0, "behind the light");
    assert!((map.around(DVec3::ZERO).thickness(DVec3::ZERO).expect("within") - 1.0).abs() < 1e-5);
    assert_eq!(
        [map.around(DVec3::ZERO).thickness(beside), map.around(DVec3::ZERO).thickness(DVec3::Z * 9.0)],
        [None; 2]
    );
}
