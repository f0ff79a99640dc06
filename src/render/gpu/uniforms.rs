//! What the skin pass is told about a frame: the scene, its lights, and how light goes through skin.

use glam::DVec3;

use super::lens::Lens;
use super::record::record;
use super::tiles::tiles;
use crate::canvas::frame::{FrameJob, Light};
use crate::canvas::look::Law;
use crate::render::kernel::PROFILE;
use crate::render::srgb;

record! {
    /// The scene, as `skin.wgsl` says.
    Scene {
        eye: [f32; 3],
        light_count: u32,
        ray: [f32; 3],
        across: u32,
        ray_across: [f32; 3],
        unused: f32,
        ray_down: [f32; 3],
        padding: f32,
        size: [u32; 2],
        spare: [u32; 2],
        forward: [f32; 4],
        albedo: [f32; 3],
        bumpiness: f32,
        intensity: f32,
        roughness: f32,
        specular: f32,
        reflectance: f32,
        irradiance: [[f32; 4]; 9],
        tissue: [[f32; 4]; 3],
    }
}

record! {
    /// A light, as `light.wgsl` says.
    Lamp {
        position: [f32; 3],
        distance: f32,
        right: [f32; 3],
        cos_outer: f32,
        up: [f32; 3],
        cos_inner: f32,
        axis: [f32; 3],
        tan_half: f32,
        color: [f32; 3],
        near: f32,
        far: f32,
        layer: u32,
        unused: [u32; 2],
    }
}

record! {
    /// How light goes through skin, and how shadows are looked up.
    Transport {
        profile: [[f32; 4]; 6],
        millimetre: f32,
        thickness: f32,
        filter_size: u32,
        unused: u32,
    }
}

/// The scene of a frame with so many lights.
pub(crate) fn scene(job: &FrameJob<'_>, lights: usize) -> Scene {
    let [ray, ray_across, ray_down] = Lens::rays(&job.view);
    let (skin, ambient) = (&job.look.skin, &job.look.ambient);
    let wide = |[x, y, z]: [f32; 3]| [x, y, z, 0.0];
    Scene {
        ray,
        across: tiles(job.view.size)[0],
        ray_across,
        ray_down,
        size: job.view.size,
        eye: near(job.view.eye, job.origin),
        light_count: lights as u32,
        forward: Lens::of_view(&job.view, job.origin).depth(),
        albedo: srgb::decode_color(skin.albedo),
        bumpiness: skin.bumpiness,
        intensity: skin.intensity,
        roughness: skin.roughness,
        specular: skin.specular,
        reflectance: skin.reflectance,
        irradiance: ambient.irradiance.map(|color| wide(color.map(|c| c * ambient.intensity))),
        tissue: job.look.wound.tissue.map(wide),
        ..Scene::default()
    }
}

/// A light whose shadow map lies in a layer.
pub(crate) fn lamp(light: &Light, origin: DVec3, layer: u32) -> Lamp {
    let [right, up, axis] = light.basis.map(|axis| axis.as_vec3().to_array());
    Lamp {
        position: near(light.position, origin),
        distance: light.distance as f32,
        right,
        cos_outer: light.cos_outer as f32,
        up,
        cos_inner: light.cos_inner as f32,
        axis,
        tan_half: light.tan_half as f32,
        color: light.color,
        near: light.near as f32,
        far: light.far as f32,
        layer,
        unused: [0; 2],
    }
}

/// How light goes through skin in a frame.
pub(crate) fn transport(job: &FrameJob<'_>) -> Transport {
    let per = match job.look.scattering.law {
        Law::Published => 1.0,
        Law::Derived => 2.0,
    };
    let profile = PROFILE.map(|gaussian| {
        let [r, g, b] = gaussian.weights.map(|w| w as f32);
        [r, g, b, (-1.0 / (per * gaussian.variance)) as f32]
    });
    let millimetre = 0.1 / job.unit_cm;
    Transport {
        profile,
        millimetre: millimetre as f32,
        thickness: ((1.0 - f64::from(job.look.scattering.translucency)) / millimetre) as f32,
        filter_size: job.look.shadows.filter.clamp(1, 9),
        unused: 0,
    }
}

fn near(point: DVec3, origin: DVec3) -> [f32; 3] {
    (point - origin).as_vec3().to_array()
}
