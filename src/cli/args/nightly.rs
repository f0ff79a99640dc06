//! What `lancet nightly` takes.

use std::path::PathBuf;
use std::str::FromStr;
use std::time::Duration;

use clap::ValueHint;

use super::{Renderer, Target};

/// Verify, stress and fuzz for some time, and write one report
#[derive(Debug, clap::Args)]
pub(in crate::cli) struct Nightly {
    /// Recordings to verify, and folders of them
    #[arg(value_name = "PATH", default_value = "recordings", value_hint = ValueHint::AnyPath)]
    pub(in crate::cli) paths: Vec<PathBuf>,
    /// How long, such as 90s, 30m or 8h; verifying takes as long as it takes, and building the fuzzers comes on top
    #[arg(long = "for", value_name = "TIME", default_value = "30m")]
    pub(in crate::cli) time: Span,
    /// What all chance comes from [default: the day's number, so that no night repeats the one before]
    #[arg(long, value_name = "S")]
    pub(in crate::cli) seed: Option<u64>,
    /// How many cuts or recordings at a time [default: as many as there are processors]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub(in crate::cli) jobs: Option<u16>,
    /// Who renders
    #[arg(long, value_enum, default_value_t, value_name = "WHO")]
    pub(in crate::cli) renderer: Renderer,
    /// The crate of the fuzz targets, with their corpora
    #[arg(long, value_name = "DIR", default_value = "fuzz", value_hint = ValueHint::DirPath)]
    pub(in crate::cli) fuzz: PathBuf,
    /// Write what leads to findings, and new inputs, into this folder
    #[arg(long, value_name = "DIR", default_value = "fuzz/artifacts/nightly", value_hint = ValueHint::DirPath)]
    pub(in crate::cli) findings: PathBuf,
    /// Write the report as JSON
    #[arg(long, value_name = "F", value_hint = ValueHint::FilePath)]
    pub(in crate::cli) json: Option<Target>,
}

/// A span of time: a whole number of seconds, minutes or hours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::cli) struct Span(pub(in crate::cli) Duration);

impl FromStr for Span {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let wrong = || format!("`{text}` is not a time, such as 90s, 30m or 8h");
        let unit = text.chars().next_back().ok_or_else(wrong)?;
        let seconds = match unit {
            's' => 1,
            'm' => 60,
            'h' => 3600,
            _ => return Err(wrong()),
        };
        let count: u64 = text[..text.len() - 1].parse().map_err(|_| wrong())?;
        let whole = count.checked_mul(seconds).filter(|seconds| *seconds > 0).ok_or_else(wrong)?;
        Ok(Self(Duration::from_secs(whole)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_span_is_a_number_and_a_unit() {
        let seconds = |text: &str| Span::from_str(text).map(|span| span.0.as_secs());
        assert_eq!([seconds("90s"), seconds("30m"), seconds("8h")], [Ok(90), Ok(1800), Ok(28_800)]);
        for wrong in
            ["", "s", "30", "0m", "-1s", "1.5h", "99999999999999999999h", "18446744073709551615h", "5µ"]
        {
            assert!(seconds(wrong).is_err(), "{wrong}");
        }
    }
}
