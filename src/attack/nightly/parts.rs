//! The parts of a night that need no other program.

use std::path::Path;
use std::time::{Duration, Instant};

use super::{Night, NightFinding, Part, Reached};
use crate::assets;
use crate::attack::matrix::{self, Matrix};
use crate::attack::storm::Storm;
use crate::attack::{Finding, Hits, TARGETS, Target};
use crate::measure::stability;
use crate::verify;

/// Cuts of the first round of stability; each round has twice those of the one before.
const FIRST_CUTS: usize = 100;
/// Cuts of a round at most, so that the clock is looked at now and then.
const MOST_CUTS: usize = 12_800;
/// Cuts on every rung of the ladders, a round.
const PER_RUNG: usize = 20;
/// The shortest time that has room for the ladders, which take some ten seconds a round.
const LADDERS: Duration = Duration::from_secs(20);
/// Inputs between two looks at the clock.
const GUST: usize = 16;

pub(super) fn verify(night: &Night) -> Part {
    let report = verify::verify(&night.recordings, &night.verify, &());
    let problems = report.recordings.iter().flat_map(|recording| {
        let found = |detail: String| NightFinding { detail, file: Some(recording.recording.clone().into()) };
        recording.problems().into_iter().map(found)
    });
    let rest = report
        .orphans
        .iter()
        .chain(&report.errors)
        .map(|detail| NightFinding { detail: detail.clone(), file: None });
    let findings: Vec<NightFinding> = problems.chain(rest).collect();
    let detail = format!("{} recordings", report.recordings.len());
    let part = Part::ran(report.recordings.len() as u64, detail, findings);
    match report.exit_code() {
        2 => Part { verdict: super::Verdict::Unable, ..part },
        _ => part,
    }
}

/// Rounds of random cuts until the time is up, one at least; each with a seed of its own. Where there is time for them, with the ladders.
pub(super) fn stability(night: &Night, time: Duration) -> Part {
    let (clock, mut cuts, mut findings) = (Instant::now(), 0, Vec::new());
    let per_rung = if time < LADDERS { 0 } else { PER_RUNG };
    for round in 0u64.. {
        let in_round = (FIRST_CUTS << round.min(7)).min(MOST_CUTS);
        let seed = night.seed_of("stability", round);
        let options = stability::Options { cuts: in_round, per_rung, seed, jobs: night.jobs };
        let report = match stability::measure(&options, &|_, _, _| {}) {
            Ok(report) => report,
            Err(error) => return Part::unable(error.to_string()),
        };
        cuts += report.cuts as u64;
        let saved = report.save_findings(&night.findings).map_err(|error| error.to_string()).err();
        findings.extend(report.findings.iter().map(|found| NightFinding {
            detail: format!("{} {}/{}: {}", found.scene, found.stage, found.check.name, found.check.detail),
            file: saved.is_none().then(|| night.findings.join(found.file())),
        }));
        if clock.elapsed() >= time {
            break;
        }
    }
    let ladders = if per_rung == 0 { ", no time for ladders" } else { "" };
    Part::ran(cuts, format!("a seed for each round, from {}{ladders}", night.seed), findings)
}

/// A target without libFuzzer, until the time is up or something is found.
pub(super) fn storm(night: &Night, target: &'static Target, time: Duration, why: &str) -> Part {
    let clock = Instant::now();
    let seeds: Vec<Vec<u8>> =
        inputs(&night.fuzz.join("corpus").join(target.name)).map(|input| input.1).collect();
    let mut storm = Storm::new(target, seeds, night.seed_of(target.name, 0));
    let mut findings = Vec::new();
    while findings.is_empty() && (storm.runs == 0 || clock.elapsed() < time) {
        if let Some((finding, data)) = (0..GUST).find_map(|_| storm.round().err()) {
            findings.push(keep(night, target, &finding, &data));
        }
    }
    let each_second = storm.runs as f64 / clock.elapsed().as_secs_f64().max(1e-9);
    Part::ran(storm.runs, format!("{why}: in-process, {each_second:.0} inputs a second"), findings)
}

/// Writes what leads to a finding: the recording where it has one, else the input.
fn keep(night: &Night, target: &Target, finding: &Finding, data: &[u8]) -> NightFinding {
    let bytes = finding.recording.as_deref().unwrap_or(data);
    let end = match &finding.recording {
        Some(recording) if recording.starts_with(b"{") => "json",
        Some(_) => "lancet",
        None => "input",
    };
    let hash = blake3::hash(data).to_hex();
    let path = night.findings.join(format!("{}-{}.{end}", target.name, &hash[..16]));
    match assets::write_file(&path, bytes) {
        Ok(()) => NightFinding { detail: finding.to_string(), file: Some(path) },
        Err(error) => NightFinding { detail: format!("{finding}; not written: {error}"), file: None },
    }
}

/// Runs every corpus again, that of the checkout and that of the night.
pub(super) fn reached(night: &Night, hits: &mut Reached) -> Part {
    let (mut count, mut findings) = (0, Vec::new());
    for target in TARGETS {
        let folders = [night.fuzz.join("corpus").join(target.name), new_inputs(night, target.name)];
        for (name, data) in folders.iter().flat_map(|folder| inputs(folder)) {
            count += 1;
            match target.attempt(&data) {
                Ok(reached) => {
                    hits.all.add(&reached);
                    let named =
                        reached.0.into_iter().map(|(what, n)| (format!("{}: {what}", target.name), n));
                    hits.by_target.add(&Hits(named.collect()));
                }
                Err(finding) => {
                    let found = keep(night, target, &finding, &data);
                    findings.push(NightFinding { detail: format!("{name}: {}", found.detail), ..found });
                }
            }
        }
    }
    Part::ran(count, format!("{} things of a name", hits.by_target.0.len()), findings)
}

/// The matrix of what was reached; more inputs are drawn while a cell that can be reached is empty, until the time is up.
pub(super) fn matrix(night: &Night, reached: &Hits, time: Duration) -> (Part, Matrix) {
    let (clock, mut drawn, mut findings) = (Instant::now(), 0, Vec::new());
    let (mut matrix, mut hits) = (Matrix::of(reached), reached.clone());
    while !matrix.empty().is_empty() && clock.elapsed() < time {
        match matrix::sweep(night.seed_of("matrix", drawn), GUST) {
            Ok(more) => {
                hits.add(&more);
                matrix = Matrix::of(&hits);
            }
            // One of them is enough here: the fuzzers have the others.
            Err(finding) if findings.is_empty() => {
                findings.push(NightFinding { detail: finding.to_string(), file: None });
            }
            Err(_) => {}
        }
        drawn += GUST as u64;
    }
    let never = matrix.empty().into_iter().map(|cell| (cell, "is never met".to_owned()));
    let wrong = matrix.wrong().into_iter().map(|cell| {
        let why = cell.impossible.unwrap_or_default();
        (cell, format!("is met, and it was said to be impossible: {why}"))
    });
    findings.extend(never.chain(wrong).map(|(cell, what)| NightFinding {
        detail: format!("{} {}: {what}", cell.configuration, cell.degeneracy.title()),
        file: None,
    }));
    let short = if matrix.empty().is_empty() { "" } else { "; the time was up before all were met" };
    (Part::ran(drawn, format!("{} cells{short}", matrix.cells.len()), findings), matrix)
}

/// Where libFuzzer puts what it makes of a target in this night.
pub(super) fn new_inputs(night: &Night, target: &str) -> std::path::PathBuf {
    night.findings.join("corpus").join(target)
}

/// The files of a corpus, by name; those that cannot be read are none.
fn inputs(folder: &Path) -> impl Iterator<Item = (String, Vec<u8>)> + use<> {
    let files = assets::list_files(folder).unwrap_or_default();
    files.into_iter().filter_map(|path| Some((path.display().to_string(), assets::read_file(&path).ok()?)))
}
