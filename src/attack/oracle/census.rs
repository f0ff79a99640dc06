//! Nodes, edges, faces, area and volume, counted over the whole mesh, against what the line alone says they must be.
//!
//! A point inside of an edge makes a node and a face more for each face beside it, one inside of a face a node and two faces. Opening
//! k inner nodes makes two nodes and four faces more for each, and the middle, where it has to be made, is a point inside of an edge. The Euler
//! characteristic stays, which leaves one number of edges. A line that is merged moves nothing: area and volume stay.

use super::{Verdict, Witness, require};
use crate::engine::wound::chain::At;
use crate::engine::wound::{Cut, Mode};
use crate::geometry::ulp;
use crate::mesh::check::{doubled_area, euler, sixfold_volume};
use crate::mesh::{EdgeId, FaceId, Mesh};

pub(super) fn look(witness: &Witness<'_>) -> Verdict {
    let Some(cut) = witness.ran.applied() else { return Ok(()) };
    counts(witness, cut)?;
    match cut.mode {
        Mode::Carve => Ok(()),
        Mode::Patch | Mode::Merge => measures(witness, cut),
    }
}

fn counts(witness: &Witness<'_>, cut: &Cut) -> Verdict {
    let (before, after) = (&witness.before.mesh, &witness.after.mesh);
    let [mut nodes, mut faces, mut border] = [0i64; 3];
    if cut.mode != Mode::Patch {
        [nodes, faces, border] = merged(before, cut);
    }
    if cut.mode == Mode::Carve {
        let middle = (cut.carved.line.nodes.len() - cut.line.nodes.len()) as i64;
        let inner = cut.carved.opened.len() as i64 - 2;
        nodes += middle + 2 * inner;
        faces += 2 * middle + 4 * inner;
    }
    let grown = |count: fn(&Mesh) -> usize| count(after) as i64 - count(before) as i64;
    let found =
        [grown(Mesh::node_count), grown(Mesh::face_count), grown(borders), euler(after) - euler(before)];
    let expected = [nodes, faces, border, 0];
    require(found == expected, "census", || {
        format!("nodes, faces, border edges and V − E + F grew by {found:?}, not by {expected:?}")
    })
}

fn borders(mesh: &Mesh) -> usize {
    mesh.edges().iter().filter(|edge| edge.is_boundary()).count()
}

/// How many nodes, faces and border edges the points of a line make.
fn merged(mesh: &Mesh, cut: &Cut) -> [i64; 3] {
    let made = |at: At| match at {
        At::Node(_) => [0, 0, 0],
        At::Edge(e) => beside(mesh, e),
        At::Face(_) => [1, 2, 0],
    };
    let all = cut.formed.chain.points.iter().map(|p| made(p.at));
    all.fold([0; 3], |sum, more| [0, 1, 2].map(|i| sum[i] + more[i]))
}

fn beside(mesh: &Mesh, edge: EdgeId) -> [i64; 3] {
    if mesh.edge(edge).is_boundary() { [1, 1, 1] } else { [1, 2, 0] }
}

/// Area and volume of the whole, within what the rounding of the new nodes can do.
fn measures(witness: &Witness<'_>, cut: &Cut) -> Verdict {
    let (before, after) = (&witness.before.mesh, &witness.after.mesh);
    let [low, high] = after.bounds();
    let (size, faces) = ((high - low).length(), after.face_count() as f64);
    let moved = 4.0 * ulp(witness.ground.mesh.largest_coordinate().max(after.largest_coordinate()));
    let rounding = 1e-13 * faces * size * size;
    let (area, volume) = ([before, after].map(area), [before, after].map(volume));
    // Each new node moves by so much, and each face at it changes by no more than its sides times that.
    let points = cut.formed.chain.points.len() as f64;
    let slack = rounding + 64.0 * points * moved * size;
    require((area[1] - area[0]).abs() <= slack, "area", || format!("{} became {}", area[0], area[1]))?;
    let slack = slack * size;
    require((volume[1] - volume[0]).abs() <= slack, "volume", || {
        format!("{} became {}", volume[0], volume[1])
    })
}

fn triangles(mesh: &Mesh) -> impl Iterator<Item = [glam::DVec3; 3]> {
    (0..mesh.face_count()).map(|f| mesh.triangle(FaceId::of(f)))
}

fn area(mesh: &Mesh) -> f64 {
    triangles(mesh).map(|t| 0.5 * doubled_area(t).length()).sum()
}

/// Over a node of it: the origin may be far away.
fn volume(mesh: &Mesh) -> f64 {
    let from = mesh.positions()[0];
    triangles(mesh).map(|t| sixfold_volume(from, t) / 6.0).sum()
}
