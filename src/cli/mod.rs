//! The command line.
//!
//! In two steps, as ripgrep does it: `args` is what the user typed, and the one source of parser, help, completions and man page; a file for
//! each command says what it means and does it. Commands show what the rooms report: they compute nothing, and know no engine by name.
//!
//! A command writes its answer to standard output, everything else to standard error, both through [`Console`]: so broken pipes, colour and
//! the progress line are looked after in one place, and a test can read what was written.

mod args;
mod bless;
mod check;
mod completions;
mod console;
mod diff;
mod doctor;
mod failure;
mod info;
mod json;
mod man;
mod measure;
mod merge;
mod nightly;
mod orbit;
mod pack;
mod picture;
mod pixels;
mod place;
mod reduce;
mod render;
mod replay;
mod scenes;
mod schema;
mod show;
mod table;
#[cfg(test)]
mod tests;
mod tui;
mod unpack;
mod verify;

use std::ffi::OsString;
use std::io::Write;
use std::process::ExitCode;

use clap::Parser;

use args::{Args, Command};
pub use console::Console;
use failure::Failure;

/// How a command ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// All is as it should be.
    Verified,
    /// Something diverged, or an invariant broke.
    Diverged,
    /// Bad input, or it could not run.
    Failed,
}

impl From<Status> for ExitCode {
    fn from(status: Status) -> Self {
        match status {
            Status::Verified => Self::from(0),
            Status::Diverged => Self::from(1),
            Status::Failed => Self::from(2),
        }
    }
}

type Done = Result<Status, Failure>;

/// Runs the program with its arguments, the first of which is its name.
pub fn run(arguments: impl IntoIterator<Item = OsString>, console: &mut Console<'_>) -> Status {
    crate::assets::begin_outputs();
    match Args::try_parse_from(arguments) {
        Ok(args) => finish(dispatch(args.command, console), console),
        Err(error) => explain(&error, console),
    }
}

/// Whether these arguments, of which the first is the program's name, are some that it takes. An error says what is wrong.
#[cfg(all(test, feature = "tui"))]
pub(crate) fn parses(arguments: &[String]) -> Result<(), String> {
    Args::try_parse_from(arguments).map(drop).map_err(|error| error.to_string())
}

/// The long flags of a command.
#[cfg(all(test, feature = "tui"))]
pub(crate) fn flags(command: &str) -> Vec<String> {
    use clap::CommandFactory;
    let all = Args::command();
    let command = all.find_subcommand(command).expect("a command");
    command.get_arguments().filter_map(|argument| argument.get_long()).map(str::to_owned).collect()
}

fn dispatch(command: Command, console: &mut Console<'_>) -> Done {
    match command {
        Command::Verify(typed) => verify::run(&typed, console),
        Command::Merge(typed) => merge::run(&typed, console),
        Command::Bless(typed) => bless::run(&typed, console),
        Command::Replay(typed) => replay::run(&typed, console),
        Command::Tui(typed) => tui::run(&typed, console),
        Command::Render(typed) => render::run(&typed, console),
        Command::Pack(typed) => pack::run(&typed, console),
        Command::Unpack(typed) => unpack::run(&typed, console),
        Command::Info(typed) => info::run(&typed, console),
        Command::Reduce(typed) => reduce::run(&typed, console),
        Command::Diff(typed) => diff::run(&typed, console),
        Command::Check(typed) => check::run(&typed, console),
        Command::Measure(typed) => measure::run(&typed, console),
        Command::Nightly(typed) => nightly::run(&typed, console),
        Command::Scenes => scenes::run(console),
        Command::Doctor => doctor::run(console),
        Command::Schema(typed) => schema::run(&typed, console),
        Command::Completions(typed) => completions::run(&typed, console),
        Command::Man(typed) => man::run(&typed, console),
    }
}

/// Writes the answer out before the complaint.
fn finish(done: Done, console: &mut Console<'_>) -> Status {
    let written = console.out.flush().map_err(Failure::from);
    done.and_then(|status| written.map(|()| status)).unwrap_or_else(|failure| {
        console.err.error(&failure);
        Status::Failed
    })
}

/// Help and version are answers; everything else that clap says is a complaint.
fn explain(error: &clap::Error, console: &mut Console<'_>) -> Status {
    let (channel, status) = match error.use_stderr() {
        true => (&mut console.err, Status::Failed),
        false => (&mut console.out, Status::Verified),
    };
    channel.styled(&error.render());
    status
}
