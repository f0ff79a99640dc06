//! How wide a cut gapes, and how that is spread over the neighbourhood (Lam 2016, §4.3.1.1).
//!
//! With L and d in centimetres, the cut opening displacement is
//!
//! ```text
//! d        = clamp(L / 5, 0.1, 1)
//! k        = (d − 0.1) / 0.02
//! COD(L,d) = (0.0111 + 0.0002 k) ln L + 0.0415 + 0.0015 k
//! width(s) = COD · m(s),   m(s) = 4 s (L − s) / L²
//! ```
//!
//! The thesis moves the rims alone, and a face thinner than the opening folds over. Here the opening is a displacement of the tissue: a
//! point beside the line at distance r from it moves along û, away from the plane, by half the width at the nearest point of the line times
//! (1 − r/ρ). With ρ at least four times the COD this squeezes nothing to less than 7/8 of its size; where the triangles are larger
//! than ρ, and one still turns over, ρ grows, and if that does not help the opening narrows where it would.

use std::cmp::Ordering;
use std::collections::hash_map::Entry;
use std::ops::RangeInclusive;

use glam::DVec3;
use rustc_hash::FxHashMap;

use super::slit::Slit;
use super::{Carved, Opened, Place, arc_lengths, least};
use crate::engine::wound::merge::{Line, face_box};
use crate::geometry::predicates::facing;
use crate::mesh::{FaceId, NodeId};
use crate::report::Rejection;

/// How far the opening is spread, in CODs; the next is tried where a face folds over.
const SPREADS: [f64; 4] = [4.0, 8.0, 16.0, 32.0];
/// How often the opening is halved where a face folds over before the cut is given up.
const HALVINGS: usize = 48;

/// Depth of a cut of length `length_cm`, cm.
pub fn depth_cm(length_cm: f64) -> f64 {
    (length_cm / 5.0).clamp(0.1, 1.0)
}

/// Opening of a cut in its middle, cm; negative for lengths so short that it does not gape.
pub fn cod_cm(length_cm: f64, depth_cm: f64) -> f64 {
    let k = (depth_cm - 0.1) / 0.02;
    (0.0111 + 0.0002 * k) * libm::log(length_cm) + 0.0415 + 0.0015 * k
}

/// The planned opening along a line.
pub struct Widths {
    length: f64,
    cod: f64,
    depth: f64,
    s: Vec<f64>,
    half: Vec<f64>,
    /// The part that opens: beyond it the width is less than what rounding leaves.
    pub range: RangeInclusive<usize>,
}

impl Widths {
    /// Plans the opening of a line.
    pub fn along(place: &Place<'_>, line: &Line) -> Result<Self, Rejection> {
        let s = arc_lengths(place.mesh, &line.nodes);
        let length = s[s.len() - 1];
        let length_cm = length * place.unit_cm;
        let depth = depth_cm(length_cm);
        let cod = cod_cm(length_cm, depth) / place.unit_cm;
        let short = |why: &str| {
            Err(Rejection::new(
                "too-short-to-open",
                format!("a cut of {length_cm:.3e} cm {why} (it would open by {cod:.3e})"),
            ))
        };
        if cod.is_nan() || cod < least(place.largest) {
            return short("does not gape");
        }
        let half: Vec<f64> =
            s.iter().map(|&s| 0.5 * cod * 4.0 * s * (length - s) / (length * length)).collect();
        let opens = |h: &f64| 2.0 * h >= least(place.largest);
        let (Some(first), Some(last)) = (half.iter().position(opens), half.iter().rposition(opens)) else {
            return short("opens nowhere");
        };
        let depth = depth / place.unit_cm;
        Ok(Self { length, cod, depth, s, half, range: first - 1..=last + 1 })
    }

    /// The incision before anything moved.
    pub fn start(self, line: Line, slit: &Slit) -> Carved {
        let (start, end) = (*self.range.start(), *self.range.end());
        let opened = (start..=end).map(|i| Opened {
            at: DVec3::ZERO,
            s: self.s[i],
            left: slit.left[i - start],
            right: slit.right[i - start],
            bottom: slit.left[i - start],
            half_width: if i == start || i == end { 0.0 } else { self.half[i] },
            depth: self.depth,
        });
        let half = self.length * 0.5;
        let nearest = |&a: &usize, &b: &usize| (self.s[a] - half).abs().total_cmp(&(self.s[b] - half).abs());
        let middle = (start..=end).min_by(nearest).unwrap_or(start) - start;
        let (length, cod, depth) = (self.length, self.cod, self.depth);
        Carved { opened: opened.collect(), line, length, cod, depth, middle, ..Carved::default() }
    }
}

/// A node near the line: where along it, and how much of the opening reaches it.
#[derive(Clone, Copy, Debug)]
struct Near {
    node: NodeId,
    /// Where it was before the opening.
    from: DVec3,
    /// Place among the opened nodes: index and fraction towards the next.
    along: (usize, f64),
    /// From −1, all of it to the right, to 1, all of it to the left.
    share: f64,
}

/// An opening that can still be narrowed.
pub struct Opening {
    spread: Spread,
    left: DVec3,
    planned: Vec<f64>,
    /// What is left of each node's planned width.
    share: Vec<f64>,
}

impl Opening {
    /// Moves the rims apart, and the neighbourhood with them.
    pub fn make(place: &mut Place<'_>, carved: &mut Carved) -> Result<Self, Rejection> {
        for o in &mut carved.opened {
            o.at = place.mesh.position(o.left);
        }
        let left = left_direction(place, carved);
        let planned = carved.opened.iter().map(|o| o.half_width).collect();
        let share = vec![1.0; carved.opened.len()];
        let spread = Spread::fitting(place, carved, left);
        carved.stretched = spread.faces.iter().map(|&(f, _)| (f, place.mesh.triangle(f))).collect();
        let mut opening = Self { spread, left, planned, share };
        opening.settle(place, carved)?;
        Ok(opening)
    }

    /// Narrows the opening to a quarter at some nodes.
    pub fn narrow(
        &mut self,
        place: &mut Place<'_>,
        carved: &mut Carved,
        nodes: &[usize],
    ) -> Result<(), Rejection> {
        nodes.iter().for_each(|&i| self.share[i] *= 0.25);
        self.settle(place, carved)
    }

    /// Halves the opening wherever a face would fold over, until none does, and moves what is to move.
    fn settle(&mut self, place: &mut Place<'_>, carved: &mut Carved) -> Result<(), Rejection> {
        for round in 0..=HALVINGS {
            for (o, (planned, share)) in carved.opened.iter_mut().zip(self.planned.iter().zip(&self.share)) {
                o.half_width = planned * share;
            }
            let faults = self.spread.faults(carved, self.left);
            let Some(first) = faults.first() else { break };
            if round == HALVINGS {
                let detail = format!("{} folds over however little the cut opens", first.0);
                return Err(Rejection::new("fold", detail));
            }
            let mut blamed: Vec<usize> = faults.iter().flat_map(|f| f.1.iter().copied()).collect();
            blamed.sort_unstable();
            blamed.dedup();
            blamed.into_iter().for_each(|i| self.share[i] *= 0.5);
        }
        carved.narrowed = self.share.iter().filter(|&&n| n < 1.0).count();
        if carved.opened.iter().any(|o| o.left != o.right && 2.0 * o.half_width < least(place.largest)) {
            return Err(Rejection::new("fold", "the tissue beside the line is too narrow for it to open"));
        }
        self.spread.apply(place, carved, self.left);
        Ok(())
    }
}

/// The direction in which the left rim moves: û or −û, as the faces beside the line lie.
fn left_direction(place: &Place<'_>, carved: &Carved) -> DVec3 {
    let unit = place.plane.unit();
    let tilt = carved.opened.windows(2).fold(0.0, |sum, pair| {
        let tangent = pair[1].at - pair[0].at;
        let edge = place.mesh.edge_between(pair[0].left, pair[1].left);
        let faces = edge.map_or([FaceId::NONE; 2], |e| place.mesh.edge(e).faces);
        let normals = faces.into_iter().filter_map(FaceId::some).map(|f| {
            let [a, b, c] = place.mesh.triangle(f);
            (b - a).cross(c - a).normalize_or_zero()
        });
        sum + normals.fold(DVec3::ZERO, |n, m| n + m).cross(tangent).dot(unit)
    });
    if tilt < 0.0 { -unit } else { unit }
}

/// The nodes that an opening moves, and the faces that hang on them.
#[derive(Default)]
struct Spread {
    near: Vec<Near>,
    /// Each face at a moved node as it lies before the opening, with the places of its corners in `near` (`usize::MAX` for those that
    /// stay).
    faces: Vec<(FaceId, [usize; 3])>,
    closed: Vec<[DVec3; 3]>,
}

impl Spread {
    /// The smallest spread that folds nothing over, or else the one that folds over least.
    fn fitting(place: &Place<'_>, carved: &Carved, left: DVec3) -> Self {
        let mut best: Option<(usize, Self)> = None;
        for factor in SPREADS {
            let spread = Self::over(place, carved, factor * carved.cod, left);
            let folded = spread.faults(carved, left).len();
            if best.as_ref().is_none_or(|b| folded < b.0) {
                best = Some((folded, spread));
            }
            if folded == 0 {
                break;
            }
        }
        best.map(|b| b.1).unwrap_or_default()
    }

    /// Walks over the surface from both rims, as far as `radius` from the line.
    fn over(place: &Place<'_>, carved: &Carved, radius: f64, left: DVec3) -> Self {
        let mut spread = Self::default();
        let mut at: FxHashMap<NodeId, usize> = FxHashMap::default();
        let inner = 1..carved.opened.len() - 1;
        for side in [1.0, -1.0] {
            for i in inner.clone() {
                let o = &carved.opened[i];
                let node = if side > 0.0 { o.left } else { o.right };
                at.insert(node, spread.near.len());
                let from = place.mesh.position(node);
                spread.near.push(Near { node, from, along: (i, 0.0), share: side });
            }
        }
        for end in [0, carved.opened.len() - 1] {
            at.insert(carved.opened[end].left, usize::MAX);
        }
        let mut next = 0;
        while next < spread.near.len() {
            let from = spread.near[next];
            next += 1;
            for (face, corner) in place.mesh.fan(from.node) {
                for node in [1, 2].map(|k| place.mesh.face(face).nodes[(corner + k) % 3]) {
                    if let Entry::Vacant(entry) = at.entry(node) {
                        let reached = spread.reach(place, carved, radius, left, node, from.along);
                        entry.insert(if reached { spread.near.len() - 1 } else { usize::MAX });
                    }
                }
            }
        }
        spread.collect_faces(place, &at);
        spread
    }

    /// Adds a node if it is near enough to the line to move.
    fn reach(
        &mut self,
        place: &Place<'_>,
        carved: &Carved,
        radius: f64,
        left: DVec3,
        node: NodeId,
        guess: (usize, f64),
    ) -> bool {
        let position = place.mesh.position(node);
        let (along, distance) = nearest(&carved.opened, position, guess.0);
        let share = 1.0 - distance / radius;
        let side = match place.plane.side_of(place.mesh, node) {
            Ordering::Equal => 0.0,
            Ordering::Greater => 1.0,
            Ordering::Less => -1.0,
        };
        // A node on the plane stays; so does the boundary, which is not the cut's to move.
        if share <= 0.0 || side == 0.0 || place.mesh.is_boundary_node(node) {
            return false;
        }
        let share = share * side * left.dot(place.plane.unit()).signum();
        self.near.push(Near { node, from: position, along, share });
        true
    }

    fn collect_faces(&mut self, place: &Place<'_>, at: &FxHashMap<NodeId, usize>) {
        let mut faces: Vec<FaceId> =
            self.near.iter().flat_map(|n| place.mesh.fan(n.node).map(|(f, _)| f)).collect();
        faces.sort_unstable();
        faces.dedup();
        let corner = |n: NodeId| at.get(&n).copied().unwrap_or(usize::MAX);
        self.faces = faces.into_iter().map(|f| (f, place.mesh.face(f).nodes.map(corner))).collect();
        self.closed = self.faces.iter().map(|f| place.mesh.triangle(f.0)).collect();
    }

    /// How far each node moves.
    fn shifts(&self, carved: &Carved, left: DVec3) -> Vec<DVec3> {
        let half = |k: usize| carved.opened.get(k).map_or(0.0, |o| o.half_width);
        let shift = |n: &Near| {
            left * (n.share * (half(n.along.0) * (1.0 - n.along.1) + half(n.along.0 + 1) * n.along.1))
        };
        self.near.iter().map(shift).collect()
    }

    /// The faces that would fold over, and the opened nodes whose opening is to blame.
    fn faults(&self, carved: &Carved, left: DVec3) -> Vec<(FaceId, Vec<usize>)> {
        let shifts = self.shifts(carved, left);
        let folds = |(&(face, corners), old): (&(FaceId, [usize; 3]), &[DVec3; 3])| {
            let new = [0, 1, 2].map(|k| old[k] + shifts.get(corners[k]).copied().unwrap_or(DVec3::ZERO));
            (facing(*old, new) != Ordering::Greater).then(|| (face, self.blame(carved, &corners)))
        };
        self.faces.iter().zip(&self.closed).filter_map(folds).collect()
    }

    fn blame(&self, carved: &Carved, corners: &[usize; 3]) -> Vec<usize> {
        let last = carved.opened.len() - 1;
        let places =
            corners.iter().filter_map(|&c| self.near.get(c)).flat_map(|n| [n.along.0, n.along.0 + 1]);
        places.filter(|&k| k > 0 && k < last).collect()
    }

    fn apply(&self, place: &mut Place<'_>, carved: &mut Carved, left: DVec3) {
        let rims = 2 * (carved.opened.len() - 2);
        carved.moved.clear();
        for (i, (near, shift)) in self.near.iter().zip(self.shifts(carved, left)).enumerate() {
            let to = near.from + shift;
            if i >= rims && to != near.from {
                carved.moved.push((near.node, near.from));
            }
            if place.mesh.position(near.node) != to {
                place.mesh.set_position(near.node, to);
            }
        }
        let mesh = &*place.mesh;
        place.bvh.update(self.faces.iter().map(|f| f.0.0), &|f| face_box(mesh, f));
    }
}

/// The nearest place of the line to a point, looked for downhill from a guess: index, fraction towards the next, and the distance.
fn nearest(opened: &[Opened], point: DVec3, guess: usize) -> ((usize, f64), f64) {
    let last = opened.len() - 2;
    let on = |k: usize| {
        let (a, b) = (opened[k].at, opened[k + 1].at);
        let t = ((point - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
        let t = if t.is_nan() { 0.0 } else { t };
        (t, point.distance(a + (b - a) * t))
    };
    let mut k = guess.min(last);
    let mut best = on(k);
    loop {
        let candidates = [k.wrapping_sub(1), k + 1].into_iter().filter(|&j| j <= last).map(|j| (j, on(j)));
        match candidates.filter(|(_, c)| c.1 < best.1).min_by(|a, b| a.1.1.total_cmp(&b.1.1)) {
            Some((j, better)) => (k, best) = (j, better),
            None => return ((k, best.0), best.1),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_opening_follows_the_formula_of_the_source() {
        // Lam 2016, §4.3.1.1: the measured rows at depths of 0.06, 0.08 and 0.10 cm.
        for (depth, slope, offset) in [(0.06, 0.0107, 0.0385), (0.08, 0.0109, 0.0400), (0.10, 0.0111, 0.0415)]
        {
            for length in [0.05, 0.3, 2.0] {
                let expected = slope * libm::log(length) + offset;
                assert!((cod_cm(length, depth) - expected).abs() < 1e-15, "{length} {depth}");
            }
        }
        assert!(cod_cm(0.02, depth_cm(0.02)) < 0.0);
        assert_eq!([0.1, 2.0, 50.0].map(depth_cm), [0.1, 0.4, 1.0]);
    }
}
