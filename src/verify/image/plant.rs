//! Proof that a golden is sensitive: defects are planted in it, and each must be caught by a gate.
//!
//! | defect | what is done | what is there to catch it |
//! | --- | --- | --- |
//! | hole | a square of 12 × 12 pixels turns black; in a small picture less, a fiftieth of it | tile, outliers |
//! | crack | a line of 40 × 1 pixels, across or down, goes down to a quarter | tile, outliers |
//! | tone | the skin is 3 less red | tone |
//! | shift | the whole picture moves by one pixel to the right | displacement, structure |
//!
//! Hole and crack are planted in lit skin, where one could see them, as near to its middle as they fit. Where there is no room for
//! them, or the picture is smaller than 64 × 64, nothing is proven, and the report says why.

use std::fmt;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::distance::{Distance, Metric, first_beyond};
use super::skin::Skin;
use crate::canvas::image::Image;

/// Pixels along a picture that has to prove its sensitivity.
const SMALLEST: u32 = 64;
/// Pixels along a hole.
const HOLE: u32 = 12;
/// Pixels along a crack.
const CRACK: u32 = 40;
/// How much less red a tone shift makes the skin.
const LESS_RED: u8 = 3;

/// What can be wrong with a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Defect {
    /// A black square.
    Hole,
    /// A dark line.
    Crack,
    /// Skin of another tone.
    Tone,
    /// A picture that is off by a pixel.
    Shift,
}

impl fmt::Display for Defect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Hole => "hole",
            Self::Crack => "crack",
            Self::Tone => "tone shift",
            Self::Shift => "one-pixel shift",
        })
    }
}

/// A defect that was planted, and what caught it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Planted {
    /// What was planted.
    pub defect: Defect,
    /// The first measure that was beyond its gate; none when all let it pass.
    pub caught_by: Option<Metric>,
}

/// What was proven of a golden's sensitivity.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Proof {
    /// The defects that were planted.
    pub planted: Vec<Planted>,
    /// Why others were not.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub unproven: Vec<String>,
}

impl Proof {
    /// The defects that nothing caught.
    pub fn missed(&self) -> impl Iterator<Item = Defect> + '_ {
        self.planted.iter().filter(|planted| planted.caught_by.is_none()).map(|planted| planted.defect)
    }
}

/// Plants every defect in a golden, and holds a gate against it.
pub(crate) fn prove(golden: &Image, skin: &Skin, gate: &Distance) -> Proof {
    let mut proof = Proof::default();
    if golden.size.iter().any(|side| *side < SMALLEST) {
        proof.unproven.push(format!("the picture is smaller than {SMALLEST} x {SMALLEST}"));
        return proof;
    }
    for defect in [Defect::Hole, Defect::Crack, Defect::Tone, Defect::Shift] {
        match planted(golden, skin, defect) {
            Some(image) => {
                let caught_by = first_beyond(golden, &image, skin, gate);
                proof.planted.push(Planted { defect, caught_by });
            }
            None => proof.unproven.push(format!("{defect}: there is too little lit skin for it")),
        }
    }
    proof
}

/// A golden with a defect; none where there is no room for it.
pub(super) fn planted(golden: &Image, skin: &Skin, defect: Defect) -> Option<Image> {
    planted_by(golden, skin, defect, usual(golden, defect))
}

/// How large a defect every golden has to catch.
pub(super) fn usual(golden: &Image, defect: Defect) -> f64 {
    match defect {
        Defect::Hole => f64::from(hole(golden.size)),
        Defect::Crack => f64::from(CRACK),
        Defect::Tone => f64::from(LESS_RED),
        Defect::Shift => 1.0,
    }
}

/// A golden with a defect of a size: pixels along a hole or a crack, levels less red, or pixels to the right, which may be a part of one.
pub(super) fn planted_by(golden: &Image, skin: &Skin, defect: Defect, size: f64) -> Option<Image> {
    let mut image = golden.clone();
    let whole = size.round() as u32;
    match defect {
        Defect::Hole => darken(&mut image, skin.place([whole; 2])?, [whole; 2], |_| 0),
        Defect::Crack => {
            let across = skin.place([whole, 1]).map(|at| (at, [whole, 1]));
            let (at, line) = across.or_else(|| Some((skin.place([1, whole])?, [1, whole])))?;
            darken(&mut image, at, line, |v| v / 4);
        }
        _ if skin.lit() < HOLE * HOLE => return None,
        Defect::Tone => {
            let texels = image.texels.iter_mut().filter(|t| skin.holds(**t));
            texels.for_each(|texel| texel[0] = texel[0].saturating_sub(whole as u8));
        }
        Defect::Shift => {
            let rows = image.texels.chunks_mut(golden.size[0].max(1) as usize);
            rows.for_each(|row| shift(row, size.clamp(0.0, 1.0)));
        }
    }
    Some(image)
}

/// Moves a row to the right by a part of a pixel.
fn shift(row: &mut [[u8; 4]], part: f64) {
    for x in (1..row.len()).rev() {
        let (here, before) = (row[x], row[x - 1]);
        let mixed = |c: usize| f64::from(here[c]) + part * (f64::from(before[c]) - f64::from(here[c]));
        row[x] = [0, 1, 2, 3].map(|c| mixed(c).round() as u8);
    }
}

/// Pixels along the hole of a picture.
fn hole([width, height]: [u32; 2]) -> u32 {
    let area = u64::from(width) * u64::from(height);
    (1..=HOLE).rev().find(|side| u64::from(side * side) * 50 <= area).unwrap_or(1)
}

fn darken(image: &mut Image, [x, y]: [u32; 2], [w, h]: [u32; 2], how: impl Fn(u8) -> u8) {
    let width = image.size[0];
    for row in y..y + h {
        let from = (row * width + x) as usize;
        for texel in &mut image.texels[from..from + w as usize] {
            (0..3).for_each(|channel| texel[channel] = how(texel[channel]));
        }
    }
}
