//! FC as one would write it without exact signs: rounded arithmetic, and an ε within which things coincide. For comparison only; nothing is cut by it.
//!
//! The way is that of Lam 2016, Algorithm 4.2 and §4.2 (Figure 4.8): go from face to face, intersect each edge that was not visited with the plane,
//! take what lies on it up to ε, call a point that is within ε of a node or an edge incident to it. Its errors that have nothing to do with
//! rounding are put right, so that what fails here fails for the ε alone (`walk`):
//!
//! - from a point at a node it goes on through all faces around the node, not through one;
//! - where the first pick has two ways to go, it tries both and keeps the shorter one that arrives;
//! - the whole plane cuts, not a quadrilateral of it, so that a line may leave the wedge of the two rays.
//!
//! It is generous, too: the places of the picks are handed over, correctly rounded, where a program of this kind would cast its rays with the same arithmetic.
//! One implementation serves f32 and f64 ([`Scalar`]). In f32 the mesh itself is rounded to f32, as such a program would store it.
//!
//! What comes out is looked at by exact means (`merge`, [`judge`]): faces that it divides must have area and keep their orientation,
//! and its line must pass through the elements that the exact one passes through. A line that passes through others only because ε makes them one
//! ([`Failure::Moved`]) is told apart: that is what an ε is for.

mod merge;
mod scalar;
#[cfg(test)]
mod tests;
mod walk;

use glam::DVec3;
use schemars::JsonSchema;
use serde::Serialize;

pub use scalar::Scalar;

use super::exact::{Line, Section};
use crate::engine::wound::chain::At;
use crate::engine::wound::pick::Picked;
use crate::mesh::{FaceId, Mesh};

/// ε of f32 and f64 as a share of the mesh's diagonal: of 1e-4, 1e-6 and 1e-8 those with which the fewest cuts of `measure stability` failed, first of all on
/// the scenes as they are. A larger ε bears moves better and thin faces worse.
pub const SHARES: [f64; 2] = [1e-4, 1e-8];

/// A line with rounded places.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BaselineChain {
    /// The elements that its points are taken to be incident to, and where they are.
    pub places: Vec<(At, DVec3)>,
    /// The faces of its links.
    pub faces: Vec<FaceId>,
}

/// Why there is no line, or no mesh after it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Failure {
    /// No edge of the face meets the plane.
    NoNextCrossing,
    /// Every way on leads to where it was already.
    Loops,
    /// It runs into a boundary.
    DoesNotArrive,
    /// A face that the line divides gets a child without area, or one that is turned over.
    DegenerateChild,
    /// The line passes through other elements than the exact one, but none that is farther from the plane than ε allows.
    Moved,
    /// The line keeps to the plane, but takes a longer way than the exact one: where several lead on from a node, a walk takes the one ahead.
    Detour,
    /// The line passes through elements that the plane does not come near, or does not join the picks.
    WrongConstruct,
}

/// A point within ε of a node is moved by up to ε; with its rounding this is enough.
const SLACK: f64 = 2.0;

impl Failure {
    /// Whether there is no line or no mesh, rather than another one.
    pub fn is_lost(self) -> bool {
        !matches!(self, Self::Moved | Self::Detour | Self::WrongConstruct)
    }
}

/// The line between two picks, and whether the mesh could be divided along it.
pub fn cut<S: Scalar>(
    mesh: &Mesh,
    eye: DVec3,
    picks: &[Picked; 2],
    epsilon: f64,
) -> Result<BaselineChain, Failure> {
    let chain = walk::walk::<S>(mesh, eye, picks, epsilon)?;
    if merge::is_sound::<S>(mesh, &chain) { Ok(chain) } else { Err(Failure::DegenerateChild) }
}

/// ε for a mesh, as a share of its diagonal.
pub fn epsilon(mesh: &Mesh, share: f64) -> f64 {
    let [low, high] = mesh.bounds();
    share * low.distance(high)
}

/// Whether a line passes through the elements of the exact one, or of one as long; or else through such as ε lets pass for them.
pub fn judge(
    section: &Section<'_>,
    exact: &Line,
    chain: &BaselineChain,
    epsilon: f64,
) -> Result<(), Failure> {
    let way: Vec<At> = chain.places.iter().map(|place| place.0).collect();
    if section.is_as_short(exact, &way) {
        return Ok(());
    }
    let far = SLACK * epsilon;
    if !joins_the_picks(exact, chain, far) || way.iter().any(|&at| section.apart(at) > far) {
        return Err(Failure::WrongConstruct);
    }
    let longer = (chain.length() - section.length_of(exact)).abs();
    let moved = longer <= SLACK * epsilon * (way.len() + exact.places.len()) as f64;
    Err(if moved { Failure::Moved } else { Failure::Detour })
}

/// Whether a line has the ends of the exact one, or such as are taken for them within a distance.
fn joins_the_picks(exact: &Line, chain: &BaselineChain, far: f64) -> bool {
    let ends = [(exact.places.first(), chain.places.first()), (exact.places.last(), chain.places.last())];
    ends.into_iter().all(|ends| match ends {
        (Some(exact), Some((at, position))) => exact.at == *at || exact.point.distance(*position) <= far,
        _ => false,
    })
}
