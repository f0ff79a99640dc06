//! The face that is seen at a place of a picture, or lies at a place of a map.
//!
//! The ray is the third axis of seen space, turned: a triangle is hit if the ray passes its three sides on the same hand. The product
//! for a side is exactly the neighbour's with the other sign, so no ray slips through between two faces. Ties go to the first face.
//!
//! Meant for a pointer, not for cuts: these pick with exact signs.

use glam::{DVec2, DVec3, Vec2, dvec2};
use rayon::prelude::*;

use crate::canvas::frame::View;
use crate::mesh::{Face, FaceId, Mesh, Surface};
use crate::render::reference::lens::Lens;
use crate::render::spans::{COPIES, FARTHEST};

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

/// The face of the skin that lies at texture coordinates, maps repeating. Where several do, the first.
pub fn face_at_uv(mesh: &Mesh, at: [f64; 2]) -> Option<FaceId> {
    if !mesh.is_textured() || !at.iter().all(|c| c.is_finite()) {
        return None;
    }
    let covers = |face: &Face| {
        let corners = face.vertices.map(|v| mesh.vertex(v).uv);
        face.surface == Surface::Skin && copies(corners, at).any(|at| is_within(at, corners))
    };
    let found = mesh.faces().par_iter().enumerate().find_first(|(_, face)| covers(face));
    found.map(|(face, _)| FaceId::of(face))
}

/// The places of a point on the copies of the map that a triangle may lie on.
fn copies(corners: [Vec2; 3], at: [f64; 2]) -> impl Iterator<Item = DVec2> {
    let within = corners.iter().all(|c| c.x.abs() <= FARTHEST && c.y.abs() <= FARTHEST);
    let shifts = [0, 1].map(|k| {
        let values = corners.map(|c| f64::from(c[k]));
        let (least, most) = values.iter().fold((values[0], values[0]), |(l, m), v| (l.min(*v), m.max(*v)));
        let [first, last] = [(least - at[k]).ceil() as i64, (most - at[k]).floor() as i64];
        let last = if within { last.min(first + COPIES) } else { first - 1 };
        first..=last
    });
    let [across, up] = shifts;
    across.flat_map(move |i| up.clone().map(move |j| dvec2(at[0] + i as f64, at[1] + j as f64)))
}

fn is_within(at: DVec2, corners: [Vec2; 3]) -> bool {
    let [a, b, c] = corners.map(Vec2::as_dvec2);
    let hand = |p: DVec2, q: DVec2| (q - p).perp_dot(at - p);
    let hands = [hand(a, b), hand(b, c), hand(c, a)];
    let has_area = (b - a).perp_dot(c - a) != 0.0;
    has_area && (hands.iter().all(|hand| *hand >= 0.0) || hands.iter().all(|hand| *hand <= 0.0))
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
