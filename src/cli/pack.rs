//! `lancet pack`: a recording from its script, with the hashes that its scene is found to have.

use super::args::Pack;
use super::failure::Failure;
use super::{Console, Done, Status, input, json};
use crate::recording::to_bytes;

pub(super) fn run(typed: &Pack, console: &mut Console<'_>) -> Done {
    let mut input = input::hashed(&typed.script)?;
    let scene = input::moved(input.recording.scene(), &input.base, &typed.output)?;
    input.recording.set_scene(scene);
    let bytes = to_bytes(&input.recording).map_err(|e| Failure::about(&typed.script)(&e))?;
    json::put(&bytes, &typed.output, console)?;
    Ok(Status::Verified)
}
