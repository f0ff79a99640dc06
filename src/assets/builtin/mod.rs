//! The built-in scenes, made by code: the same bytes on every machine (`+ − × ÷ √` and libm only), no file needed.
//!
//! All are closed, oriented manifolds with charts that do not overlap, in centimetres, and face the default camera: y up, seen
//! from +z. `bust` is what cuts are made for; the others are there for what they do to a cut: `sphere` is plain, `slab` and the
//! ears of the bust are thin, `torus` has a hole, `two-fingers` has two components with a silhouette between them, and on
//! `grid` rows of nodes and edges are exactly in line.

mod atlas;
mod bisect;
mod boxes;
mod bust;
mod cage;
mod ear;
mod maps;
mod round;
mod sculpt;
mod sdf;
#[cfg(test)]
mod tests;

use std::fmt;

pub(super) use maps::{MapKind, paint};

use crate::mesh::IndexedMesh;
use crate::report::quoted;

/// A built-in scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Builtin {
    /// Its surface, with texture coordinates.
    pub mesh: IndexedMesh,
    /// How many centimetres a model unit is.
    pub unit_cm: f64,
}

/// A line of the list of built-in scenes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Listing {
    /// What to write after `builtin:`; N stands for a number.
    pub name: &'static str,
    /// What it is.
    pub about: &'static str,
}

/// Why there is no such scene.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum BuiltinError {
    /// No scene has this name.
    Unknown(String),
    /// The number after the colon is missing, no whole number, or out of bounds.
    Faces {
        /// The scene.
        name: &'static str,
        /// What stands after the colon; `None` for no colon.
        given: Option<String>,
        /// The least and the most faces it can have.
        bounds: (usize, usize),
    },
    /// This scene has one size only, yet a number was given.
    Fixed(&'static str),
}

impl fmt::Display for BuiltinError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unknown(name) => write!(f, "there is no built-in scene {}", quoted(name))?,
            Self::Faces { name, given: Some(given), bounds: (least, most) } => {
                let given = quoted(given);
                write!(f, "{name}:N takes a whole number of faces from {least} to {most}, not {given}")?;
            }
            Self::Faces { name, given: None, bounds: (least, most) } => {
                write!(f, "{name}:N needs a whole number of faces from {least} to {most}")?;
            }
            Self::Fixed(name) => write!(f, "{name} takes no number")?,
        }
        let names: Vec<&str> = LIST.iter().map(|l| l.name).collect();
        write!(f, "; built-in scenes: {}", names.join(", "))
    }
}

impl std::error::Error for BuiltinError {}

const LIST: [Listing; 7] = [
    Listing {
        name: "bust",
        about: "a head on its neck, 9,000 faces, the face finer than the skull, nine charts",
    },
    Listing { name: "bust:N", about: "the same head at about N faces, 2,000 to 4,000,000" },
    Listing {
        name: "sphere:N",
        about: "a sphere of even faces, about N of them, 20 to 4,000,000, five charts",
    },
    Listing { name: "slab", about: "a thin plate, 10 x 10 x 0.3 cm" },
    Listing { name: "torus", about: "a ring, 19 cm across: a surface with a hole" },
    Listing {
        name: "two-fingers",
        about: "two fingers side by side: two components, a silhouette between them",
    },
    Listing { name: "grid", about: "a box with exact coordinates: rows of nodes and edges exactly in line" },
];

/// Faces of `bust`, about.
const BUST_FACES: usize = 9_000;
const BUST_BOUNDS: (usize, usize) = (2_000, 4_000_000);
const SPHERE_BOUNDS: (usize, usize) = (20, 4_000_000);

/// What there is.
pub fn list() -> &'static [Listing] {
    &LIST
}

/// Makes the scene of this name: what stands after `builtin:`.
pub fn builtin(name: &str) -> Result<Builtin, BuiltinError> {
    let (stem, number) = match name.split_once(':') {
        Some((stem, number)) => (stem, Some(number)),
        None => (name, None),
    };
    let mesh = match stem {
        "bust" if number.is_none() => bust::bust(BUST_FACES),
        "bust" => bust::bust(count("bust", number, BUST_BOUNDS)?),
        "sphere" => round::sphere(count("sphere", number, SPHERE_BOUNDS)?),
        "slab" => fixed("slab", number, boxes::slab)?,
        "torus" => fixed("torus", number, round::torus)?,
        "two-fingers" => fixed("two-fingers", number, boxes::two_fingers)?,
        "grid" => fixed("grid", number, boxes::grid)?,
        _ => return Err(BuiltinError::Unknown(name.to_owned())),
    };
    Ok(Builtin { mesh, unit_cm: 1.0 })
}

fn fixed(
    name: &'static str,
    number: Option<&str>,
    make: fn() -> IndexedMesh,
) -> Result<IndexedMesh, BuiltinError> {
    if number.is_some() { Err(BuiltinError::Fixed(name)) } else { Ok(make()) }
}

fn count(name: &'static str, number: Option<&str>, bounds: (usize, usize)) -> Result<usize, BuiltinError> {
    number
        .and_then(|n| n.parse().ok())
        .filter(|n| (bounds.0..=bounds.1).contains(n))
        .ok_or_else(|| BuiltinError::Faces { name, given: number.map(str::to_owned), bounds })
}
