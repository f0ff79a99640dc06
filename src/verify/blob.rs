//! A report with all that its page shows, as one JSON file: what a shard writes, and `lancet merge` reads.

use serde::{Deserialize, Serialize};

use super::detail::Detail;
use super::report::VerifyReport;

/// Version of the file.
const VERSION: u32 = 1;

/// A report, and what a page shows of its recordings.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Blob {
    /// Version of this layout.
    pub lancet_blob: u32,
    /// The report.
    pub report: VerifyReport,
    /// Of every recording that was replayed, in their order.
    pub details: Vec<Detail>,
}

impl Blob {
    pub(super) fn new(report: VerifyReport, details: Vec<Detail>) -> Self {
        Self { lancet_blob: VERSION, report, details }
    }

    /// Its file.
    pub fn text(&self) -> Vec<u8> {
        serde_json::to_vec(self).expect("names, numbers and texts always have a form")
    }

    /// Reads a file. An error says what is wrong with it, and where.
    pub fn parse(text: &[u8]) -> Result<Self, String> {
        let blob: Self = serde_json::from_slice(text).map_err(|e| format!("no blob of verify: {e}"))?;
        match blob.lancet_blob {
            VERSION => Ok(blob),
            other => Err(format!("a blob of version {other}, not {VERSION}")),
        }
    }

    /// The same with every time at zero: two blobs of the same recordings are compared so.
    #[must_use]
    pub fn without_times(&self) -> Self {
        let details = self.details.iter().cloned().map(Detail::without_times);
        Self::new(self.report.without_times(), details.collect())
    }
}
