//! How far the rounded points of a line are from where they are exactly.

use glam::DVec3;
use schemars::JsonSchema;
use serde::Serialize;

use super::{Question, Refusal, Section};
use crate::engine::wound::chain::At;
use crate::geometry::ulp;
use crate::mesh::Mesh;

/// Distances of a line's points, in ulps of the mesh's largest coordinate but where another unit is named.
///
/// The distance from the exact point grows where plane and surface meet at a small angle, whatever one computes with: a point that was given, a pick, then
/// moves far along the surface for one ulp that it was rounded by. The distances from plane and element do not.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct ChainErrors {
    /// How many points were looked at.
    pub points: usize,
    /// Points on an element on which the plane has none.
    pub misplaced: usize,
    /// The largest distance from an exact point.
    pub max_ulps: f64,
    /// The mean of those distances.
    pub mean_ulps: f64,
    /// The largest distance from an exact point, model units.
    pub max_absolute: f64,
    /// The largest distance from the plane.
    pub off_plane_ulps: f64,
    /// The largest distance from the node, from the edge's line or from the face's plane.
    pub off_element_ulps: f64,
}

/// The errors of a line that answers a question. The picks themselves are points of it too.
pub fn errors(
    mesh: &Mesh,
    question: &Question,
    points: impl IntoIterator<Item = (At, DVec3)>,
) -> Result<ChainErrors, Refusal> {
    Ok(Section::of(mesh, question)?.errors(points))
}

impl Section<'_> {
    /// The errors of a line's points.
    pub fn errors(&self, points: impl IntoIterator<Item = (At, DVec3)>) -> ChainErrors {
        let (ulp, mut errors, mut sum) = (ulp(self.mesh.largest_coordinate()), ChainErrors::default(), 0.0);
        for (at, position) in points {
            errors.points += 1;
            let Some(exact) = self.point(at) else {
                errors.misplaced += 1;
                continue;
            };
            let distance = exact.distance(position);
            sum += distance / ulp;
            errors.max_absolute = errors.max_absolute.max(distance);
            errors.off_plane_ulps = errors.off_plane_ulps.max(self.off_plane(position) / ulp);
            errors.off_element_ulps = errors.off_element_ulps.max(self.off_element(at, position) / ulp);
        }
        errors.max_ulps = errors.max_absolute / ulp;
        errors.mean_ulps = sum / (errors.points - errors.misplaced).max(1) as f64;
        errors
    }
}
