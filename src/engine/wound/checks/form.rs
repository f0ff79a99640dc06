//! FC: the chain hangs together, lies where it says, and ends at the picks.

use std::cmp::Ordering;

use glam::DVec2;

use super::{largest, position_bound};
use crate::engine::wound::chain::{At, Chain, Point};
use crate::engine::wound::plane::CutPlane;
use crate::engine::wound::state::{Cut, State};
use crate::geometry::{distance_to_plane, distance_to_segment, fine_distance_to_segment};
use crate::mesh::{FaceId, Mesh};
use crate::report::Check;

pub(in super::super) fn form(state: &State, cut: &Cut) -> Vec<Check> {
    let (mesh, chain) = (&state.mesh, &cut.formed.chain);
    let Some(plane) = &cut.plane else { return vec![Check::fail("plane", "there is no cutting plane")] };
    let bound = position_bound(state);
    let mut checks = vec![
        links_join(mesh, chain),
        classes(mesh, plane, chain),
        ends(cut, bound),
        Check::at_most("plane-distance", over_links(chain, |p, _| plane.distance(p.position)), bound),
        Check::at_most(
            "face-distance",
            over_links(chain, |p, f| distance_to_plane(p.position, mesh.triangle(f))),
            bound,
        ),
        edges(mesh, chain, bound),
    ];
    if mesh.is_textured() {
        checks.push(uvs(mesh, chain));
    }
    checks
}

/// Over all links, at both ends.
fn over_links(chain: &Chain, measure: impl Fn(&Point, FaceId) -> f64) -> f64 {
    let ends = chain.links.iter().enumerate().flat_map(|(i, l)| [(i, l.face), (i + 1, l.face)]);
    largest(ends.map(|(i, f)| measure(&chain.points[i], f)))
}

fn links_join(mesh: &Mesh, chain: &Chain) -> Check {
    if chain.links.is_empty() || chain.points.len() != chain.links.len() + 1 {
        return Check::fail(
            "links-join",
            format!("{} links join {} points", chain.links.len(), chain.points.len()),
        );
    }
    let apart =
        chain.links.iter().enumerate().find(|(i, l)| {
            !chain.points[*i].touches(mesh, l.face) || !chain.points[i + 1].touches(mesh, l.face)
        });
    match apart {
        None => Check::pass("links-join"),
        Some((i, l)) => {
            Check::fail("links-join", format!("link {i} does not end at its face")).culprits([l.face])
        }
    }
}

/// Every place is what it claims by exact signs, and no place is passed twice.
fn classes(mesh: &Mesh, plane: &CutPlane, chain: &Chain) -> Check {
    let last = chain.points.len() - 1;
    let single = chain.links.len() == 1;
    let wrong = chain.points.iter().enumerate().find(|(i, p)| match p.at {
        // A line within one face or along one edge is given by its two picks, whatever the plane.
        _ if single => false,
        At::Node(n) => *i != 0 && *i != last && plane.side_of(mesh, n) != Ordering::Equal,
        At::Edge(e) => {
            let [a, b] = mesh.edge(e).nodes.map(|n| plane.side_of(mesh, n));
            a != b.reverse()
        }
        At::Face(_) => *i != 0 && *i != last,
    });
    let mut places: Vec<At> = chain.points.iter().map(|p| p.at).collect();
    places.sort_unstable();
    let twice = places.windows(2).find(|w| w[0] == w[1] && !single);
    match (wrong, twice) {
        (Some((i, p)), _) => {
            Check::fail("classes", format!("point {i} is not where it claims")).culprits([p.at])
        }
        (_, Some(w)) => Check::fail("classes", "the line passes a place twice").culprits([w[0]]),
        _ => Check::pass("classes"),
    }
}

fn ends(cut: &Cut, bound: f64) -> Check {
    let (Some(picked), [first, .., last]) = (&cut.picked, &cut.formed.chain.points[..]) else {
        return Check::fail("ends", "the line has no ends");
    };
    let moved = |p: &Point, i: usize| p.position.distance(picked[i].point.position);
    Check::at_most("ends", largest([moved(first, 0), moved(last, 1)].into_iter()), bound)
}

fn edges(mesh: &Mesh, chain: &Chain, bound: f64) -> Check {
    let off = chain.points.iter().map(|p| match p.at {
        At::Edge(e) => {
            let [a, b] = mesh.edge(e).nodes.map(|n| mesh.position(n));
            fine_distance_to_segment(p.position, a, b)
        }
        At::Node(n) => mesh.position(n).distance(p.position),
        At::Face(_) => 0.0,
    });
    Check::at_most("edge-distance", largest(off), bound)
}

/// Two ulps of f32 around the face's triangle in texture space.
fn uvs(mesh: &Mesh, chain: &Chain) -> Check {
    let outside = |uv: glam::Vec2, face: FaceId| {
        let corners = mesh.face(face).vertices.map(|v| mesh.vertex(v).uv);
        let size = corners.iter().map(|c| c.abs().max_element()).fold(f32::MIN_POSITIVE, f32::max);
        distance_outside(uv.as_dvec2(), corners.map(|c| c.as_dvec2())) / (size.next_up() - size) as f64
    };
    let ends = chain.links.iter().flat_map(|l| l.uv.map(|uv| outside(uv, l.face)));
    Check::at_most("uv-ulps", largest(ends), 2.0)
}

/// How far a point is from a triangle of either orientation; 0 inside.
fn distance_outside(p: DVec2, corners: [DVec2; 3]) -> f64 {
    let side = |i: usize| (corners[(i + 1) % 3] - corners[i]).perp_dot(p - corners[i]);
    let sides = [side(0), side(1), side(2)];
    if sides.iter().all(|&s| s > 0.0) || sides.iter().all(|&s| s < 0.0) {
        return 0.0;
    }
    let flat = |v: DVec2| v.extend(0.0);
    let to_side = |i: usize| distance_to_segment(flat(p), flat(corners[i]), flat(corners[(i + 1) % 3]));
    to_side(0).min(to_side(1)).min(to_side(2))
}
