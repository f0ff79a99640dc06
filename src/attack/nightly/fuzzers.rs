//! libFuzzer as another program: `cargo +nightly fuzz`, started, waited for, and its words read.
//!
//! The one place of the house that starts a program: a fuzzer has to end its process at the first panic, and needs a compiler of its own, so
//! that it cannot be a part of this one.

use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

use super::parts::new_inputs;
use super::{CANARY, Night, NightFinding, Part, Progress, Verdict};
use crate::assets;
use crate::attack::{Target, canary};

/// Seconds after which an input counts as one that does not end.
const SLOWEST: u32 = 20;
/// Most memory that a fuzzer may have used, MB; inputs are of some kilobytes.
const MOST_MB: u32 = 512;
/// Without a sanitizer, which looks for what safe code cannot do and makes an input cost several times as much.
const PLAIN: [&str; 2] = ["--sanitizer", "none"];
/// Seconds within which the planted bug must be found.
const CANARY_SECONDS: u32 = 60;
/// What libFuzzer says before the path of an input that broke something.
const WRITTEN: &str = "Test unit written to ";

/// cargo-fuzz with its targets built, and apart from them the program with the planted bug.
pub(super) struct Tool {
    fuzz: PathBuf,
}

/// Why there is no tool.
pub(super) enum Missing {
    /// It was never there: what it does is done otherwise.
    Absent(String),
    /// It is there, and its targets do not build: the night cannot do what it is for.
    Broken(String),
}

impl Tool {
    /// The tool for a fuzz crate, or why there is none.
    pub(super) fn find(fuzz: &Path, progress: Progress<'_>) -> Result<Self, Missing> {
        if !assets::is_file(&fuzz.join("Cargo.toml")) {
            return Err(Missing::Absent(format!("no cargo-fuzz crate at {}", fuzz.display())));
        }
        let tool = Self { fuzz: fuzz.to_path_buf() };
        match tool.cargo(&["--version"]) {
            Ok(output) if output.status.success() => {}
            _ => return Err(Missing::Absent("no cargo-fuzz".into())),
        }
        progress("building the fuzz targets");
        tool.build(&["--fuzz-dir", &tool.folder()])?;
        progress("building the program with the planted bug");
        tool.build(&[&tool.canary_options().each_ref().map(String::as_str)[..], &[CANARY]].concat())?;
        Ok(tool)
    }

    fn build(&self, options: &[&str]) -> Result<(), Missing> {
        let built = self.cargo(&[&["build"], &PLAIN[..], options].concat());
        let why = match &built {
            Ok(built) if built.status.success() => return Ok(()),
            Ok(built) => error_line(&text(built)).to_owned(),
            Err(error) => error.to_string(),
        };
        Err(Missing::Broken(format!("the fuzz targets do not build: {why}")))
    }

    /// The planted bug is built apart, so that the other targets need not be built again.
    fn canary_options(&self) -> [String; 6] {
        let apart = self.fuzz.join("target").join(CANARY).display().to_string();
        ["--fuzz-dir".into(), self.folder(), "--target-dir".into(), apart, "--features".into(), CANARY.into()]
    }

    fn folder(&self) -> String {
        self.fuzz.display().to_string()
    }

    fn cargo(&self, arguments: &[&str]) -> std::io::Result<Output> {
        let mut command = Command::new("cargo");
        command.args(["+nightly", "fuzz"]).args(arguments).stdin(Stdio::null()).output()
    }

    /// Runs the program with the planted bug until it is found; a minute without it is a failure.
    pub(super) fn canary(&self, night: &Night) -> Part {
        // It begins with nothing: inputs that are known to meet the bug would prove nothing of the fuzzer.
        let none = new_inputs(night, CANARY);
        if let Err(error) = assets::real_folder(&none) {
            return Part::unable(error.to_string());
        }
        let clock = Instant::now();
        let mut command = Command::new("cargo");
        command.args(["+nightly", "fuzz", "run"]).args(self.canary_options()).args(PLAIN);
        command.arg(CANARY).arg(&none);
        command.arg("--").args(limits(night, CANARY, u64::from(CANARY_SECONDS)));
        command.env("LANCET_FINDINGS", night.findings.join(CANARY)).stdin(Stdio::null());
        match command.output() {
            Ok(output) => canary_of(&part_of(output.status.success(), &text(&output)), clock.elapsed()),
            Err(error) => Part::unable(error.to_string()),
        }
    }

    /// Runs a target for some time.
    pub(super) fn fuzz(&self, night: &Night, target: &Target, time: Duration) -> Part {
        let new = new_inputs(night, target.name);
        let old = self.fuzz.join("corpus").join(target.name);
        if let Err(error) = assets::real_folder(&new) {
            return Part::unable(error.to_string());
        }
        let mut command = Command::new("cargo");
        command.args(["+nightly", "fuzz", "run", "--fuzz-dir"]).arg(&self.fuzz).args(PLAIN);
        command.arg(target.name).arg(&new);
        if assets::is_folder(&old) {
            command.arg(&old);
        }
        command.arg("--").args(limits(night, target.name, time.as_secs().max(1)));
        command.env("LANCET_FINDINGS", &night.findings).stdin(Stdio::null());
        match command.output() {
            Ok(output) => part_of(output.status.success(), &text(&output)),
            Err(error) => Part::unable(error.to_string()),
        }
    }
}

/// libFuzzer's own options.
fn limits(night: &Night, target: &str, seconds: u64) -> [String; 5] {
    [
        // libFuzzer takes a seed of 0 for none.
        format!("-seed={}", (night.seed_of(target, 0) as u32).max(1)),
        format!("-max_total_time={seconds}"),
        format!("-timeout={SLOWEST}"),
        format!("-rss_limit_mb={MOST_MB}"),
        "-print_final_stats=1".into(),
    ]
}

fn text(output: &Output) -> String {
    [&output.stdout, &output.stderr].map(|bytes| String::from_utf8_lossy(bytes).into_owned()).concat()
}

fn last_line(text: &str) -> &str {
    text.lines().rev().find(|line| !line.trim().is_empty()).unwrap_or_default()
}

/// What a compiler said first of what is wrong.
fn error_line(text: &str) -> &str {
    text.lines().find(|line| line.starts_with("error")).unwrap_or_else(|| last_line(text))
}

/// What a run came to, by its words.
fn part_of(success: bool, text: &str) -> Part {
    let word = |before: &str, line: &str| {
        line.split_once(before).and_then(|(_, rest)| rest.split_whitespace().next()).map(str::to_owned)
    };
    let last = |before: &str| text.lines().rev().find_map(|line| word(before, line));
    let runs = last("stat::number_of_executed_units:").and_then(|n| n.parse().ok()).unwrap_or(0);
    let said = |before: &str| last(before).unwrap_or_else(|| "?".into());
    let detail = format!(
        "{} inputs a second, coverage {}, features {}",
        said("stat::average_exec_per_sec:"),
        said("cov: "),
        said("ft: ")
    );
    let input = last(WRITTEN).map(PathBuf::from);
    match (success, input) {
        (true, _) => Part::ran(runs, detail, Vec::new()),
        (false, Some(input)) => Part::ran(runs, detail, vec![finding(text, input)]),
        (false, None) => Part::unable(last_line(text)),
    }
}

/// A canary's run, which must break, and by what was planted: another finding proves nothing of the fuzzer, and is one to be told.
fn canary_of(run: &Part, time: Duration) -> Part {
    match run.findings.first() {
        Some(found) if !canary::is_planted(&found.detail) => run.clone(),
        Some(found) => Part::ran(
            run.count,
            format!("found in {:.1} s: {}", time.as_secs_f64(), found.detail),
            Vec::new(),
        ),
        None if run.verdict == Verdict::Passed => {
            let detail =
                format!("the planted bug was not found in {CANARY_SECONDS} s: this night says nothing");
            Part::ran(run.count, "", vec![NightFinding { detail, file: None }])
        }
        None => run.clone(),
    }
}

/// What broke, and the recording of it if one was written.
fn finding(text: &str, input: PathBuf) -> NightFinding {
    let after_panic = text.lines().skip_while(|line| !line.contains("panicked at")).nth(1);
    let summary = text.lines().find(|line| line.contains("SUMMARY:"));
    let detail = after_panic.or(summary).unwrap_or("it broke").trim().to_owned();
    let recording = text.lines().find_map(|line| line.strip_prefix("the recording of it: "));
    NightFinding { detail, file: Some(recording.map_or(input, PathBuf::from)) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_libfuzzer_says_is_read() {
        let sound = "#2\tINITED cov: 12 ft: 13 corp: 1/1b exec/s: 0 rss: 30Mb\n#9\tDONE   cov: 41 ft: 55 corp: 7/9b\n\
            stat::number_of_executed_units: 9\nstat::average_exec_per_sec:     3\n";
        let part = part_of(true, sound);
        assert_eq!((part.verdict, part.count), (Verdict::Passed, 9));
        assert_eq!(part.detail, "3 inputs a second, coverage 41, features 55");
        let broken = "thread '<unnamed>' panicked at src/lib.rs:39:9:\npick-is-the-first: f3\nthe recording of it: a/b.lancet\n\
            artifact_prefix='x/'; Test unit written to x/crash-1\n";
        let part = part_of(false, broken);
        assert_eq!(part.verdict, Verdict::Failed);
        let found = NightFinding { detail: "pick-is-the-first: f3".into(), file: Some("a/b.lancet".into()) };
        assert_eq!(part.findings, [found]);
        let without = broken.replace("the recording of it", "");
        assert_eq!(part_of(false, &without).findings[0].file, Some("x/crash-1".into()));
        assert_eq!(part_of(false, "error: no such target\n").verdict, Verdict::Unable);
    }

    #[test]
    fn a_canary_passes_by_being_found() {
        let found = |detail: &str| vec![NightFinding { detail: detail.into(), file: None }];
        let verdict = |run: Part| canary_of(&run, Duration::from_secs(2)).verdict;
        assert_eq!(verdict(Part::ran(9, "", found("MC/uv-affine: 0.1 is more than 1e-6"))), Verdict::Passed);
        assert_eq!(verdict(Part::ran(9, "", found("SUMMARY: libFuzzer: out-of-memory"))), Verdict::Failed);
        assert_eq!(verdict(Part::ran(9, "", Vec::new())), Verdict::Failed);
        assert_eq!(verdict(Part::unable("no such program")), Verdict::Unable);
    }

    #[test]
    fn without_a_fuzz_crate_there_is_no_tool() {
        let folder = tempfile::tempdir().expect("a folder");
        let missing = Tool::find(folder.path(), &|_| {}).err().expect("there is none");
        assert!(matches!(missing, Missing::Absent(why) if why.starts_with("no cargo-fuzz")));
    }
}
