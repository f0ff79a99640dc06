//! CI: the wound is where it should be, as wide and deep as it should be, and nothing else changed.

use std::cmp::Ordering;

use glam::DVec3;

use super::{euler, largest, position_bound, topology};
use crate::engine::wound::carve::gutter::crosses_something;
use crate::engine::wound::carve::opening::{cod_cm, depth_cm};
use crate::engine::wound::carve::{Carved, Opened};
use crate::engine::wound::state::{Cut, State};
use crate::geometry::predicates::facing;
use crate::mesh::check::sixfold_volume;
use crate::mesh::{FaceId, Mesh, NodeId};
use crate::report::Check;

pub(in super::super) fn carve(state: &State, cut: &Cut) -> Vec<Check> {
    let (mesh, carved) = (&state.mesh, &cut.carved);
    let touched = mesh.touched_since(cut.before_carve.mark);
    vec![
        topology(mesh, &touched.faces),
        euler(mesh, &cut.before_carve),
        volume(state, carved),
        ends(mesh, carved),
        untouched(cut, &touched.nodes),
        width(state, carved),
        upright(mesh, carved),
        clear(state, carved),
    ]
}

/// The change of volume, summed over the faces before and after, is what the moved faces swept plus the gutter's wedge: up to 1e-9 of
/// them, and what rounding the coordinates leaves open.
fn volume(state: &State, carved: &Carved) -> Check {
    let mesh = &state.mesh;
    let origin = carved.opened.first().map_or(DVec3::ZERO, |o| o.at);
    let skin =
        carved.stretched.iter().map(|&(face, old)| (old, mesh.triangle(face), sixfold_volume(origin, old)));
    let closed = |n| collapsed(carved, n);
    let gutter =
        carved.gutter.iter().map(|&face| (mesh.face(face).nodes.map(closed), mesh.triangle(face), 0.0));
    let (mut grown, mut swept, mut allowed) = (0.0, 0.0, 0.0);
    for (old, new, before) in skin.chain(gutter) {
        let (after, sweep) = (sixfold_volume(origin, new), sweep(old, new));
        let reach = new.iter().map(|p| p.distance(origin)).fold(0.0, f64::max);
        grown += after - before;
        swept += sweep;
        allowed += 1e-9 * sweep.abs() + 1e-13 * reach * reach * reach + position_bound(state) * reach * reach;
    }
    Check::at_most("volume", (grown - swept).abs(), allowed)
}

/// Where a node of the gutter was when the cut was still closed.
fn collapsed(carved: &Carved, node: NodeId) -> DVec3 {
    let here = |o: &&Opened| o.left == node || o.right == node || o.bottom == node;
    carved.opened.iter().find(here).map_or(DVec3::NAN, |o| o.at)
}

/// Six times the volume that a triangle sweeps as its corners move straight: the flux through it is quadratic in time, so Simpson's
/// rule is exact.
fn sweep(old: [DVec3; 3], new: [DVec3; 3]) -> f64 {
    let velocity = (0..3).map(|i| new[i] - old[i]).sum::<DVec3>();
    let normal = |t: f64| {
        let [a, b, c] = [0, 1, 2].map(|i| old[i] + (new[i] - old[i]) * t);
        (b - a).cross(c - a)
    };
    velocity.dot(normal(0.0) + normal(0.5) * 4.0 + normal(1.0)) / 6.0
}

fn ends(mesh: &Mesh, carved: &Carved) -> Check {
    let ends = carved.opened.first().into_iter().chain(carved.opened.last());
    let moved = ends.filter(|o| o.left != o.right || mesh.position(o.left) != o.at).map(|o| o.left);
    let moved: Vec<NodeId> = moved.collect();
    if moved.is_empty() {
        Check::pass("ends")
    } else {
        Check::fail("ends", "an end of the line moved").culprits(moved)
    }
}

/// Of the nodes that were there before, only the line's and those named as moved were written.
fn untouched(cut: &Cut, touched: &[NodeId]) -> Check {
    let mut named: Vec<NodeId> = cut.carved.opened.iter().map(|o| o.left).collect();
    named.extend(cut.carved.moved.iter().map(|m| m.0));
    named.sort_unstable();
    let there = touched.iter().filter(|n| n.at() < cut.before_carve.counts[0]);
    let strays: Vec<NodeId> = there.copied().filter(|n| named.binary_search(n).is_err()).collect();
    if strays.is_empty() {
        return Check::pass("untouched");
    }
    Check::fail("untouched", "nodes moved that are not the cut's").culprits(strays)
}

/// The width in the middle is the cut opening displacement, unless it had to be narrowed there; and every width is what is reported.
fn width(state: &State, carved: &Carved) -> Check {
    let mesh = &state.mesh;
    let apart = |o: &Opened| mesh.position(o.left).distance(mesh.position(o.right));
    let off = largest(carved.opened.iter().map(|o| (apart(o) - 2.0 * o.half_width).abs()));
    let middle = &carved.opened[carved.middle];
    let length_cm = carved.length * state.unit_cm;
    let cod = cod_cm(length_cm, depth_cm(length_cm)) / state.unit_cm;
    let s = middle.s / carved.length;
    let planned = cod * 4.0 * s * (1.0 - s);
    let as_planned = carved.closed == 0 && !carved.middle_narrowed;
    let missing = if as_planned { (apart(middle) - planned).abs() } else { 0.0 };
    Check::at_most("width", largest([off, missing].into_iter()), 2.0 * position_bound(state))
}

/// No face that moved has turned over.
fn upright(mesh: &Mesh, carved: &Carved) -> Check {
    let turned =
        carved.stretched.iter().filter(|(f, old)| facing(*old, mesh.triangle(*f)) != Ordering::Greater);
    let turned: Vec<FaceId> = turned.map(|t| t.0).collect();
    if turned.is_empty() {
        Check::pass("no-fold")
    } else {
        Check::fail("no-fold", "faces turned over").culprits(turned)
    }
}

fn clear(state: &State, carved: &Carved) -> Check {
    let Some(bvh) = &state.bvh else { return Check::fail("clear", "there is no hierarchy to look with") };
    let crossing = carved.gutter.iter().find_map(|&f| Some((f, crosses_something((&state.mesh, bvh), f)?)));
    match crossing {
        None => Check::pass("clear"),
        Some((f, other)) => Check::fail("clear", "the gutter crosses a face").culprits([f, other]),
    }
}
