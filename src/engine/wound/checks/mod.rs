//! The invariants of the stages, looked at around what a cut touched.
//!
//! They use other means than the stages: distances instead of constructs, sums over faces instead of edits, sweeps instead of
//! moves. A bound that is a multiple of an ulp is counted by the largest coordinate of the mesh as it was loaded.

mod carve;
mod form;
mod merge;
mod paint;
mod patch;

pub(super) use carve::carve;
pub(super) use form::form;
pub(super) use merge::{merge, subdivision};
pub(super) use paint::paint;
pub(super) use patch::patch;

use super::state::{Before, State};
use crate::geometry::ulp;
use crate::mesh::{FaceId, Mesh, check};
use crate::report::Check;

/// How far positions may be from what they are the rounding of, in ulps.
const POSITION_ULPS: f64 = 4.0;

/// Four ulps of the largest coordinate that has anything to do with a cut.
fn position_bound(state: &State) -> f64 {
    POSITION_ULPS * ulp(state.largest)
}

/// The largest of some measurements; NaN if one of them is, so that no bound is kept by not being a number.
fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, |most, v| if v.is_nan() || v > most { v } else { most })
}

fn topology(mesh: &Mesh, faces: &[FaceId]) -> Check {
    match check::around(mesh, faces) {
        Ok(()) => Check::pass("topology"),
        Err(b) => Check::fail("topology", b.what).culprits([b.element]),
    }
}

/// V − E + F must be what it was.
fn euler(mesh: &Mesh, before: &Before) -> Check {
    let [v, e, f] = before.counts.map(|n| n as i64);
    let (then, now) = (v - e + f, check::euler(mesh));
    Check {
        ok: then == now,
        value: Some(now as f64),
        detail: if then == now { String::new() } else { format!("it was {then}") },
        ..Check::pass("euler")
    }
}

/// The invariants of the whole mesh.
pub(super) fn state(state: &State) -> Vec<Check> {
    let mesh = &state.mesh;
    let whole = match check::whole(mesh) {
        Ok(()) => Check::pass("topology"),
        Err(b) => Check::fail("topology", b.what).culprits([b.element]),
    };
    let finite = match mesh.positions().iter().position(|p| !p.is_finite()) {
        None => Check::pass("finite"),
        Some(n) => Check::fail("finite", "a position is not finite").culprits([crate::mesh::NodeId::of(n)]),
    };
    let bvh = match &state.bvh {
        Some(bvh) if bvh.len() != mesh.face_count() => {
            Check::fail("hierarchy", format!("it holds {} of {} faces", bvh.len(), mesh.face_count()))
        }
        _ => Check::pass("hierarchy"),
    };
    vec![whole, finite, bvh]
}
