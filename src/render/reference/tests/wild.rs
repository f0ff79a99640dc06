//! Views, lights and triangles as no scene has them: no panic, and no light that is not a number.

use glam::DVec3;
use proptest::prelude::*;

use super::kit::{self, Stage};
use crate::canvas::frame::{Light, View};
use crate::canvas::look::Switches;
use crate::mesh::{IndexedMesh, Mesh};

fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![
        -3.0..3.0_f64,
        (-1000_i32..1000).prop_map(f64::from),
        -1e9..1e9,
        -1e30..1e30,
        Just(0.0),
        -1e-9..1e-9
    ]
}

fn point() -> impl Strategy<Value = DVec3> {
    (coordinate(), coordinate(), coordinate()).prop_map(DVec3::from)
}

/// Right, up and forward of a direction.
fn basis(forward: DVec3) -> [DVec3; 3] {
    let forward = forward.normalize_or(DVec3::NEG_Z);
    let right = forward.any_orthonormal_vector();
    [right, right.cross(forward), forward]
}

prop_compose! {
    fn view()(
        eye in point(), forward in point(), fov_y in prop_oneof![Just(0.6), 1e-6..3.1_f64],
        size in (1..70_u32, 1..50_u32),
        near in prop_oneof![Just(0.01), 1e-12..1e3_f64, Just(0.0)], depth in prop_oneof![Just(100.0), 1e-3..1e12_f64],
    ) -> View {
        View { eye, basis: basis(forward), fov_y, size: size.into(), near, far: near + depth }
    }
}

prop_compose! {
    fn light()(
        position in point(), target in point(), distance in 0.0..1e9_f64, outer in 0.0..1.5_f64, softness in 0.0..=1.0_f64,
        near in 1e-6..10.0_f64, depth in 1e-3..1e9_f64,
    ) -> Light {
        Light {
            position,
            basis: basis(target - position),
            distance,
            color: [1.0, 0.5, 0.0],
            cos_outer: libm::cos(outer),
            cos_inner: libm::cos(outer * (1.0 - softness)),
            tan_half: libm::tan(outer),
            near,
            far: near + depth,
            reaches: true,
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]
    #[test]
    fn nothing_wild_panics_or_gives_no_number(
        corners in prop::collection::vec([point(), point(), point()], 1..12),
        view in view(), lights in prop::collection::vec(light(), 0..3),
        seen in any::<bool>(), everything in any::<bool>(), width_cm in prop_oneof![Just(0.6_f32), 0.0..1e6_f32],
    ) {
        let positions: Vec<DVec3> = corners.concat();
        let faces = (0..corners.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        let mesh = Mesh::build(&IndexedMesh { positions, faces, ..IndexedMesh::default() }).expect("loose triangles");
        let mut stage = Stage::new(mesh);
        stage.view = view;
        if seen {
            stage.view.eye = DVec3::new(0.1, 0.2, 3.0);
        }
        stage.lights = lights;
        stage.switches = Switches::default();
        stage.look.scattering.width_cm = width_cm;
        stage.look.shadows.size = 16;
        stage.look.ambient.intensity = 1.0;
        stage.everything = everything;
        let layers = stage.layers();
        prop_assert!(layers.diffuse.as_flattened().iter().all(|x| x.is_finite()));
        prop_assert!(layers.specular.as_flattened().iter().all(|x| x.is_finite()));
        prop_assert!(layers.depth.iter().all(|x| *x > 0.0));
    }
}

#[test]
fn a_picture_of_one_pixel_shows_what_is_there() {
    let mut stage = Stage::new(kit::wall());
    stage.switches = Switches::default();
    stage.look.ambient.intensity = 1.0;
    stage.lights = vec![kit::light(DVec3::new(1.0, 0.0, 3.0), DVec3::ZERO)];
    let wide = stage.frame().image.at(32, 24);
    stage.view.size = [1, 1];
    let one = stage.frame().image.at(0, 0);
    assert!((0..3).all(|c| one[c].abs_diff(wide[c]) < 12), "{one:?} {wide:?}");
}
