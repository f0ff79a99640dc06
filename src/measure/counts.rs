//! Instruction counts of the hot paths: kept in a file, and compared with those of another run.
//!
//! Seconds on a shared machine are noise; the same instructions are run whoever else is about. What a path costs depends on compiler, processor and
//! on whoever counted, so that counts are compared only with those that were made alike. A count that is off by more than [`MOST`] has to be
//! blessed with a reason, which is kept beside it: in either direction, since what has become cheaper without anybody knowing why may have
//! become wrong. Not promised: that fewer instructions take less time.

use std::fmt::{self, Write};

/// By what share a count may be off: a few times what unrelated changes move by inlining and layout.
pub const MOST: f64 = 0.03;

/// What the file says of itself.
const HEAD: &str = "# Instructions of the hot paths, as callgrind counts them. `cargo bench --no-default-features --bench instructions` compares them;
# with `-- --bless --reason TEXT` it keeps those that are off by more than it allows.
";

/// A path's count.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Count {
    /// Its name, a word.
    pub name: String,
    /// Instructions.
    pub instructions: u64,
    /// Why they are as many.
    pub reason: String,
}

/// The counts of a run.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// What they depend on: compiler, processor, whoever counted. A line.
    pub made: String,
    /// By path.
    pub paths: Vec<Count>,
}

/// What is not as it was.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Change {
    /// A path that was not counted before.
    New(String),
    /// A path that is not counted any longer.
    Gone(String),
    /// A path that is off by more than it may be.
    Off {
        /** The path. */
        name: String,
        /** What is kept. */
        was: u64,
        /** What it is. */
        is: u64,
    },
}

impl fmt::Display for Change {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::New(name) => write!(f, "{name}: was not counted before"),
            Self::Gone(name) => write!(f, "{name}: is not counted any longer"),
            Self::Off { name, was, is } => {
                write!(f, "{name}: {is} instructions, not {was}: {:+.1} %", 100.0 * share(*was, *is))
            }
        }
    }
}

/// By how much of what it was something is more.
pub fn share(was: u64, is: u64) -> f64 {
    (is as f64 - was as f64) / was.max(1) as f64
}

impl Counts {
    /// Reads the file. An error names the line.
    pub fn parse(text: &str) -> Result<Self, String> {
        let mut counts = Self::default();
        for (number, line) in (1..).zip(text.lines()) {
            match line.split_once(' ') {
                _ if line.is_empty() || line.starts_with('#') => {}
                Some(("made:", made)) => counts.made = made.trim().into(),
                _ => counts.paths.push(count(line).ok_or_else(|| {
                    format!("line {number}: not a path, its instructions and the reason: {line}")
                })?),
            }
        }
        Ok(counts)
    }

    /// The file.
    pub fn text(&self) -> String {
        let mut text = format!("{HEAD}made: {}\n", self.made);
        for Count { name, instructions, reason } in &self.paths {
            // Writing to a text does not fail.
            let _ = writeln!(text, "{name:<16} {instructions:>12}  {reason}");
        }
        text
    }

    fn of(&self, name: &str) -> Option<&Count> {
        self.paths.iter().find(|count| count.name == name)
    }

    /// What another run has to be blessed for.
    pub fn changes(&self, now: &Self) -> Vec<Change> {
        let here = now.paths.iter().filter_map(|is| match self.of(&is.name) {
            None => Some(Change::New(is.name.clone())),
            Some(was) if share(was.instructions, is.instructions).abs() <= MOST => None,
            Some(was) => {
                Some(Change::Off { name: is.name.clone(), was: was.instructions, is: is.instructions })
            }
        });
        let gone = self.paths.iter().filter(|was| now.of(&was.name).is_none());
        here.chain(gone.map(|was| Change::Gone(was.name.clone()))).collect()
    }

    /// What is kept of another run: what changed, for a reason; the rest stays as it was kept, so that small changes add up. What was made in
    /// another way is kept whole.
    #[must_use]
    pub fn blessed(&self, now: &Self, reason: &str) -> Self {
        let (changes, alike) = (self.changes(now), self.made == now.made);
        let keep = |is: &Count| {
            let changed = changes.iter().any(|change| match change {
                Change::New(name) | Change::Off { name, .. } => *name == is.name,
                Change::Gone(_) => false,
            });
            let was = self.of(&is.name).filter(|_| alike && !changed);
            was.cloned().unwrap_or_else(|| Count { reason: reason.into(), ..is.clone() })
        };
        Self { made: now.made.clone(), paths: now.paths.iter().map(keep).collect() }
    }
}

fn count(line: &str) -> Option<Count> {
    let (name, rest) = line.split_once(' ')?;
    let (instructions, reason) = rest.trim_start().split_once(' ')?;
    Some(Count { name: name.into(), instructions: instructions.parse().ok()?, reason: reason.trim().into() })
}

/// The instructions of one of callgrind's files.
pub fn callgrind_total(text: &str) -> Option<u64> {
    let total = |line: &str| {
        line.strip_prefix("totals:").or_else(|| line.strip_prefix("summary:"))?.trim().parse().ok()
    };
    text.lines().find_map(total)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn counts(paths: &[(&str, u64)]) -> Counts {
        let count = |(name, instructions): &(&str, u64)| Count {
            name: (*name).into(),
            instructions: *instructions,
            reason: "the first".into(),
        };
        Counts { made: "a compiler, a machine".into(), paths: paths.iter().map(count).collect() }
    }

    #[test]
    fn the_file_reads_as_it_was_written() {
        let kept = counts(&[("pick", 12_345), ("a-path-with-a-long-name", u64::MAX)]);
        assert_eq!(Counts::parse(&kept.text()), Ok(kept));
        for wrong in ["pick", "pick 12", "pick many instructions"] {
            assert!(Counts::parse(&format!("# head\n{wrong}\n")).expect_err(wrong).starts_with("line 2"));
        }
    }

    #[test]
    fn three_percent_pass_and_more_does_not_in_either_direction() {
        let was = counts(&[("a", 10_000), ("b", 10_000), ("gone", 1)]);
        assert!(was.changes(&counts(&[("a", 10_300), ("b", 9_700), ("gone", 1)])).is_empty());
        let changes = was.changes(&counts(&[("a", 10_301), ("b", 9_699), ("new", 1)]));
        let said: Vec<String> = changes.iter().map(ToString::to_string).collect();
        assert_eq!(
            said,
            [
                "a: 10301 instructions, not 10000: +3.0 %",
                "b: 9699 instructions, not 10000: -3.0 %",
                "new: was not counted before",
                "gone: is not counted any longer"
            ]
        );
        assert_eq!(counts(&[("none", 0)]).changes(&counts(&[("none", 0)])), []);
    }

    #[test]
    fn only_what_changed_is_kept_with_the_new_reason() {
        let was = counts(&[("a", 10_000), ("b", 10_000), ("gone", 1)]);
        let kept = was.blessed(&counts(&[("a", 10_200), ("b", 20_000), ("new", 7)]), "b does more");
        let rows: Vec<_> =
            kept.paths.iter().map(|c| (c.name.as_str(), c.instructions, c.reason.as_str())).collect();
        assert_eq!(
            rows,
            [("a", 10_000, "the first"), ("b", 20_000, "b does more"), ("new", 7, "b does more")]
        );
        let other = Counts { made: "another compiler".into(), ..counts(&[("a", 10_001)]) };
        assert_eq!(was.blessed(&other, "moved").paths[0].instructions, 10_001);
    }

    #[test]
    fn a_total_is_found_in_callgrinds_file() {
        assert_eq!(callgrind_total("version: 1\nevents: Ir\nfn=(1)\n1 5\n\ntotals: 4711\n"), Some(4711));
        assert_eq!(callgrind_total("summary: 12\n"), Some(12));
        assert_eq!(callgrind_total("events: Ir\n"), None);
    }
}
