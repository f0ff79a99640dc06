//! `lancet replay`: one recording, stage by stage.

use super::args::{Overlay, Replay, Target, Until};
use super::failure::Failure;
use super::{Console, Done, Status, json, pixels, place, show};
use crate::assets;
use crate::canvas::Studio;
use crate::canvas::image::Image;
use crate::render::overlay::{self, Drawing};
use crate::replay::{self, Case, Options, Shot};
use crate::report::{self, RunReport, trace};

/// A replay, where it ended.
type Replayed = Box<dyn replay::Replay>;

pub(super) fn run(typed: &Replay, console: &mut Console<'_>) -> Done {
    require_possible(typed)?;
    let case = Case::open(&typed.recording)?;
    let studio = match typed.frame {
        Some(_) => Some(pixels::studio(typed.pixels.renderer, console)?),
        None => None,
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

/// What cannot be meant is refused before anything is replayed.
fn require_possible(typed: &Replay) -> Result<(), Failure> {
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
    let (everything, pictures) = (typed.pixels.no_skip, typed.frame.is_some());
    let options = Options { paranoid: typed.paranoid, everything, pictures, ..Options::default() };
    let mut replay = case.replay(&case.recording, options, studio)?;
    let name = typed.recording.display().to_string();
    let report = match &typed.until {
        None => to_the_end(replay.as_mut(), &name, console),
        Some(until) => up_to(until, replay.as_mut(), &name, console)?,
    };
    Ok((replay, report))
}

fn to_the_end(replay: &mut dyn replay::Replay, name: &str, console: &mut Console<'_>) -> RunReport {
    let end = replay.len();
    step_to(replay, end, console);
    replay.run_report(name)
}

fn up_to(
    until: &Until,
    replay: &mut dyn replay::Replay,
    name: &str,
    console: &mut Console<'_>,
) -> Result<RunReport, Failure> {
    if until.event >= replay.len() {
        return Err(Failure::new(format_args!(
            "there is no event {}; there are {}",
            until.event,
            replay.len()
        )));
    }
    let Some(stage) = &until.stage else {
        step_to(replay, until.event + 1, console);
        return Ok(replay.run_report(name));
    };
    step_to(replay, until.event, console);
    let last = replay.hold(until.event, stage).map_err(Failure::new)?;
    let before = replay.run_report(name);
    let events = before.events.into_iter().chain([last]).collect();
    Ok(RunReport::new(name, replay.engine(), before.scene, events, None))
}

fn step_to(replay: &mut dyn replay::Replay, end: usize, console: &mut Console<'_>) {
    let mut work = console.err.work();
    while replay.position() < end && replay.step().is_some() {
        work.show(format_args!("event {} of {end}", replay.position()));
    }
}

fn write(
    typed: &Replay,
    report: &RunReport,
    replay: &mut dyn replay::Replay,
    console: &mut Console<'_>,
) -> Result<(), Failure> {
    if let Some(path) = &typed.frame {
        pixels::write(&picture(typed, report, replay)?, path)?;
    }
    json::write(report, typed.json.as_ref(), console)?;
    if let Some(target) = &typed.trace {
        let mut spans = Vec::new();
        trace(report, &mut spans)?;
        json::put(&spans, target, console)?;
    }
    if let Some(path) = &typed.export_mesh {
        let mesh = replay.mesh().ok_or_else(|| Failure::new("this engine has no mesh to export"))?;
        assets::export::save(mesh, path)?;
    }
    Ok(show::run(report, json::text([&typed.json, &typed.trace], console))?)
}

/// The frame as it is in the end with what is drawn over it, or a map.
fn picture(typed: &Replay, report: &RunReport, replay: &mut dyn replay::Replay) -> Result<Image, Failure> {
    if let Some(map) = typed.map {
        return replay.map(pixels::map_id(map)).ok_or_else(|| pixels::missing(replay));
    }
    let (mut frame, view) = replay.shoot(&Shot::default()).ok_or_else(|| pixels::missing(replay))?;
    let last_cut = report.events.iter().rev().find(|event| event.cut);
    let overlays = last_cut.map_or(&[][..], |event| &event.overlays);
    let drawings: Vec<Drawing<'_>> =
        typed.overlay.iter().flat_map(|what| drawings(*what, overlays)).collect();
    if let Some(mesh) = replay.mesh() {
        overlay::draw(&mut frame.image, &view, mesh, &drawings);
    }
    Ok(frame.image)
}

/// What a word stands for, of what an event has to show.
fn drawings(what: Overlay, shown: &[report::Overlay]) -> Vec<Drawing<'_>> {
    let named = |names: &'static [&str]| {
        shown.iter().filter(move |o| names.contains(&o.name())).map(Drawing::Shown).collect()
    };
    match what {
        Overlay::Wire => vec![Drawing::Wire],
        Overlay::Line => named(&["line", "picks"]),
        Overlay::Configurations => {
            shown.iter().filter(|o| o.name().starts_with("configuration ")).map(Drawing::Shown).collect()
        }
    }
}
