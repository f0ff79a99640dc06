//! Old versions load for ever.

use super::{EVERYTHING, everything, pack, parse};
use crate::recording::read;

const V1: &[u8] = include_bytes!("../../../tests/fixtures/recordings/v1.lancet");
const V1_SCRIPT: &str = include_str!("../../../tests/fixtures/recordings/v1.json");

#[test]
fn version_1_loads() {
    assert_eq!(read(V1).unwrap(), pack(V1_SCRIPT));
}

#[test]
fn version_1_scripts_load() {
    assert_eq!(parse(V1_SCRIPT), parse(EVERYTHING));
}

/// Goes when a second version is written; the test above stays.
#[test]
fn version_1_is_what_is_written() {
    assert_eq!(everything(), V1);
}
