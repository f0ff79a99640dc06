//! The thesis's own figures (Lam 2016, §6.5), on its machine.

use schemars::JsonSchema;
use serde::Serialize;

/// The stages that are timed, in order.
pub const STAGES: [&str; 5] = ["FC", "GP", "PP", "MC", "CI"];

/// A row of Table 6.2.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Published {
    /// Size and place, such as `small I`.
    pub name: &'static str,
    /// Faces that the line crosses.
    pub faces: u32,
    /// Length of the line, texture widths.
    pub length: f64,
    /// Milliseconds of the five stages.
    pub ms: [f64; 5],
}

const fn published(name: &'static str, faces: u32, length: f64, ms: [f64; 5]) -> Published {
    Published { name, faces, length, ms }
}

/// Table 6.2, in its order.
pub const CUTS: [Published; 18] = [
    published("small I", 4, 0.025, [0.014, 0.219, 6.848, 3.638, 2.721]),
    published("small III", 6, 0.042, [0.017, 0.225, 12.717, 2.154, 1.106]),
    published("small II", 6, 0.051, [0.017, 0.224, 13.003, 2.184, 1.120]),
    published("small VI", 8, 0.027, [0.019, 0.226, 16.841, 2.006, 1.011]),
    published("small V", 8, 0.038, [0.020, 0.226, 20.919, 1.839, 0.924]),
    published("small IV", 9, 0.048, [0.018, 0.227, 25.360, 2.049, 0.966]),
    published("medium I", 9, 0.052, [0.021, 0.237, 12.532, 2.540, 1.199]),
    published("medium III", 11, 0.084, [0.025, 0.238, 18.767, 2.180, 1.044]),
    published("medium II", 11, 0.096, [0.022, 0.255, 19.865, 2.307, 1.044]),
    published("medium IV", 17, 0.095, [0.026, 0.253, 54.019, 3.222, 1.388]),
    published("medium VI", 18, 0.061, [0.027, 0.221, 32.418, 3.471, 1.419]),
    published("medium V", 19, 0.076, [0.030, 0.225, 46.359, 3.446, 1.450]),
    published("large I", 22, 0.119, [0.035, 0.267, 23.740, 4.085, 1.593]),
    published("large II", 24, 0.191, [0.036, 0.264, 34.373, 4.081, 1.690]),
    published("large III", 25, 0.176, [0.038, 0.256, 34.134, 4.073, 1.727]),
    published("large IV", 30, 0.173, [0.040, 0.249, 145.400, 4.962, 1.916]),
    published("large V", 39, 0.155, [0.051, 0.248, 101.956, 6.079, 2.347]),
    published("large VI", 46, 0.151, [0.053, 0.249, 95.329, 7.562, 2.672]),
];

/// Table 6.3: cuts in view, and milliseconds of a frame.
pub const FRAMES: [(usize, f64); 4] = [(0, 2.173), (10, 2.215), (20, 2.242), (30, 2.273)];

/// Figure 6.7: what the discoloration adds to the scattering's time, at 10 and at 50 cuts, as a share.
pub const LOCALIZED: f64 = 0.13;

impl Published {
    /// Milliseconds of FC, MC and CI together.
    pub fn mesh(&self) -> f64 {
        self.ms[0] + self.ms[3] + self.ms[4]
    }

    /// Milliseconds of all five stages.
    pub fn total(&self) -> f64 {
        self.ms.iter().sum()
    }

    /// The file of its recording.
    pub fn file(&self) -> String {
        format!("thesis-{}.lancet", self.name.replace(' ', "-"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_is_the_theses() {
        let mean = |of: fn(&Published) -> f64| CUTS.iter().map(of).sum::<f64>() / CUTS.len() as f64;
        assert!((mean(Published::mesh) - 4.985).abs() < 1e-3);
        // The thesis gives the totals too; they add up to 808.615 ms.
        assert!((mean(Published::total) * 18.0 - 808.615).abs() < 0.01);
        assert!(CUTS.is_sorted_by_key(|row| row.faces));
    }
}
