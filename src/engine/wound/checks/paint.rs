//! PP: the faces around the line are all there and no others, and they lie on the plane of (s, d) as the skin around the line does.

use glam::{DVec2, DVec3, Vec2};
use rustc_hash::{FxHashMap, FxHashSet};

use super::largest;
use crate::canvas::job::PaintJob;
use crate::canvas::look::Distance;
use crate::engine::wound::chain::At;
use crate::engine::wound::paint::{Corner, Painted};
use crate::engine::wound::state::{Cut, State};
use crate::geometry::distance_to_segment;
use crate::mesh::{EdgeId, FaceId, Mesh, Surface};
use crate::report::Check;

/// How far along the patch, from 0 to 1, and how far from its middle the line's points may be.
const SPAN_ERROR: f64 = 1e-4;
/// How far a distance may be off by the rounding of coordinates to f32, in lengths of the line.
const ROUNDING: f64 = 1e-5;

pub(in super::super) fn paint(state: &State, cut: &Cut) -> Vec<Check> {
    let (Some(painted), Some(patch)) = (&cut.painted, &cut.patch) else {
        return vec![Check::fail("gathered", "nothing is painted")];
    };
    let job = &painted.painting.paint;
    let mut checks = vec![finite(job)];
    // In the texture nothing is continuous, and distances are others: that is what it is there to show.
    if state.look.wound.distance == Distance::Surface || patch.density == 0.0 {
        let mesh = &state.mesh;
        checks.extend([
            spans(cut, job, painted),
            seams(painted),
            gathered(mesh, cut, painted),
            distant(mesh, cut, painted),
        ]);
    }
    checks
}

fn finite(job: &PaintJob) -> Check {
    let figures = [job.length, job.height, job.noise_scale, job.offset[0], job.offset[1]];
    let is_finite = |all: &[Vec2]| all.iter().all(|v| v.is_finite());
    let bad = job.faces.iter().find(|f| !is_finite(&f.uv) || !is_finite(&f.at));
    match (figures.iter().chain(&job.factor).all(|v| v.is_finite()), bad) {
        (false, _) => Check::fail("finite", "a figure of the painting is not finite"),
        (_, Some(face)) => Check::fail("finite", "a corner is nowhere").culprits([FaceId(face.face)]),
        _ => Check::pass("finite"),
    }
}

/// Along every link in skin there is a side of a painted part, with x from 0.025 to 0.975 and d = 0.
fn spans(cut: &Cut, job: &PaintJob, painted: &Painted) -> Check {
    let mut at: FxHashMap<(u32, [Corner; 2]), [Vec2; 2]> = FxHashMap::default();
    for (face, corners) in job.faces.iter().zip(&painted.corners) {
        for (i, j) in [(0, 1), (1, 2), (2, 0)] {
            at.insert((face.face, [corners[i], corners[j]]), [face.at[i], face.at[j]]);
            at.insert((face.face, [corners[j], corners[i]]), [face.at[j], face.at[i]]);
        }
    }
    let points = &cut.formed.chain.points;
    let steps: Vec<f64> = points.windows(2).map(|w| w[0].position.distance(w[1].position)).collect();
    let total: f64 = steps.iter().sum();
    let corner = |i: usize| match points[i].at {
        At::Node(node) => Corner::Node(node),
        _ => Corner::Point(i as u32),
    };
    let mut off = Vec::new();
    for link in &cut.links {
        let ends = [link.link, link.link + 1];
        let Some(found) = at.get(&(link.face.0, ends.map(corner))) else {
            return Check::fail("spans", format!("no part lies along link {}", link.link))
                .culprits([link.face]);
        };
        for (i, at) in ends.into_iter().zip(found) {
            let x = 0.025 + 0.95 * f64::from(at.x) / f64::from(job.length);
            let expected = 0.025 + 0.95 * steps[..i].iter().sum::<f64>() / total;
            off.extend([x - expected, f64::from(at.y) / f64::from(job.height)]);
        }
    }
    Check::at_most("spans", largest(off.into_iter().map(f64::abs)), SPAN_ERROR)
}

/// What several parts share as a corner lies at one place, unless fronts meet there. The value is at how many nodes they do.
fn seams(painted: &Painted) -> Check {
    let mut places: FxHashMap<Corner, Vec2> = FxHashMap::default();
    for (face, corners) in painted.painting.paint.faces.iter().zip(&painted.corners) {
        for (&corner, &at) in corners.iter().zip(&face.at) {
            let is_torn = matches!(corner, Corner::Node(n) if painted.torn.binary_search(&n).is_ok());
            if *places.entry(corner).or_insert(at) != at && !is_torn {
                let what = format!("{corner:?} lies at {at} and elsewhere");
                return Check::fail("seams", what).culprits([FaceId(face.face)]);
            }
        }
    }
    Check { value: Some(painted.torn.len() as f64), ..Check::pass("seams") }
}

/// The parts are within the radius, and in order; they hang together with the line; and no neighbour that is within it is left out.
fn gathered(mesh: &Mesh, cut: &Cut, painted: &Painted) -> Check {
    let job = &painted.painting.paint;
    let (length, height) = (f64::from(job.length), f64::from(job.height));
    let distances: Vec<(f64, f64)> =
        job.faces.iter().map(|f| (triangle_distance(f.at, length), slack(f.at, length))).collect();
    let misplaced = distances.iter().enumerate().find(|&(i, &(d, slack))| match i < job.inner {
        true => d > 0.5 * height + slack,
        false => d < 0.5 * height - slack || d > height + slack,
    });
    let fail = |what: &str, face: FaceId| Check::fail("gathered", what).culprits([face]);
    if let Some((i, (d, _))) = misplaced {
        return fail(&format!("part {i} is {d} from the line"), FaceId(job.faces[i].face));
    }
    let found: FxHashSet<FaceId> = job.faces.iter().map(|f| FaceId(f.face)).collect();
    match (unconnected(mesh, cut, &found), left_out(mesh, cut, painted, &found, height)) {
        (Some(face), _) => fail("a face is not connected with the line", face),
        (_, Some(face)) => fail("a face within the radius is left out", face),
        _ => Check { value: Some(found.len() as f64), ..Check::pass("gathered") },
    }
}

/// How far a part's distance may be off: its corners are in f32, and where they are much farther apart than the line is long, that is what counts.
fn slack(at: [Vec2; 3], length: f64) -> f64 {
    let farthest = at.iter().map(|p| p.abs().max_element()).fold(0.0, f32::max);
    ROUNDING * length + f64::from(f32::EPSILON * farthest)
}

/// No way on the surface is shorter than the straight one: what lies far from the line is not painted as if it were near. Unrolled, strongly curved
/// skin lies nearer than it is, so what is beyond the patch need only be laid beyond a fifth of its half height. The value is the largest
/// share of that half height that is missing. Faces under the line go by their own links.
fn distant(mesh: &Mesh, cut: &Cut, painted: &Painted) -> Check {
    let job = &painted.painting.paint;
    let (length, half) = (f64::from(job.length), 0.5 * f64::from(job.height));
    let line: Vec<DVec3> = cut.formed.chain.points.iter().map(|p| p.position).collect();
    let straight = |p: DVec3| least(line.windows(2).map(|w| distance_to_segment(p, w[0], w[1])));
    let under: FxHashSet<u32> = cut.links.iter().map(|link| link.face.0).collect();
    let beside = job.faces.iter().zip(&painted.corners).filter(|(face, _)| !under.contains(&face.face));
    let mut worst = (0.0, FaceId(0));
    for (face, corners) in beside {
        for (corner, at) in corners.iter().zip(face.at) {
            let Corner::Node(node) = corner else { continue };
            let laid = at.as_dvec2().distance(DVec2::new(f64::from(at.x).clamp(0.0, length), 0.0));
            // However far it is, it could not be worse.
            if half - laid <= worst.0 * half {
                continue;
            }
            let missing = (straight(mesh.position(*node)).min(half) - laid) / half;
            if missing > worst.0 {
                worst = (missing, FaceId(face.face));
            }
        }
    }
    let check = Check::at_most("distant", worst.0, 0.8 + ROUNDING);
    if check.ok { check } else { check.culprits([worst.1]) }
}

fn least(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(f64::INFINITY, f64::min)
}

/// A painted face that cannot be reached from the line over painted faces, or that is no skin.
fn unconnected(mesh: &Mesh, cut: &Cut, found: &FxHashSet<FaceId>) -> Option<FaceId> {
    let mut reached: FxHashSet<FaceId> = FxHashSet::default();
    let mut next: Vec<FaceId> = cut.links.iter().map(|link| link.face).collect();
    while let Some(face) = next.pop() {
        if found.contains(&face) && mesh.face(face).surface == Surface::Skin && reached.insert(face) {
            next.extend(mesh.face(face).edges.iter().filter_map(|&e| mesh.edge(e).other_face(face).some()));
        }
    }
    found.iter().filter(|f| !reached.contains(f)).min().copied()
}

/// A skin face that is not painted, though the side over which it borders on a painted part is nearer than the radius.
fn left_out(
    mesh: &Mesh,
    cut: &Cut,
    painted: &Painted,
    found: &FxHashSet<FaceId>,
    radius: f64,
) -> Option<FaceId> {
    let length = f64::from(painted.painting.paint.length);
    let parts = painted.painting.paint.faces.iter().zip(&painted.corners);
    let sides = parts.flat_map(|(face, corners)| [0, 1, 2].map(|i| (face, corners, i)));
    let mut missing = sides.filter_map(|(face, corners, i)| {
        let j = (i + 1) % 3;
        let beyond = beyond(mesh, cut, FaceId(face.face), [corners[i], corners[j]])?;
        let [a, b] = [face.at[i], face.at[j]].map(|at| at.as_dvec2());
        let is_there = found.contains(&beyond) || painted.refused.binary_search(&beyond).is_ok();
        let is_within = || segment_distance(a, b, length) < radius - slack(face.at, length);
        (!is_there && is_within()).then_some(beyond)
    });
    missing.next()
}

/// The skin face beyond the side of a face on which two corners lie.
fn beyond(mesh: &Mesh, cut: &Cut, face: FaceId, corners: [Corner; 2]) -> Option<FaceId> {
    let lies_on = |corner: &Corner, edge: EdgeId| match *corner {
        Corner::Node(node) => mesh.edge(edge).nodes.contains(&node),
        Corner::Point(i) => cut.formed.chain.points[i as usize].at == At::Edge(edge),
    };
    let edge = mesh.face(face).edges.into_iter().find(|&e| corners.iter().all(|c| lies_on(c, e)))?;
    mesh.edge(edge).other_face(face).some().filter(|&f| mesh.face(f).surface == Surface::Skin)
}

/// Distance from the line to a triangle: 0 if what the triangle leaves of d = 0 meets the line, else that of the nearest side.
fn triangle_distance(at: [Vec2; 3], length: f64) -> f64 {
    let corners = at.map(|at| at.as_dvec2());
    let sides = [0, 1, 2].map(|i| [corners[i], corners[(i + 1) % 3]]);
    let crossed = sides.iter().filter(|[a, b]| a.y.min(b.y) <= 0.0 && a.y.max(b.y) >= 0.0);
    let places = crossed.flat_map(|[a, b]| match a.y == b.y {
        true => [a.x, b.x],
        false => [a.lerp(*b, a.y / (a.y - b.y)).x; 2],
    });
    let [from, to] = places.fold([f64::INFINITY, f64::NEG_INFINITY], |[lo, hi], x| [lo.min(x), hi.max(x)]);
    if from <= length && to >= 0.0 {
        return 0.0;
    }
    sides.iter().map(|[a, b]| segment_distance(*a, *b, length)).fold(f64::INFINITY, f64::min)
}

/// Distance from the line to a segment: the least at its ends and wherever it is beside or nearest to an end of the line, or crosses it.
fn segment_distance(a: DVec2, b: DVec2, length: f64) -> f64 {
    let (step, end) = (b - a, DVec2::new(length, 0.0));
    let distance = |t: f64| {
        let p = a + step * if t > 0.0 { t.min(1.0) } else { 0.0 };
        p.distance(DVec2::new(p.x.clamp(0.0, length), 0.0))
    };
    let beside = [-a.x / step.x, (length - a.x) / step.x, -a.y / step.y];
    let nearest = [-a, end - a].map(|to| to.dot(step) / step.length_squared());
    least([0.0, 1.0].into_iter().chain(beside).chain(nearest).map(distance))
}
