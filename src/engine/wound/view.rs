//! What a frame of the state shows: the camera's view, the lights in place, and the scene's look as the settings have changed it.

use std::collections::BTreeMap;

use glam::DVec3;

use super::camera::Camera;
use super::event::Value;
use super::settings;
use super::state::State;
use crate::canvas::frame::{FrameJob, Light, View, place_lights};
use crate::canvas::look::Look;
use crate::mesh::Mesh;

/// The sphere around a mesh as it was loaded: round the middle of its box, through the box's corners.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Its centre.
    pub centre: DVec3,
    /// Its radius.
    pub radius: f64,
}

impl Bounds {
    /// The bounds of a mesh.
    pub fn of(mesh: &Mesh) -> Self {
        let [lo, hi] = mesh.bounds();
        Self { centre: (lo + hi) * 0.5, radius: (hi - lo).length() * 0.5 }
    }
}

/// What one sees by.
#[derive(Clone, Debug, PartialEq)]
pub struct Seen {
    /// The look, with its settings.
    pub look: Look,
    /// The lights, as strong as they are set.
    pub lights: Vec<Light>,
}

impl Seen {
    pub(super) fn new(look: &Look, bounds: Bounds, values: &BTreeMap<String, Value>) -> Self {
        let mut lights = place_lights(look, bounds.centre, bounds.radius);
        let strength = settings::number(values, "light-intensity").unwrap_or(1.0) as f32;
        lights.iter_mut().for_each(|light| light.color = light.color.map(|c| c * strength));
        Self { look: settings::applied(look, values), lights }
    }
}

/// The camera's view, with the depths between which the bounds lie.
///
/// From inside of the bounds, or with all of them behind the eye, near is a thousandth of their radius and far lies beyond it.
fn view(camera: &Camera, bounds: Bounds) -> View {
    let (eye, basis) = (camera.eye(), camera.basis());
    let (depth, radius) = ((bounds.centre - eye).dot(basis[2]), 1.05 * bounds.radius);
    let near = (depth - radius).max(1e-3 * bounds.radius);
    let far = (depth + radius).max(near + radius);
    View { eye, basis, fov_y: camera.fov_y, size: camera.viewport, near, far }
}

pub(super) fn frame(state: &State, version: u64, everything: bool) -> FrameJob<'_> {
    let control = &state.control;
    FrameJob {
        mesh: &state.mesh,
        version,
        view: view(&control.camera, state.bounds),
        lights: &control.seen.lights,
        look: &control.seen.look,
        switches: control.seen.look.switches,
        unit_cm: state.unit_cm,
        origin: state.bounds.centre,
        everything,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn depths(distance: f64) -> [f64; 2] {
        let target = DVec3::new(1.0, 2.0, 3.0);
        let (zenith, viewport) = (1.2, [640, 360]);
        let camera = Camera { target, azimuth: 0.4, zenith, distance, fov_y: 0.6, viewport };
        let view = view(&camera, Bounds { centre: target, radius: 2.0 });
        [view.near, view.far]
    }

    #[test]
    fn near_and_far_hold_the_bounds_and_are_in_order_from_everywhere() {
        let [near, far] = depths(10.0);
        assert!((near - 7.9).abs() < 1e-12 && (far - 12.1).abs() < 1e-12, "{near} {far}");
        for distance in [2.0, 0.1, -1.0, -50.0] {
            let [near, far] = depths(distance);
            assert!(near >= 2e-3 && far > near, "{distance}: {near} {far}");
        }
    }
}
