//! `lancet unpack`: a recording's script.

use super::args::Unpack;
use super::failure::Failure;
use super::{Console, Done, Status, input, json};
use crate::recording::Script;

pub(super) fn run(typed: &Unpack, console: &mut Console<'_>) -> Done {
    let input = input::read(&typed.recording)?;
    let mut script = Script::of(&input.recording);
    script.set_scene(input::moved(input.recording.scene(), &input.base, &typed.output)?);
    let mut text = Vec::new();
    script.write(&mut text).map_err(Failure::new)?;
    json::put(&text, &typed.output, console)?;
    Ok(Status::Verified)
}
