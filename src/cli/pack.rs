//! `lancet pack`: a recording from its script, with the hashes that its scene is found to have.

use super::args::{Pack, Target};
use super::failure::Failure;
use super::{Console, Done, Status, json, place};
use crate::recording::to_bytes;
use crate::replay::Case;

pub(super) fn run(typed: &Pack, console: &mut Console<'_>) -> Done {
    if let Target::File(output) = &typed.output {
        place::require_other(&typed.script, output)?;
    }
    let mut case = Case::open(&typed.script)?;
    let scene = place::moved(case.recording.scene(), &case.folder, &typed.output)?;
    case.recording.set_scene(scene);
    let bytes = to_bytes(&case.recording).map_err(|e| Failure::about(&typed.script)(&e))?;
    json::put(&bytes, &typed.output, console)?;
    Ok(Status::Verified)
}
