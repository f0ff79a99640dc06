//! What the user typed: the one source of the parser, the help, the completions and the man page.

mod accuracy;
mod nightly;
mod values;

use std::path::PathBuf;

use clap::{Parser, Subcommand, ValueEnum, ValueHint};

use crate::replay::Plant;
use crate::report::Stop;
use crate::verify::Shard;
pub(super) use accuracy::Accuracy;
pub(super) use nightly::Nightly;
pub(super) use values::{Setting, Size, Target, Until};

const AFTER: &str = "Exit status: 0 when all is verified, 1 when something diverged or an invariant broke, 2 for bad input or when \
it could not run.\n\nREC is a recording (.lancet) or its script (.json). `--json -` writes to standard output. NO_COLOR is honoured.";

/// Replay recorded cuts into surface meshes, and verify every step of the way
#[derive(Debug, Parser)]
#[command(name = "lancet", version, arg_required_else_help = true, after_help = AFTER, max_term_width = 110)]
pub(super) struct Args {
    #[command(subcommand)]
    pub(super) command: Command,
}

#[derive(Debug, Subcommand)]
pub(super) enum Command {
    Verify(Verify),
    Merge(Merge),
    Bless(Bless),
    Replay(Replay),
    Tui(Tui),
    Render(Render),
    Pack(Pack),
    Unpack(Unpack),
    Info(Info),
    Reduce(Reduce),
    Diff(Diff),
    Check(Check),
    Measure(Measure),
    Nightly(Nightly),
    /// List the scenes that are made by code
    Scenes,
    /// Say what the program and the machine are
    Doctor,
    Schema(Schema),
    Completions(Completions),
    Man(Man),
}

/// Who renders.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(super) enum Renderer {
    /// A GPU where there is one, else the CPU reference
    #[default]
    Auto,
    /// A GPU, or a program that plays one, through Vulkan
    Gpu,
    /// The CPU reference
    Reference,
}

/// How pixels are made.
#[derive(Clone, Copy, Debug, clap::Args)]
pub(super) struct Pixels {
    /// Who renders
    #[arg(long, value_enum, default_value_t, value_name = "WHO")]
    pub(super) renderer: Renderer,
    /// Skip nothing, whether a scene needs it or not: the answer is the same
    #[arg(long)]
    pub(super) no_skip: bool,
}

/// Replay recordings, look at every invariant, and compare them with their goldens
#[derive(Debug, clap::Args)]
pub(super) struct Verify {
    /// Recordings, and folders of them
    #[arg(value_name = "PATH", default_value = "recordings", value_hint = ValueHint::AnyPath)]
    pub(super) paths: Vec<PathBuf>,
    #[command(flatten)]
    pub(super) select: Select,
    /// Only part K of N of the recordings; `lancet merge` makes one report of all parts' blobs
    #[arg(long, value_name = "K/N")]
    pub(super) shard: Option<Shard>,
    /// Leave out what comes after the first recording that fails
    #[arg(long, conflicts_with = "shard")]
    pub(super) fail_fast: bool,
    #[command(flatten)]
    pub(super) pixels: Pixels,
    /// Digest and check the whole state after every event
    #[arg(long)]
    pub(super) paranoid: bool,
    /// Plant a defect, to see that it is found: EVENT.STAGE:BUFFER:ELEMENT:ULPS, such as 4.MC:nodes:120:1
    #[arg(long, value_name = "SPEC")]
    pub(super) plant: Option<Plant>,
    #[command(flatten)]
    pub(super) to: Reports,
    /// Write the report with all that its page shows, for `lancet merge`
    #[arg(long, value_name = "F", value_hint = ValueHint::FilePath)]
    pub(super) blob: Option<Target>,
}

/// Where the report of a verification goes, beside the table.
#[derive(Debug, clap::Args)]
pub(super) struct Reports {
    /// Write the report as JSON
    #[arg(long, value_name = "F", value_hint = ValueHint::FilePath)]
    pub(super) json: Option<Target>,
    /// Write the report as one page with all pictures, DIR/index.html
    #[arg(long, value_name = "DIR", value_hint = ValueHint::DirPath)]
    pub(super) html: Option<PathBuf>,
    /// Write the report as JUnit XML
    #[arg(long, value_name = "F", value_hint = ValueHint::FilePath)]
    pub(super) junit: Option<Target>,
}

/// Make one report of the shards of several machines
#[derive(Debug, clap::Args)]
pub(super) struct Merge {
    /// What `verify --shard K/N --blob` wrote, each shard once
    #[arg(value_name = "BLOB", required = true, value_hint = ValueHint::FilePath)]
    pub(super) blobs: Vec<PathBuf>,
    #[command(flatten)]
    pub(super) to: Reports,
}

/// Which recordings, and how many at a time.
#[derive(Debug, clap::Args)]
pub(super) struct Select {
    /// Only recordings with this in their name
    #[arg(long, value_name = "TEXT")]
    pub(super) filter: Option<String>,
    /// How many recordings at a time [default: as many as there are processors]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub(super) jobs: Option<u16>,
}

/// Write what the runs are now as their goldens
#[derive(Debug, clap::Args)]
pub(super) struct Bless {
    /// Recordings, and folders of them
    #[arg(value_name = "PATH", default_value = "recordings", value_hint = ValueHint::AnyPath)]
    pub(super) paths: Vec<PathBuf>,
    #[command(flatten)]
    pub(super) select: Select,
    /// Why the runs, or the gates, are right as they are; it is written down with them
    #[arg(long, value_name = "TEXT")]
    pub(super) reason: String,
    /// Measure how far the adapter in use is from the goldens, and write down its gates instead
    #[arg(long)]
    pub(super) gates: bool,
    /// Who renders: goldens are blessed from the reference alone, gates are those of a GPU
    #[arg(long, value_enum, value_name = "WHO")]
    pub(super) renderer: Option<Renderer>,
    /// Say what would change, and write nothing
    #[arg(long)]
    pub(super) dry_run: bool,
}

/// Replay one recording, stage by stage
#[derive(Debug, clap::Args)]
pub(super) struct Replay {
    /// The recording
    #[arg(value_name = "REC", value_hint = ValueHint::FilePath)]
    pub(super) recording: PathBuf,
    /// Stop after this event, or after a stage of it, such as 4.MC; or before the first one (`start`)
    #[arg(long, value_name = "EVENT[.STAGE]")]
    pub(super) until: Option<Until>,
    /// Stop after the first event with a broken invariant (`finding`), that was rejected (`rejected`, `rejected=miss`), that counted something
    /// (`configurations=FE`), or with a stage that took more milliseconds (`MC>0.5`); may be said several times
    #[arg(long, value_name = "WHAT", conflicts_with = "repeat")]
    pub(super) stop_at: Vec<Stop>,
    /// Replay so many times, and say the median times; runs that differ are an error
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..))]
    pub(super) repeat: u32,
    /// Digest and check the whole state after every event
    #[arg(long)]
    pub(super) paranoid: bool,
    /// Make the pixels too, and look at their invariants, as `verify` does, and `tui`; where a picture is asked for they are made anyway
    #[arg(long = "pixels")]
    pub(super) makes_pixels: bool,
    /// Write the report as JSON
    #[arg(long, value_name = "F", value_hint = ValueHint::FilePath)]
    pub(super) json: Option<Target>,
    /// Write the mesh, as it is in the end, as OBJ or PLY
    #[arg(long, value_name = "F", value_hint = ValueHint::FilePath)]
    pub(super) export_mesh: Option<PathBuf>,
    /// Write where the time went, as a Chrome trace
    #[arg(long, value_name = "F", value_hint = ValueHint::FilePath)]
    pub(super) trace: Option<Target>,
    /// Write a picture of the end, as PNG
    #[arg(long, value_name = "F", value_hint = ValueHint::FilePath)]
    pub(super) frame: Option<PathBuf>,
    #[command(flatten)]
    pub(super) viewpoint: Viewpoint,
    /// Draw over it: the mesh's edges (`wire`), its charts (`charts`), or whatever the last cut's report has to show, by its name or by the first word of it: `line`,
    /// `picks`, `gutter`, `painted`, `configurations`
    #[arg(long, value_name = "NAME", value_delimiter = ',', requires = "frame")]
    pub(super) overlay: Vec<String>,
    /// Mark elements in it: faces, edges, nodes, vertices, such as f12,e7,n3,v9
    #[arg(long, value_name = "IDS", value_delimiter = ',', requires = "frame")]
    pub(super) select: Vec<String>,
    /// Instead of the frame, a map as it is in the end
    #[arg(long, value_enum, value_name = "MAP", requires = "frame")]
    pub(super) map: Option<Map>,
    #[command(flatten)]
    pub(super) pixels: Pixels,
}

/// Where a picture is taken from, rather than from where the recording looks.
#[derive(Clone, Copy, Debug, Default, clap::Args)]
pub(super) struct Viewpoint {
    /// Look from another angle around the vertical axis, radians
    #[arg(long, value_name = "A", allow_negative_numbers = true, requires = "frame", conflicts_with = "map")]
    pub(super) azimuth: Option<f64>,
    /// Look from another angle from straight up, radians, 0 to π
    #[arg(long, value_name = "Z", allow_negative_numbers = true, requires = "frame", conflicts_with = "map")]
    pub(super) zenith: Option<f64>,
    /// Look from another distance to the target, model units
    #[arg(long, value_name = "D", allow_negative_numbers = true, requires = "frame", conflicts_with = "map")]
    pub(super) distance: Option<f64>,
}

/// How pictures reach a terminal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum ImageProtocol {
    /// By whatever the terminal is known to have
    Auto,
    /// By Kitty's graphics
    Kitty,
    /// As sixels
    Sixel,
    /// As iTerm2's inline images
    Iterm2,
    /// In characters of two colours, which every terminal shows
    Halfblocks,
    /// Not at all
    None,
}

/// What a screen lies on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Ground {
    /// Light text on a dark ground
    Dark,
    /// Dark text on a light ground
    Light,
}

/// Step through a recording in the terminal, and record new ones
#[derive(Debug, clap::Args)]
#[cfg_attr(feature = "tui", command(after_help = settings()))]
pub(super) struct Tui {
    /// The recording or script; or what to begin one on: a scene (.json), a mesh (OBJ, glTF, PLY) or builtin:NAME
    #[arg(value_name = "REC", value_hint = ValueHint::FilePath)]
    pub(super) recording: Option<PathBuf>,
    /// Who renders
    #[arg(long, value_enum, default_value_t, value_name = "WHO")]
    pub(super) renderer: Renderer,
    /// Compare it with its goldens at once
    #[arg(long, requires = "recording")]
    pub(super) compare: bool,
    /// Compare it with another run at once: the report of a replay, a recording or a script
    #[arg(long, value_name = "F", value_hint = ValueHint::FilePath, requires = "recording", conflicts_with = "compare")]
    pub(super) compare_with: Option<PathBuf>,
    /// Megabytes that going back may take, beside what undo and redo need
    #[arg(long, value_name = "MB", default_value_t = 256)]
    pub(super) budget: u32,
    /// The settings to use [default: config.toml in the user's folder of settings]
    #[arg(long, value_name = "F", value_hint = ValueHint::FilePath)]
    pub(super) config: Option<PathBuf>,
    /// Instead of taking the terminal, write what the screen shows: as text, or as a picture where F ends in .svg. The status is that
    /// of `verify` where something was compared, else that of `replay`
    #[arg(long, value_name = "F", value_hint = ValueHint::FilePath)]
    pub(super) screen: Option<Target>,
    /// Type these keys first, with blanks between them, such as `l l s shift-tab`
    #[arg(long, value_name = "KEYS", requires = "screen", default_value = "")]
    pub(super) keys: String,
    /// The screen's columns and rows
    #[arg(long, value_name = "CxR", requires = "screen", default_value = "120x40")]
    pub(super) size: Size,
    /// How pictures reach the terminal [default: the settings', or what the terminal is known to have]
    #[arg(long, value_enum, value_name = "HOW")]
    pub(super) image_protocol: Option<ImageProtocol>,
    /// Colours for a dark ground, or for a light one [default: the settings', or the terminal's]
    #[arg(long, value_enum, value_name = "GROUND")]
    pub(super) theme: Option<Ground>,
}

/// What can be set, in the help.
#[cfg(feature = "tui")]
fn settings() -> String {
    let example: String = crate::tui::config::EXAMPLE.lines().map(|line| format!("  {line}\n")).collect();
    format!("Settings:\n{example}\n`?` in the terminal shows every action with its keys and its name.")
}

/// A map to write.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Map {
    /// Colour, with the strength of scattering as alpha
    #[value(alias = "color")]
    Colour,
    /// Discoloration
    Discolor,
    /// Tangent-space normals
    Normal,
    /// Ambient occlusion
    Occlusion,
    /// Specular intensity and roughness
    Specular,
}

/// Render a scene
#[derive(Debug, clap::Args)]
pub(super) struct Render {
    /// A scene (.json), a mesh (OBJ, glTF, PLY) or builtin:NAME
    #[arg(value_hint = ValueHint::FilePath)]
    pub(super) scene: String,
    /// The picture to write, as PNG
    #[arg(short, long, value_name = "F", value_hint = ValueHint::FilePath)]
    pub(super) output: PathBuf,
    /// Its width and height in pixels
    #[arg(long, value_name = "WxH", default_value = "1280x720")]
    pub(super) size: Size,
    /// Angle around the vertical axis, radians
    #[arg(long, value_name = "A", allow_negative_numbers = true)]
    pub(super) azimuth: Option<f64>,
    /// Angle from straight up, radians, 0 to π
    #[arg(long, value_name = "Z")]
    pub(super) zenith: Option<f64>,
    /// Eye to target, model units
    #[arg(long, value_name = "D")]
    pub(super) distance: Option<f64>,
    /// Change a setting, such as shadows=false
    #[arg(long, value_name = "NAME=VALUE")]
    pub(super) set: Vec<Setting>,
    #[command(flatten)]
    pub(super) pixels: Pixels,
    #[command(flatten)]
    pub(super) json: Json,
}

/// Make a recording from its script
#[derive(Debug, clap::Args)]
pub(super) struct Pack {
    /// The script; its paths are relative to it
    #[arg(value_hint = ValueHint::FilePath)]
    pub(super) script: PathBuf,
    /// The recording to write
    #[arg(short, long, value_name = "REC", value_hint = ValueHint::FilePath)]
    pub(super) output: Target,
}

/// Write a recording's script
#[derive(Debug, clap::Args)]
pub(super) struct Unpack {
    /// The recording
    #[arg(value_name = "REC", value_hint = ValueHint::FilePath)]
    pub(super) recording: PathBuf,
    /// The script to write
    #[arg(short, long, value_name = "SCRIPT", default_value = "-", value_hint = ValueHint::FilePath)]
    pub(super) output: Target,
}

/// Say what is in a recording
#[derive(Debug, clap::Args)]
pub(super) struct Info {
    /// The recording
    #[arg(value_name = "REC", value_hint = ValueHint::FilePath)]
    pub(super) recording: PathBuf,
    #[command(flatten)]
    pub(super) json: Json,
}

/// Find the least of a recording that still breaks the same invariant
#[derive(Debug, clap::Args)]
pub(super) struct Reduce {
    /// The recording
    #[arg(value_name = "REC", value_hint = ValueHint::FilePath)]
    pub(super) recording: PathBuf,
    /// The recording to write
    #[arg(short, long, value_name = "OUT", value_hint = ValueHint::FilePath)]
    pub(super) output: Target,
}

/// Say where two runs part
#[derive(Debug, clap::Args)]
pub(super) struct Diff {
    /// What is expected: a recording, a script, or a report of `replay --json`
    #[arg(value_hint = ValueHint::FilePath)]
    pub(super) a: PathBuf,
    /// What is compared with it
    #[arg(value_hint = ValueHint::FilePath)]
    pub(super) b: PathBuf,
    #[command(flatten)]
    pub(super) json: Json,
}

/// Say what a mesh is, and what had to be repaired to read it
#[derive(Debug, clap::Args)]
pub(super) struct Check {
    /// A mesh (OBJ, glTF, PLY), a scene (.json) or builtin:NAME
    #[arg(value_hint = ValueHint::FilePath)]
    pub(super) mesh: String,
    #[command(flatten)]
    pub(super) json: Json,
}

/// Measure what cuts cost, and whether anything breaks
#[derive(Debug, clap::Args)]
pub(super) struct Measure {
    #[command(subcommand)]
    pub(super) what: Measured,
}

#[derive(Debug, Subcommand)]
pub(super) enum Measured {
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

/// What every measurement can be asked for.
#[derive(Debug, clap::Args)]
pub(super) struct MeasureOptions {
    /// Less of it
    #[arg(long)]
    pub(super) quick: bool,
    /// Write the figures as JSON
    #[arg(long, value_name = "F", value_hint = ValueHint::FilePath)]
    pub(super) json: Option<Target>,
}

/// An answer as JSON, for commands with little to say.
#[derive(Debug, clap::Args)]
pub(super) struct Json {
    /// Write the answer as JSON, to standard output unless a file is named
    #[arg(long = "json", value_name = "F", num_args = 0..=1, default_missing_value = "-", value_hint = ValueHint::FilePath)]
    pub(super) to: Option<Target>,
}

/// Print a JSON Schema
#[derive(Debug, clap::Args)]
pub(super) struct Schema {
    /// Of what
    pub(super) of: SchemaOf,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(super) enum SchemaOf {
    /// A recording's script
    Script,
    /// A scene
    Scene,
    /// The report of a replay
    Report,
}

/// Print completions for a shell
#[derive(Debug, clap::Args)]
pub(super) struct Completions {
    /// The shell
    pub(super) shell: clap_complete::Shell,
}

/// Print the manual page
#[derive(Debug, clap::Args)]
pub(super) struct Man {
    /// The page of a command, rather than of the program
    pub(super) command: Option<String>,
}
