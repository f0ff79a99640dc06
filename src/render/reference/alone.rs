//! Passes on their own: what a frame does in one of its passes, without the frame. For measuring them against something better.

use glam::DVec3;

use super::layers::{Layers, Tile};
use super::lens::Lens;
use super::scatter::Scatter;
use super::shadow::{Key, ShadowMap};
use crate::canvas::frame::{Light, View};
use crate::canvas::look::Scattering;
use crate::mesh::Mesh;

/// Light on a wall of skin that faces the eye, to be scattered.
pub struct Wall {
    scatter: Scatter,
    layers: Layers,
    light: Vec<[f32; 4]>,
}

impl Wall {
    /// A wall that fills a picture, with the diffuse light at each of its pixels, row by row.
    pub fn new(size: [u32; 2], light: &[[f32; 3]], pixels_per_cm: f64, scattering: &Scattering) -> Self {
        let basis = [DVec3::X, DVec3::Y, DVec3::NEG_Z];
        let view = View { eye: DVec3::ZERO, basis, fov_y: 1.0, size, near: 1e-3, far: 1e9 };
        let lens = Lens::of_view(&view);
        let mut layers = Layers::default();
        layers.resize(size);
        layers.depth.fill((lens.focal / pixels_per_cm) as f32);
        layers.tiles.fill(Tile { surface: true, scatters: true, discolored: false });
        let light = light.iter().map(|[r, g, b]| [*r, *g, *b, 1.0]).collect();
        Self { scatter: Scatter::new(scattering, 1.0, &lens, false), layers, light }
    }

    /// Puts the light back as it was before it scattered.
    pub fn reset(&mut self) {
        self.layers.diffuse.copy_from_slice(&self.light);
    }

    /// Both passes over the light as it is.
    pub fn scatter(&mut self) {
        self.scatter.run(&mut self.layers);
    }

    /// The light as it is now.
    pub fn light(&self) -> impl Iterator<Item = [f32; 3]> + '_ {
        self.layers.diffuse.iter().map(|[r, g, b, _]| [*r, *g, *b])
    }
}

/// A light's shadow map.
pub struct Shadows(ShadowMap);

impl Shadows {
    /// Draws it, with so many texels along a side.
    pub fn draw(mesh: &Mesh, light: &Light, size: u32) -> Self {
        Self(ShadowMap::new(mesh, Key::new(light, 0, size)))
    }

    /// How much of the light arrives at a point of a surface, from 0 to 1.
    pub fn lit(&self, point: DVec3, normal: DVec3, filter: u32) -> f32 {
        self.0.around(DVec3::ZERO).lit(point, normal, filter)
    }
}
