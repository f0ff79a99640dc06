//! Which texels are the skin's.

use glam::{DVec3, vec2};

use super::*;
use crate::mesh::IndexedMesh;

#[test]
fn a_texel_is_marked_if_its_centre_is_covered() {
    // A square from texel 2.5 to 5.5 both ways: its top left centres are its own, its bottom right ones are not.
    let uvs: Vec<Vec2> =
        [[2.5, 2.5], [5.5, 2.5], [5.5, 5.5], [2.5, 5.5]].map(|[x, y]| vec2(x / 8.0, 1.0 - y / 8.0)).into();
    let faces = vec![[0, 2, 1], [0, 3, 2]];
    let positions = uvs.iter().map(|c| DVec3::new(c.x.into(), c.y.into(), 0.0)).collect();
    let input = IndexedMesh { positions, faces: faces.clone(), uvs, face_uvs: faces, surfaces: Vec::new() };
    let mesh = Mesh::build(&input).expect("a square");
    let mask = covered(&mesh, [8, 8]);
    for (k, covered) in mask.iter().enumerate() {
        let inside = (2..5).contains(&(k % 8)) && (2..5).contains(&(k / 8));
        assert_eq!(*covered == 1, inside, "texel {}, {}", k % 8, k / 8);
    }
    let gutter = IndexedMesh { surfaces: vec![Surface::Gutter, Surface::Skin], ..input };
    let half = covered(&Mesh::build(&gutter).expect("a square"), [8, 8]);
    assert_eq!(half.iter().filter(|c| **c == 1).count(), 3, "the lower left half, without its diagonal");
}
