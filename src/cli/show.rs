//! Reports of runs, for people.

use std::io::{self, Write};

use anstyle::{AnsiColor, Style};

use super::console::Channel;
use super::table::{Cell, TextTable};
use crate::report::{EventReport, Finding, Outcome, Pass, RunReport, StageReport};

/// What was done for a frame, pass by pass.
pub(super) fn passes(passes: &[Pass], to: &mut Channel<'_>) -> io::Result<()> {
    let mut table = TextTable::new(&["pass", ">us", ">tiles", ">of", ""]);
    for pass in passes {
        let number = |n: u32| if pass.of == 0 { String::new() } else { n.to_string() };
        let skipped = pass.skipped.iter().map(|reason| format!("skipped: {reason}"));
        let cells = [pass.id.clone(), format!("{:.0}", pass.us), number(pass.tiles), number(pass.of)];
        table.row(cells.into_iter().chain([skipped.collect::<String>()]).map(Cell::from));
    }
    table.write(to)
}

/// As much of a digest as tells two apart.
const SHORT: usize = 12;

/// A run, stage by stage: a row for each event, with its first stage, and one for each further stage.
pub(super) fn run(report: &RunReport, to: &mut Channel<'_>) -> io::Result<()> {
    let mut table =
        TextTable::new(&[">event", "kind", "mode", "outcome", "stage", ">us", ">checks", "digest"]);
    for event in &report.events {
        let mut stages = event.stages.iter();
        table.row(head(event).into_iter().chain(stage(stages.next())));
        stages.for_each(|s| table.row([(); 4].map(|()| Cell::from("")).into_iter().chain(stage(Some(s)))));
    }
    table.write(to)?;
    report.findings().try_for_each(|found| finding(&found, to))?;
    totals(report, to)
}

fn head(event: &EventReport) -> [Cell; 4] {
    let reason = event.reason.iter().map(|reason| format!(": {reason}"));
    let outcome = format!("{}{}", word(event.outcome), reason.collect::<String>());
    [
        event.index.into(),
        (&event.kind).into(),
        (&event.mode).into(),
        Cell::styled(outcome, style(event.outcome)),
    ]
}

fn stage(stage: Option<&StageReport>) -> [Cell; 4] {
    let Some(stage) = stage else { return [(); 4].map(|()| "".into()) };
    if let Some(reason) = &stage.skipped {
        return [(&stage.id).into(), "".into(), "".into(), format!("skipped: {reason}").into()];
    }
    let digest: String = stage.digest.iter().flat_map(|digest| digest.chars()).take(SHORT).collect();
    [(&stage.id).into(), format!("{:.1}", stage.us).into(), checks(stage), digest.into()]
}

fn checks(stage: &StageReport) -> Cell {
    let broken = stage.checks.iter().filter(|check| !check.ok).count();
    match broken {
        0 => format!("{} ok", stage.checks.len()).into(),
        _ => Cell::styled(format!("{broken} broken"), AnsiColor::Red.on_default().bold()),
    }
}

/// An outcome's word, as it stands in JSON.
fn word(outcome: Outcome) -> &'static str {
    match outcome {
        Outcome::Applied => "applied",
        Outcome::Rejected => "rejected",
        Outcome::Pending => "pending",
        Outcome::Cancelled => "cancelled",
        Outcome::None => "none",
    }
}

fn style(outcome: Outcome) -> Style {
    match outcome {
        Outcome::Applied => AnsiColor::Green.on_default(),
        Outcome::Rejected => AnsiColor::Yellow.on_default(),
        Outcome::Pending | Outcome::Cancelled | Outcome::None => Style::new(),
    }
}

/// A broken invariant, on a line.
pub(super) fn finding(found: &Finding, to: &mut Channel<'_>) -> io::Result<()> {
    let place = found.event.map_or_else(|| "at the end".into(), |event| format!("event {event}"));
    let label = to.bad("finding:");
    let culprits: String = found.check.culprits.iter().map(|culprit| format!(" {culprit}")).collect();
    writeln!(to, "{label} {place}, {}: {}{culprits}", found.name(), found.check.detail)
}

fn totals(report: &RunReport, to: &mut Channel<'_>) -> io::Result<()> {
    let totals = &report.totals;
    let findings = format!("{} findings in {} checks", totals.findings, report.checks());
    let findings = if totals.findings == 0 { to.good(findings) } else { to.bad(findings) };
    let (cuts, applied, rejected) = (totals.cuts, totals.applied, totals.rejected);
    // A run that stopped within an event has none.
    let digest = (!totals.digest.is_empty()).then(|| format!("; digest {}", totals.digest));
    let digest = digest.unwrap_or_default();
    writeln!(to, "{cuts} cuts, {applied} applied, {rejected} rejected; {findings}{digest}")
}
