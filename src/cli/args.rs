//! What the user typed: the one source of the parser, the help, the completions and the man page.

use std::ffi::OsString;
use std::path::PathBuf;

use clap::{Parser, Subcommand, ValueEnum, ValueHint};

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
    Pack(Pack),
    Unpack(Unpack),
    Info(Info),
    Check(Check),
    /// Say what the program and the machine are
    Doctor,
    Schema(Schema),
    Completions(Completions),
    Man(Man),
}

/// Where an answer goes: a file, or `-` for standard output.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Target {
    Stdout,
    File(PathBuf),
}

impl From<OsString> for Target {
    fn from(typed: OsString) -> Self {
        if typed == "-" { Self::Stdout } else { Self::File(typed.into()) }
    }
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
