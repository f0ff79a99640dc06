//! `lancet replay`: one recording, stage by stage.

use super::args::{Replay, Target, Until};
use super::failure::Failure;
use super::{Console, Done, Status, json, orbit, picture, pixels, place, show};
use crate::assets;
use crate::canvas::Studio;
use crate::replay::{self, Case, Options};
use crate::report::{RunReport, Stop, trace};

/// A replay, where it ended.
type Replayed = Box<dyn replay::Replay>;

pub(super) fn run(typed: &Replay, console: &mut Console<'_>) -> Done {
    require_possible(typed)?;
    let case = Case::open(&typed.recording)?;
    let studio = match makes_pixels(typed) {
        true => Some(pixels::studio(typed.pixels.renderer, console)?),
        false => None,
    };
    let (mut reports, mut last) = (Vec::new(), None);
    for _ in 0..typed.repeat {
        let (replayed, report) = once(typed, &case, studio.as_deref(), console)?;
        reports.push(report);
        last = Some(replayed);
    }
    let Some((report, mut last)) = RunReport::with_median_times(&reports).zip(last) else {
        return Ok(Status::Verified);
    };
    write(typed, &report, last.as_mut(), console)?;
    // A NaN is not equal to itself, so a single run is not compared.
    let same =
        reports.len() < 2 || reports.iter().all(|other| other.without_times() == report.without_times());
    if !same {
        console.err.note("the runs differ from one another: that is a bug of lancet's");
    }
    Ok(if same && report.totals.findings == 0 { Status::Verified } else { Status::Diverged })
}

fn makes_pixels(typed: &Replay) -> bool {
    typed.makes_pixels || typed.frame.is_some()
}

/// What cannot be meant is refused before anything is replayed.
fn require_possible(typed: &Replay) -> Result<(), Failure> {
    orbit::require_possible(typed.viewpoint)?;
    let files = [&typed.json, &typed.trace].into_iter().flatten().filter_map(|t| match t {
        Target::File(path) => Some(path),
        Target::Stdout => None,
    });
    files
        .chain(&typed.export_mesh)
        .chain(&typed.frame)
        .try_for_each(|output| place::require_other(&typed.recording, output))
}

fn once(
    typed: &Replay,
    case: &Case,
    studio: Option<&dyn Studio>,
    console: &mut Console<'_>,
) -> Result<(Replayed, RunReport), Failure> {
    let (everything, pictures) = (typed.pixels.no_skip, makes_pixels(typed));
    let options = Options { paranoid: typed.paranoid, everything, pictures, ..Options::default() };
    let mut replay = case.replay(&case.recording, options, studio)?;
    require_there(typed, replay.as_ref())?;
    let name = typed.recording.display().to_string();
    let (end, within) = match &typed.until {
        None => (replay.len(), None),
        Some(Until { events, stage }) => (*events, stage.as_ref()),
    };
    let stopped = step_to(replay.as_mut(), end, &typed.stop_at, console);
    let report = match within {
        Some(stage) if !stopped => within_event(end, stage, replay.as_mut(), &name)?,
        _ => replay.run_report(&name),
    };
    Ok((replay, report))
}

/// What the recording has not is refused before anything is run.
fn require_there(typed: &Replay, replay: &dyn replay::Replay) -> Result<(), Failure> {
    let (events, stages) = (replay.len(), replay.stages());
    let last = typed.until.as_ref().and_then(Until::event);
    if let Some(event) = last.filter(|event| *event >= events) {
        return Err(Failure::new(format_args!("there is no event {event}; there are {events}")));
    }
    let ids: Vec<&str> = stages.into_iter().map(|(id, _)| id).collect();
    let unknown = typed.stop_at.iter().find(|stop| stop.stage().is_some_and(|stage| !ids.contains(&stage)));
    match unknown {
        Some(stop) => Err(Failure::new(format_args!(
            "--stop-at {stop}: there is no such stage; there are {}",
            ids.join(", ")
        ))),
        None => Ok(()),
    }
}

/// The run with an event that goes no further than a stage of it.
fn within_event(
    event: usize,
    stage: &str,
    replay: &mut dyn replay::Replay,
    name: &str,
) -> Result<RunReport, Failure> {
    let last = replay.hold(event, stage).map_err(Failure::new)?;
    let before = replay.run_report(name);
    let events = before.events.into_iter().chain([last]).collect();
    Ok(RunReport::new(name, replay.engine(), before.scene, events, None))
}

/// Runs events up to one, or to one at which it is to stop; whether that was so is said, and told.
fn step_to(replay: &mut dyn replay::Replay, end: usize, stops: &[Stop], console: &mut Console<'_>) -> bool {
    let mut work = console.err.work();
    let mut hit = None;
    while let (true, None) = (replay.position() < end, hit) {
        let Some(event) = replay.step() else { break };
        hit = stops.iter().find(|stop| stop.hits(event));
        work.show(format_args!("event {} of {end}", replay.position()));
    }
    drop(work);
    match hit {
        Some(stop) => console.err.note(format_args!("stopped after event {}: {stop}", replay.position() - 1)),
        None if stops.is_empty() => {}
        None => console.err.note("nothing stopped it"),
    }
    hit.is_some()
}

fn write(
    typed: &Replay,
    report: &RunReport,
    replay: &mut dyn replay::Replay,
    console: &mut Console<'_>,
) -> Result<(), Failure> {
    if let Some(path) = &typed.frame {
        pixels::write(&picture::of(typed, report, replay)?, path)?;
    }
    json::write(report, typed.json.as_ref(), console)?;
    if let Some(target) = &typed.trace {
        let mut spans = Vec::new();
        trace(report, &mut spans)?;
        json::put(&spans, target, console)?;
    }
    if let Some(path) = &typed.export_mesh {
        let mesh = replay.mesh().ok_or_else(|| Failure::new("this engine has no mesh to export"))?;
        assets::claim_output(path)?;
        assets::export::save(mesh, path)?;
    }
    Ok(show::run(report, json::text([&typed.json, &typed.trace], console))?)
}
