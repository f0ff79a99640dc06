//! JSON answers, to a file or to standard output.

use std::io::Write;

use serde::Serialize;

use super::args::Target;
use super::console::{Channel, Console};
use super::failure::Failure;
use crate::assets;

/// Writes an answer where it was asked for; nowhere when it was not.
pub(super) fn write(
    value: &impl Serialize,
    to: Option<&Target>,
    console: &mut Console<'_>,
) -> Result<(), Failure> {
    let Some(target) = to else { return Ok(()) };
    let mut bytes = serde_json::to_vec_pretty(value).map_err(Failure::new)?;
    bytes.push(b'\n');
    put(&bytes, target, console)
}

/// Writes bytes to a file or to standard output.
pub(super) fn put(bytes: &[u8], target: &Target, console: &mut Console<'_>) -> Result<(), Failure> {
    match target {
        Target::Stdout => Ok(console.out.write_all(bytes)?),
        Target::File(path) => Ok(assets::write_output(path, bytes)?),
    }
}

/// Where the same is said for people: beside an answer on standard output there is only standard error.
pub(super) fn text<'c, 'a, const N: usize>(
    answers: [&Option<Target>; N],
    console: &'c mut Console<'a>,
) -> &'c mut Channel<'a> {
    let taken = answers.into_iter().any(|to| *to == Some(Target::Stdout));
    if taken { &mut console.err } else { &mut console.out }
}
