//! Meshes, and a driver that runs a cut through all stages and looks at every invariant.

use std::collections::BTreeMap;

use glam::{DVec3, Vec2};

use crate::canvas::look::Look;
use crate::engine::wound::carve::Carved;
use crate::engine::wound::chain::Chain;
use crate::engine::wound::{Cut, Mode, Pick, Scene, State, Work, Wound, WoundEvent};
use crate::engine::{Engine, Part, Start};
use crate::mesh::{IndexedMesh, Mesh};
use crate::report::{Outcome, Rejection};

/// A sphere: an icosahedron whose faces are divided `n` times.
pub(super) fn sphere(divisions: usize) -> IndexedMesh {
    let t = (1.0 + 5f64.sqrt()) / 2.0;
    let corners = [
        (-1.0, t, 0.0),
        (1.0, t, 0.0),
        (-1.0, -t, 0.0),
        (1.0, -t, 0.0),
        (0.0, -1.0, t),
        (0.0, 1.0, t),
        (0.0, -1.0, -t),
        (0.0, 1.0, -t),
        (t, 0.0, -1.0),
        (t, 0.0, 1.0),
        (-t, 0.0, -1.0),
        (-t, 0.0, 1.0),
    ];
    let mut positions: Vec<DVec3> =
        corners.iter().map(|&(x, y, z)| DVec3::new(x, y, z).normalize() * 10.0).collect();
    let mut faces: Vec<[u32; 3]> = vec![
        [0, 11, 5],
        [0, 5, 1],
        [0, 1, 7],
        [0, 7, 10],
        [0, 10, 11],
        [1, 5, 9],
        [5, 11, 4],
        [11, 10, 2],
        [10, 7, 6],
        [7, 1, 8],
        [3, 9, 4],
        [3, 4, 2],
        [3, 2, 6],
        [3, 6, 8],
        [3, 8, 9],
        [4, 9, 5],
        [2, 4, 11],
        [6, 2, 10],
        [8, 6, 7],
        [9, 8, 1],
    ];
    for _ in 0..divisions {
        let mut middles: BTreeMap<(u32, u32), u32> = BTreeMap::new();
        let mut middle = |a: u32, b: u32, positions: &mut Vec<DVec3>| {
            *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                positions.push((positions[a as usize] + positions[b as usize]).normalize() * 10.0);
                positions.len() as u32 - 1
            })
        };
        faces = faces
            .iter()
            .flat_map(|&[a, b, c]| {
                let (ab, bc, ca) = (
                    middle(a, b, &mut positions),
                    middle(b, c, &mut positions),
                    middle(c, a, &mut positions),
                );
                [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
            })
            .collect();
    }
    let uvs =
        positions.iter().map(|p| Vec2::new((p.x / 25.0 + 0.5) as f32, (p.y / 25.0 + 0.5) as f32)).collect();
    IndexedMesh { face_uvs: faces.clone(), positions, faces, uvs, ..IndexedMesh::default() }
}

/// A closed plate of n x n squares in the plane z = 0, two units wide each, facing +z, with a back at z = −4: exact coordinates.
pub(super) fn plate(n: u32) -> IndexedMesh {
    let mut mesh = IndexedMesh::default();
    let at = |i: u32, j: u32, back: u32| back * (n + 1) * (n + 1) + j * (n + 1) + i;
    for back in 0..2 {
        for j in 0..=n {
            for i in 0..=n {
                mesh.positions.push(DVec3::new(
                    2.0 * i as f64 - n as f64,
                    2.0 * j as f64 - n as f64,
                    -4.0 * back as f64,
                ));
            }
        }
    }
    let mut quad = |a, b, c, d| mesh.faces.extend([[a, b, c], [a, c, d]]);
    for j in 0..n {
        for i in 0..n {
            quad(at(i, j, 0), at(i + 1, j, 0), at(i + 1, j + 1, 0), at(i, j + 1, 0));
            quad(at(i, j, 1), at(i, j + 1, 1), at(i + 1, j + 1, 1), at(i + 1, j, 1));
        }
    }
    for i in 0..n {
        quad(at(i, 0, 1), at(i + 1, 0, 1), at(i + 1, 0, 0), at(i, 0, 0));
        quad(at(i, n, 0), at(i + 1, n, 0), at(i + 1, n, 1), at(i, n, 1));
        quad(at(0, i, 1), at(0, i, 0), at(0, i + 1, 0), at(0, i + 1, 1));
        quad(at(n, i, 0), at(n, i, 1), at(n, i + 1, 1), at(n, i + 1, 0));
    }
    mesh
}

/// An open sheet of n x n squares, each cut along its diagonal, with positions and texture coordinates by column and row.
pub(super) fn sheet(
    n: u32,
    position: impl Fn(u32, u32) -> DVec3,
    uv: impl Fn(u32, u32) -> Vec2,
) -> IndexedMesh {
    let at = |i: u32, j: u32| j * (n + 1) + i;
    let nodes = || (0..=n).flat_map(|j| (0..=n).map(move |i| (i, j)));
    let squares = (0..n).flat_map(|j| (0..n).map(move |i| (i, j)));
    let halves = |(i, j)| {
        let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        [[a, b, c], [a, c, d]]
    };
    let faces: Vec<[u32; 3]> = squares.flat_map(halves).collect();
    let positions = nodes().map(|(i, j)| position(i, j)).collect();
    let uvs = nodes().map(|(i, j)| uv(i, j)).collect();
    IndexedMesh { positions, face_uvs: faces.clone(), faces, uvs, ..IndexedMesh::default() }
}

/// A state that looks at a mesh from +z.
pub(super) fn state(mesh: &IndexedMesh) -> State {
    state_with(mesh, Look::default())
}

/// The same with a look.
pub(super) fn state_with(mesh: &IndexedMesh, look: Look) -> State {
    let scene = Scene {
        viewport: [640, 360],
        unit_cm: 1.0,
        snap_px: 0.0,
        fov_y: 0.6,
        target: None,
        azimuth: 0.0,
        zenith: std::f64::consts::FRAC_PI_2,
        distance: None,
        look,
        map_size: [1024; 2],
    };
    State::new(Mesh::build(mesh).unwrap(), scene)
}

/// Runs an event as the session does; every broken invariant is a panic. Gives the outcome and, for a rejection, its reason and detail.
pub(super) fn run(state: &mut State, event: &WoundEvent) -> (Outcome, String) {
    let mut work = match Wound::start(state, event, 0) {
        Start::Done(outcome) => return (outcome, String::new()),
        Start::Rejected(r) => return (Outcome::Rejected, format!("{}: {}", r.reason, r.detail)),
        Start::Run(work) => work,
    };
    match through_stages(state, &mut work, event) {
        Ok(()) => {
            Wound::commit(state, &mut work);
            (Outcome::Applied, String::new())
        }
        Err(r) => {
            Wound::rollback(state, &mut work);
            (Outcome::Rejected, format!("{}: {}", r.reason, r.detail))
        }
    }
}

fn through_stages(state: &mut State, work: &mut Work, event: &WoundEvent) -> Result<(), Rejection> {
    for stage in Wound::STAGES {
        if (stage.part)(work) != Part::Run {
            continue;
        }
        (stage.run)(state, work)?;
        let broken: Vec<_> = (stage.check)(state, work).into_iter().filter(|c| !c.ok).collect();
        assert!(broken.is_empty(), "{} of {event:?}: {broken:#?}", stage.id);
    }
    Ok(())
}

/// Runs work through its stages, which must apply.
pub(super) fn applied(state: &mut State, work: &mut Work, event: &WoundEvent) {
    if let Err(r) = through_stages(state, work, event) {
        panic!("{event:?} is rejected: {r:?}");
    }
}

/// A cut that must apply, with what its stages found out.
pub(super) fn cut_work(state: &mut State, from: Pick, to: Pick) -> Box<Cut> {
    let event = WoundEvent::Cut { from, to };
    let Start::Run(mut work) = Wound::start(state, &event, 0) else { panic!("{event:?} does not start") };
    applied(state, &mut work, &event);
    Wound::commit(state, &mut work);
    match work {
        Work::Cut(cut) => cut,
        Work::Subdivide { .. } => panic!("a cut is no subdivision"),
    }
}

/// A cut that is painted and not merged.
pub(super) fn painted(state: &mut State, from: Pick, to: Pick) -> Box<Cut> {
    let before = state.control.mode;
    mode(state, Mode::Patch);
    let cut = cut_work(state, from, to);
    mode(state, before);
    cut
}

/// FC's line of a cut that is not merged.
pub(super) fn formed(state: &mut State, from: Pick, to: Pick) -> Chain {
    painted(state, from, to).formed.chain
}

/// What CI did.
pub(super) fn carved(state: &mut State, from: Pick, to: Pick) -> Carved {
    cut_work(state, from, to).carved
}

pub(super) fn cut(state: &mut State, from: Pick, to: Pick) -> (Outcome, String) {
    run(state, &WoundEvent::Cut { from, to })
}

pub(super) fn mode(state: &mut State, mode: Mode) {
    run(state, &WoundEvent::Mode(mode));
}

/// The whole state must be sound.
pub(super) fn assert_sound(state: &State) {
    let broken: Vec<_> = Wound::check(state).into_iter().filter(|c| !c.ok).collect();
    assert!(broken.is_empty(), "{broken:#?}");
}

/// A small generator of pseudorandom numbers (splitmix64).
pub(super) struct Random(pub(super) u64);

impl Random {
    pub(super) fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    pub(super) fn below(&mut self, n: usize) -> usize {
        (self.next() % n as u64) as usize
    }

    /// In [0, 1).
    pub(super) fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }
}
