//! A mesh takes at most 200 bytes a face, topology included; 60 of them are kept for the bounding volume hierarchy.

use glam::{DVec3, Vec2};
use lancet::mesh::{IndexedMesh, Mesh};
use peak_alloc::PeakAlloc;

#[global_allocator]
static ALLOCATOR: PeakAlloc = PeakAlloc;

const BYTES_PER_FACE: f64 = 200.0;
const RESERVED: f64 = 60.0;
const SIDE: u32 = 256;

/// A torus of `SIDE` x `SIDE` quads in charts of 16 x 16, so that there are seams as in a scan.
fn torus() -> IndexedMesh {
    let mut mesh = IndexedMesh::default();
    let turn = |i: u32| f64::from(i) / f64::from(SIDE) * std::f64::consts::TAU;
    for i in 0..SIDE {
        for j in 0..SIDE {
            let ((s, c), (t, d)) = (libm::sincos(turn(j)), libm::sincos(turn(i)));
            mesh.positions.push(DVec3::new((2.0 + c) * d, (2.0 + c) * t, s));
            let corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
            let nodes = corners.map(|(i, j)| i % SIDE * SIDE + j % SIDE);
            let first = mesh.uvs.len() as u32;
            let chart = (i / 16 * 16 + j / 16) as f32;
            mesh.uvs.extend(corners.map(|(i, j)| Vec2::new(i as f32 + chart, j as f32)));
            for [a, b, c] in [[0, 1, 2], [0, 2, 3]] {
                mesh.faces.push([nodes[a], nodes[b], nodes[c]]);
                mesh.face_uvs.push([first + a as u32, first + b as u32, first + c as u32]);
            }
        }
    }
    mesh
}

#[test]
fn a_face_takes_less_than_two_hundred_bytes() {
    let input = torus();
    let before = ALLOCATOR.current_usage();
    let mesh = Mesh::build(&input).expect("a torus");
    let live = ALLOCATOR.current_usage() - before;
    let per_face = live as f64 / mesh.face_count() as f64;
    assert!(mesh.face_count() >= 100_000 && mesh.vertex_count() > mesh.node_count());
    assert!(per_face <= BYTES_PER_FACE - RESERVED, "{per_face} bytes a face");
    assert!(
        mesh.bytes() as f64 >= 0.99 * live as f64,
        "the mesh knows what it takes: {} of {live}",
        mesh.bytes()
    );
}
