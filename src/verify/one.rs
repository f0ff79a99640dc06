//! One recording: replayed, and compared with its goldens.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::time::Instant;

use super::compare::{Comparison, compare};
use super::detail::Detail;
use super::golden::{Found, Stored};
use super::image::{ImageReport, Rules};
use super::report::{RecordingReport, Verdict};
use super::{VerifyOptions, home, skips};
use crate::canvas::{Adapter, Studio};
use crate::replay::{self, Options, Planting, Replay};

/// Opens a recording for replay, with whoever renders. An error says what is wrong with which file.
pub(super) type Open<'a> =
    dyn Fn(&Path, Options, Option<&dyn Studio>) -> Result<Box<dyn Replay>, String> + Sync + 'a;

/// Whoever watches a run: told of how many events have run, of how many there are, and answering whether to go on.
pub type Watch<'a> = &'a dyn Fn(usize, usize) -> bool;

/// Nobody watches.
pub fn unwatched(_: usize, _: usize) -> bool {
    true
}

/// Opens a recording's file.
pub(super) fn open_file(
    path: &Path,
    options: Options,
    studio: Option<&dyn Studio>,
) -> Result<Box<dyn Replay>, String> {
    replay::open_file(path, options, studio).map_err(|error| error.to_string())
}

/// Why there is no run to look at.
pub(super) enum Failure {
    /// The recording cannot be opened.
    BadInput(String),
    /// The program broke one of its own assertions.
    Panic(String),
}

impl Failure {
    /// The same for a person.
    pub(super) fn why(self) -> String {
        match self {
            Self::BadInput(why) | Self::Panic(why) => why,
        }
    }
}

/// Replays a recording to its end.
pub(super) fn run(
    path: &Path,
    options: &Options,
    studio: Option<&dyn Studio>,
    open: &Open<'_>,
    watch: Watch<'_>,
) -> Result<Found, Failure> {
    let adapter = studio.map(|studio| studio.adapter());
    run_opened(&home::name(path), options, adapter, watch, |options| open(path, options, studio))
}

/// Replays to its end what is opened, under a name.
pub(super) fn run_opened(
    name: &str,
    options: &Options,
    adapter: Option<&Adapter>,
    watch: Watch<'_>,
    open: impl FnOnce(Options) -> Result<Box<dyn Replay>, String>,
) -> Result<Found, Failure> {
    let planted = options.plant.is_some();
    let options = Options { keep_deltas: true, budget_bytes: 0, ..options.clone() };
    let replayed = catch_unwind(AssertUnwindSafe(|| {
        let mut replay = open(options)?;
        finish(replay.as_mut(), watch)?;
        if let Some(error) = replay.failure() {
            return Err(format!("it cannot be rendered: {error}"));
        }
        match replay.planting() {
            Planting::Failed(why) => return Err(format!("nothing to plant: {why}")),
            Planting::Open if planted => return Err("nothing to plant: the place was not reached".into()),
            _ => {}
        }
        let found = Found::new(replay.run_report(name), replay.take_deltas());
        Ok(Found { frames: replay.take_frames(), adapter: adapter.cloned(), ..found })
    }));
    match replayed {
        Ok(found) => found.map_err(Failure::BadInput),
        Err(panic) => Err(Failure::Panic(panic_text(panic.as_ref()))),
    }
}

/// Runs all events, for as long as whoever watches says so.
fn finish(replay: &mut dyn Replay, watch: Watch<'_>) -> Result<(), String> {
    while watch(replay.position(), replay.len()) {
        if replay.step().is_none() {
            return Ok(());
        }
    }
    Err(format!("stopped before event {} of {}", replay.position(), replay.len()))
}

fn panic_text(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().copied();
    let text = text.or_else(|| panic.downcast_ref::<String>().map(String::as_str));
    format!("panicked: {}", text.unwrap_or("without a message"))
}

/// What was looked at: a run, and its goldens.
pub(super) struct Seen {
    pub(super) found: Found,
    pub(super) stored: Stored,
}

/// Replays a recording and compares it with its goldens. With details, what a page shows of it comes along.
pub(super) fn verify_one(
    path: &Path,
    options: &VerifyOptions,
    rules: Option<&Rules>,
    open: &Open<'_>,
) -> (RecordingReport, Option<Detail>) {
    let (report, seen) = look(path, &options.replay, options.studio.as_deref(), rules, open, &unwatched);
    let seen = seen.filter(|_| options.details);
    let detail = seen.map(|Seen { found, stored }| Detail::new(&found, &stored, &report.images));
    (report, detail)
}

/// Replays a recording and compares it with its goldens. Nothing was seen of one that has no run.
pub(super) fn look(
    path: &Path,
    options: &Options,
    studio: Option<&dyn Studio>,
    rules: Option<&Rules>,
    open: &Open<'_>,
    watch: Watch<'_>,
) -> (RecordingReport, Option<Seen>) {
    let clock = Instant::now();
    let mut report = RecordingReport::new(home::name(path));
    let mut seen = None;
    match run(path, options, studio, open, watch) {
        Ok(found) => {
            let stored = Stored::read(&home::goldens(path), &found);
            report.images = judge(&found, &stored, rules);
            let problems = [stored.problems.as_slice(), &stored.orphans].concat();
            describe(&mut report, &found, compare(&found, &stored), problems);
            seen = Some(Seen { found, stored });
        }
        Err(Failure::BadInput(why)) => report.error = Some(why),
        Err(Failure::Panic(why)) => (report.verdict, report.error) = (Verdict::Failed, Some(why)),
    }
    report.ms = clock.elapsed().as_secs_f64() * 1e3;
    (report, seen)
}

fn judge(found: &Found, stored: &Stored, rules: Option<&Rules>) -> Vec<ImageReport> {
    let golden = |name: &String| stored.pictures.get(name).map(|picture| &picture.image);
    let rules = rules.iter();
    rules.flat_map(|rules| found.frames.iter().map(|f| rules.judge(f, golden(&f.name)))).collect()
}

fn describe(report: &mut RecordingReport, found: &Found, comparison: Comparison, problems: Vec<String>) {
    let totals = &found.run.totals;
    (report.events, report.cuts) = (found.run.events.len(), totals.cuts);
    (report.applied, report.rejected) = (totals.applied, totals.rejected);
    (report.checks, report.digest) = (found.run.checks(), totals.digest.clone());
    report.findings = found.run.findings().collect();
    report.skips = skips::of_run(&found.run.events);
    (report.divergence, report.differing) = (comparison.first(), comparison.differing);
    report.divergences = comparison.divergences;
    (report.new, report.goldens) = (comparison.new, problems);
    let clean = report.findings.is_empty() && report.divergence.is_none();
    let known = report.new.is_empty() && report.goldens.is_empty();
    let pictured = report.images.iter().all(ImageReport::is_fine);
    report.verdict = if clean && known && pictured { Verdict::Verified } else { Verdict::Failed };
}

/// Whether a replay fails, and how: the name of its first broken invariant, such as `MC/manifold`, or `panic`. It goes no
/// further than that.
pub fn failure(mut replay: Box<dyn Replay>) -> Option<String> {
    let name = catch_unwind(AssertUnwindSafe(|| {
        while replay.finding().is_none() && replay.step().is_some() {}
        replay.finding().map(|finding| finding.name())
    }));
    name.unwrap_or_else(|_| Some("panic".into()))
}
