//! The engine's line beside the exact one.
//!
//! They agree when they pass through the same elements in the same order, or when the engine's is a way through the same section that is as long,
//! up to the rounding of lengths. Its points have to lie within four ulps of plane and element, as DESIGN says. Where there is no line,
//! both have to say so for the same reason.

use std::fmt;

use glam::DVec3;
use num_bigint::BigInt;

use super::{Datum, Line, Question, Refusal, Section};
use crate::engine::wound::chain::{At, Chain};
use crate::engine::wound::form;
use crate::engine::wound::pick::Picked;
use crate::engine::wound::plane::CutPlane;
use crate::geometry::ulp;
use crate::mesh::{FaceId, Mesh};

/// How far a rounded point may be from plane and element, in ulps of the largest coordinate (DESIGN: four).
const TOLERANCE_ULPS: f64 = 4.0;
/// What a link of the engine's line may be longer, in ulps: its ends are rounded, its length, and the sum.
const LENGTH_ULPS: f64 = 16.0;

/// In which way engine and exact answer agree.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Agreement {
    /// The same elements in the same order.
    Same,
    /// Another way that is as long.
    EquallyLong,
    /// No line, for the same reason.
    Refused,
    /// There is no exact answer, because a pick does not lie exactly where it says.
    NotPosed,
}

/// In which way they do not.
#[derive(Clone, Debug, PartialEq)]
#[allow(missing_docs, reason = "the fields are what the message says")]
pub enum Disagreement {
    /// One has a line and the other none, or for another reason.
    Outcome { exact: String, found: String },
    /// The line does not begin and end at the picks.
    Ends { found: Vec<At> },
    /// The plane does not lead from one place to the next.
    NoArc { link: usize, from: At, to: At },
    /// A link lies in a face that its arc is not in.
    Face { link: usize, exact: FaceId, found: FaceId },
    /// A shorter line exists.
    Longer { by: f64, exact: Vec<At>, found: Vec<At> },
    /// A point is too far from plane or element.
    Position { point: usize, at: At, off_plane_ulps: f64, off_element_ulps: f64 },
}

impl fmt::Display for Disagreement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Outcome { exact, found } => write!(f, "exactly it is {exact}, and {found} was found"),
            Self::Ends { found } => {
                write!(f, "a line of {} points does not join the picks: {}", found.len(), words(found))
            }
            Self::NoArc { link, from, to } => {
                write!(f, "link {link}: the plane does not lead from {from} to {to}")
            }
            Self::Face { link, exact, found } => {
                write!(f, "link {link} is said to lie in {found}, and lies in {exact}")
            }
            Self::Longer { by, exact, found } => {
                write!(f, "{} is longer than {} by {by:e}", words(found), words(exact))
            }
            Self::Position { point, at, off_plane_ulps, off_element_ulps } => write!(
                f,
                "point {point} at {at} is {off_plane_ulps:.3} ulps off the plane and {off_element_ulps:.3} off {at}"
            ),
        }
    }
}

impl std::error::Error for Disagreement {}

fn words(way: &[At]) -> String {
    way.iter().map(At::to_string).collect::<Vec<_>>().join(" ")
}

impl Question {
    /// What is exact about two picks that the engine resolved.
    pub fn of(eye: DVec3, picks: &[Picked; 2]) -> Self {
        Self { eye, picks: picks.map(|p| Datum { through: p.through, at: p.point.at }) }
    }
}

/// Has the engine trace the line between two picks, as FC does before it looks at what rounding does to it, and compares.
pub fn compare(mesh: &Mesh, eye: DVec3, picks: &[Picked; 2]) -> Result<Agreement, Disagreement> {
    let found = match CutPlane::through([eye, picks[0].through, picks[1].through]) {
        Some(plane) => {
            form::trace(mesh, &plane, &picks[0].point, &picks[1].point).map_err(|rejection| rejection.reason)
        }
        None => Err("degenerate-plane".to_owned()),
    };
    compare_chain(mesh, &Question::of(eye, picks), &found)
}

/// Compares a line, or the reason why there is none, with the exact answer.
pub fn compare_chain(
    mesh: &Mesh,
    question: &Question,
    found: &Result<Chain, String>,
) -> Result<Agreement, Disagreement> {
    let section = match Section::of(mesh, question) {
        Ok(section) => section,
        Err(Refusal::NotPosed(_)) => return Ok(Agreement::NotPosed),
        Err(refusal) => return same_refusal(&refusal, found),
    };
    match (section.line(), found) {
        (Ok(line), Ok(chain)) => {
            let way: Vec<At> = chain.points.iter().map(|p| p.at).collect();
            let faces: Vec<FaceId> = chain.links.iter().map(|l| l.face).collect();
            section.positions(chain)?;
            section.compare_way(&line, &way, &faces)
        }
        (Ok(_), Err(reason)) if reason == "same-point" && section.is_speck() => Ok(Agreement::Refused),
        (Err(Refusal::SamePoint), Ok(chain)) if chain.links.len() == 1 => {
            section.positions(chain).map(|()| Agreement::Same)
        }
        (Ok(_), Err(reason)) => Err(Disagreement::Outcome { exact: "a line".into(), found: reason.clone() }),
        (Err(refusal), _) => same_refusal(&refusal, found),
    }
}

fn same_refusal(refusal: &Refusal, found: &Result<Chain, String>) -> Result<Agreement, Disagreement> {
    match found {
        Err(reason) if reason == refusal.reason() => Ok(Agreement::Refused),
        other => Err(Disagreement::Outcome {
            exact: refusal.reason().into(),
            found: other.as_ref().map_or_else(Clone::clone, |chain| format!("{} links", chain.links.len())),
        }),
    }
}

impl Section<'_> {
    /// Compares a way through elements, and the faces of its links, with the exact line.
    pub fn compare_way(&self, line: &Line, way: &[At], faces: &[FaceId]) -> Result<Agreement, Disagreement> {
        let exact = line.way();
        if exact == way && line.faces == faces {
            return Ok(Agreement::Same);
        }
        if faces.len() + 1 != way.len() {
            return Err(Disagreement::Ends { found: way.to_vec() });
        }
        self.is_a_way(way, faces)?;
        let by = self.longer(&exact, way).ok_or_else(|| Disagreement::Ends { found: way.to_vec() })?;
        match by <= 0.0 {
            true => Ok(if exact == way { Agreement::Same } else { Agreement::EquallyLong }),
            false => Err(Disagreement::Longer { by, exact, found: way.to_vec() }),
        }
    }

    /// Whether elements are those of the exact line, or those of another way that is as long.
    pub fn is_as_short(&self, line: &Line, way: &[At]) -> bool {
        let exact = line.way();
        let leads = |ends: &[At]| self.arcs(ends[0]).iter().any(|arc| arc.to == ends[1]);
        exact == way || way.windows(2).all(leads) && self.longer(&exact, way).is_some_and(|by| by <= 0.0)
    }

    /// By how much a way is longer than another, beyond what its rounding can explain; `None` if they have not the same ends.
    fn longer(&self, exact: &[At], way: &[At]) -> Option<f64> {
        if way.len() < 2 || [way.first(), way.last()] != [exact.first(), exact.last()] {
            return None;
        }
        let by = self.in_model_units(&(self.length(way) - self.length(exact)));
        let allowed = LENGTH_ULPS * (way.len() + exact.len()) as f64 * ulp(self.mesh.largest_coordinate());
        Some(if by <= allowed { 0.0 } else { by })
    }

    fn is_a_way(&self, way: &[At], faces: &[FaceId]) -> Result<(), Disagreement> {
        for (link, (ends, &found)) in way.windows(2).zip(faces).enumerate() {
            let (from, to) = (ends[0], ends[1]);
            let mut arcs = self.arcs(from).iter().filter(|arc| arc.to == to).map(|arc| arc.face);
            let Some(exact) = arcs.clone().next() else {
                return Err(Disagreement::NoArc { link, from, to });
            };
            if !arcs.any(|face| face == found) {
                return Err(Disagreement::Face { link, exact, found });
            }
        }
        Ok(())
    }

    fn positions(&self, chain: &Chain) -> Result<(), Disagreement> {
        let ulp = ulp(self.mesh.largest_coordinate());
        for (point, p) in chain.points.iter().enumerate() {
            let off_plane_ulps = self.off_plane(p.position) / ulp;
            let off_element_ulps = self.off_element(p.at, p.position) / ulp;
            if off_plane_ulps > TOLERANCE_ULPS || off_element_ulps > TOLERANCE_ULPS {
                return Err(Disagreement::Position { point, at: p.at, off_plane_ulps, off_element_ulps });
            }
        }
        Ok(())
    }

    /// Whether both picks lie in one element, so near to each other that they round to one point.
    fn is_speck(&self) -> bool {
        let [a, b] = &self.picks;
        let reach = TOLERANCE_ULPS * ulp(self.mesh.largest_coordinate());
        a.at == b.at && a.point.distance(b.point.rounded()) <= reach
    }

    /// The length of the exact line, rounded.
    pub fn length_of(&self, line: &Line) -> f64 {
        self.in_model_units(&self.length(&line.way()))
    }

    /// A length of [`Section::length`], rounded.
    fn in_model_units(&self, length: &BigInt) -> f64 {
        self.unit.ratio(length, &(BigInt::from(1) << self.shift()))
    }
}
