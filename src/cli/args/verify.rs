//! What `verify`, `merge` and `bless` can be asked for.

use std::path::PathBuf;

use clap::ValueHint;

use super::{Pixels, Renderer, Target};
use crate::replay::Plant;
use crate::verify::Shard;

/// Replay recordings, look at every invariant, and compare them with their goldens
#[derive(Debug, clap::Args)]
pub(in crate::cli) struct Verify {
    /// Recordings, and folders of them
    #[arg(value_name = "PATH", default_value = "recordings", value_hint = ValueHint::AnyPath)]
    pub(in crate::cli) paths: Vec<PathBuf>,
    #[command(flatten)]
    pub(in crate::cli) select: Select,
    /// Only part K of N of the recordings; `lancet merge` makes one report of all parts' blobs
    #[arg(long, value_name = "K/N")]
    pub(in crate::cli) shard: Option<Shard>,
    /// Leave out what comes after the first recording that fails
    #[arg(long, conflicts_with = "shard")]
    pub(in crate::cli) fail_fast: bool,
    #[command(flatten)]
    pub(in crate::cli) pixels: Pixels,
    /// Digest and check the whole state after every event
    #[arg(long)]
    pub(in crate::cli) paranoid: bool,
    /// Plant a defect, to see that it is found: EVENT.STAGE:BUFFER:ELEMENT:ULPS, such as 4.MC:nodes:120:1
    #[arg(long, value_name = "SPEC")]
    pub(in crate::cli) plant: Option<Plant>,
    #[command(flatten)]
    pub(in crate::cli) to: Reports,
    /// Write the report with all that its page shows, for `lancet merge`
    #[arg(long, value_name = "F", value_hint = ValueHint::FilePath)]
    pub(in crate::cli) blob: Option<Target>,
}

/// Where the report of a verification goes, beside the table.
#[derive(Debug, clap::Args)]
pub(in crate::cli) struct Reports {
    /// Write the report as JSON
    #[arg(long, value_name = "F", value_hint = ValueHint::FilePath)]
    pub(in crate::cli) json: Option<Target>,
    /// Write the report as one page with all pictures, DIR/index.html
    #[arg(long, value_name = "DIR", value_hint = ValueHint::DirPath)]
    pub(in crate::cli) html: Option<PathBuf>,
    /// Write the report as JUnit XML
    #[arg(long, value_name = "F", value_hint = ValueHint::FilePath)]
    pub(in crate::cli) junit: Option<Target>,
}

/// Make one report of the shards of several machines
#[derive(Debug, clap::Args)]
pub(in crate::cli) struct Merge {
    /// What `verify --shard K/N --blob` wrote, each shard once
    #[arg(value_name = "BLOB", required = true, value_hint = ValueHint::FilePath)]
    pub(in crate::cli) blobs: Vec<PathBuf>,
    #[command(flatten)]
    pub(in crate::cli) to: Reports,
}

/// Which recordings, and how many at a time.
#[derive(Debug, clap::Args)]
pub(in crate::cli) struct Select {
    /// Only recordings with this in their name
    #[arg(long, value_name = "TEXT")]
    pub(in crate::cli) filter: Option<String>,
    /// How many recordings at a time [default: as many as there are processors]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub(in crate::cli) jobs: Option<u16>,
}

/// Write what the runs are now as their goldens
#[derive(Debug, clap::Args)]
pub(in crate::cli) struct Bless {
    /// Recordings, and folders of them
    #[arg(value_name = "PATH", default_value = "recordings", value_hint = ValueHint::AnyPath)]
    pub(in crate::cli) paths: Vec<PathBuf>,
    #[command(flatten)]
    pub(in crate::cli) select: Select,
    /// Why the runs, or the gates, are right as they are; it is written down with them
    #[arg(long, value_name = "TEXT")]
    pub(in crate::cli) reason: String,
    /// Measure how far the adapter in use is from the goldens, and write down its gates instead
    #[arg(long)]
    pub(in crate::cli) gates: bool,
    /// Who renders: goldens are blessed from the reference alone, gates are those of a GPU
    #[arg(long, value_enum, value_name = "WHO")]
    pub(in crate::cli) renderer: Option<Renderer>,
    /// Say what would change, and write nothing
    #[arg(long)]
    pub(in crate::cli) dry_run: bool,
}
