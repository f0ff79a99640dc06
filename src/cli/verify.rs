//! `lancet verify`: every recording against its goldens.

use std::io::{self, Write};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::available_parallelism;

use anstyle::AnsiColor;

use super::args::{Reports, Target, Verify};
use super::console::{Channel, Work};
use super::failure::Failure;
use super::table::{Cell, TextTable};
use super::{Console, Done, Status, json, pixels, place};
use crate::assets;
use crate::canvas::Studio;
use crate::replay::Options;
use crate::report::printable;
use crate::verify::{self, Blob, Progress, RecordingReport, Skips, Verdict, VerifyOptions, VerifyReport};

/// Refuses what a program with a bug in it must not do: to say that something is right.
pub(super) fn no_planted_bug() -> Result<(), Failure> {
    match cfg!(feature = "canary") {
        true => Err(Failure::new("a bug is planted in this program (feature `canary`): it verifies nothing")),
        false => Ok(()),
    }
}

pub(super) fn run(typed: &Verify, console: &mut Console<'_>) -> Done {
    no_planted_bug()?;
    let answers = [&typed.blob, &typed.to.json, &typed.to.junit];
    let files = answers.into_iter().filter_map(|answer| match answer {
        Some(Target::File(path)) => Some(path),
        _ => None,
    });
    for file in files {
        typed.paths.iter().try_for_each(|path| place::require_other(path, file))?;
    }
    let options = meaning(typed, pixels::studio(typed.pixels.renderer, console)?.into());
    let blob = verify::verify_to_blob(&typed.paths, &options, &Line::on(&mut console.err));
    if let Some(target) = &typed.blob {
        json::put(&blob.text(), target, console)?;
    }
    deliver(&blob, &typed.to, answers, console)
}

/// What was typed means this.
fn meaning(typed: &Verify, studio: Arc<dyn Studio>) -> VerifyOptions {
    let (plant, everything) = (typed.plant.clone(), typed.pixels.no_skip);
    VerifyOptions {
        filter: typed.select.filter.clone(),
        jobs: jobs(typed.select.jobs),
        fail_fast: typed.fail_fast,
        replay: Options { paranoid: typed.paranoid, plant, everything, ..Options::default() },
        studio: Some(studio),
        shard: typed.shard,
        details: typed.blob.is_some() || typed.to.html.is_some(),
    }
}

/// Writes a report wherever it was asked for, and shows it.
pub(super) fn deliver<const N: usize>(
    blob: &Blob,
    to: &Reports,
    answers: [&Option<Target>; N],
    console: &mut Console<'_>,
) -> Done {
    json::write(&blob.report, to.json.as_ref(), console)?;
    if let Some(folder) = &to.html {
        assets::write_file(&folder.join("index.html"), verify::html(blob).as_bytes())?;
    }
    if let Some(target) = &to.junit {
        json::put(verify::junit(&blob.report).as_bytes(), target, console)?;
    }
    show(&blob.report, json::text(answers, console)).map_err(Failure::from)?;
    Ok(status(blob.report.exit_code()))
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
    let heads =
        ["recording", ">events", ">cuts", ">applied", ">rejected", ">checks", ">pictures", ">ms", "verdict"];
    let mut table = TextTable::new(&heads);
    report.recordings.iter().for_each(|recording| table.row(row(recording)));
    if !report.recordings.is_empty() {
        table.write(to)?;
    }
    report.recordings.iter().try_for_each(|recording| problems(recording, to))?;
    let rest = report.orphans.iter().chain(&report.errors);
    rest.into_iter().try_for_each(|problem| writeln!(to, "{} {}", to.bad("problem:"), printable(problem)))?;
    pictures(report, to)?;
    sum(report, to)
}

/// Who rendered, and what skipping saved.
fn pictures(report: &VerifyReport, to: &mut Channel<'_>) -> io::Result<()> {
    let Some(adapter) = &report.adapter else { return Ok(()) };
    let count = report.recordings.iter().map(|recording| recording.images.len()).sum::<usize>();
    writeln!(to, "{count} pictures by {adapter}")?;
    let skipped = report.skips.iter().filter(|s| s.times_skipped() > 0 || s.tiles < s.of);
    let skipped: Vec<String> = skipped.map(skips).collect();
    let saved: f64 = report.skips.iter().map(Skips::saved_us).sum();
    match skipped.as_slice() {
        [] => Ok(()),
        list => writeln!(to, "skipped: {}; saved about {:.1} s", list.join("; "), saved / 1e6),
    }
}

fn skips(pass: &Skips) -> String {
    let (name, skipped) = (&pass.pass, pass.times_skipped());
    let tiles = match pass.of {
        0 => String::new(),
        of => format!(", {:.0} % of the tiles", 100.0 * (of - pass.tiles.min(of)) as f64 / of as f64),
    };
    format!("{name} {skipped} of {}{tiles}", pass.done + skipped)
}

fn row(r: &RecordingReport) -> [Cell; 9] {
    let (word, colour) = match r.verdict {
        Verdict::Verified => ("verified", AnsiColor::Green),
        Verdict::Failed => ("failed", AnsiColor::Red),
        Verdict::Unreadable => ("unreadable", AnsiColor::Red),
    };
    let figures = [r.events, r.cuts, r.applied, r.rejected, r.checks, r.images.len()].map(Cell::from);
    let [events, cuts, applied, rejected, checks, pictures] = figures;
    let (ms, verdict) = (format!("{:.1}", r.ms), Cell::styled(word, colour.on_default()));
    [(&r.recording).into(), events, cuts, applied, rejected, checks, pictures, ms.into(), verdict]
}

fn problems(recording: &RecordingReport, to: &mut Channel<'_>) -> io::Result<()> {
    let name = to.bad(format_args!("{}:", printable(&recording.recording)));
    recording.problems().iter().try_for_each(|problem| writeln!(to, "{name} {}", printable(problem)))
}

fn sum(report: &VerifyReport, to: &mut Channel<'_>) -> io::Result<()> {
    let count = |verdict| report.recordings.iter().filter(|r| r.verdict == verdict).count();
    let [verified, failed, unreadable] = [Verdict::Verified, Verdict::Failed, Verdict::Unreadable].map(count);
    let (all, seconds) = (report.recordings.len(), report.ms / 1e3);
    let left_out = match report.left_out {
        0 => String::new(),
        n => format!(", {n} left out"),
    };
    let shard = report.shard.as_ref().map(|s| format!("shard {} of {}: ", s.index, s.of)).unwrap_or_default();
    let text = format!(
        "{shard}{all} recordings: {verified} verified, {failed} failed, {unreadable} unreadable{left_out}; {seconds:.1} s"
    );
    let text = if report.exit_code() == 0 { to.good(text) } else { to.bad(text) };
    writeln!(to, "{text}")
}
