//! `lancet man`: the manual page of the program, or of one of its commands.

use std::io::Write;

use clap::CommandFactory;

use super::args::{Args, Man};
use super::failure::Failure;
use super::{Console, Done, Status};

pub(super) fn run(typed: &Man, console: &mut Console<'_>) -> Done {
    let mut page = Vec::new();
    clap_mangen::Man::new(command(typed.command.as_deref())?).render(&mut page)?;
    console.out.write_all(&page)?;
    Ok(Status::Verified)
}

fn command(name: Option<&str>) -> Result<clap::Command, Failure> {
    let mut program = Args::command();
    program.build();
    let Some(name) = name else { return Ok(program) };
    let found = program.find_subcommand(name).cloned();
    found.ok_or_else(|| Failure::new(format_args!("there is no command `{name}`")))
}
