//! Whether two triangles cross: whether an edge of one passes through the inside of the other, by exact signs.
//!
//! Touching is not crossing: triangles that share corners, or meet in a point or a line of their borders, do not cross. Overlapping
//! coplanar triangles do not cross either; they are caught as neighbours of faces that do, or by the facing of their normals.

use std::cmp::Ordering;

use glam::DVec3;

use super::predicates::orient3d;

/// A triangle with the ids of its corners: equal ids are the same point.
#[derive(Clone, Copy, Debug)]
pub struct Corners {
    /// Ids.
    pub ids: [u32; 3],
    /// Positions.
    pub at: [DVec3; 3],
}

/// Whether two triangles cross.
pub fn cross(a: &Corners, b: &Corners) -> bool {
    let shared = a.ids.iter().filter(|id| b.ids.contains(id)).count();
    shared < 2 && (pierces(a, b) || pierces(b, a))
}

/// Whether an edge of `a` passes through the inside of `b`.
fn pierces(a: &Corners, b: &Corners) -> bool {
    let shared = a.ids.map(|id| b.ids.contains(&id));
    let side = [0, 1, 2].map(|i| if shared[i] { Ordering::Equal } else { orient3d(b.at[0], b.at[1], b.at[2], a.at[i]) });
    if side.iter().all(|&s| s != Ordering::Less) || side.iter().all(|&s| s != Ordering::Greater) {
        return false;
    }
    (0..3).any(|i| {
        let j = (i + 1) % 3;
        let apart = side[i] != Ordering::Equal && side[i] == side[j].reverse();
        apart
            && !b.ids.contains(&a.ids[i])
            && !b.ids.contains(&a.ids[j])
            && passes_inside(a.at[i], a.at[j], b.at)
    })
}

/// Whether the line through `p` and `q` passes through the open inside of a triangle.
fn passes_inside(p: DVec3, q: DVec3, [a, b, c]: [DVec3; 3]) -> bool {
    let s = orient3d(p, q, a, b);
    s != Ordering::Equal && s == orient3d(p, q, b, c) && s == orient3d(p, q, c, a)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn triangle(ids: [u32; 3], at: [[f64; 3]; 3]) -> Corners {
        Corners { ids, at: at.map(DVec3::from) }
    }

    #[test]
    fn triangles_that_pierce_cross_and_those_that_touch_do_not() {
        let flat = triangle([0, 1, 2], [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]]);
        let through = triangle([3, 4, 5], [[1.0, 1.0, -1.0], [1.0, 1.0, 1.0], [9.0, 9.0, 1.0]]);
        let above = triangle([3, 4, 5], [[1.0, 1.0, 0.0], [1.0, 1.0, 1.0], [9.0, 9.0, 1.0]]);
        let beside = triangle([3, 4, 5], [[5.0, 5.0, -1.0], [5.0, 5.0, 1.0], [9.0, 9.0, 1.0]]);
        assert!(cross(&flat, &through) && cross(&through, &flat));
        assert!(!cross(&flat, &above) && !cross(&flat, &beside));
    }

    #[test]
    fn a_shared_corner_is_no_crossing_but_an_opposite_edge_is() {
        let flat = triangle([0, 1, 2], [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]]);
        let hinge = triangle([0, 4, 5], [[0.0, 0.0, 0.0], [1.0, 1.0, 1.0], [2.0, 1.0, 1.0]]);
        let pierced = triangle([0, 4, 5], [[0.0, 0.0, 0.0], [1.0, 1.0, -1.0], [1.0, 1.5, 1.0]]);
        assert!(!cross(&flat, &hinge));
        assert!(cross(&flat, &pierced));
    }
}
