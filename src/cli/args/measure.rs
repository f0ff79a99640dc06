//! What `measure` can be asked for.

use std::path::PathBuf;

use clap::{Subcommand, ValueHint};

use super::{Renderer, Target};

/// Measure what cuts cost, and whether anything breaks
#[derive(Debug, clap::Args)]
pub(in crate::cli) struct Measure {
    #[command(subcommand)]
    pub(in crate::cli) what: Measured,
}

#[derive(Debug, Subcommand)]
pub(in crate::cli) enum Measured {
    /// The thesis's performance tests, beside its figures: cuts stage by stage, frames, scattering (Lam 2016, §6.5)
    Thesis {
        /// The folder of their recordings
        #[arg(value_name = "DIR", default_value = "recordings/wound", value_hint = ValueHint::DirPath)]
        recordings: PathBuf,
        /// Run each cut, and take each frame, so many times [default: 100; quick: 10]
        #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
        repeat: Option<u32>,
        /// Who renders
        #[arg(long, value_enum, default_value_t, value_name = "WHO")]
        renderer: Renderer,
        #[command(flatten)]
        common: MeasureOptions,
    },
    /// The same cut and pick on meshes of 8 thousand to 4 million faces; quick: to 125 thousand
    Scaling {
        /// Run so many rounds over all meshes [default: 60; quick: 20]
        #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
        rounds: Option<u32>,
        #[command(flatten)]
        common: MeasureOptions,
    },
    /// Time against error, for each of several subjects: a table, and a plot
    Accuracy(Accuracy),
    /// Random and hostile cuts over the built-in scenes, every invariant looked at
    Stability {
        /// How many random cuts [default: 100000; quick: 2000]
        #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1_000_000_000))]
        cuts: Option<u32>,
        /// How many cuts on every rung of every ladder; 0 leaves them out [default: 400; quick: 40]
        #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(0..=1_000_000))]
        per_rung: Option<u32>,
        /// What they are drawn from
        #[arg(long, value_name = "S", default_value_t = 1)]
        seed: u64,
        /// How many scenes at a time; the answer does not depend on it [default: as many as there are processors]
        #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
        jobs: Option<u16>,
        /// Write a script for each finding into this folder
        #[arg(long, value_name = "DIR", value_hint = ValueHint::DirPath)]
        findings: Option<PathBuf>,
        /// Write a picture of each ladder into this folder, as SVG
        #[arg(long, value_name = "DIR", value_hint = ValueHint::DirPath)]
        plot: Option<PathBuf>,
        #[command(flatten)]
        common: MeasureOptions,
    },
}

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

/// What every measurement can be asked for.
#[derive(Debug, clap::Args)]
pub(in crate::cli) struct MeasureOptions {
    /// Less of it
    #[arg(long)]
    pub(in crate::cli) quick: bool,
    /// Write the figures as JSON
    #[arg(long, value_name = "F", value_hint = ValueHint::FilePath)]
    pub(in crate::cli) json: Option<Target>,
}
