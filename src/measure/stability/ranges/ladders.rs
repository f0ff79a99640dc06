//! The ladders: what grows from rung to rung, and on which scenes.

use std::collections::BTreeMap;

use glam::{DMat3, DVec3};

use crate::geometry::predicates::collinear;
use crate::measure::Random;
use crate::mesh::IndexedMesh;

/// One of them. A rung is a number; the first or the one that changes nothing stands for the scene as it is.
pub(super) struct Ladder {
    pub(super) name: &'static str,
    /// What a rung's number counts.
    pub(super) unit: &'static str,
    pub(super) scenes: [&'static str; 2],
    pub(super) rungs: &'static [f64],
    /// Where everything goes, the eye with it.
    pub(super) place: fn(f64) -> Placement,
    /// What happens to the mesh alone.
    pub(super) spoil: fn(&mut IndexedMesh, f64, &mut Random),
}

/// A change of place, size and direction.
#[derive(Clone, Copy, Debug)]
pub(super) struct Placement {
    linear: DMat3,
    shift: DVec3,
    /// How much larger a unit is.
    pub(super) scale: f64,
}

impl Placement {
    const NONE: Self = Self { linear: DMat3::IDENTITY, shift: DVec3::ZERO, scale: 1.0 };

    /// Where a point goes.
    pub(super) fn of(&self, p: DVec3) -> DVec3 {
        self.linear * p + self.shift
    }
}

fn nowhere(_: f64) -> Placement {
    Placement::NONE
}

fn unspoiled(_: &mut IndexedMesh, _: f64, _: &mut Random) {}

/// A head, where nothing coincides, and a box on a grid of quarters, where everything does.
const BOTH: [&str; 2] = ["bust:2000", "grid"];

pub(super) const LADDERS: [Ladder; 8] = [
    Ladder {
        name: "translation",
        unit: "units along every axis",
        scenes: BOTH,
        rungs: &[0.0, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12],
        place: |by| Placement { shift: DVec3::splat(by), ..Placement::NONE },
        spoil: unspoiled,
    },
    Ladder {
        name: "scale",
        unit: "times as large",
        scenes: BOTH,
        rungs: &[1e-9, 1e-6, 1e-3, 1.0, 1e3, 1e6, 1e9],
        place: |by| Placement { linear: DMat3::IDENTITY * by, scale: by, ..Placement::NONE },
        spoil: unspoiled,
    },
    Ladder {
        name: "rotation",
        unit: "radians",
        scenes: BOTH,
        rungs: &[0.0, 1e-15, 1e-12, 1e-9, 1e-6, 1e-3, 1.0],
        place: |by| Placement { linear: turned(by), ..Placement::NONE },
        spoil: unspoiled,
    },
    Ladder {
        name: "noise",
        unit: "last bits",
        scenes: BOTH,
        rungs: &[0.0, 1.0, 4.0, 16.0, 256.0, 65536.0],
        place: nowhere,
        spoil: shake,
    },
    Ladder {
        name: "coincidences",
        unit: "of the diagonal, coordinates rounded to it",
        scenes: BOTH,
        rungs: &[0.0, 1e-9, 1e-6, 1e-4, 1e-3, 1e-2],
        place: nowhere,
        spoil: onto_grid,
    },
    Ladder {
        name: "slivers",
        unit: "times as narrow",
        scenes: BOTH,
        rungs: &[1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9],
        place: |by| Placement {
            linear: DMat3::from_diagonal(DVec3::new(1.0 / by, 1.0, 1.0)),
            ..Placement::NONE
        },
        spoil: unspoiled,
    },
    Ladder {
        name: "short edges",
        unit: "of every ninth edge left",
        scenes: BOTH,
        rungs: &[1.0, 1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14],
        place: nowhere,
        spoil: shorten,
    },
    Ladder {
        name: "duplicates",
        unit: "of the way left to a node across an edge; at 0 two nodes are one point",
        scenes: BOTH,
        rungs: &[1.0, 1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14, 0.0],
        place: nowhere,
        spoil: double,
    },
];

/// About an axis that is no coordinate's.
fn turned(angle: f64) -> DMat3 {
    if angle == 0.0 {
        return DMat3::IDENTITY;
    }
    DMat3::from_axis_angle(DVec3::new(1.0, 2.0, 3.0).normalize(), angle)
}

/// Moves every coordinate by up to so many ulps of it.
fn shake(mesh: &mut IndexedMesh, ulps: f64, random: &mut Random) {
    for p in &mut mesh.positions {
        *p = p.map(|v| v + v * f64::EPSILON * (random.within(-ulps, ulps)).round());
    }
}

/// Rounds every coordinate to a multiple of a share of the diagonal, so that nodes come to lie in rows, in planes and on each other.
fn onto_grid(mesh: &mut IndexedMesh, share: f64, _: &mut Random) {
    if share == 0.0 {
        return;
    }
    // A power of two, so that what is rounded stays exact.
    let step = libm::exp2(libm::log2(share * diagonal(mesh)).round());
    mesh.positions.iter_mut().for_each(|p| *p = p.map(|v| (v / step).round() * step));
}

/// Moves a node of every third face towards the next until a share of the edge is left.
fn shorten(mesh: &mut IndexedMesh, share: f64, _: &mut Random) {
    let pairs: Vec<[u32; 3]> = mesh.faces.iter().copied().step_by(3).collect();
    approach(mesh, share, &pairs);
}

/// Moves a node of every third face towards the node on the other side of an edge. The face folds, and keeps its area.
fn double(mesh: &mut IndexedMesh, share: f64, _: &mut Random) {
    let mut beyond: BTreeMap<[u32; 2], u32> = BTreeMap::new();
    for &[a, b, c] in &mesh.faces {
        beyond.extend([([a, b], c), ([b, c], a), ([c, a], b)]);
    }
    let folds = mesh.faces.iter().step_by(3).filter_map(|&[a, b, c]| Some([a, *beyond.get(&[c, b])?, b]));
    let folds: Vec<[u32; 3]> = folds.collect();
    approach(mesh, share, &folds);
}

/// Moves the first of three nodes towards the second, where none of them has been in it before.
fn approach(mesh: &mut IndexedMesh, share: f64, nodes: &[[u32; 3]]) {
    if share == 1.0 {
        return;
    }
    let mut taken = vec![false; mesh.positions.len()];
    for three in nodes.iter().map(|three| three.map(|n| n as usize)) {
        if three.iter().any(|&n| taken[n]) {
            continue;
        }
        three.iter().for_each(|&n| taken[n] = true);
        let to = mesh.positions[three[1]];
        mesh.positions[three[0]] = to + (mesh.positions[three[0]] - to) * share;
    }
}

/// Puts nodes back where they were until no face is without area: no reader lets such a face through. Gives how many still are.
pub(super) fn mend(mesh: &mut IndexedMesh, before: &[DVec3]) -> usize {
    loop {
        let at = |f: &[u32; 3]| f.map(|n| mesh.positions[n as usize]);
        let is_flat = |f: &&[u32; 3]| matches!(at(f), [a, b, c] if collinear(a, b, c));
        let flat: Vec<[u32; 3]> = mesh.faces.iter().filter(is_flat).copied().collect();
        let moved = |n: &&u32| mesh.positions[**n as usize] != before[**n as usize];
        let back: Vec<u32> = flat.as_flattened().iter().filter(moved).copied().collect();
        if back.is_empty() {
            return flat.len();
        }
        back.into_iter().for_each(|n| mesh.positions[n as usize] = before[n as usize]);
    }
}

fn diagonal(mesh: &IndexedMesh) -> f64 {
    let all = mesh.positions.iter().copied();
    let low = all.clone().fold(DVec3::INFINITY, DVec3::min);
    low.distance(all.fold(DVec3::NEG_INFINITY, DVec3::max))
}
