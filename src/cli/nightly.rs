//! `lancet nightly`: everything that can find something, for some time, and one report.

use super::args::Nightly;
use super::{Console, Done};

#[cfg(feature = "attack")]
pub(super) fn run(typed: &Nightly, console: &mut Console<'_>) -> Done {
    use std::sync::{Mutex, PoisonError};

    use super::verify::{jobs, no_planted_bug, status};
    use super::{json, pixels};
    use crate::attack::nightly::Night;
    use crate::verify::VerifyOptions;

    no_planted_bug()?;
    let studio = pixels::studio(typed.renderer, console)?;
    let jobs = jobs(typed.jobs);
    let night = Night {
        time: typed.time.0,
        seed: typed.seed.unwrap_or_else(day),
        jobs,
        recordings: typed.paths.clone(),
        verify: VerifyOptions { jobs, studio: Some(studio.into()), ..VerifyOptions::default() },
        fuzz: typed.fuzz.clone(),
        findings: typed.findings.clone(),
    };
    let report = {
        let work = Mutex::new(console.err.work());
        night.run(&|what| work.lock().unwrap_or_else(PoisonError::into_inner).show(format_args!("{what}")))
    };
    json::write(&report, typed.json.as_ref(), console)?;
    show(&report, json::text([&typed.json], console))?;
    Ok(status(report.exit_code()))
}

/// Days since the beginning of 1970.
#[cfg(feature = "attack")]
#[expect(clippy::disallowed_methods, reason = "a night tries other things than the one before")]
fn day() -> u64 {
    use std::time::{SystemTime, UNIX_EPOCH};
    SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs() / 86_400)
}

#[cfg(feature = "attack")]
fn show(
    report: &crate::attack::nightly::NightReport,
    to: &mut super::console::Channel<'_>,
) -> std::io::Result<()> {
    use std::io::Write;

    use crate::report::printable;

    report.tables().iter().try_for_each(|table| super::measure::show(table, to))?;
    for part in &report.parts {
        writeln!(to, "{}: {}", part.name, printable(&part.detail))?;
        for finding in &part.findings {
            let label = to.bad("finding:");
            let file =
                finding.file.as_ref().map(|file| format!("\n  {}", file.display())).unwrap_or_default();
            writeln!(to, "{label} {}{file}", printable(&finding.detail))?;
        }
    }
    let found: usize = report.parts.iter().map(|part| part.findings.len()).sum();
    let text = format!("{found} findings in {:.0} s", report.seconds);
    let text = if report.exit_code() == 0 { to.good(text) } else { to.bad(text) };
    writeln!(to, "{text}")
}

#[cfg(not(feature = "attack"))]
pub(super) fn run(_: &Nightly, _: &mut Console<'_>) -> Done {
    Err(super::failure::Failure::new("this program was built without the feature `attack`: it cannot fuzz"))
}
