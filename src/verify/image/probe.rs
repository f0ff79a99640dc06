//! The gates as something to be measured: what a comparison costs, and the smallest defect that it catches.

use std::path::Path;

use super::distance::{Distance, Metric, structure, sweep};
use super::gates::Gate;
use super::plant::{planted_by, usual};
use super::skin::Skin;
use super::{Defect, GatesFile};
use crate::canvas::image::Image;
use crate::verify::home;
use crate::verify::suite::read_gates;

/// A golden, and the gate that defects in it are held against.
#[derive(Clone, Debug)]
pub struct Probe {
    golden: Image,
    skin: Skin,
    gate: Gate,
}

impl Probe {
    /// A golden before a background, and the general gate of a file.
    pub fn new(golden: Image, background: [u8; 4], gates: &GatesFile) -> Self {
        Self { skin: Skin::of(&golden, background), golden, gate: gates.general() }
    }

    /// The gates that hold for the recordings in a folder.
    pub fn gates(recordings: &Path) -> Result<GatesFile, String> {
        read_gates(&home::gates(&recordings.join("any")))
    }

    /// The same with another gate.
    #[must_use]
    pub fn with_gate(self, most: Distance) -> Self {
        Self { gate: Gate { most, ..self.gate }, ..self }
    }

    /// The golden.
    pub fn golden(&self) -> &Image {
        &self.golden
    }

    /// The first of some measures by which a picture is beyond the gate. Only the work that these take is done: all but structure take one
    /// sweep together.
    pub fn caught(&self, found: &Image, by: &[Metric]) -> Option<Metric> {
        let cheap: Vec<Metric> = by.iter().copied().filter(|metric| *metric != Metric::Structure).collect();
        let beyond = |distance: Distance, by: &[Metric]| {
            by.iter().copied().find(|metric| distance.get(*metric) > self.gate.most.get(*metric))
        };
        let swept = (!cheap.is_empty()).then(|| sweep(&self.golden, found, &self.skin).distance);
        swept.and_then(|distance| beyond(distance, &cheap)).or_else(|| {
            let last = by.contains(&Metric::Structure).then(|| structure(&self.golden, found))?;
            beyond(Distance { structure: last, ..Distance::default() }, &[Metric::Structure])
        })
    }

    /// The golden with a defect of a size, in pixels or levels; none where there is no room for it.
    pub fn planted(&self, defect: Defect, size: f64) -> Option<Image> {
        planted_by(&self.golden, &self.skin, defect, size)
    }

    /// The size of the defect that every golden has to catch.
    pub fn usual(&self, defect: Defect) -> f64 {
        usual(&self.golden, defect)
    }
}
