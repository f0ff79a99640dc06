//! A common orientation for the faces of each part of a mesh.

use crate::assets::error::{Fault, FaultKind};
use crate::assets::links::{HalfEdge, grouped};
use crate::assets::soup::Soup;
use crate::mesh::IndexedMesh;

use super::note_faces;

/// A volume below this part of the box around it is rounding, and says nothing about inside and outside.
const VOLUME_NOISE: f64 = 1e-12;

/// The face across a side, and whether the two disagree about the outside.
#[derive(Clone, Copy)]
struct Neighbour {
    face: u32,
    disagrees: bool,
}

/// Turns faces over so that neighbours agree. `sides` must have two faces an edge at most.
pub(super) fn orient(soup: &mut Soup, sides: &[HalfEdge]) -> Result<(), Fault> {
    let neighbours = neighbours(soup.mesh.faces.len(), sides);
    let mut turned: Vec<Option<bool>> = vec![None; neighbours.len()];
    let mut to_flip = Vec::new();
    for first in 0..neighbours.len() {
        if turned[first].is_none() {
            let part = spread(soup, first, &neighbours, &mut turned)?;
            to_flip.extend(choose(soup, &part, &neighbours, &turned));
        }
    }
    to_flip.sort_unstable();
    to_flip.iter().for_each(|&f| soup.flip(f));
    note_faces(soup, "face-turned", "faces were turned over to agree with their neighbours", &to_flip);
    Ok(())
}

fn neighbours(faces: usize, sides: &[HalfEdge]) -> Vec<[Option<Neighbour>; 3]> {
    let mut all = vec![[None; 3]; faces];
    for pair in grouped(sides) {
        let [one, other] = pair else { continue };
        let disagrees = one.forward == other.forward;
        for (here, there) in [(one, other), (other, one)] {
            all[here.face()][here.side()] = Some(Neighbour { face: there.face() as u32, disagrees });
        }
    }
    all
}

/// Walks over one part from its first face, which stays; says which faces belong to it.
fn spread(
    soup: &Soup,
    first: usize,
    neighbours: &[[Option<Neighbour>; 3]],
    turned: &mut [Option<bool>],
) -> Result<Vec<usize>, Fault> {
    turned[first] = Some(false);
    let mut part = vec![first];
    let mut next = 0;
    while let Some(&face) = part.get(next) {
        next += 1;
        let here = turned[face].unwrap_or_default();
        for n in neighbours[face].iter().flatten() {
            let there = here != n.disagrees;
            match turned[n.face as usize].replace(there) {
                None => part.push(n.face as usize),
                Some(before) if before != there => return Err(not_orientable(soup, face, n.face as usize)),
                Some(_) => {}
            }
        }
    }
    Ok(part)
}

fn not_orientable(soup: &Soup, face: usize, other: usize) -> Fault {
    let detail = format!(
        "the surface has one side only: its faces cannot agree about the outside, the last conflict is with {}",
        soup.says(other)
    );
    Fault::new(soup.place(face), FaultKind::NotOrientable, detail)
}

/// The faces of a part to turn over: none where all agree; in a closed part those that make its volume positive; else
/// the fewer, the first face staying where there are as many.
fn choose(
    soup: &Soup,
    part: &[usize],
    neighbours: &[[Option<Neighbour>; 3]],
    turned: &[Option<bool>],
) -> Vec<usize> {
    let select = |wanted: bool| part.iter().copied().filter(move |&f| turned[f] == Some(wanted));
    let minority = select(true).count();
    if minority == 0 {
        return Vec::new();
    }
    let closed = part.iter().all(|&f| neighbours[f].iter().all(Option::is_some));
    let volume = signed_volume(&soup.mesh, part.iter().map(|&f| (f, turned[f] == Some(true))));
    let invert =
        if closed && is_certain(&soup.mesh, volume) { volume < 0.0 } else { 2 * minority > part.len() };
    select(!invert).collect()
}

/// Whether closed faces enclose a negative volume.
pub(super) fn is_inside_out(mesh: &IndexedMesh, faces: impl Iterator<Item = usize>) -> bool {
    let volume = signed_volume(mesh, faces.map(|f| (f, false)));
    volume < 0.0 && is_certain(mesh, volume)
}

fn is_certain(mesh: &IndexedMesh, volume: f64) -> bool {
    let Some(&first) = mesh.positions.first() else { return false };
    let (low, high) = mesh.positions.iter().fold((first, first), |(l, h), p| (l.min(*p), h.max(*p)));
    let size = (high - low).max_element();
    volume.abs() > VOLUME_NOISE * size * size * size
}

/// Volume under faces, some of them taken the other way round; seen from the first node, which keeps the terms small.
fn signed_volume(mesh: &IndexedMesh, faces: impl Iterator<Item = (usize, bool)>) -> f64 {
    let origin = mesh.positions.first().copied().unwrap_or_default();
    let term = |(f, turned): (usize, bool)| {
        let [a, b, c] = mesh.faces[f].map(|n| mesh.positions[n as usize] - origin);
        let volume = a.dot(b.cross(c)) / 6.0;
        if turned { -volume } else { volume }
    };
    faces.map(term).sum()
}
