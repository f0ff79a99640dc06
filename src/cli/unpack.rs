//! `lancet unpack`: a recording's script.

use std::path::Path;

use super::args::Unpack;
use super::{Console, Done, Status, json, place};
use crate::recording::Script;
use crate::replay;

pub(super) fn run(typed: &Unpack, console: &mut Console<'_>) -> Done {
    let recording = replay::read(&typed.recording)?;
    let mut script = Script::of(&recording);
    let folder = typed.recording.parent().unwrap_or(Path::new(""));
    script.set_scene(place::moved(recording.scene(), folder, &typed.output)?);
    let mut text = Vec::new();
    script.write(&mut text)?;
    json::put(&text, &typed.output, console)?;
    Ok(Status::Verified)
}
