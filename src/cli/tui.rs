//! `lancet tui`: the terminal, where there is one, or what it would show.

#[cfg(feature = "tui")]
use super::Status;
use super::args::Tui;
use super::failure::Failure;
#[cfg(feature = "tui")]
use super::place;
use super::{Console, Done};

#[cfg(feature = "tui")]
pub(super) fn run(typed: &Tui, console: &mut Console<'_>) -> Done {
    use super::args::{Ground, ImageProtocol as Asked};
    use super::pixels;
    use crate::tui::config::Config;
    use crate::tui::image::protocol::ImageProtocol;
    use crate::tui::terminal::Terminal;
    use crate::tui::theme::Base;
    use crate::tui::{self, Drafts, Start};

    let mut config = Config::load(typed.config.as_deref(), &tui::actions()).map_err(Failure::new)?;
    let base = typed.theme.map(|ground| match ground {
        Ground::Dark => Base::Dark,
        Ground::Light => Base::Light,
    });
    config.theme.base = base.or(config.theme.base);
    let protocol = typed.image_protocol.map(|asked| match asked {
        Asked::Auto => ImageProtocol::Auto,
        Asked::Kitty => ImageProtocol::Kitty,
        Asked::Sixel => ImageProtocol::Sixel,
        Asked::Iterm2 => ImageProtocol::Iterm2,
        Asked::Halfblocks => ImageProtocol::Halfblocks,
        Asked::None => ImageProtocol::None,
    });
    config.image_protocol = protocol.unwrap_or(config.image_protocol);
    let start = Start {
        recording: typed.recording.clone(),
        renderer: pixels::choice(typed.renderer),
        compare: compare(typed),
        budget_bytes: (typed.budget as usize) << 20,
        // What is written depends on nothing that was left behind, and leaves nothing behind.
        drafts: if typed.screen.is_some() { Drafts::default() } else { Drafts::from_environment() },
        config,
    };
    if let Some(target) = &typed.screen {
        return screen(typed, &start, target, console);
    }
    if !Terminal::is_there() {
        return Err(Failure::new(format_args!("this is not a terminal: {INSTEAD}")));
    }
    tui::run(start)?;
    Ok(Status::Verified)
}

/// Writes what the screen shows.
#[cfg(feature = "tui")]
fn screen(
    typed: &Tui,
    start: &crate::tui::Start,
    target: &super::args::Target,
    console: &mut Console<'_>,
) -> Done {
    use std::io::Write;

    use super::args::Target;
    use crate::assets;
    use crate::tui::environment::Environment;
    use crate::tui::lower::Depth;
    use crate::tui::theme::Theme;
    use crate::tui::{Stage, screen};

    // What was typed is looked at before anything is opened, which may take long.
    let keys = Stage::keys(&typed.keys).map_err(|why| Failure::new(format_args!("--keys: {why}")))?;
    if let (Some(recording), Target::File(path)) = (&typed.recording, target) {
        place::require_other(recording, path)?;
    }
    let [width, height] = typed.size.0.map(|side| u16::try_from(side).unwrap_or(u16::MAX));
    if u32::from(width) * u32::from(height) > MOST_CELLS {
        return Err(Failure::new(format_args!("--size {width}x{height}: at most {MOST_CELLS} cells")));
    }
    let is_picture = matches!(target, Target::File(path) if path.extension().is_some_and(|ext| ext == "svg"));
    let chosen = Theme::chosen(&start.config.theme, &Environment::read());
    // A picture shows every colour, whatever this terminal can.
    let theme = if is_picture { Theme::new(chosen.base(), Depth::Full) } else { chosen };
    let mut stage = Stage::open(start, theme.clone(), [width, height], false);
    keys.into_iter().for_each(|key| stage.press_key(key));
    let buffer = stage.screen();
    match target {
        Target::File(path) if is_picture => {
            assets::write_output(path, screen::to_svg(&buffer, &theme).as_bytes())?
        }
        Target::File(path) => assets::write_output(path, screen::to_text(&buffer).as_bytes())?,
        Target::Stdout => console.out.write_all(screen::to_text(&buffer).as_bytes())?,
    }
    status(&stage)
}

/// As `verify` and `replay` end: what could not be opened or compared is a failure, what differs or broke is none of the program's.
#[cfg(feature = "tui")]
fn status(stage: &crate::tui::Stage) -> Done {
    match (stage.failure(), stage.compared()) {
        (Some(why), _) | (None, Some(Err(why))) => Err(Failure::new(why)),
        (None, Some(Ok(false))) => Ok(Status::Diverged),
        (None, _) if stage.has_finding() => Ok(Status::Diverged),
        (None, _) => Ok(Status::Verified),
    }
}

/// No screen has more.
#[cfg(feature = "tui")]
const MOST_CELLS: u32 = 1 << 20;

/// What to compare it with at once.
#[cfg(feature = "tui")]
fn compare(typed: &Tui) -> Option<crate::tui::With> {
    use crate::tui::With;
    let run = typed.compare_with.clone().map(With::Run);
    run.or_else(|| typed.compare.then_some(With::Goldens))
}

#[cfg(not(feature = "tui"))]
pub(super) fn run(_: &Tui, _: &mut Console<'_>) -> Done {
    Err(Failure::new(format_args!("this program was built without its terminal: {INSTEAD}")))
}

/// What does the same elsewhere.
const INSTEAD: &str =
    "`lancet replay REC --json -` says the same, `lancet replay REC --frame F.png` shows it";
