//! Pictures against their goldens.
//!
//! Equal bytes pass at once. Else the picture is [measured](distance) and held against the [gates](gates) of the adapter that rendered it; the
//! CPU reference has none, since it is the same everywhere. Each golden also [proves](plant) that the gates would catch a defect in it.

mod difference;
mod distance;
mod gates;
mod plant;
mod probe;
mod skin;

#[cfg(test)]
pub(super) mod tests;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use difference::difference;
pub use distance::{Distance, Metric};
pub use gates::{Gate, GatesError, GatesFile, Known};
pub use plant::{Defect, Planted, Proof};
pub use probe::Probe;

pub(super) use distance::measure;
pub(super) use plant::prove;
pub(super) use skin::Skin;

use crate::canvas::image::Image;
use crate::canvas::{Adapter, Kind};
use crate::replay::CheckpointFrame;

/// What became of a checkpoint's picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ImageVerdict {
    /// Byte for byte its golden.
    Equal,
    /// Not its golden, but no farther than the gate.
    Within,
    /// Farther than the gate.
    Beyond,
    /// There is no golden to compare it with.
    Unseen,
}

/// What there is to say of a checkpoint's picture.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ImageReport {
    /// The checkpoint.
    pub checkpoint: String,
    /// Its event.
    pub event: usize,
    /// Width and height.
    pub size: [u32; 2],
    /// What became of it.
    pub verdict: ImageVerdict,
    /// How far it is from its golden; none without one.
    pub distance: Option<Distance>,
    /// The top left pixel of the worst tile, where they differ.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub worst_tile: Option<[u32; 2]>,
    /// How far it may be.
    pub gate: Gate,
    /// The gate that the planted defects were held against.
    pub proven_by: String,
    /// Whether the golden is sensitive.
    pub proof: Proof,
}

impl ImageReport {
    /// Whether nothing is wrong with it.
    pub fn is_fine(&self) -> bool {
        self.problems().is_empty()
    }

    /// What is wrong with it, a line each. That it has no golden is said where goldens are.
    pub fn problems(&self) -> Vec<String> {
        let mut lines = Vec::new();
        if let (ImageVerdict::Beyond, Some(distance)) = (self.verdict, self.distance) {
            let beyond = distance.beyond(&self.gate.most);
            let metric = beyond.map_or(String::new(), |metric| format!("{metric}: "));
            let at = self.worst_tile.map_or(String::new(), |[x, y]| format!(", worst around ({x}, {y})"));
            lines.push(format!(
                "picture {}: {metric}{distance}{at}; at most {} ({})",
                self.checkpoint, self.gate.most, self.gate.of
            ));
        }
        let missed = self.proof.missed();
        lines.extend(missed.map(|defect| {
            format!(
                "picture {}: insensitive: a planted {defect} passes ({})",
                self.checkpoint, self.proven_by
            )
        }));
        lines
    }
}

/// How pictures of an adapter are judged.
#[derive(Clone, Debug)]
pub(super) struct Rules {
    /// How far they may be.
    pub(super) gate: Gate,
    /// What the planted defects are held against: of the reference, to which any defect is one, the general gate.
    proving: Gate,
}

impl Rules {
    pub(super) fn new(gates: &GatesFile, adapter: &Adapter) -> Self {
        let gate = gates.gate(adapter);
        let proving = if adapter.kind == Kind::Reference { gates.general() } else { gate.clone() };
        Self { gate, proving }
    }

    /// Judges a checkpoint's picture by its golden, which has its size.
    pub(super) fn judge(&self, found: &CheckpointFrame, golden: Option<&Image>) -> ImageReport {
        let mut report = self.unseen(found);
        let Some(golden) = golden else { return report };
        let skin = Skin::of(golden, found.background);
        report.proof = prove(golden, &skin, &self.proving.most);
        if *golden == found.frame.image {
            (report.verdict, report.distance) = (ImageVerdict::Equal, Some(Distance::default()));
            return report;
        }
        let measured = measure(golden, &found.frame.image, &skin);
        let beyond = measured.distance.beyond(&self.gate.most).is_some();
        report.verdict = if beyond { ImageVerdict::Beyond } else { ImageVerdict::Within };
        (report.distance, report.worst_tile) = (Some(measured.distance), Some(measured.worst_tile));
        report
    }

    fn unseen(&self, found: &CheckpointFrame) -> ImageReport {
        ImageReport {
            checkpoint: found.name.clone(),
            event: found.event,
            size: found.frame.image.size,
            verdict: ImageVerdict::Unseen,
            distance: None,
            worst_tile: None,
            gate: self.gate.clone(),
            proven_by: self.proving.of.clone(),
            proof: Proof::default(),
        }
    }
}
