//! Nodes at the same place made one.
//!
//! Formats and exporters repeat a node wherever its attributes differ (along seams, at sharp edges), which tears the surface.
//! Equal means equal bit for bit, once −0 is 0; nearly equal is not equal.
//!
//! - `Rule::Own` (OBJ, which has indices for positions alone): the file's own connectivity counts. Two faces that pass along
//!   equal positions in opposite directions, and no third, are **stitched**: their ends become one. Nodes that only touch stay apart, so
//!   two cubes that share an edge or a corner in space stay two cubes.
//! - `Rule::Position` (glTF and PLY, which cannot say it): all equal positions become one node, unless an edge would get
//!   more than two faces by it; then stitching is the rule here too.
//!
//! A stitch can close an edge that others use already; then the nodes at its ends stay as they were in the file. So welding never
//! takes away from a mesh that it is a manifold.

use glam::DVec3;
use rustc_hash::FxHashMap;

use super::Notes;
use super::links::{HalfEdge, grouped, half_edges};
use super::soup::Soup;
use crate::mesh::Union;

/// Whose connectivity counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Rule {
    /// That of the file's indices.
    Own,
    /// That of the positions.
    Position,
}

/// Makes equal positions one node, and notes how many nodes that took away.
pub(super) fn weld(soup: &mut Soup, rule: Rule) {
    let Some(places) = equal_positions(&soup.mesh.positions) else { return };
    let faces = &soup.mesh.faces;
    let names = match rule {
        Rule::Position if is_edge_manifold(faces, &places) => places,
        _ => stitch(faces, &places),
    };
    let welded = names.iter().enumerate().filter(|(i, n)| *i != **n as usize).count();
    if welded == 0 {
        return;
    }
    soup.mesh.faces.iter_mut().flatten().for_each(|n| *n = names[*n as usize]);
    soup.compact();
    soup.notes.note("welded", welded, "nodes at the place of another were made one with it".into());
}

/// For each node the first one at its place; `None` when all differ.
fn equal_positions(positions: &[DVec3]) -> Option<Vec<u32>> {
    let mut first = FxHashMap::with_capacity_and_hasher(positions.len(), Default::default());
    let key = |p: &DVec3| [p.x.to_bits(), p.y.to_bits(), p.z.to_bits()];
    let places = positions.iter().enumerate().map(|(i, p)| *first.entry(key(p)).or_insert(i as u32));
    let places: Vec<u32> = places.collect();
    (first.len() < positions.len()).then_some(places)
}

fn is_edge_manifold(faces: &[[u32; 3]], names: &[u32]) -> bool {
    grouped(&half_edges(faces, names)).all(|sides| sides.len() <= 2)
}

/// For each node its name after stitching: the lowest node that it was made one with.
fn stitch(faces: &[[u32; 3]], places: &[u32]) -> Vec<u32> {
    let mut union = Union::new(places.len());
    for sides in grouped(&half_edges(faces, places)) {
        if let [one, other] = sides
            && one.forward != other.forward
        {
            let ([a, b], [c, d]) = (ends(faces, one), ends(faces, other));
            union.join(a, d);
            union.join(b, c);
        }
    }
    let mut names = union.names();
    undo_crowded(faces, &mut names);
    names
}

/// Nodes at the ends of edges that stitching has given too many faces get their own names back.
fn undo_crowded(faces: &[[u32; 3]], names: &mut [u32]) {
    let mut crowded = vec![false; names.len()];
    for sides in grouped(&half_edges(faces, names)) {
        let fits = match sides {
            [_] => true,
            [one, other] => one.forward != other.forward,
            _ => false,
        };
        let in_file = |side: &HalfEdge| {
            let [a, b] = ends(faces, side);
            [a.min(b), a.max(b)]
        };
        if !fits && sides.iter().any(|s| in_file(s) != in_file(&sides[0])) {
            sides[0].key.iter().for_each(|&n| crowded[n as usize] = true);
        }
    }
    for (node, name) in names.iter_mut().enumerate() {
        if crowded[*name as usize] {
            *name = node as u32;
        }
    }
}

/// The nodes that a half-edge runs between, as the file names them.
fn ends(faces: &[[u32; 3]], side: &HalfEdge) -> [u32; 2] {
    let face = faces[side.face()];
    [face[side.side()], face[(side.side() + 1) % 3]]
}
