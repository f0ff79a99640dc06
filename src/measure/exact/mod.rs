//! FC once more, slowly and without any rounding: what the engine's line is compared with, and what its errors are measured from.
//!
//! It is written apart from the engine, which lends it ids and nothing else: its own numbers (`number`), its own plane, signs and section
//! graph (`section`), its own search (`search`). Every coordinate is an integer of one unit, a power of two; a point that is computed is three
//! integers over a fourth. So every sign, every crossing and every comparison of two places is exact, whatever the coordinates.
//!
//! What is asked ([`Question`]) are the exact data of a cut: the eye, a point on the ray of each pick, and the element that each pick
//! met. The answer is a [`Line`], or why there is none ([`Refusal`]). The rules are those of the house, the source Lam 2016, §4.1.2, without its errors:
//!
//! - two picks that touch one face are joined straight across it, the face with the lowest id;
//! - else the line is the shortest way through the section of plane and surface: pieces within faces, and edges that lie in the plane unless no
//!   face beside them leaves it (coplanar faces are passed along their border);
//! - a pick inside a coplanar face goes over the face's corners.
//!
//! Lengths are square roots, so not exact: they are cut off 192 bits below the largest coordinate, and two lines whose lengths differ by no more
//! than what was cut off count as equally long.
//!
//! Not answered: questions whose picks do not lie where they say they do, as a pick may that was rounded ([`Refusal::NotPosed`]). The engine moves such
//! picks to what they were rounded onto; that is a policy, not geometry, and is looked at by FC's own invariants.

mod compare;
mod errors;
mod first;
mod number;
mod search;
mod section;
#[cfg(test)]
mod tests;

use glam::DVec3;

pub use compare::{Agreement, Disagreement, compare, compare_chain};
pub use errors::{ChainErrors, errors};
pub use first::first_face;
pub use number::ExactPoint;
pub use section::Section;

use crate::engine::wound::chain::At;
use crate::mesh::{FaceId, Mesh};

/// One of the two picks: what is exact about it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Datum {
    /// A point on its ray, or the node itself.
    pub through: DVec3,
    /// The element that it met.
    pub at: At,
}

/// The exact data of a cut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Question {
    /// Where both rays begin.
    pub eye: DVec3,
    /// From where, and to where.
    pub picks: [Datum; 2],
}

/// A place of the line.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    /// The element that it lies in.
    pub at: At,
    /// Where exactly.
    pub point: ExactPoint,
}

/// The line, without any rounding.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// Its places, from the first pick to the second.
    pub places: Vec<Place>,
    /// The faces of its links; along an edge the one with the lower id.
    pub faces: Vec<FaceId>,
}

impl Line {
    /// The elements that it passes through.
    pub fn way(&self) -> Vec<At> {
        self.places.iter().map(|place| place.at).collect()
    }
}

/// Why there is no line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Refusal {
    /// The eye and the two points lie on one line.
    DegeneratePlane,
    /// Both picks are the same point.
    SamePoint,
    /// No way leaves the first pick.
    Grazing,
    /// The picks are not connected by the surface.
    OtherComponent,
    /// All ways end, one of them at the boundary.
    Boundary,
    /// The section through the first pick does not pass through the second.
    Silhouette,
    /// A pick does not lie exactly where it says it does.
    NotPosed(At),
}

impl Refusal {
    /// Its name, as the engine's rejections have it.
    pub fn reason(&self) -> &'static str {
        match self {
            Self::DegeneratePlane => "degenerate-plane",
            Self::SamePoint => "same-point",
            Self::Grazing => "grazing",
            Self::OtherComponent => "other-component",
            Self::Boundary => "boundary",
            Self::Silhouette => "silhouette",
            Self::NotPosed(_) => "not-posed",
        }
    }
}

/// The line between two picks.
pub fn line(mesh: &Mesh, question: &Question) -> Result<Line, Refusal> {
    Section::of(mesh, question)?.line()
}
