//! What `measure accuracy` can be asked for.

use std::path::PathBuf;

use clap::ValueHint;

use super::{MeasureOptions, Renderer};

/// Time against error.
#[derive(Debug, clap::Args)]
pub(in crate::cli) struct Accuracy {
    /// Only these subjects
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    pub(in crate::cli) only: Vec<String>,
    /// Take times in so many rounds [default: 30; quick: 8]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub(in crate::cli) rounds: Option<u32>,
    /// Write a plot of each curve into this folder, as SVG
    #[arg(long, value_name = "DIR", value_hint = ValueHint::DirPath)]
    pub(in crate::cli) plot: Option<PathBuf>,
    /// Fail where a setting got both slower and less accurate than in this file
    #[arg(long, value_name = "F", value_hint = ValueHint::FilePath)]
    pub(in crate::cli) against: Option<PathBuf>,
    /// Write what was measured into that file instead
    #[arg(long, requires_all = ["against", "reason"])]
    pub(in crate::cli) bless: bool,
    /// Why the curves may be what they are now
    #[arg(long, value_name = "TEXT", requires = "bless")]
    pub(in crate::cli) reason: Option<String>,
    /// The folder of recordings
    #[arg(long, value_name = "DIR", default_value = "recordings/wound", value_hint = ValueHint::DirPath)]
    pub(in crate::cli) recordings: PathBuf,
    /// Who renders
    #[arg(long, value_enum, default_value_t, value_name = "WHO")]
    pub(in crate::cli) renderer: Renderer,
    #[command(flatten)]
    pub(in crate::cli) common: MeasureOptions,
}
