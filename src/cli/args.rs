//! What the user typed: the one source of the parser, the help, the completions and the man page.

mod measure;
mod nightly;
mod tui;
mod values;
mod verify;

use std::path::PathBuf;

use clap::{Parser, Subcommand, ValueEnum, ValueHint};

use crate::report::Stop;
pub(super) use measure::{Accuracy, Measure, MeasureOptions, Measured};
pub(super) use nightly::Nightly;
pub(super) use tui::Tui;
#[cfg(feature = "tui")]
pub(super) use tui::{Ground, ImageProtocol};
pub(super) use values::{Setting, Size, Target, Until};
pub(super) use verify::{Bless, Merge, Reports, Verify};

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
