//! Generators and oracles of the fuzzers.

pub use crate::measure::exact;
