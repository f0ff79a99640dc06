//! `lancet verify`: every recording against its goldens.

use std::io::{self, Write};
use std::sync::{Mutex, PoisonError};
use std::thread::available_parallelism;

use anstyle::AnsiColor;

use super::args::Verify;
use super::console::{Channel, Work};
use super::table::{Cell, TextTable};
use super::{Console, Done, Status, json};
use crate::replay::Options;
use crate::verify::{self, Progress, RecordingReport, Verdict, VerifyOptions, VerifyReport};

pub(super) fn run(typed: &Verify, console: &mut Console<'_>) -> Done {
    let report = verify::verify(&typed.paths, &meaning(typed), &Line::on(&mut console.err));
    json::write(&report, typed.json.as_ref(), console)?;
    show(&report, json::text([&typed.json], console))?;
    Ok(status(report.exit_code()))
}

/// What was typed means this.
fn meaning(typed: &Verify) -> VerifyOptions {
    let plant = typed.plant.clone();
    VerifyOptions {
        filter: typed.select.filter.clone(),
        jobs: jobs(typed.select.jobs),
        fail_fast: typed.fail_fast,
        replay: Options { paranoid: typed.paranoid, plant, ..Options::default() },
    }
}

/// As many recordings at a time as there are processors, unless something else was said.
pub(super) fn jobs(typed: Option<u16>) -> usize {
    typed.map_or_else(|| available_parallelism().map_or(1, usize::from), usize::from)
}

/// A report's own exit status.
pub(super) fn status(code: u8) -> Status {
    match code {
        0 => Status::Verified,
        1 => Status::Diverged,
        _ => Status::Failed,
    }
}

/// The progress line, drawn from whichever thread is done.
pub(super) struct Line<'c, 'w>(Mutex<Work<'c, 'w>>);

impl<'c, 'w> Line<'c, 'w> {
    pub(super) fn on(channel: &'c mut Channel<'w>) -> Self {
        Self(Mutex::new(channel.work()))
    }
}

impl Progress for Line<'_, '_> {
    fn done(&self, done: usize, of: usize, recording: &str) {
        let mut work = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        work.show(format_args!("{done} of {of} recordings, {recording}"));
    }
}

fn show(report: &VerifyReport, to: &mut Channel<'_>) -> io::Result<()> {
    let heads = ["recording", ">events", ">cuts", ">applied", ">rejected", ">checks", ">ms", "verdict"];
    let mut table = TextTable::new(&heads);
    report.recordings.iter().for_each(|recording| table.row(row(recording)));
    if !report.recordings.is_empty() {
        table.write(to)?;
    }
    report.recordings.iter().try_for_each(|recording| problems(recording, to))?;
    let rest = report.orphans.iter().chain(&report.errors);
    rest.into_iter().try_for_each(|problem| writeln!(to, "{} {problem}", to.bad("problem:")))?;
    sum(report, to)
}

fn row(r: &RecordingReport) -> [Cell; 8] {
    let (word, colour) = match r.verdict {
        Verdict::Verified => ("verified", AnsiColor::Green),
        Verdict::Failed => ("failed", AnsiColor::Red),
        Verdict::Unreadable => ("unreadable", AnsiColor::Red),
    };
    let figures = [r.events, r.cuts, r.applied, r.rejected, r.checks].map(Cell::from);
    let [events, cuts, applied, rejected, checks] = figures;
    let (ms, verdict) = (format!("{:.1}", r.ms), Cell::styled(word, colour.on_default()));
    [(&r.recording).into(), events, cuts, applied, rejected, checks, ms.into(), verdict]
}

fn problems(recording: &RecordingReport, to: &mut Channel<'_>) -> io::Result<()> {
    let name = to.bad(format_args!("{}:", recording.recording));
    recording.problems().iter().try_for_each(|problem| writeln!(to, "{name} {problem}"))
}

fn sum(report: &VerifyReport, to: &mut Channel<'_>) -> io::Result<()> {
    let count = |verdict| report.recordings.iter().filter(|r| r.verdict == verdict).count();
    let [verified, failed, unreadable] = [Verdict::Verified, Verdict::Failed, Verdict::Unreadable].map(count);
    let (all, seconds) = (report.recordings.len(), report.ms / 1e3);
    let left_out = match report.left_out {
        0 => String::new(),
        n => format!(", {n} left out"),
    };
    let text = format!(
        "{all} recordings: {verified} verified, {failed} failed, {unreadable} unreadable{left_out}; {seconds:.1} s"
    );
    let text = if report.exit_code() == 0 { to.good(text) } else { to.bad(text) };
    writeln!(to, "{text}")
}
