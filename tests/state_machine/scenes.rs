//! Small scenes: every replay of a few events on them takes milliseconds.

use lancet::recording::{InlineMesh, SceneRef};
use proptest::prelude::*;

pub(crate) fn any_scene() -> impl Strategy<Value = SceneRef> {
    prop::sample::select(vec![plate(), tetrahedron(), SceneRef::Builtin("sphere:20".into())])
}

/// A square of eighteen triangles on a grid of exact coordinates, with texture coordinates: nodes and edges in line, and a boundary.
pub(crate) fn plate() -> SceneRef {
    const SIDE: u32 = 3;
    let steps = || (0..=SIDE).flat_map(|y| (0..=SIDE).map(move |x| [x, y]));
    let node = |x: u32, y: u32| y * (SIDE + 1) + x;
    let squares = (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| [x, y]));
    let faces = squares.flat_map(|[x, y]| {
        let [a, b, c, d] = [node(x, y), node(x + 1, y), node(x + 1, y + 1), node(x, y + 1)];
        [[a, b, c], [a, c, d]]
    });
    SceneRef::Inline(InlineMesh {
        nodes: steps().map(|[x, y]| [2.0 * f64::from(x), 2.0 * f64::from(y), 0.0]).collect(),
        faces: faces.collect(),
        uv: steps().map(|at| at.map(|step| step as f32 / SIDE as f32)).collect(),
    })
}

/// The least that is closed.
fn tetrahedron() -> SceneRef {
    SceneRef::Inline(InlineMesh {
        nodes: vec![[-3.0, -3.0, 3.0], [3.0, -3.0, 3.0], [0.0, -3.0, -3.0], [0.0, 3.0, 0.0]],
        faces: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]],
        uv: Vec::new(),
    })
}
