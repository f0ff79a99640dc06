//! Goldens: what a run was when somebody last looked at it, and whether it still is.
//!
//! A recording's goldens are text for people (`facts`: outcomes, counts, counters, then digests; one file for the run, one for each
//! checkpoint) and, beside the run's, the changed values behind the digests (`values`), so that a divergence is named down to the
//! element. Verifying replays the recording and compares fact by fact; what differs is named, in the order of the run. A fact that the golden does not know is new; it hides nothing about those that it knows.
//!
//! **Pictures.** A checkpoint's golden picture (`picture`) is a PNG beside its text, blessed from the CPU reference. The reference has to give it
//! byte for byte; a device has to come within the gates of its adapter (`image`), and every golden proves that the gates would catch a
//! defect in it. Who renders is given by the front end.
//!
//! A missing, damaged, mis-sized or orphaned golden is a failure, never a reason to write one: only [`bless()`] and [`gauge()`] write.
//!
//! **Reports.** [`VerifyReport`] is plain data; as a page ([`html()`]), as [`junit()`] XML, and as a [`Blob`] that holds all that the page shows, so that
//! [`merge()`] can make one report of the shards of several machines.

mod against;
mod bless;
mod blob;
mod compare;
mod detail;
mod diff;
mod facts;
mod gauge;
mod golden;
mod home;
mod html;
mod image;
mod junit;
mod merge;
mod one;
mod picture;
mod report;
mod shard;
mod skips;
mod suite;
mod values;

#[cfg(test)]
mod tests;

pub use against::{Compared, ComparedPicture, against_goldens, against_run};
pub use bless::{BlessOptions, BlessReport, Blessed, Change, bless};
pub use blob::Blob;
pub use compare::Divergence;
pub use detail::{Detail, EventDetail, PictureDetail, StageDetail};
pub use diff::{Diff, Side, diff};
pub use gauge::{GaugeReport, gauge};
pub use html::html;
pub use image::{
    Defect, Distance, Gate, GatesError, GatesFile, ImageReport, ImageVerdict, Known, Metric, Planted, Probe,
    Proof, difference,
};
pub use junit::junit;
pub use merge::{MergeError, merge};
pub use one::{Watch, failure, unwatched};
pub use report::{RecordingReport, Verdict, VerifyReport};
pub use shard::{Shard, ShardReport};
pub use skips::Skips;
pub use suite::{Progress, VerifyOptions, verify, verify_to_blob};
