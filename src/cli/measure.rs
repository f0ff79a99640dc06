//! `lancet measure`: what cuts cost, and whether anything breaks.

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use serde::Serialize;

use super::args::{Accuracy, Measure, MeasureOptions, Measured};
use super::console::Channel;
use super::failure::Failure;
use super::pixels::studio;
use super::table::TextTable;
use super::verify::jobs;
use super::{Console, Done, Status, json};
use crate::assets;
use crate::measure::accuracy::{self, AccuracyReport, Ask, Stored};
use crate::measure::stability::report::StabilityFinding;
use crate::measure::stability::{self, StabilityReport};
use crate::measure::{MeasureError, plot, scaling, thesis};
use crate::report::Table;

pub(super) fn run(typed: &Measure, console: &mut Console<'_>) -> Done {
    match &typed.what {
        Measured::Thesis { recordings, repeat, renderer, common } => {
            let cuts = or_else(*repeat, common, [100, 10]);
            let repeat = thesis::Repeat { cuts, frames: cuts };
            let studio = studio(*renderer, console)?;
            let report = showing(console, |told| thesis::measure(recordings, repeat, studio.as_ref(), told))?;
            answer(&report, &report.tables(), common, console)
        }
        Measured::Scaling { rounds, common } => {
            let rounds = or_else(*rounds, common, [60, 20]);
            let sizes = if common.quick { &scaling::QUICK[..] } else { &scaling::SIZES };
            let report = showing(console, |told| scaling::measure(sizes, rounds, told))?;
            answer(&report, &report.tables(), common, console)
        }
        Measured::Accuracy(typed) => accuracy(typed, console),
        Measured::Stability { cuts, per_rung, seed, jobs: threads, findings, plot, common } => {
            let cuts = or_else(*cuts, common, [100_000, 2_000]);
            let per_rung = or_else(*per_rung, common, [400, 40]);
            let options = stability::Options { cuts, per_rung, seed: *seed, jobs: jobs(*threads) };
            let report = showing(console, |told| stability::measure(&options, told))?;
            answer(&report, &report.tables(), common, console)?;
            if let Some(folder) = plot {
                draw_ladders(&report, folder)?;
            }
            broken(&report, findings.as_deref(), common, console)
        }
    }
}

fn accuracy(typed: &Accuracy, console: &mut Console<'_>) -> Done {
    let studio = studio(typed.renderer, console)?;
    // What is blessed of every subject takes the place of whatever stood there.
    let is_there = |file: &Path| !matches!(file.try_exists(), Ok(false));
    let is_read = |file: &&Path| !typed.bless || (!typed.only.is_empty() && is_there(file));
    let stored = typed.against.as_deref().filter(is_read).map(read_curves).transpose()?;
    let ask = Ask {
        quick: typed.common.quick,
        rounds: or_else(typed.rounds, &typed.common, [30, 8]),
        recordings: &typed.recordings,
        studio: studio.as_ref(),
    };
    let report = showing(console, |told| accuracy::measure(&typed.only, &ask, told))?;
    answer(&report, &report.tables(), &typed.common, console)?;
    if let Some(folder) = &typed.plot {
        write_plots(&report, folder)?;
    }
    let faults = gate(typed, stored, &report)?;
    let to = json::text([&typed.common.json], console);
    faults.iter().try_for_each(|fault| writeln!(to, "{} {fault}", to.bad("finding:")))?;
    Ok(if faults.is_empty() { Status::Verified } else { Status::Diverged })
}

/// What is wrong with curves, by themselves and against those of a file. Those with which nothing is are written into it, where it is blessed.
fn gate(typed: &Accuracy, stored: Option<Stored>, report: &AccuracyReport) -> Result<Vec<String>, Failure> {
    let mut faults = report.untrusted();
    match (&typed.against, &typed.reason) {
        (Some(file), Some(reason)) if faults.is_empty() => match blessed(stored, report, reason) {
            Ok(blessed) => assets::write_file(file, &blessed.text())?,
            Err(fault) => faults.push(fault),
        },
        (_, Some(_)) => {}
        (_, None) => faults.extend(stored.iter().flat_map(|stored| stored.compare(report))),
    }
    Ok(faults)
}

/// What a file holds once it is blessed.
fn blessed(stored: Option<Stored>, report: &AccuracyReport, reason: &str) -> Result<Stored, String> {
    match stored {
        Some(stored) => stored.merged(report, reason),
        None => Ok(Stored::of(report, reason)),
    }
}

fn read_curves(file: &Path) -> Result<Stored, Failure> {
    Stored::parse(&assets::read_file(file)?).map_err(|why| Failure::about(file)(&why))
}

fn write_plots(report: &AccuracyReport, folder: &Path) -> Result<(), Failure> {
    for curve in &report.curves {
        let file = folder.join(format!("{}.svg", curve.name));
        assets::write_file(&file, plot::svg(&curve.plot()).as_bytes())?;
    }
    Ok(())
}

fn draw_ladders(report: &StabilityReport, folder: &Path) -> Result<(), Failure> {
    for ladder in &report.ranges.ladders {
        let (name, picture) = ladder.plot();
        assets::write_file(&folder.join(name), picture.as_bytes())?;
    }
    Ok(())
}

/// What was typed, or what is usual, or what is quick.
fn or_else(typed: Option<u32>, common: &MeasureOptions, [usual, quick]: [usize; 2]) -> usize {
    typed.map_or(if common.quick { quick } else { usual }, |n| n as usize)
}

/// Measures, and shows how far it is.
fn showing<T>(
    console: &mut Console<'_>,
    measure: impl FnOnce(crate::measure::Progress<'_>) -> Result<T, MeasureError>,
) -> Result<T, Failure> {
    let work = Mutex::new(console.err.work());
    let told = |done: usize, of: usize, what: &str| {
        work.lock().unwrap_or_else(PoisonError::into_inner).show(format_args!("{done} of {of}, {what}"));
    };
    measure(&told).map_err(Failure::new)
}

fn answer(
    report: &impl Serialize,
    tables: &[Table],
    common: &MeasureOptions,
    console: &mut Console<'_>,
) -> Done {
    json::write(report, common.json.as_ref(), console)?;
    let to = json::text([&common.json], console);
    tables.iter().try_for_each(|table| show(table, to))?;
    Ok(Status::Verified)
}

/// A table of figures: all but the first column stand to the right.
pub(super) fn show(table: &Table, to: &mut Channel<'_>) -> io::Result<()> {
    writeln!(to, "{}", to.faint(&table.title))?;
    let head = |(i, head): (usize, &String)| if i == 0 { head.clone() } else { format!(">{head}") };
    let heads: Vec<String> = table.columns.iter().enumerate().map(head).collect();
    let mut text = TextTable::new(&heads.iter().map(String::as_str).collect::<Vec<_>>());
    table.rows.iter().for_each(|row| text.row(row.cells.iter()));
    text.write(to)?;
    writeln!(to)
}

/// The findings of a stability run, and where their scripts are.
fn broken(
    report: &StabilityReport,
    folder: Option<&Path>,
    common: &MeasureOptions,
    console: &mut Console<'_>,
) -> Done {
    if let Some(folder) = folder {
        report.save_findings(folder)?;
    }
    let to = json::text([&common.json], console);
    report.findings.iter().try_for_each(|found| finding(report, found, folder, to))?;
    let text = format!("{} findings in {} cuts", report.findings.len(), report.all_cuts());
    let sound = report.findings.is_empty();
    writeln!(to, "{}", if sound { to.good(text) } else { to.bad(text) })?;
    Ok(if sound { Status::Verified } else { Status::Diverged })
}

fn finding(
    report: &StabilityReport,
    found: &StabilityFinding,
    folder: Option<&Path>,
    to: &mut Channel<'_>,
) -> io::Result<()> {
    let label = to.bad("finding:");
    let StabilityFinding { scene, part, cut, stage, check, .. } = found;
    let culprits: String = check.culprits.iter().map(|culprit| format!(" {culprit}")).collect();
    let seed = report.seed;
    writeln!(
        to,
        "{label} seed {seed}, scene {scene}, part {part}, cut {cut}, {stage}/{}: {}{culprits}",
        check.name, check.detail
    )?;
    let path: Option<PathBuf> = folder.map(|folder| folder.join(found.file()));
    match path {
        Some(path) => writeln!(to, "  {}", path.display()),
        None => writeln!(to, "  its script is in the JSON answer, or in the folder that --findings names"),
    }
}
