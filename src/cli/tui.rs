//! `lancet tui`: the terminal, where there is one.

use super::args::Tui;
use super::failure::Failure;
use super::{Done, Status};

#[cfg(feature = "tui")]
pub(super) fn run(typed: &Tui) -> Done {
    use super::pixels;
    use crate::tui::config::Config;
    use crate::tui::terminal::Terminal;
    use crate::tui::{self, Start};

    if !Terminal::is_there() {
        return Err(Failure::new(format_args!("this is not a terminal: {INSTEAD}")));
    }
    let config = Config::load(typed.config.as_deref(), &tui::action_names()).map_err(Failure::new)?;
    tui::run(Start {
        recording: typed.recording.clone(),
        renderer: pixels::choice(typed.renderer),
        compare: compare(typed),
        budget_bytes: (typed.budget as usize) << 20,
        config,
    })?;
    Ok(Status::Verified)
}

/// What to compare it with at once.
#[cfg(feature = "tui")]
fn compare(typed: &Tui) -> Option<crate::tui::With> {
    use crate::tui::With;
    let run = typed.compare_with.clone().map(With::Run);
    run.or_else(|| typed.compare.then_some(With::Goldens))
}

#[cfg(not(feature = "tui"))]
pub(super) fn run(_: &Tui) -> Done {
    Err(Failure::new(format_args!("this program was built without its terminal: {INSTEAD}")))
}

/// What does the same elsewhere.
const INSTEAD: &str =
    "`lancet replay REC --json -` says the same, `lancet replay REC --frame F.png` shows it";
