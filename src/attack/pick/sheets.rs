//! Sheets of triangles over one another, and rays that go for their nodes, edges and coincidences.

use arbitrary::{Arbitrary, Result, Unstructured};
use glam::DVec3;

use crate::geometry::predicates::collinear;
use crate::mesh::{EdgeId, FaceId, IndexedMesh, Mesh, NodeId};

/// Nodes along a side of a sheet, at most.
const MOST_SIDE: usize = 5;
/// What the axes are multiplied by: nothing, all alike, or so that every face is a sliver.
const SCALES: [[f64; 3]; 7] =
    [[1.0; 3], [1.0; 3], [1e-9; 3], [1e9; 3], [1e-6, 1.0, 1.0], [1.0, 1e6, 1e6], [1.0, 1.0, 1e-12]];

/// One to four sheets of up to 5 x 5 nodes, each at a depth of its own, the same as the last one's, or an ulp beside it.
pub(super) fn sheets(bytes: &mut Unstructured<'_>) -> Result<IndexedMesh> {
    let mut mesh = IndexedMesh::default();
    let scale = *bytes.choose(&SCALES)?;
    let mut depth = 0.0;
    for _ in 0..bytes.int_in_range(1..=4)? {
        depth = match bytes.int_in_range(0..=3u8)? {
            0 => depth,
            1 => f64::next_up(depth),
            2 => depth + f64::EPSILON,
            _ => f64::from(i8::arbitrary(bytes)?) / 16.0,
        };
        sheet(bytes, depth, &mut mesh)?;
    }
    let lies_askew = bool::arbitrary(bytes)?;
    for p in &mut mesh.positions {
        *p *= DVec3::from(scale);
        if lies_askew {
            *p += DVec3::new(0.7 * p.y, 0.3 * p.z, 0.9 * p.x);
        }
    }
    let corner = |i: u32| mesh.positions[i as usize];
    let is_flat = mesh.faces.iter().any(|&[a, b, c]| collinear(corner(a), corner(b), corner(c)));
    // What lies askew is rounded, and a sliver may become a line by it: no reader lets that pass.
    if is_flat { Err(arbitrary::Error::IncorrectFormat) } else { Ok(mesh) }
}

/// Nodes on a lattice, each moved by three sixteenths of its distance at most: so no face is flat, and none folds over another of its sheet but
/// for its depth.
fn sheet(bytes: &mut Unstructured<'_>, depth: f64, mesh: &mut IndexedMesh) -> Result<()> {
    let [wide, high] = [bytes.int_in_range(2..=MOST_SIDE)?, bytes.int_in_range(2..=MOST_SIDE)?];
    let first = mesh.positions.len() as u32;
    let bumpy = bool::arbitrary(bytes)?;
    let by = |bytes: &mut Unstructured<'_>| {
        Ok::<_, arbitrary::Error>(f64::from(bytes.int_in_range(-3..=3i8)?) / 16.0)
    };
    for (row, column) in (0..high).flat_map(|row| (0..wide).map(move |column| (row, column))) {
        let z = if bumpy { depth + by(bytes)? } else { depth };
        let x = column as f64 + by(bytes)?;
        mesh.positions.push(DVec3::new(x, row as f64 + by(bytes)?, z));
    }
    let turned = bool::arbitrary(bytes)?;
    for (row, column) in (1..high).flat_map(|row| (1..wide).map(move |column| (row, column))) {
        let at = |r: usize, c: usize| first + (r * wide + c) as u32;
        let [a, b, c, d] =
            [at(row - 1, column - 1), at(row - 1, column), at(row, column), at(row, column - 1)];
        mesh.faces.extend(if turned { [[a, c, b], [a, d, c]] } else { [[a, b, c], [a, c, d]] });
    }
    Ok(())
}

/// A ray: an eye on the lattice or anywhere, through a node, a point on an edge or in a face, or anywhere.
pub(super) fn ray(bytes: &mut Unstructured<'_>, mesh: &Mesh) -> Result<[DVec3; 2]> {
    let through = aim(bytes, mesh)?;
    let scale = mesh.largest_coordinate();
    let away = *bytes.choose(&[scale, 2.0 * scale, 1e3 * scale, 1e-3 * scale])?;
    let eye = match bytes.int_in_range(0..=3u8)? {
        0 => through + DVec3::Z * away,
        1 => through - DVec3::Z * away,
        2 => aim(bytes, mesh)? + DVec3::new(0.0, 0.0, away),
        _ => anywhere(bytes)? * away,
    };
    Ok([eye, through])
}

fn aim(bytes: &mut Unstructured<'_>, mesh: &Mesh) -> Result<DVec3> {
    let share = |bytes: &mut Unstructured<'_>| Ok(f64::from(bytes.int_in_range(0..=16u8)?) / 16.0);
    Ok(match bytes.int_in_range(0..=3u8)? {
        0 => mesh.position(NodeId::of(bytes.choose_index(mesh.node_count())?)),
        1 => {
            let edge = mesh.edge(EdgeId::of(bytes.choose_index(mesh.edge_count())?));
            let [a, b] = edge.nodes.map(|n| mesh.position(n));
            a + (b - a) * share(bytes)?
        }
        2 => {
            let [a, b, c] = mesh.triangle(FaceId::of(bytes.choose_index(mesh.face_count())?));
            a + (b - a) * share(bytes)? + (c - a) * share(bytes)?
        }
        _ => anywhere(bytes)? * mesh.largest_coordinate(),
    })
}

/// Within a cube of two around the origin.
fn anywhere(bytes: &mut Unstructured<'_>) -> Result<DVec3> {
    let one = |bytes: &mut Unstructured<'_>| {
        Ok::<_, arbitrary::Error>(f64::from(i32::arbitrary(bytes)?) / f64::from(i32::MAX))
    };
    Ok(DVec3::new(one(bytes)?, one(bytes)?, one(bytes)?))
}
