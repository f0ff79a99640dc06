//! Goldens: what a run was when somebody last looked at it, and whether it still is.
//!
//! A recording's goldens are text for people (`facts`: outcomes, counts, counters, then digests; one file for the run, one for each
//! checkpoint) and, beside the run's, the changed values behind the digests (`values`), so that a divergence is named down to the
//! element. Verifying replays the recording and compares fact by fact; the first that differs, in the order of the run, is
//! named. A fact that the golden does not know is new; it hides nothing about those that it knows.
//!
//! A missing, damaged or orphaned golden is a failure, never a reason to write one: only [`bless`] writes.

mod bless;
mod compare;
mod diff;
mod facts;
mod golden;
mod home;
mod one;
mod report;
mod suite;
mod values;

#[cfg(test)]
mod tests;

pub use bless::{BlessOptions, BlessReport, Blessed, Change, bless};
pub use compare::Divergence;
pub use diff::{Diff, Side, diff};
pub use one::failure;
pub use report::{RecordingReport, Verdict, VerifyReport};
pub use suite::{Progress, VerifyOptions, verify};
