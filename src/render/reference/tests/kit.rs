//! Small scenes, and a stage to render them on.

use std::sync::Arc;

use glam::{DVec3, Vec2};

use crate::canvas::frame::{Frame, FrameJob, Light, View};
use crate::canvas::image::{Image, Maps};
use crate::canvas::look::{Look, Switches};
use crate::mesh::{IndexedMesh, Mesh, Surface};
use crate::render::reference::Frames;
use crate::render::reference::layers::Layers;

/// Everything a frame needs.
#[derive(Clone)]
pub(super) struct Stage {
    pub(super) mesh: Mesh,
    pub(super) version: u64,
    pub(super) view: View,
    pub(super) lights: Vec<Light>,
    pub(super) look: Look,
    pub(super) switches: Switches,
    pub(super) maps: Maps,
    pub(super) discolor: Image,
    pub(super) everything: bool,
}

impl Stage {
    /// A mesh seen from +z, five units away, in 64 x 48 pixels; no light, no map, all off but scattering's own switch.
    pub(super) fn new(mesh: Mesh) -> Self {
        let mut look = Look::default();
        look.ambient.intensity = 0.0;
        Self {
            mesh,
            version: 0,
            view: view([64, 48], 5.0),
            lights: Vec::new(),
            look,
            switches: off(),
            maps: maps(),
            discolor: Image::filled([1, 1], [0; 4]),
            everything: false,
        }
    }

    pub(super) fn frames(&self) -> Frames {
        Frames::new(Arc::new(self.maps.clone()))
    }

    pub(super) fn render(&self, frames: &mut Frames) -> Frame {
        let job = FrameJob {
            mesh: &self.mesh,
            version: self.version,
            view: self.view,
            lights: &self.lights,
            look: &self.look,
            switches: self.switches,
            unit_cm: 1.0,
            origin: DVec3::ZERO,
            everything: self.everything,
        };
        frames.frame(&job, &self.maps.color, &self.discolor).expect("it is not too large")
    }

    pub(super) fn frame(&self) -> Frame {
        self.render(&mut self.frames())
    }

    /// The layers after a frame.
    pub(super) fn layers(&self) -> Layers {
        let mut frames = self.frames();
        self.render(&mut frames);
        frames.layers
    }

    /// The direction through a pixel's centre, at depth 1; worked out from the view's definition.
    pub(super) fn ray(&self, x: usize, y: usize) -> DVec3 {
        let ([w, h], tan) = (self.view.size.map(f64::from), libm::tan(self.view.fov_y * 0.5));
        let [right, up, forward] = self.view.basis;
        let (sx, sy) = ((2.0 * (x as f64 + 0.5) - w) / h * tan, (1.0 - 2.0 * (y as f64 + 0.5) / h) * tan);
        forward + right * sx + up * sy
    }
}

/// Nothing on.
pub(super) fn off() -> Switches {
    Switches {
        shadows: false,
        transmittance: false,
        specular: false,
        scattering: false,
        discoloration: false,
        color_map: false,
        normal_map: false,
        occlusion_map: false,
        specular_map: false,
    }
}

/// A view from +z.
pub(super) fn view(size: [u32; 2], distance: f64) -> View {
    View {
        eye: DVec3::new(0.0, 0.0, distance),
        basis: [DVec3::X, DVec3::Y, DVec3::NEG_Z],
        fov_y: 0.6,
        size,
        near: 0.05,
        far: 100.0,
    }
}

/// Maps that say nothing.
pub(super) fn maps() -> Maps {
    let of = |texel| Image::filled([1, 1], texel);
    Maps {
        color: of([200, 150, 120, 255]),
        normal: of([128, 128, 255, 255]),
        occlusion: of([255; 4]),
        specular: of([150, 90, 0, 255]),
    }
}

/// A light at a place that shines on another; a cone of 0.5, fading over its outer half.
pub(super) fn light(position: DVec3, target: DVec3) -> Light {
    let forward = (target - position).normalize();
    let right = forward.cross(if forward.y.abs() < 0.9 { DVec3::Y } else { DVec3::Z }).normalize();
    Light {
        position,
        basis: [right, right.cross(forward), forward],
        distance: position.distance(target),
        color: [1.2, 0.9, 0.7],
        cos_outer: libm::cos(0.5),
        cos_inner: libm::cos(0.25),
        tan_half: libm::tan(0.5),
        near: 0.1,
        far: 50.0,
        reaches: true,
    }
}

/// Parallelograms: a corner, and the two sides from it, which are u and v. Seen from where u × v points.
pub(super) fn sheets(sheets: &[[DVec3; 3]], surface: Surface) -> Mesh {
    let mut indexed =
        IndexedMesh { uvs: vec![Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y], ..IndexedMesh::default() };
    for &[corner, u, v] in sheets {
        let first = indexed.positions.len() as u32;
        indexed.positions.extend([corner, corner + u, corner + u + v, corner + v]);
        for face in [[0, 1, 2], [0, 2, 3]] {
            indexed.faces.push(face.map(|i| first + i));
            indexed.face_uvs.push(face);
            indexed.surfaces.push(surface);
        }
    }
    Mesh::build(&indexed).expect("sheets are manifolds")
}

/// A square of side 2 a around a centre, that faces +z.
pub(super) fn square(centre: DVec3, a: f64) -> [DVec3; 3] {
    [centre - DVec3::new(a, a, 0.0), DVec3::X * (2.0 * a), DVec3::Y * (2.0 * a)]
}

/// A square that fills the view, at z = 0.
pub(super) fn wall() -> Mesh {
    sheets(&[square(DVec3::ZERO, 4.0)], Surface::Skin)
}

/// The linear light of an sRGB value.
pub(super) fn linear(value: f64) -> f64 {
    if value <= 0.04045 { value / 12.92 } else { libm::pow((value + 0.055) / 1.055, 2.4) }
}

/// Asserts that two numbers are as good as equal.
#[track_caller]
pub(super) fn close(found: f32, expected: f64, tolerance: f64) {
    let off = (f64::from(found) - expected).abs();
    assert!(off <= tolerance * expected.abs().max(1e-3), "{found} is not {expected}");
}
