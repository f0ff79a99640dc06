//! How far a renderer may be from the goldens: `golden/gates.json`.
//!
//! ```json
//! { "version": 1, "adapters": [
//!     { "adapter": "llvmpipe*", "reason": "software Vulkan, as in CI",
//!       "measured": { "tile": 0.4, "outliers": 2, "tone": 0.02, "displacement": 0.001, "structure": 0.001 } } ] }
//! ```
//!
//! An entry is what was measured: the worst distance of an adapter from the reference over the goldens, and why it is fine. The
//! gate is twice that, and no less than [`FLOOR`], since a shader compiler of another version is no defect. It has to lie below the
//! smallest planted defect ([`SMALLEST_DEFECT`]); whether it does for each single golden is proven there.
//!
//! The first entry whose pattern (`*` stands for anything) is the adapter's name holds for it; for an adapter that is not known, the largest of all. The
//! reference has no gate: it is exact.

use std::fmt;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::distance::{Distance, Metric};
use crate::canvas::{Adapter, Kind};

/// Version of the file.
const VERSION: u32 = 1;
/// No gate is narrower.
const FLOOR: Distance =
    Distance { tile: 0.25, outliers: 4, tone: 0.05, displacement: 0.02, structure: 0.002 };
/// What each measure has to catch: tile and outliers a crack in skin of 160 or more, tone the tone shift; displacement and structure
/// the one-pixel shift, which costs a frame that is half full a structure of 0.14 and more.
const SMALLEST_DEFECT: Distance =
    Distance { tile: 7.5, outliers: 40, tone: 3.0, displacement: 0.8, structure: 0.12 };

/// An adapter whose distance from the reference is known.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Known {
    /// Its name; `*` stands for anything.
    pub adapter: String,
    /// Why its distance is fine.
    pub reason: String,
    /// The worst distance of any golden.
    pub measured: Distance,
}

/// The adapters whose distance from the reference is known.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GatesFile {
    /// Version of this layout.
    pub version: u32,
    /// The adapters; the first that matches holds.
    pub adapters: Vec<Known>,
}

impl Default for GatesFile {
    fn default() -> Self {
        Self { version: VERSION, adapters: Vec::new() }
    }
}

/// What is wrong with a file of gates.
#[derive(Clone, Debug, PartialEq)]
pub enum GatesError {
    /// It is not the JSON that it should be; with line and column.
    Json(String),
    /// It has another layout.
    Version(u32),
    /// An entry has no pattern, or no reason.
    Empty {
        /** Its place. */
        entry: usize,
        /** Which of the two. */
        what: &'static str,
    },
    /// A distance is no number from 0 up.
    NoDistance {
        /** The adapter. */
        adapter: String,
        /** The measure. */
        metric: Metric,
    },
    /// A gate would let a planted defect pass.
    TooWide {
        /** The adapter. */
        adapter: String,
        /** The measure. */
        metric: Metric,
        /** The gate. */
        gate: f64,
        /** The smallest planted defect. */
        defect: f64,
    },
}

impl fmt::Display for GatesError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Json(why) => f.write_str(why),
            Self::Version(version) => write!(f, "its version is {version}, not {VERSION}"),
            Self::Empty { entry, what } => write!(f, "adapters[{entry}] has no {what}"),
            Self::NoDistance { adapter, metric } => write!(f, "{adapter}: {metric} is no distance"),
            Self::TooWide { adapter, metric, gate, defect } => write!(
                f,
                "{adapter}: the gate of {metric}, twice what was measured, is {gate}, and the smallest planted defect {defect}"
            ),
        }
    }
}

impl std::error::Error for GatesError {}

/// How far a picture may be from its golden.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Gate {
    /// Whose distance it comes from.
    pub of: String,
    /// How far at most.
    pub most: Distance,
}

impl Known {
    /// Twice what was measured, and no less than the floor. An error says why that is no gate.
    pub(crate) fn gate(&self) -> Result<Distance, GatesError> {
        let Distance { tile, outliers, tone, displacement, structure } = self.measured;
        let twice = Distance {
            tile: tile * 2.0,
            outliers: outliers.saturating_mul(2),
            tone: tone * 2.0,
            displacement: displacement * 2.0,
            structure: structure * 2.0,
        };
        for metric in Metric::ALL {
            let (gate, defect) = (twice.get(metric), SMALLEST_DEFECT.get(metric));
            let adapter = || self.adapter.clone();
            if !(gate >= 0.0 && gate.is_finite()) {
                return Err(GatesError::NoDistance { adapter: adapter(), metric });
            }
            if gate >= defect {
                return Err(GatesError::TooWide { adapter: adapter(), metric, gate, defect });
            }
        }
        Ok(twice.max(&FLOOR))
    }

    fn is_of(&self, adapter: &Adapter) -> bool {
        matches(&self.adapter, &adapter.name)
    }
}

/// Whether a name is what a pattern says; `*` stands for anything.
fn matches(pattern: &str, name: &str) -> bool {
    let Some((first, rest)) = pattern.split_once('*') else { return pattern == name };
    let Some(mut name) = name.strip_prefix(first) else { return false };
    let mut parts: Vec<&str> = rest.split('*').collect();
    let last = parts.pop().unwrap_or_default();
    for part in parts {
        let Some(at) = name.find(part) else { return false };
        name = &name[at + part.len()..];
    }
    name.ends_with(last)
}

impl GatesFile {
    /// Reads a file of gates.
    pub fn parse(text: &[u8]) -> Result<Self, GatesError> {
        let file: Self = serde_json::from_slice(text).map_err(|e| GatesError::Json(e.to_string()))?;
        if file.version != VERSION {
            return Err(GatesError::Version(file.version));
        }
        for (entry, known) in file.adapters.iter().enumerate() {
            let empty = |what| Err(GatesError::Empty { entry, what });
            match (known.adapter.trim().is_empty(), known.reason.trim().is_empty()) {
                (true, _) => return empty("adapter"),
                (_, true) => return empty("reason"),
                _ => known.gate()?,
            };
        }
        Ok(file)
    }

    /// Its text.
    pub(crate) fn text(&self) -> Vec<u8> {
        let mut text = serde_json::to_vec_pretty(self).expect("names and numbers always have a form");
        text.push(b'\n');
        text
    }

    /// The gate of an adapter.
    pub fn gate(&self, adapter: &Adapter) -> Gate {
        if adapter.kind == Kind::Reference {
            return Gate { of: "exact".into(), most: Distance::default() };
        }
        let own = self.adapters.iter().find(|known| known.is_of(adapter));
        let own = own.and_then(|known| Some(Gate { of: known.adapter.clone(), most: known.gate().ok()? }));
        own.unwrap_or_else(|| self.general())
    }

    /// The largest gate of all known adapters.
    pub fn general(&self) -> Gate {
        let of = if self.adapters.is_empty() { "no adapter is known" } else { "all known adapters" };
        let gates = self.adapters.iter().filter_map(|known| known.gate().ok());
        Gate { of: of.into(), most: gates.fold(FLOOR, |widest, gate| widest.max(&gate)) }
    }

    /// The entry of an adapter, where there is one.
    pub(crate) fn entry(&self, adapter: &Adapter) -> Option<&Known> {
        self.adapters.iter().find(|known| known.is_of(adapter))
    }

    /// Puts an entry in place of the one with its pattern, or at the end.
    pub(crate) fn put(&mut self, entry: Known) {
        match self.adapters.iter_mut().find(|known| known.adapter == entry.adapter) {
            Some(known) => *known = entry,
            None => self.adapters.push(entry),
        }
    }
}
