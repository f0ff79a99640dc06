//! The face that is seen at a place of a picture.
//!
//! The ray is the third axis of seen space, turned: a triangle is hit if the ray passes its three sides on the same hand. The product
//! for a side is exactly the neighbour's with the other sign, so no ray slips through between two faces. Ties go to the first face.
//!
//! Meant for a pointer, not for cuts: these pick with exact signs.

use glam::DVec3;
use rayon::prelude::*;

use crate::canvas::frame::View;
use crate::mesh::{FaceId, Mesh};
use crate::render::reference::lens::Lens;

/// The face seen at a place of a view, in pixels from its upper left. None beside the mesh or the picture.
pub fn face_at(view: &View, mesh: &Mesh, [x, y]: [f64; 2]) -> Option<FaceId> {
    let inside = |at: f64, side: u32| (0.0..f64::from(side)).contains(&at);
    if !inside(x, view.size[0]) || !inside(y, view.size[1]) {
        return None;
    }
    let lens = Lens::of_view(view);
    let [cx, cy] = lens.centre();
    let ray = DVec3::new(x - cx, y - cy, 1.0);
    let seen: Vec<DVec3> = mesh.positions().par_iter().map(|p| lens.see(*p)).collect();
    let depths = mesh.faces().par_iter().enumerate().filter_map(|(i, face)| {
        let depth = hit(ray, face.nodes.map(|node| seen[node.at()]))?;
        (lens.near..=lens.far).contains(&depth).then_some((depth, FaceId::of(i)))
    });
    let nearest = depths.min_by(|(d, f), (e, g)| d.total_cmp(e).then(f.cmp(g)));
    nearest.map(|(_, face)| face)
}

/// The depth at which a ray hits a triangle, if it does.
#[inline]
fn hit(ray: DVec3, [a, b, c]: [DVec3; 3]) -> Option<f64> {
    let hands = [ray.dot(a.cross(b)), ray.dot(b.cross(c)), ray.dot(c.cross(a))];
    let same = hands.iter().all(|hand| *hand >= 0.0) || hands.iter().all(|hand| *hand <= 0.0);
    if !same {
        return None;
    }
    let normal = (b - a).cross(c - a);
    let depth = a.dot(normal) / ray.dot(normal);
    (depth > 0.0 && depth.is_finite()).then_some(depth)
}
