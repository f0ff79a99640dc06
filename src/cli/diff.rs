//! `lancet diff`: where two runs part. A side is a recording or a script, which is replayed, or the report of a replay.

use std::io::{self, Write};

use super::args::Diff;
use super::console::Channel;
use super::failure::Failure;
use super::{Console, Done, Status, json};
use crate::report::printable;
use crate::verify;

/// As many divergences are shown; `--json` has more.
const SHOWN: usize = 10;

pub(super) fn run(typed: &Diff, console: &mut Console<'_>) -> Done {
    let diff = verify::against_run(&typed.b, &typed.a, &verify::unwatched).map_err(Failure::new)?;
    json::write(&diff, typed.json.to.as_ref(), console)?;
    show(&diff, json::text([&typed.json.to], console))?;
    Ok(if diff.is_empty() { Status::Verified } else { Status::Diverged })
}

fn show(diff: &verify::Diff, to: &mut Channel<'_>) -> io::Result<()> {
    if let Some(inputs) = &diff.inputs {
        writeln!(to, "the inputs differ first in {}", printable(inputs))?;
    }
    if diff.is_empty() {
        return writeln!(to, "{}", to.good("the runs are the same"));
    }
    for (at, divergence) in diff.divergences.iter().take(SHOWN).enumerate() {
        let label = if at == 0 { to.bad("the runs part at") } else { to.faint("then at") };
        writeln!(to, "{label} {}", printable(divergence))?;
    }
    if diff.differing > SHOWN {
        writeln!(to, "and {} more", diff.differing - SHOWN)?;
    }
    if !diff.new.is_empty() {
        writeln!(to, "only the second knows: {}", printable(diff.new.join(", ")))?;
    }
    writeln!(to, "{} facts differ", diff.differing)
}
