//! `lancet bless`: what the runs are now, as goldens.

use std::io::{self, Write};

use anstyle::{AnsiColor, Style};

use super::args::{Bless, Renderer};
use super::console::Channel;
use super::table::{Cell, TextTable};
use super::verify::{Line, jobs, no_planted_bug, status};
use super::{Console, Done, pixels};
use crate::report::printable;
use crate::verify::{self, BlessOptions, BlessReport, Blessed, Change, GaugeReport};

pub(super) fn run(typed: &Bless, console: &mut Console<'_>) -> Done {
    no_planted_bug()?;
    let usual = if typed.gates { Renderer::Gpu } else { Renderer::Reference };
    let studio = pixels::studio(typed.renderer.unwrap_or(usual), console)?;
    let options = BlessOptions {
        reason: typed.reason.clone(),
        dry_run: typed.dry_run,
        filter: typed.select.filter.clone(),
        jobs: jobs(typed.select.jobs),
        studio: Some(studio.into()),
    };
    if typed.gates {
        let report = verify::gauge(&typed.paths, &options, &Line::on(&mut console.err));
        show_gates(&report, typed.dry_run, &mut console.out)?;
        return Ok(status(report.exit_code()));
    }
    let report = verify::bless(&typed.paths, &options, &Line::on(&mut console.err));
    show(&report, typed.dry_run, &mut console.out)?;
    Ok(status(report.exit_code()))
}

fn show(report: &BlessReport, dry_run: bool, to: &mut Channel<'_>) -> io::Result<()> {
    let mut table = TextTable::new(&["recording", "golden", ">facts changed", "first change"]);
    let (same, others): (Vec<_>, Vec<_>) = report.recordings.iter().partition(|r| r.change == Change::Same);
    others.iter().for_each(|blessed| table.row(row(blessed)));
    if !others.is_empty() {
        table.write(to)?;
    }
    // What lies beside goldens that are as they were has no row.
    let beside = same.iter().flat_map(|recording| &recording.goldens);
    let rest = report.orphans.iter().chain(&report.errors).chain(beside);
    rest.into_iter().try_for_each(|problem| writeln!(to, "{} {}", to.bad("problem:"), printable(problem)))?;
    let written = others.iter().filter(|r| r.change != Change::Refused).count();
    let verb = if dry_run { "would be written" } else { "written" };
    writeln!(to, "{written} goldens {verb}, {} as they were, {} refused", same.len(), others.len() - written)
}

fn show_gates(report: &GaugeReport, dry_run: bool, to: &mut Channel<'_>) -> io::Result<()> {
    let GaugeReport { adapter, file, images, before, measured, worst, errors } = report;
    errors.iter().try_for_each(|problem| writeln!(to, "{} {}", to.bad("problem:"), printable(problem)))?;
    if *images > 0 {
        let before = before.map_or("nothing".into(), |before| before.to_string());
        writeln!(to, "{adapter}, {images} pictures: {measured}; before: {before}")?;
    }
    worst.iter().try_for_each(|(metric, picture)| writeln!(to, "worst by {metric}: {picture}"))?;
    let verb = match (errors.is_empty(), dry_run) {
        (false, _) => "not written",
        (true, true) => "would be written",
        (true, false) => "written",
    };
    writeln!(to, "gates {verb}: {file}")
}

fn row(blessed: &Blessed) -> [Cell; 4] {
    let (word, style) = match blessed.change {
        Change::New => ("new", AnsiColor::Green.on_default()),
        Change::Changed => ("changed", AnsiColor::Yellow.on_default()),
        Change::Same => ("same", Style::new()),
        Change::Refused => ("refused", AnsiColor::Red.on_default()),
    };
    let first = blessed.divergence.iter().map(ToString::to_string);
    let new = (!blessed.new.is_empty()).then(|| format!("new: {}", blessed.new.join(", ")));
    let why: Vec<String> = blessed
        .error
        .iter()
        .cloned()
        .chain(first)
        .chain(new)
        .chain(blessed.goldens.iter().cloned())
        .collect();
    let facts = blessed.differing;
    [(&blessed.recording).into(), Cell::styled(word, style), facts.into(), why.join("; ").into()]
}
