//! The target `paint`: which faces lie around a line, and where, against brute force on skins that unroll.
//!
//! The skin is a sheet of exact rows and columns, flat or folded along its columns by angles whose sines are rational (3, 4, 5), so that how it lies when
//! it is unrolled is known from how it was made. The line is straight when unrolled too: across the folds at right angles, or anywhere on a flat sheet.
//! Then (s, d) of every corner is known in closed form, and so is the set of faces within a radius: those that can be reached from the
//! line over sides that are nearer than it. That set is collected here by going over all faces again and again until none is added.

use std::collections::BTreeSet;

use glam::{DVec2, DVec3};

use super::draw::Dice;
use super::trial::{Look, Trial};
use super::{Finding, Hits, Outcome, drive};
use crate::engine::wound::surface::{Placed, Walk, walk};
use crate::engine::wound::{CameraChange, Cut, Mode, Pick, WoundEvent};
use crate::mesh::{EdgeId, FaceId, Mesh};
use crate::recording::{InlineMesh, Recording, SceneRef};

/// Width of a column: every fold of (5, 0), (4, 3) or (3, 4) is as wide.
const WIDTH: f64 = 5.0;
/// Parts of the sheet's size that rounding may move a corner by.
const ROUNDING: f64 = 1e-9;

/// A sheet, where each node lies when it is unrolled, and a cut.
struct Case {
    mesh: InlineMesh,
    unrolled: Vec<DVec2>,
    picks: [Pick; 2],
    radius: f64,
    seed: u8,
}

pub(super) fn run(data: &[u8]) -> Outcome {
    Case::draw(&mut Dice::new(data)).judge()
}

impl Case {
    fn draw(dice: &mut Dice<'_>) -> Self {
        let (rows, columns) = (2 + dice.below(5), 1 + dice.below(6));
        let folded = dice.once_in(2);
        let mut sheet = Self {
            mesh: InlineMesh::default(),
            unrolled: Vec::new(),
            picks: [Pick::Node(crate::mesh::NodeId::NONE); 2],
            radius: 0.0,
            seed: dice.byte(),
        };
        sheet.make(rows, columns, folded, dice);
        sheet.picks = if folded { sheet.across(rows, columns, dice) } else { sheet.anywhere(dice) };
        sheet.radius = dice.one_of([0.5, 2.0, 4.0, 7.5, 15.0, 100.0]) * (0.5 + dice.inside());
        sheet
    }

    /// Rows of nodes at drawn distances, columns of one width, folded or not.
    fn make(&mut self, rows: usize, columns: usize, folded: bool, dice: &mut Dice<'_>) {
        let mut along = vec![[0.0, 0.0]];
        for _ in 0..columns {
            let [x, y] = along[along.len() - 1];
            let step = dice.one_of([[5.0, 0.0], [4.0, 3.0], [3.0, 4.0], [4.0, -3.0]]);
            let step = if folded { step } else { [WIDTH, 0.0] };
            along.push([x + step[0], y + step[1]]);
        }
        let mut z = 0.0;
        for _ in 0..=rows {
            for (column, [x, y]) in along.iter().enumerate() {
                self.mesh.nodes.push([*x, *y, z]);
                self.unrolled.push(DVec2::new(WIDTH * column as f64, -z));
            }
            z += dice.one_of([1.0, 2.0, 0.5, 3.0]);
        }
        let id = |i: usize, j: usize| (i * (columns + 1) + j) as u32;
        for i in 0..rows {
            for j in 0..columns {
                let [a, b, c, d] = [id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)];
                let halves = if dice.once_in(2) { [[a, b, d], [b, c, d]] } else { [[a, b, c], [a, c, d]] };
                self.mesh.faces.extend(halves);
            }
        }
        let uv = |p: &DVec2| [p.x as f32 / 64.0, p.y as f32 / 64.0 + 1.0];
        self.mesh.uv = self.unrolled.iter().map(uv).collect();
    }

    /// Between two nodes of one row: the section is the row itself.
    fn across(&self, rows: usize, columns: usize, dice: &mut Dice<'_>) -> [Pick; 2] {
        let (row, from) = (dice.below(rows + 1), dice.below(columns));
        let to = from + 1 + dice.below(columns - from);
        let node = |column: usize| Pick::Node(crate::mesh::NodeId::of(row * (columns + 1) + column));
        if dice.once_in(2) { [node(to), node(from)] } else { [node(from), node(to)] }
    }

    /// Anywhere in or on two faces of a flat sheet.
    fn anywhere(&self, dice: &mut Dice<'_>) -> [Pick; 2] {
        [(); 2].map(|()| {
            let face = dice.below(self.mesh.faces.len());
            let [u, v] =
                dice.one_of([[0.25, 0.25], [0.5, 0.25], [0.0, 0.5], [0.25, 0.0], [0.125, 0.75], [1.0, 0.0]]);
            Pick::Face(FaceId::of(face), u, v)
        })
    }

    fn recording(&self) -> Recording<WoundEvent> {
        let blank = Trial::blank(SceneRef::Inline(self.mesh.clone()), u64::from(self.seed));
        let [from, to] = self.picks;
        let above = CameraChange { azimuth: Some(0.0), zenith: Some(0.0), distance: Some(256.0) };
        let events = [WoundEvent::Camera(above), WoundEvent::Mode(Mode::Patch), WoundEvent::Cut { from, to }];
        let keyed = (0..).zip(events).map(|(key, event)| crate::recording::Keyed { key, event });
        blank.with_events(keyed.collect())
    }

    /// What the other oracles find leads to itself as a recording. What is found here does not: no recording has such an eye or radius.
    fn judge(&self) -> Result<Hits, Box<Finding>> {
        let mut hits = super::trial::judge(&self.recording())?;
        let Some(trial) = Trial::begin(self.recording().with_events(Vec::new()), Look::Nothing) else {
            return Err(Finding::new("scene", "a drawn sheet is refused"));
        };
        let mut state = trial.state;
        state.control.mode = Mode::Patch;
        let [from, to] = self.picks;
        // The eye over the line's own middle, so that the plane is upright whatever the folds.
        let eye = self.eye();
        let ran = drive::run(&mut state, &WoundEvent::Cut { from, to }, 0, Some(eye));
        let Some(cut) = ran.applied() else { return Ok(hits) };
        self.compare(&state.mesh, cut, &mut hits)?;
        Ok(hits)
    }

    fn eye(&self) -> DVec3 {
        let middle = self.picks.map(|pick| match pick {
            Pick::Node(n) => DVec3::from(self.mesh.nodes[n.at()]),
            _ => DVec3::ZERO,
        });
        DVec3::new(middle[0].x, 256.0, middle[0].z)
    }

    fn compare(&self, mesh: &Mesh, cut: &Cut, hits: &mut Hits) -> Result<(), Box<Finding>> {
        let (Some(length), false) = (cut.arc.last().copied(), cut.links.is_empty()) else { return Ok(()) };
        let chain = &cut.formed.chain;
        let at = |p: &crate::engine::wound::chain::Point| self.place(mesh, p);
        let [Some(first), Some(last)] = [chain.points.first(), chain.points.last()].map(|p| p.map(at)) else {
            return Ok(());
        };
        let frame = Frame::new(first, last);
        let size = self.unrolled.iter().map(|p| p.distance(first)).fold(0.0, f64::max);
        if (first.distance(last) - length).abs() > ROUNDING * size {
            return Err(Finding::new(
                "paint-straight",
                format!("the line is {length} long, not {}", first.distance(last)),
            ));
        }
        hits.note("oracle paint");
        let found = walk(mesh, chain, &cut.links, length, self.radius);
        self.coordinates(mesh, &found, &frame, size)?;
        self.gathered(mesh, cut, &found, &frame, size)
    }

    /// Where a point of the line lies when the sheet is unrolled.
    fn place(&self, mesh: &Mesh, point: &crate::engine::wound::chain::Point) -> DVec2 {
        let faces = (0..mesh.face_count()).map(FaceId::of);
        let face = faces.into_iter().find(|&f| point.touches(mesh, f)).unwrap_or(FaceId(0));
        let weights = point.weights_in(mesh, face);
        (0..3).map(|i| self.unrolled[mesh.face(face).nodes[i].at()] * weights[i]).sum()
    }

    fn coordinates(&self, mesh: &Mesh, found: &Walk, frame: &Frame, size: f64) -> Result<(), Box<Finding>> {
        for placed in &found.faces {
            for (node, at) in mesh.face(placed.face).nodes.into_iter().zip(placed.at) {
                let expected = frame.at(self.unrolled[node.at()]);
                if expected.distance(at) > ROUNDING * size {
                    let detail = format!("{node} of {} lies at {at}, unrolled at {expected}", placed.face);
                    return Err(Finding::new("paint-coordinates", detail));
                }
            }
        }
        Ok(())
    }

    /// Exactly the faces that can be reached, but for those at the radius itself.
    fn gathered(
        &self,
        mesh: &Mesh,
        cut: &Cut,
        found: &Walk,
        frame: &Frame,
        size: f64,
    ) -> Result<(), Box<Finding>> {
        let found: BTreeSet<FaceId> = found.faces.iter().map(|placed: &Placed| placed.face).collect();
        let slack = ROUNDING * size;
        let least = self.reached(mesh, cut, frame, self.radius - slack);
        let most = self.reached(mesh, cut, frame, self.radius + slack);
        match (least.difference(&found).next(), found.difference(&most).next()) {
            (Some(face), _) => {
                Err(Finding::new("paint-gathered", format!("{face} is within the radius and not found")))
            }
            (_, Some(face)) => {
                Err(Finding::new("paint-gathered", format!("{face} is found and not within the radius")))
            }
            _ => Ok(()),
        }
    }

    /// The faces that can be reached from the line's own over sides that are no farther from the line.
    fn reached(&self, mesh: &Mesh, cut: &Cut, frame: &Frame, radius: f64) -> BTreeSet<FaceId> {
        let mut reached: BTreeSet<FaceId> = cut.links.iter().map(|link| link.face).collect();
        loop {
            let before = reached.len();
            for (e, edge) in mesh.edges().iter().enumerate() {
                let beside = edge.faces.into_iter().filter_map(FaceId::some);
                if beside.clone().any(|f| reached.contains(&f))
                    && self.distance(mesh, EdgeId::of(e), frame) <= radius
                {
                    reached.extend(beside);
                }
            }
            if reached.len() == before {
                return reached;
            }
        }
    }

    /// From the line to an edge, by halving where the distance may be least: it is convex along the edge.
    fn distance(&self, mesh: &Mesh, edge: EdgeId, frame: &Frame) -> f64 {
        let [a, b] = mesh.edge(edge).nodes.map(|n| frame.at(self.unrolled[n.at()]));
        let away = |t: f64| {
            let p = a + (b - a) * t;
            p.distance(DVec2::new(p.x.clamp(0.0, frame.length), 0.0))
        };
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..100 {
            let [left, right] = [low + (high - low) / 3.0, high - (high - low) / 3.0];
            if away(left) <= away(right) { high = right } else { low = left }
        }
        away(low).min(away(high)).min(away(0.0)).min(away(1.0))
    }
}

/// The line on the unrolled sheet: along it and to its left.
struct Frame {
    origin: DVec2,
    along: DVec2,
    length: f64,
}

impl Frame {
    fn new(from: DVec2, to: DVec2) -> Self {
        let length = from.distance(to);
        Self { origin: from, along: (to - from) / length, length }
    }

    fn at(&self, point: DVec2) -> DVec2 {
        let from = point - self.origin;
        DVec2::new(from.dot(self.along), self.along.perp_dot(from))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::Random;

    #[test]
    fn sheets_unroll_as_they_were_made() {
        let (mut random, mut hits) = (Random::of(1, 0, "paint"), Hits::default());
        for _ in 0..60 {
            let bytes: Vec<u8> = (0..96).map(|_| random.any() as u8).collect();
            hits.add(&run(&bytes).expect("no finding"));
        }
        assert!(hits.0["oracle paint"] > 20, "{hits:?}");
    }
}
