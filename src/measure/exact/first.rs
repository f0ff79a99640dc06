//! The first face on a ray by a look at every face, with exact signs: no hierarchy, no box, no parameter along the ray.
//!
//! It is written apart from [`crate::engine::wound::pick`], which is measured and attacked by it.

use std::cmp::Ordering;

use glam::DVec3;

use crate::geometry::predicates::{nearer, orient3d};
use crate::mesh::{FaceId, Mesh};

/// The face that a ray meets first in front of the eye, and how many faces it meets there; of several at one place the one with the lowest id.
pub fn first_face(mesh: &Mesh, eye: DVec3, through: DVec3) -> (Option<FaceId>, usize) {
    let (mut first, mut level) = (None, 0);
    for face in (0..mesh.face_count()).map(FaceId::of).filter(|&f| is_met(mesh.triangle(f), eye, through)) {
        let order =
            first.map_or(Ordering::Greater, |b| nearer(eye, through, mesh.triangle(b), mesh.triangle(face)));
        match order {
            Ordering::Greater => (first, level) = (Some(face), 1),
            Ordering::Equal => level += 1,
            Ordering::Less => {}
        }
    }
    (first, level)
}

/// Whether a ray goes through a triangle in front of the eye, borders included; not where it lies in the triangle's plane.
fn is_met([a, b, c]: [DVec3; 3], eye: DVec3, through: DVec3) -> bool {
    let sides = [(a, b), (b, c), (c, a)].map(|(p, q)| orient3d(eye, through, p, q));
    // Less: it turns counter-clockwise as one looks against the ray. Of both signs: the ray passes it by.
    let turn = match [Ordering::Greater, Ordering::Less].map(|side| sides.contains(&side)) {
        [true, false] => Ordering::Greater,
        [false, true] => Ordering::Less,
        _ => return false,
    };
    // Seen from the eye it turns as it does against the ray where it is in front, and the other way around where it is behind.
    orient3d(a, b, c, eye) == turn.reverse()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::IndexedMesh;

    /// One triangle above the other, at these heights.
    fn sheets(heights: &[f64]) -> Mesh {
        let corners = |z: &f64| [[0.0, 0.0, *z], [1.0, 0.0, *z], [0.0, 1.0, *z]].map(DVec3::from);
        let positions = heights.iter().flat_map(corners).collect();
        let faces = (0..heights.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        Mesh::build(&IndexedMesh { positions, faces, ..IndexedMesh::default() }).expect("sheets")
    }

    fn seen(heights: &[f64], from: f64, to: f64) -> Option<FaceId> {
        let [eye, through] = [from, to].map(|z| DVec3::new(0.25, 0.25, z));
        first_face(&sheets(heights), eye, through).0
    }

    #[test]
    fn the_nearest_is_the_first_from_either_side_and_the_lowest_of_those_at_one_place() {
        let heights = [0.0, 1.0, 1.0, 0.5];
        assert_eq!(seen(&heights, 3.0, 2.0), Some(FaceId(1)));
        let both = first_face(&sheets(&heights), DVec3::new(0.25, 0.25, 3.0), DVec3::new(0.25, 0.25, 2.0));
        assert_eq!(both, (Some(FaceId(1)), 2));
        assert_eq!(seen(&heights, -3.0, -2.0), Some(FaceId(0)));
        assert_eq!(seen(&heights, 0.75, 0.7), Some(FaceId(3)));
        assert_eq!(seen(&heights, 3.0, 4.0), None, "they are behind the eye");
        assert_eq!(seen(&[1.0, 1.0_f64.next_up()], 3.0, 2.0), Some(FaceId(1)), "an ulp nearer");
    }

    #[test]
    fn what_a_ray_passes_by_or_along_is_not_met() {
        let mesh = sheets(&[0.0]);
        let first = |eye: [f64; 3], through: [f64; 3]| first_face(&mesh, eye.into(), through.into()).0;
        assert_eq!(first([0.75, 0.75, 1.0], [0.75, 0.75, 0.5]), None, "by it");
        assert_eq!(first([-1.0, 0.25, 0.0], [0.0, 0.25, 0.0]), None, "along it");
        assert_eq!(first([0.5, 0.5, 1.0], [0.5, 0.5, 0.5]), Some(FaceId(0)), "over its side");
    }

    #[test]
    fn a_triangle_of_either_turn_is_met_in_front_alone() {
        let [a, b, c] = [DVec3::ZERO, DVec3::X, DVec3::Y];
        let eye = DVec3::new(0.25, 0.25, 1.0);
        assert!(is_met([a, b, c], eye, eye - DVec3::Z) && is_met([a, c, b], eye, eye - DVec3::Z));
        assert!(!is_met([a, b, c], eye, eye + DVec3::Z) && !is_met([a, c, b], eye, eye + DVec3::Z));
        assert!(!is_met([a, b, c], eye, eye + DVec3::X));
    }
}
