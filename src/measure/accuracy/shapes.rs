//! Surfaces on which the truth has a closed form, and cuts across their middle.
//!
//! **The sheet** is a square grid of right triangles, turned by [`TURN`] so that no line follows its rows, flat or bent round a vertical axis. It is
//! developable: unrolled, it is the plane again. **The sphere** is the built-in one.
//!
//! **The cut.** Seen from straight ahead at a distance D, two pixels at the same distance from the middle, left and right of it, span a plane
//! through the axis, the centre, or straight across: the line is a straight segment, an arc of the cylinder's circle, or of a great circle. On all three
//! it is a geodesic of length [`LENGTH_CM`]; a ray meets the round ones half an angle θ = L/2R from the middle where tan φ = R sin θ/(D − R cos θ).

use glam::{DVec2, DVec3, Vec2};

use crate::assets::builtin::builtin;
use crate::canvas::look::{Distance, Look};
use crate::engine::wound::{Pick, Scene, State, WoundEvent};
use crate::measure::MeasureError;
use crate::measure::scaling::default_scene;
use crate::mesh::{IndexedMesh, Mesh};

/// Length of the line on the smooth surface, cm.
pub(super) const LENGTH_CM: f64 = 4.0;
/// Side of the sheet, cm.
const SIDE_CM: f64 = 8.0;
/// How far its grid is turned, radians.
const TURN: f64 = 0.35;
/// The cylinder's radius, cm: the sheet goes a third of the way round.
const CYLINDER_CM: f64 = 5.0;
/// The built-in sphere's radius, cm.
const SPHERE_CM: f64 = 10.0;
/// Eye to middle, cm.
const EYE_CM: f64 = 40.0;
/// What a stretched chart is scaled by, across and up.
const STRETCHED: [f64; 2] = [0.95, 0.6];

/// A surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Shape {
    /// A flat sheet.
    Plate,
    /// A sheet bent to a part of a cylinder.
    Cylinder,
    /// The same, with a chart that is stretched across.
    StretchedCylinder,
    /// The built-in sphere.
    Sphere,
}

impl Shape {
    /// What it is called.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Plate => "plate",
            Self::Cylinder => "cylinder",
            Self::StretchedCylinder => "cylinder, chart stretched 1.6 times",
            Self::Sphere => "sphere",
        }
    }

    /// 1/R of the section, 1/cm.
    pub(super) fn curvature(self) -> f64 {
        match self {
            Self::Plate => 0.0,
            Self::Cylinder | Self::StretchedCylinder => 1.0 / CYLINDER_CM,
            Self::Sphere => 1.0 / SPHERE_CM,
        }
    }

    /// The surface with about so many faces.
    pub(super) fn mesh(self, faces: usize) -> Result<Mesh, MeasureError> {
        Ok(Mesh::build(&match self {
            Self::Sphere => builtin(&format!("sphere:{faces}"))?.mesh,
            _ => self.sheet(faces),
        })?)
    }

    fn sheet(self, faces: usize) -> IndexedMesh {
        let cells = libm::round((faces as f64 / 2.0).sqrt()).max(1.0) as u32;
        let mut mesh = IndexedMesh::default();
        for (j, i) in (0..=cells).flat_map(|j| (0..=cells).map(move |i| (j, i))) {
            let at = DVec2::new(f64::from(i), f64::from(j)) / f64::from(cells) - 0.5;
            mesh.positions.push(self.bent(turned(at * SIDE_CM)));
            mesh.uvs.push(self.chart(at));
        }
        for (j, i) in (0..cells).flat_map(|j| (0..cells).map(move |i| (j, i))) {
            let corner = j * (cells + 1) + i;
            let (right, above) = (corner + 1, corner + cells + 1);
            mesh.faces.extend([[corner, right, above + 1], [corner, above + 1, above]]);
        }
        mesh.face_uvs = mesh.faces.clone();
        mesh
    }

    /// A point of the unrolled sheet in space.
    fn bent(self, at: DVec2) -> DVec3 {
        if self == Self::Plate {
            return at.extend(0.0);
        }
        let (sin, cos) = libm::sincos(at.x / CYLINDER_CM);
        DVec3::new(CYLINDER_CM * sin, at.y, CYLINDER_CM * cos)
    }

    /// Texture coordinates of a place of the grid, each from −½ to ½.
    fn chart(self, at: DVec2) -> Vec2 {
        let [across, up] = if self == Self::StretchedCylinder { STRETCHED } else { [0.95; 2] };
        (DVec2::new(at.x * across, at.y * up) + 0.5).as_vec2()
    }

    /// Where a point of the surface lies on the unrolled one: (s, d), s from the line's beginning, d to its left.
    pub(super) fn exact(self, point: DVec3) -> DVec2 {
        let half = 0.5 * LENGTH_CM;
        match self {
            Self::Plate => DVec2::new(point.x + half, point.y),
            Self::Cylinder | Self::StretchedCylinder => {
                DVec2::new(CYLINDER_CM * libm::atan2(point.x, point.z) + half, point.y)
            }
            Self::Sphere => DVec2::new(
                SPHERE_CM * libm::atan2(point.x, point.z) + half,
                SPHERE_CM * libm::asin((point.y / SPHERE_CM).clamp(-1.0, 1.0)),
            ),
        }
    }

    /// How it is looked at.
    pub(super) fn scene(self, distance: Distance) -> Scene {
        let mut look = Look::default();
        look.wound.distance = distance;
        Scene { target: Some([0.0; 3]), distance: Some(EYE_CM), look, ..default_scene() }
    }

    /// The cut across its middle.
    pub(super) fn cut(self, state: &State) -> WoundEvent {
        let camera = &state.control.camera;
        let [middle, level] = camera.viewport.map(|side| 0.5 * f64::from(side));
        let off = self.tangent() / libm::tan(0.5 * camera.fov_y) * level;
        let at = |side: f64| Pick::Pixel([middle + side * off, level]);
        WoundEvent::Cut { from: at(-1.0), to: at(1.0) }
    }

    /// The tangent of the angle at the eye between the middle and the line's end.
    fn tangent(self) -> f64 {
        let (half, curvature) = (0.5 * LENGTH_CM, self.curvature());
        if curvature == 0.0 {
            return half / EYE_CM;
        }
        let (sin, cos) = libm::sincos(half * curvature);
        sin / (EYE_CM * curvature - cos)
    }
}

fn turned(at: DVec2) -> DVec2 {
    let (sin, cos) = libm::sincos(TURN);
    DVec2::new(cos * at.x - sin * at.y, sin * at.x + cos * at.y)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SHAPES: [Shape; 4] = [Shape::Plate, Shape::Cylinder, Shape::StretchedCylinder, Shape::Sphere];

    #[test]
    fn the_cut_begins_and_ends_where_the_line_does() {
        for shape in SHAPES {
            let mut state = State::new(shape.mesh(20_000).expect("a mesh"), shape.scene(Distance::Surface));
            let WoundEvent::Cut { from, to } = shape.cut(&state) else { panic!("a cut") };
            for (pick, s) in [(from, 0.0), (to, LENGTH_CM)] {
                let at = crate::engine::wound::pick::resolve(&mut state, pick).expect("it meets the surface");
                let off = (shape.exact(at.point.position) - DVec2::new(s, 0.0)).length();
                assert!(off < 1e-3, "{shape:?}: {off}");
            }
        }
    }
}
