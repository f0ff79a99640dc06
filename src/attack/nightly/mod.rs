//! The nightly run: everything that can find something, one after another within a span of time, and one report.
//!
//! | part | what it does | its time |
//! | --- | --- | --- |
//! | verify | every recording against its goldens | as long as it takes |
//! | stability | random and hostile cuts, in rounds with a seed each | a sixth of what is left |
//! | fuzz TARGET | libFuzzer, or a [`super::storm`] where there is none | the rest, in equal shares |
//! | reached | the corpora, old and new, run again: what the night reached | as long as it takes |
//! | matrix | the cells of [`super::matrix`] that the corpora and a sweep of random inputs reach | seconds |
//! | canary | the target of that name, with the planted bug | until it is found, a minute at most |
//!
//! libFuzzer is started as `cargo +nightly fuzz` where that and the folder fuzz/ are there (`fuzzers`), and says so in the report where not. Its new
//! inputs go into a folder of the night's, so that a checkout stays as it is. Whatever is found is written there too, as a recording where it is one.
//!
//! Not promised: that two nights are the same. With the same seed they begin alike, and end when their time is up.

mod fuzzers;
mod parts;
mod report;

use std::path::PathBuf;
use std::time::{Duration, Instant};

pub use report::{NightFinding, NightReport, Part, Verdict};

use super::{Hits, TARGETS};
use crate::verify::VerifyOptions;

/// What a night is to do.
#[derive(Clone, Debug)]
pub struct Night {
    /// How long, all in all.
    pub time: Duration,
    /// What all chance comes from.
    pub seed: u64,
    /// How many cuts or recordings at a time.
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

/// Stability's share of the time that verifying leaves: one in so many parts.
const STABILITY_SHARE: u32 = 6;

/// Told what is being done.
pub type Progress<'a> = &'a dyn Fn(&str);

impl Night {
    /// Does it all. What breaks ends its part, and no other.
    pub fn run(&self, progress: Progress<'_>) -> NightReport {
        let clock = Instant::now();
        let mut report = NightReport::new(self.seed);
        report.parts.push(timed("verify", progress, || parts::verify(self)));
        let left = self.time.saturating_sub(clock.elapsed());
        report.parts.push(timed("stability", progress, || parts::stability(self, left / STABILITY_SHARE)));
        let tool = fuzzers::Tool::find(&self.fuzz, progress);
        for (number, target) in TARGETS.iter().enumerate() {
            // What one part leaves over is shared by those after it.
            let left = self.time.saturating_sub(clock.elapsed());
            let share = left / u32::try_from(TARGETS.len() - number).unwrap_or(1);
            let name = format!("fuzz {}", target.name);
            report.parts.push(timed(&name, progress, || match &tool {
                Ok(tool) => tool.fuzz(self, target, share),
                Err(why) => parts::storm(self, target, share, why),
            }));
        }
        let mut hits = Hits::default();
        report.parts.push(timed("reached", progress, || parts::reached(self, &mut hits)));
        report.parts.push(timed("matrix", progress, || {
            let (part, matrix) = parts::matrix(self, &hits);
            report.matrix = Some(matrix);
            part
        }));
        report.parts.push(timed("canary", progress, || match &tool {
            Ok(tool) => tool.canary(self),
            Err(why) => Part::ran(0, format!("skipped: {why}"), Vec::new()),
        }));
        report.reached = hits.0;
        report.seconds = clock.elapsed().as_secs_f64();
        report
    }
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
    fn a_short_night_without_libfuzzer_does_every_part() {
        let folder = tempfile::tempdir().expect("a folder");
        let night = Night {
            time: Duration::from_millis(600),
            seed: 4,
            jobs: 1,
            recordings: vec!["recordings/wound/both-picks-on-one-edge.lancet".into()],
            verify: VerifyOptions::default(),
            fuzz: folder.path().join("none"),
            findings: folder.path().join("findings"),
        };
        let report = night.run(&|_| {});
        let names: Vec<&str> = report.parts.iter().map(|part| part.name.as_str()).collect();
        assert_eq!(names[..2], ["verify", "stability"]);
        assert_eq!(names.len(), 5 + TARGETS.len());
        assert!(report.matrix.as_ref().is_some_and(|matrix| matrix.empty().is_empty()));
        assert!(report.parts.iter().all(|part| part.verdict == Verdict::Passed), "{report:?}");
        let fuzzed = report.parts.iter().filter(|part| part.name.starts_with("fuzz "));
        assert!(
            fuzzed.clone().all(|part| part.detail.contains("no cargo-fuzz") && part.count > 0),
            "{report:?}"
        );
        assert_eq!(report.exit_code(), 0);
    }
}
