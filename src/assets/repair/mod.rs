//! From the triangles of a file to a mesh: what can be repaired in one way is, and is noted; the rest is refused.
//!
//! | in the file | becomes |
//! | --- | --- |
//! | a face with a node twice, or whose corners are exactly in line | dropped |
//! | the same face again (same corners, same way round) | dropped |
//! | a node that no face uses | dropped |
//! | nodes at the same place | welded, see [`super::weld`] |
//! | neighbours that disagree about the outside | the fewer are turned over; in a closed part, so that its volume is positive |
//! | a closed mesh that is inside out | turned over |
//! | a node at which several fans of faces meet | one node for each fan |
//! | a face with a coordinate that is not finite | refused |
//! | an edge with three faces or more | refused: which two belong together is anyone's guess |
//! | a Möbius strip | refused: it has no outside |
//!
//! Exactly means exactly: nothing is dropped for being small. Dropping a face that is flat but has neighbours leaves a slit of width zero.
//!
//! A file that needs none of it pays for two passes: [`Mesh::build`] is tried first, and says whether there is anything to mend.

mod orient;

use rustc_hash::FxHashSet;

use super::error::{Fault, FaultKind};
use super::links::{HalfEdge, grouped, half_edges};
use super::soup::Soup;
use super::weld::{self, Rule};
use super::{Note, Notes, exact};
use crate::mesh::{BuildError, Mesh, Union};

/// Builds a file's mesh, repaired, with what was repaired.
pub(super) fn build(mut soup: Soup, rule: Rule) -> Result<(Mesh, Vec<Note>), Fault> {
    drop_degenerate(&mut soup)?;
    drop_unused(&mut soup);
    weld::weld(&mut soup, rule);
    let mesh = match Mesh::build(&soup.mesh) {
        Ok(mesh) => mesh,
        Err(error) if is_mendable(&error) => {
            mend(&mut soup)?;
            finish(&soup)?
        }
        Err(error) => return Err(fault(&soup, &error)),
    };
    let mesh = turn_right_side_out(&mut soup, mesh)?;
    Ok((mesh, soup.notes))
}

fn is_mendable(error: &BuildError) -> bool {
    use BuildError::{NonManifoldEdge, NonManifoldNode, Orientation};
    matches!(error, NonManifoldEdge { .. } | NonManifoldNode { .. } | Orientation { .. })
}

fn finish(soup: &Soup) -> Result<Mesh, Fault> {
    Mesh::build(&soup.mesh).map_err(|error| fault(soup, &error))
}

fn fault(soup: &Soup, error: &BuildError) -> Fault {
    Fault::build(error, |face| soup.place(face))
}

/// Refuses faces that are not finite and drops those without area.
fn drop_degenerate(soup: &mut Soup) -> Result<(), Fault> {
    let (mut repeated, mut flat) = (Vec::new(), Vec::new());
    for (f, &[a, b, c]) in soup.mesh.faces.iter().enumerate() {
        let corners = [a, b, c].map(|n| soup.mesh.positions[n as usize]);
        if !corners.iter().all(|p| p.is_finite()) || !uvs_are_finite(soup, f) {
            let detail = "the face uses a coordinate that is not finite";
            return Err(Fault::new(soup.place(f), FaultKind::NotFinite, detail));
        }
        if a == b || b == c || c == a {
            repeated.push(f);
        } else if exact::collinear(corners[0], corners[1], corners[2]) {
            flat.push(f);
        }
    }
    drop_faces(soup, "face-repeats-node", "faces that use a node twice were dropped", &repeated, &flat);
    Ok(())
}

fn uvs_are_finite(soup: &Soup, face: usize) -> bool {
    let corners = soup.mesh.face_uvs.get(face);
    corners.is_none_or(|c| c.iter().all(|&i| soup.mesh.uvs[i as usize].is_finite()))
}

/// Drops two kinds of faces in one go.
fn drop_faces(soup: &mut Soup, what: &str, why: &str, repeated: &[usize], flat: &[usize]) {
    if repeated.is_empty() && flat.is_empty() {
        return;
    }
    for (what, why, faces) in [
        (what, why, repeated),
        ("face-without-area", "faces with corners exactly in line were dropped", flat),
    ] {
        note_faces(soup, what, why, faces);
    }
    let mut keep = vec![true; soup.mesh.faces.len()];
    repeated.iter().chain(flat).for_each(|&f| keep[f] = false);
    soup.retain_faces(&keep);
}

/// Notes what was done to faces, with the first one's place.
fn note_faces(soup: &mut Soup, what: &str, why: &str, faces: &[usize]) {
    if let Some(&first) = faces.first() {
        let detail = format!("{why}, the first at {}", soup.says(first));
        soup.notes.note(what, faces.len(), detail);
    }
}

fn drop_unused(soup: &mut Soup) {
    let unused = soup.compact();
    if unused > 0 {
        soup.notes.note("node-unused", unused, "nodes that no face uses were dropped".into());
    }
}

fn mend(soup: &mut Soup) -> Result<(), Fault> {
    drop_duplicates(soup);
    let names: Vec<u32> = (0..soup.mesh.positions.len() as u32).collect();
    let sides = half_edges(&soup.mesh.faces, &names);
    refuse_crowded_edges(soup, &sides)?;
    orient::orient(soup, &sides)?;
    split_nodes(soup, &sides);
    Ok(())
}

/// Drops a face that was there before, turned to the same lowest corner.
fn drop_duplicates(soup: &mut Soup) {
    let mut seen = FxHashSet::default();
    let turned = |&[a, b, c]: &[u32; 3]| [[a, b, c], [b, c, a], [c, a, b]].into_iter().min();
    let again: Vec<usize> =
        (0..soup.mesh.faces.len()).filter(|&f| !seen.insert(turned(&soup.mesh.faces[f]))).collect();
    drop_faces(soup, "face-duplicate", "faces that were there before were dropped", &again, &[]);
}

fn refuse_crowded_edges(soup: &Soup, sides: &[HalfEdge]) -> Result<(), Fault> {
    let crowded = grouped(sides).filter(|sides| sides.len() > 2);
    // The first in the file, not the first by node.
    let Some(sides) = crowded.min_by_key(|sides| sides[2].face()) else { return Ok(()) };
    let places: Vec<String> = sides.iter().take(8).map(|s| soup.says(s.face())).collect();
    let [a, b] = sides[0].key.map(|n| soup.mesh.positions[n as usize]);
    let detail = format!("{} faces share the edge from {a} to {b}: {}", sides.len(), places.join(", "));
    Err(Fault::new(soup.place(sides[2].face()), FaultKind::NotManifold, detail))
}

/// Gives every fan of faces its own node. The fan of the first face keeps the old one.
fn split_nodes(soup: &mut Soup, sides: &[HalfEdge]) {
    let corner_fans = fans(&soup.mesh.faces, sides);
    let mut owner = vec![u32::MAX; soup.mesh.positions.len()];
    let mut new_node = vec![u32::MAX; corner_fans.len()];
    let mut split = Vec::new();
    for (at, &fan) in corner_fans.iter().enumerate() {
        let node = soup.mesh.faces[at / 3][at % 3] as usize;
        if owner[node] == u32::MAX {
            owner[node] = fan;
        }
        if owner[node] != fan && new_node[fan as usize] == u32::MAX {
            new_node[fan as usize] = soup.mesh.positions.len() as u32;
            soup.mesh.positions.push(soup.mesh.positions[node]);
            split.push(at / 3);
        }
    }
    for (at, &fan) in corner_fans.iter().enumerate().filter(|(_, fan)| new_node[**fan as usize] != u32::MAX) {
        soup.mesh.faces[at / 3][at % 3] = new_node[fan as usize];
    }
    note_faces(soup, "node-split", "nodes were added where several fans of faces met in one", &split);
}

/// For each corner the lowest corner of its fan. Orientation does not matter.
fn fans(faces: &[[u32; 3]], sides: &[HalfEdge]) -> Vec<u32> {
    let mut union = Union::new(3 * faces.len());
    for pair in grouped(sides) {
        let [one, other] = pair else { continue };
        for node in one.key {
            let corner = |side: &HalfEdge| {
                let face = side.face();
                faces[face].iter().position(|&n| n == node).map(|c| (3 * face + c) as u32)
            };
            if let (Some(a), Some(b)) = (corner(one), corner(other)) {
                union.join(a, b);
            }
        }
    }
    union.names()
}

/// A closed mesh with a negative volume is inside out as a whole: cavities are smaller than what they lie in.
fn turn_right_side_out(soup: &mut Soup, mesh: Mesh) -> Result<Mesh, Fault> {
    let closed = !mesh.edges().iter().any(|e| e.is_boundary());
    let faces = 0..soup.mesh.faces.len();
    if !closed || !orient::is_inside_out(&soup.mesh, faces.clone()) {
        return Ok(mesh);
    }
    faces.clone().for_each(|f| soup.flip(f));
    soup.notes.note("inside-out", faces.len(), "the mesh was inside out; every face was turned over".into());
    finish(soup)
}

#[cfg(test)]
mod tests;
