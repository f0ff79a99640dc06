//! The nightly run: everything that can find something, one after another within a span of time, and one report.
//!
//! | part | what it does | its time |
//! | --- | --- | --- |
//! | verify | every recording against its goldens | as long as it takes |
//! | stability | random and hostile cuts, in rounds with a seed each | an eighth of what is left |
//! | canary | a program with a planted bug, which must be found: else the night does not count | a minute at most |
//! | fuzz TARGET | libFuzzer, or a [`super::storm`] where there is none; as many at a time as there are jobs | the rest, in equal shares: each as long as any other |
//! | reached | the corpora, old and new, run again: what the night reached | as long as it takes |
//! | matrix | configurations and degenerate cases among that, and drawn until none is missing | an eighth |
//!
//! libFuzzer is started as `cargo +nightly fuzz` where that and the folder fuzz/ are there (`fuzzers`), and says so in the report where not. Its new
//! inputs go into a folder of the night's, so that a checkout stays as it is. Whatever is found is written there too, as a recording where it is one.
//!
//! Not promised: that two nights are the same. With the same seed they begin alike, and end when their time is up.

mod fuzzers;
mod parts;
mod report;

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

pub use report::{NightFinding, NightReport, Part, Verdict};

use fuzzers::{Missing, Tool};

use super::{Hits, TARGETS, Target};
use crate::measure::Random;
use crate::verify::VerifyOptions;

/// What a night is to do.
#[derive(Clone, Debug)]
pub struct Night {
    /// How long, all in all.
    pub time: Duration,
    /// What all chance comes from.
    pub seed: u64,
    /// How many recordings, cuts or targets at a time.
    pub jobs: usize,
    /// Recordings to verify, and folders of them.
    pub recordings: Vec<PathBuf>,
    /// How they are verified.
    pub verify: VerifyOptions,
    /// The folder of the fuzz crate, with its corpora.
    pub fuzz: PathBuf,
    /// Where findings and new inputs go.
    pub findings: PathBuf,
}

/// Stability's share of the time that verifying leaves, and the matrix's: one in so many parts.
const SMALL_SHARE: u32 = 8;

/// The target that has a bug to find.
const CANARY: &str = "canary";

/// Told what is being done, from any thread.
pub type Progress<'a> = &'a (dyn Fn(&str) + Sync);

impl Night {
    /// Does it all. What breaks ends its part, and no other.
    pub fn run(&self, progress: Progress<'_>) -> NightReport {
        let clock = Instant::now();
        let mut report = NightReport::new(self.seed);
        report.parts.push(timed("verify", progress, || parts::verify(self)));
        let small = self.time.saturating_sub(clock.elapsed()) / SMALL_SHARE;
        report.parts.push(timed("stability", progress, || parts::stability(self, small)));
        let before = clock.elapsed();
        let tool = Tool::find(&self.fuzz, progress);
        // What building takes comes on top of the night.
        let built = clock.elapsed() - before;
        report.parts.push(timed("canary", progress, || match &tool {
            Ok(tool) => tool.canary(self),
            Err(Missing::Absent(why)) => {
                Part::skipped(format!("{why}: no second program with the bug in it"))
            }
            Err(Missing::Broken(why)) => Part::unable(why),
        }));
        let left = (self.time + built).saturating_sub(clock.elapsed() + small);
        report.parts.extend(self.fuzz_all(&tool, left, progress));
        let mut reached = Reached::default();
        report.parts.push(timed("reached", progress, || parts::reached(self, &mut reached)));
        report.parts.push(timed("matrix", progress, || {
            let (part, matrix) = parts::matrix(self, &reached.all, small);
            report.matrix = Some(matrix);
            part
        }));
        report.reached = reached.by_target.0;
        report.seconds = clock.elapsed().as_secs_f64();
        report
    }

    /// What the chance of one part comes from: that of two parts, rounds or nights has nothing in common.
    fn seed_of(&self, part: &str, round: u64) -> u64 {
        Random::of(self.seed, round, part).any()
    }

    /// Every target, as many at a time as there are jobs, and each for as long as any other; together for so long.
    fn fuzz_all(&self, tool: &Result<Tool, Missing>, time: Duration, progress: Progress<'_>) -> Vec<Part> {
        // Without its bug the canary is another target's double.
        let targets: Vec<&'static Target> = TARGETS.iter().filter(|target| target.name != CANARY).collect();
        let jobs = self.jobs.clamp(1, targets.len());
        let share = time / u32::try_from(targets.len().div_ceil(jobs)).unwrap_or(1);
        let one = |number: usize| {
            let target = *targets.get(number)?;
            Some(timed(&format!("fuzz {}", target.name), progress, || match tool {
                Ok(tool) => tool.fuzz(self, target, share),
                Err(Missing::Absent(why)) => parts::storm(self, target, share, why),
                Err(Missing::Broken(why)) => Part::unable(why.clone()),
            }))
        };
        let (next, done) = (AtomicUsize::new(0), Mutex::new(BTreeMap::new()));
        std::thread::scope(|scope| {
            for _ in 0..jobs {
                scope.spawn(|| {
                    loop {
                        let number = next.fetch_add(1, Ordering::Relaxed);
                        let Some(part) = one(number) else { return };
                        done.lock().unwrap_or_else(PoisonError::into_inner).insert(number, part);
                    }
                });
            }
        });
        done.into_inner().unwrap_or_else(PoisonError::into_inner).into_values().collect()
    }
}

/// What the corpora reach.
#[derive(Debug, Default)]
struct Reached {
    /// All together.
    all: Hits,
    /// The same as `TARGET: WHAT`.
    by_target: Hits,
}

/// Runs a part, with its name and its time.
fn timed(name: &str, progress: Progress<'_>, part: impl FnOnce() -> Part) -> Part {
    progress(name);
    let clock = Instant::now();
    let done = part();
    Part { name: name.into(), seconds: clock.elapsed().as_secs_f64(), ..done }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_rounds_and_nights_have_seeds_of_their_own() {
        let night = |seed| Night {
            time: Duration::ZERO,
            seed,
            jobs: 1,
            recordings: Vec::new(),
            verify: VerifyOptions::default(),
            fuzz: PathBuf::new(),
            findings: PathBuf::new(),
        };
        let seeds = [(4, "stability", 1), (5, "stability", 0), (4, "pick", 0), (5, "pick", 0)];
        let mut all = seeds.map(|(seed, part, round)| night(seed).seed_of(part, round));
        all.sort_unstable();
        assert!(all.windows(2).all(|pair| pair[0] != pair[1]), "{all:?}");
        assert_eq!(night(4).seed_of("pick", 0), night(4).seed_of("pick", 0));
    }

    #[test]
    fn a_short_night_without_libfuzzer_does_every_part() {
        let folder = tempfile::tempdir().expect("a folder");
        let night = Night {
            time: Duration::from_millis(600),
            seed: 4,
            jobs: 2,
            recordings: vec!["recordings/wound/both-picks-on-one-edge.lancet".into()],
            verify: VerifyOptions::default(),
            fuzz: folder.path().join("none"),
            findings: folder.path().join("findings"),
        };
        let report = night.run(&|_| {});
        let names: Vec<&str> = report.parts.iter().map(|part| part.name.as_str()).collect();
        assert_eq!(names[..2], ["verify", "stability"]);
        assert_eq!(names.len(), 5 + TARGETS.len() - 1);
        let verdict =
            |name: &str| report.parts.iter().find(|part| part.name == name).expect("a part").verdict;
        assert_eq!(verdict("canary"), Verdict::Skipped);
        let usual = report.parts.iter().filter(|part| !["canary", "matrix"].contains(&part.name.as_str()));
        assert!(usual.into_iter().all(|part| part.verdict == Verdict::Passed), "{report:?}");
        // Half a second is too short to reach everything, and that is a failure.
        let empty = report.matrix.as_ref().expect("a matrix").empty().len();
        assert_eq!(verdict("matrix") == Verdict::Failed, empty > 0, "{empty}");
        let fuzzed = report.parts.iter().filter(|part| part.name.starts_with("fuzz "));
        assert!(
            fuzzed.clone().all(|part| part.detail.contains("no cargo-fuzz") && part.count > 0),
            "{report:?}"
        );
        assert_eq!(report.exit_code(), u8::from(empty > 0));
    }
}
