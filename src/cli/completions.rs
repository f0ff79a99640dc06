//! `lancet completions`: what a shell needs to complete commands and options.

use std::io::Write;

use clap::CommandFactory;

use super::args::{Args, Completions};
use super::{Console, Done, Status};

pub(super) fn run(typed: &Completions, console: &mut Console<'_>) -> Done {
    let mut command = Args::command();
    // To memory first: clap_complete panics when it cannot write.
    let mut script = Vec::new();
    clap_complete::generate(typed.shell, &mut command, "lancet", &mut script);
    console.out.write_all(&script)?;
    Ok(Status::Verified)
}
