//! The program: parse, dispatch, exit code.

use std::process::ExitCode;

use lancet::cli::{Console, run};

fn main() -> ExitCode {
    run(std::env::args_os(), &mut Console::standard()).into()
}
