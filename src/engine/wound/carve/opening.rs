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
//! point beside the line at distance r from it moves along û, with the rim that it hangs on, by half the width at the nearest point of the
//! line times (1 − r/ρ). With ρ at least four times the COD this squeezes nothing to less than 7/8 of its size; where the triangles are larger
//! than ρ, and one still turns over, ρ grows, and if that does not help the opening narrows where it would.

use std::cmp::Ordering;
use std::collections::hash_map::Entry;
use std::ops::RangeInclusive;

use glam::DVec3;
use rustc_hash::FxHashMap;

use super::slit::Slit;
use super::{Carved, Obstacle, Opened, Place, arc_lengths, least};
use crate::engine::wound::merge::{Line, face_box};
use crate::geometry::predicates::facing;
use crate::mesh::{FaceId, NodeId};
use crate::report::Rejection;

/// How far the opening is spread, in CODs; the next is tried where a face folds over.
const SPREADS: [f64; 4] = [4.0, 8.0, 16.0, 32.0];
/// How often the opening is halved where a face folds over before the cut is given up.
const HALVINGS: usize = 48;
/// How often the faces that fold over are straightened before the opening narrows.
const STRAIGHTENINGS: usize = 24;
/// How fast a narrowed opening may change along the line, in half widths a length.
const STEEPEST: f64 = 0.25;

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
    /// Depth that the gutter is to have, model units.
    pub depth: f64,
    s: Vec<f64>,
    half: Vec<f64>,
    /// The part that opens: beyond it the width is less than what rounding leaves, or there is no room.
    pub range: RangeInclusive<usize>,
    closed: usize,
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
                format!(
                    "a cut of {length_cm:.3e} cm {why} (it would open by {cod:.3e}); a model unit is {} cm here",
                    place.unit_cm
                ),
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
        Ok(Self { length, cod, depth, s, half, range: first - 1..=last + 1, closed: 0 })
    }

    /// Leaves some opened nodes closed and keeps the longest part between them; `None` if there is nothing left to open.
    pub fn close(&mut self, nodes: Vec<usize>) -> Option<()> {
        let (start, end) = (*self.range.start(), *self.range.end());
        let mut stops: Vec<usize> =
            nodes.into_iter().map(|i| start + i).filter(|i| (start + 1..end).contains(i)).collect();
        if stops.is_empty() {
            return None;
        }
        stops.extend([start, end]);
        stops.sort_unstable();
        stops.dedup();
        let parts = stops.windows(2).filter(|w| w[1] - w[0] >= 2);
        let longest =
            parts.max_by(|a, b| (self.s[a[1]] - self.s[a[0]]).total_cmp(&(self.s[b[1]] - self.s[b[0]])))?;
        self.closed += (end - start) - (longest[1] - longest[0]);
        self.range = longest[0]..=longest[1];
        // Towards a place that stays closed the opening tapers.
        for i in self.range.clone() {
            let reach = (self.s[i] - self.s[longest[0]]).min(self.s[longest[1]] - self.s[i]);
            self.half[i] = self.half[i].min(STEEPEST * reach);
        }
        Some(())
    }

    /// The incision before anything moved.
    pub fn start(&self, line: Line, slit: &Slit) -> Carved {
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
        Carved {
            opened: opened.collect(),
            line,
            length,
            cod,
            depth,
            middle,
            closed: self.closed,
            ..Carved::default()
        }
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
}

impl Opening {
    /// Moves the rims apart, and the neighbourhood with them.
    pub(super) fn make(place: &mut Place<'_>, carved: &mut Carved) -> Result<Self, Obstacle> {
        for o in &mut carved.opened {
            o.at = place.mesh.position(o.left);
        }
        let left = left_direction(place, carved);
        let planned = carved.opened.iter().map(|o| o.half_width).collect();
        let spread = Spread::fitting(place, carved, left);
        carved.moved =
            spread.near[2 * (carved.opened.len() - 2)..].iter().map(|n| (n.node, n.from)).collect();
        carved.stretched = spread.faces.iter().map(|&(f, _)| (f, place.mesh.triangle(f))).collect();
        let mut opening = Self { spread, left, planned };
        opening.settle(place, carved)?;
        Ok(opening)
    }

    /// Narrows the opening to a quarter at some nodes.
    pub(super) fn narrow(
        &mut self,
        place: &mut Place<'_>,
        carved: &mut Carved,
        nodes: &[usize],
    ) -> Result<(), Obstacle> {
        self.shrink(carved, nodes, 0.25);
        self.settle(place, carved)
    }

    /// Narrows the opening at some nodes, and around them so far that it stays smooth: where the width changes faster than the
    /// place, the change itself would fold faces over.
    fn shrink(&self, carved: &mut Carved, nodes: &[usize], factor: f64) {
        nodes.iter().for_each(|&i| carved.opened[i].half_width *= factor);
        for &i in nodes {
            let (at, half) = (carved.opened[i].at, carved.opened[i].half_width);
            for o in &mut carved.opened {
                o.half_width = o.half_width.min(half + STEEPEST * at.distance(o.at));
            }
        }
    }

    /// Makes the opening such that no face folds over, and moves what is to move.
    ///
    /// A sliver folds over where the displacement bends along it: it is straightened first. Where that does not help the opening narrows.
    fn settle(&mut self, place: &mut Place<'_>, carved: &mut Carved) -> Result<(), Obstacle> {
        let mut blamed = Vec::new();
        for _ in 0..=HALVINGS {
            let mut shifts = self.spread.shifts(carved);
            let faults = self.spread.straighten(carved, self.left, &mut shifts);
            if faults.is_empty() {
                return self.finish(place, carved, &shifts);
            }
            blamed = faults.iter().flat_map(|&f| self.spread.blame(carved, f)).collect();
            blamed.sort_unstable();
            blamed.dedup();
            self.shrink(carved, &blamed, 0.5);
        }
        let why = Rejection::new("fold", "a face beside the line folds over however little the cut opens");
        Err(Obstacle { nodes: blamed, why })
    }

    fn finish(&self, place: &mut Place<'_>, carved: &mut Carved, shifts: &[f64]) -> Result<(), Obstacle> {
        let narrower =
            carved.opened.iter().zip(&self.planned).filter(|(o, planned)| o.half_width != **planned);
        carved.narrowed = narrower.count();
        carved.middle_narrowed = carved.opened[carved.middle].half_width != self.planned[carved.middle];
        let too_narrow = |o: &Opened| o.left != o.right && 2.0 * o.half_width < least(place.largest);
        let nodes: Vec<usize> = (0..carved.opened.len()).filter(|&i| too_narrow(&carved.opened[i])).collect();
        if !nodes.is_empty() {
            let why = Rejection::new("fold", "the tissue beside the line is too narrow for it to open");
            return Err(Obstacle { nodes, why });
        }
        self.spread.apply(place, self.left, shifts);
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
            let spread = Self::over(place, carved, factor * carved.cod);
            let folded = spread.faults(left, &spread.shifts(carved)).len();
            if best.as_ref().is_none_or(|b| folded < b.0) {
                best = Some((folded, spread));
            }
            if folded == 0 {
                break;
            }
        }
        best.map(|b| b.1).unwrap_or_default()
    }

    /// Walks over the surface from both rims at once, as far as `radius` from the line. Which side a node belongs to is which rim reaches it,
    /// not which side of the plane it is on: a fold of an earlier cut that crosses the plane beside the line must not be torn.
    fn over(place: &Place<'_>, carved: &Carved, radius: f64) -> Self {
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
                        let reached = spread.reach(place, carved, radius, node, from);
                        entry.insert(if reached { spread.near.len() - 1 } else { usize::MAX });
                    }
                }
            }
        }
        spread.collect_faces(place, &at);
        spread
    }

    /// Adds a node, reached from one that moves, if it is near enough to the line to move too; to the same side.
    fn reach(&mut self, place: &Place<'_>, carved: &Carved, radius: f64, node: NodeId, from: Near) -> bool {
        let position = place.mesh.position(node);
        let (along, distance) = nearest(&carved.opened, position, from.along.0);
        let share = (1.0 - distance / radius) * from.share.signum();
        // The boundary is not the cut's to move.
        if distance >= radius || place.mesh.is_boundary_node(node) {
            return false;
        }
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

    /// How far each node moves to the left.
    fn shifts(&self, carved: &Carved) -> Vec<f64> {
        let half = |k: usize| carved.opened.get(k).map_or(0.0, |o| o.half_width);
        let shift =
            |n: &Near| n.share * (half(n.along.0) * (1.0 - n.along.1) + half(n.along.0 + 1) * n.along.1);
        self.near.iter().map(shift).collect()
    }

    /// The faces that fold over, as indices into `faces`.
    fn faults(&self, left: DVec3, shifts: &[f64]) -> Vec<usize> {
        (0..self.faces.len()).filter(|&f| self.folds(left, shifts, f)).collect()
    }

    fn folds(&self, left: DVec3, shifts: &[f64], face: usize) -> bool {
        let (old, corners) = (self.closed[face], self.faces[face].1);
        let new = [0, 1, 2].map(|k| old[k] + left * shifts.get(corners[k]).copied().unwrap_or(0.0));
        facing(old, new) != Ordering::Greater
    }

    /// Moves the apex of each face that folds over with its base, as if they were one stiff piece, until no face folds over or it does not
    /// help; gives the faces that still do. A rim's node takes its partner with it.
    fn straighten(&self, carved: &mut Carved, left: DVec3, shifts: &mut [f64]) -> Vec<usize> {
        let mut faults = self.faults(left, shifts);
        for _ in 0..STRAIGHTENINGS {
            if faults.is_empty() {
                break;
            }
            faults.iter().for_each(|&f| self.stiffen(carved, shifts, f));
            faults = self.faults(left, shifts);
        }
        faults
    }

    fn stiffen(&self, carved: &mut Carved, shifts: &mut [f64], face: usize) {
        let (at, corners) = (self.closed[face], self.faces[face].1);
        let base = |k: usize| at[(k + 1) % 3].distance_squared(at[(k + 2) % 3]);
        let apex = (0..3).fold(0, |best, k| if base(k) > base(best) { k } else { best });
        let (i, j) = ((apex + 1) % 3, (apex + 2) % 3);
        let t = ((at[apex] - at[i]).dot(at[j] - at[i]) / base(apex)).clamp(0.0, 1.0);
        let shift = |k: usize| shifts.get(corners[k]).copied().unwrap_or(0.0);
        let value = shift(i) * (1.0 - t) + shift(j) * t;
        let inner = carved.opened.len() - 2;
        let Some(slot) = shifts.get_mut(corners[apex]) else { return };
        if corners[apex] >= 2 * inner {
            *slot = value;
        } else if value * self.near[corners[apex]].share > 0.0 {
            let i = corners[apex] % inner;
            carved.opened[i + 1].half_width = value.abs();
            (shifts[i], shifts[inner + i]) = (value.abs(), -value.abs());
        }
    }

    /// The opened nodes whose opening moves a face.
    fn blame(&self, carved: &Carved, face: usize) -> Vec<usize> {
        let last = carved.opened.len() - 1;
        let near = self.faces[face].1.iter().filter_map(|&c| self.near.get(c));
        near.flat_map(|n| [n.along.0, n.along.0 + 1]).filter(|&k| k > 0 && k < last).collect()
    }

    fn apply(&self, place: &mut Place<'_>, left: DVec3, shifts: &[f64]) {
        for (near, shift) in self.near.iter().zip(shifts) {
            let to = near.from + left * *shift;
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
