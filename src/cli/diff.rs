//! `lancet diff`: where two runs part. A side is a recording or a script, which is replayed, or the report of a replay.

use std::io::{self, Write};
use std::path::Path;

use serde_json::Value;

use super::args::Diff;
use super::console::Channel;
use super::failure::Failure;
use super::{Console, Done, Status, json};
use crate::assets;
use crate::recording::{AnyRecording, first_difference};
use crate::replay::{Case, Options};
use crate::report::{RunReport, SCHEMA};
use crate::verify::{self, Side};

pub(super) fn run(typed: &Diff, console: &mut Console<'_>) -> Done {
    let [(a, run_a), (b, run_b)] = [side(&typed.a)?, side(&typed.b)?];
    let diff = verify::diff(run_a, run_b);
    json::write(&diff, typed.json.to.as_ref(), console)?;
    let to = json::text([&typed.json.to], console);
    if let Some(said) = a.zip(b).and_then(|(a, b)| first_difference(&a, &b)) {
        writeln!(to, "the inputs differ first in {said}")?;
    }
    show(&diff, to)?;
    Ok(if diff.is_empty() { Status::Verified } else { Status::Diverged })
}

fn show(diff: &verify::Diff, to: &mut Channel<'_>) -> io::Result<()> {
    if diff.is_empty() {
        return writeln!(to, "{}", to.good("the runs are the same"));
    }
    if let Some(divergence) = &diff.divergence {
        let label = to.bad("the runs part at");
        writeln!(to, "{label} {divergence}")?;
    }
    if !diff.new.is_empty() {
        writeln!(to, "only the second knows: {}", diff.new.join(", "))?;
    }
    writeln!(to, "{} facts differ", diff.differing)
}

/// A side, with its recording where it has one.
fn side(path: &Path) -> Result<(Option<AnyRecording>, Side), Failure> {
    let bytes = assets::read_file(path)?;
    if let Some(run) = report(path, &bytes)? {
        return Ok((None, Side { run, deltas: Vec::new() }));
    }
    let case = Case::open(path)?;
    let options = Options { keep_deltas: true, ..Options::default() };
    let mut replay = case.replay(&case.recording, options, None)?;
    replay.finish();
    let side = Side { run: replay.run_report(&path.display().to_string()), deltas: replay.take_deltas() };
    Ok((Some(case.recording), side))
}

/// The report of a replay, which is JSON with the version of its layout.
fn report(path: &Path, bytes: &[u8]) -> Result<Option<RunReport>, Failure> {
    let value = serde_json::from_slice::<Value>(bytes).ok();
    let Some(version) = value.as_ref().and_then(|value| value.get("schema")) else { return Ok(None) };
    if version != SCHEMA {
        return Err(Failure::about(path)(&format_args!("a report of schema {version}, not {SCHEMA}")));
    }
    serde_json::from_slice(bytes).map(Some).map_err(|e| Failure::about(path)(&e))
}
