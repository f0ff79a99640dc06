//! `lancet info`: what is in a recording. Of a damaged one: what is wrong, and what is in the part before it.

use std::path::Path;

use super::args::Info;
use super::failure::Failure;
use super::table::TextTable;
use super::{Console, Done, Status, json};
use crate::assets;
use crate::recording::{self, AnyRecording, Summary, summary};
use crate::replay;

pub(super) fn run(typed: &Info, console: &mut Console<'_>) -> Done {
    let (recording, damage) = readable(&typed.recording)?;
    let summary = summary(&recording)?;
    json::write(&summary, typed.json.to.as_ref(), console)?;
    if typed.json.to.is_none() {
        table(&summary).write(&mut console.out)?;
    }
    damage.map_or(Ok(Status::Verified), Err)
}

/// The recording, or the valid part of a damaged one and what is wrong with it.
fn readable(path: &Path) -> Result<(AnyRecording, Option<Failure>), Failure> {
    let bytes = assets::read_file(path)?;
    if recording::is_script(path, &bytes) {
        return Ok((replay::read(path)?, None));
    }
    match recording::read(&bytes) {
        Ok(recording) => Ok((recording, None)),
        Err(error) => {
            let failure = Failure::about(path)(&error);
            error.prefix.map(|prefix| (prefix, Some(failure.clone()))).ok_or(failure)
        }
    }
}

fn table(summary: &Summary) -> TextTable {
    let [width, height] = summary.viewport;
    let kinds: Vec<String> = summary.kinds.iter().map(|(kind, count)| format!("{count} {kind}")).collect();
    let hash = |hash: &Option<String>| hash.clone().unwrap_or_else(|| "found when packed".into());
    let mut table = TextTable::pairs();
    table.pair("engine", &summary.engine);
    table.pair("scene", &summary.scene);
    table.pair("scene hash", hash(&summary.scene_hash));
    table.pair("mesh hash", hash(&summary.mesh_hash));
    table.pair("viewport", format!("{width} x {height}"));
    table.pair("seed", summary.seed);
    table.pair("events", format!("{} ({})", summary.events, kinds.join(", ")));
    table.pair("checkpoints", summary.checkpoints.join(", "));
    table.pair("file", format!("{} bytes, format version {}", summary.bytes, summary.version));
    table
}
