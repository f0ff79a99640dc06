//! Whether a line can be merged: every face that it divides falls into children with area that face as it does, by exact signs.

use std::collections::BTreeMap;

use glam::DVec3;

use super::scalar::{vector, wide};
use super::{BaselineChain, Scalar};
use crate::engine::wound::chain::At;
use crate::engine::wound::pattern::Shape;
use crate::mesh::{FaceId, Mesh};

/// Whether all children are sound, with the mesh's nodes rounded to the scalar.
pub(super) fn is_sound<S: Scalar>(mesh: &Mesh, chain: &BaselineChain) -> bool {
    let mut divided: BTreeMap<FaceId, Vec<(At, DVec3)>> = BTreeMap::new();
    for &place in &chain.places {
        let faces = match place.0 {
            At::Node(_) => [FaceId::NONE; 2],
            At::Edge(e) => mesh.edge(e).faces,
            At::Face(f) => [f, FaceId::NONE],
        };
        faces.into_iter().filter_map(FaceId::some).for_each(|f| divided.entry(f).or_default().push(place));
    }
    divided.into_iter().all(|(face, places)| falls_apart::<S>(mesh, face, &places))
}

fn falls_apart<S: Scalar>(mesh: &Mesh, face: FaceId, places: &[(At, DVec3)]) -> bool {
    let f = mesh.face(face);
    let corners = f.nodes.map(|n| wide(vector::<S>(mesh.position(n))));
    let mut shape = Shape { at: corners.to_vec(), sides: Default::default(), inner: Vec::new() };
    for &(at, position) in places {
        let local = shape.at.len() as u8;
        shape.at.push(position);
        match at {
            At::Edge(e) => f.side(e).into_iter().for_each(|side| shape.sides[side].push(local)),
            _ => shape.inner.push(local),
        }
    }
    for side in 0..3 {
        let at = &shape.at;
        let from = corners[side];
        shape.sides[side].sort_by(|&a, &b| {
            from.distance_squared(at[a as usize]).total_cmp(&from.distance_squared(at[b as usize]))
        });
    }
    shape.divide().is_some_and(|children| children.into_iter().all(|child| shape.is_sound(child)))
}
