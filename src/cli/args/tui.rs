//! What `tui` can be asked for.

use std::path::PathBuf;

use clap::{ValueEnum, ValueHint};

use super::{Renderer, Size, Target};

/// How pictures reach a terminal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(in crate::cli) enum ImageProtocol {
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
pub(in crate::cli) enum Ground {
    /// Light text on a dark ground
    Dark,
    /// Dark text on a light ground
    Light,
}

/// Step through a recording in the terminal, and record new ones
#[derive(Debug, clap::Args)]
#[cfg_attr(feature = "tui", command(after_help = settings()))]
pub(in crate::cli) struct Tui {
    /// The recording or script; or what to begin one on: a scene (.json), a mesh (OBJ, glTF, PLY) or builtin:NAME
    #[arg(value_name = "REC", value_hint = ValueHint::FilePath)]
    pub(in crate::cli) recording: Option<PathBuf>,
    /// Who renders
    #[arg(long, value_enum, default_value_t, value_name = "WHO")]
    pub(in crate::cli) renderer: Renderer,
    /// Compare it with its goldens at once
    #[arg(long, requires = "recording")]
    pub(in crate::cli) compare: bool,
    /// Compare it with another run at once: the report of a replay, a recording or a script
    #[arg(long, value_name = "F", value_hint = ValueHint::FilePath, requires = "recording", conflicts_with = "compare")]
    pub(in crate::cli) compare_with: Option<PathBuf>,
    /// Megabytes that going back may take, beside what undo and redo need
    #[arg(long, value_name = "MB", default_value_t = 256)]
    pub(in crate::cli) budget: u32,
    /// The settings to use [default: config.toml in the user's folder of settings]
    #[arg(long, value_name = "F", value_hint = ValueHint::FilePath)]
    pub(in crate::cli) config: Option<PathBuf>,
    /// Instead of taking the terminal, write what the screen shows: as text, or as a picture where F ends in .svg. The status is that
    /// of `verify` where something was compared, else that of `replay`
    #[arg(long, value_name = "F", value_hint = ValueHint::FilePath)]
    pub(in crate::cli) screen: Option<Target>,
    /// Type these keys first, with blanks between them, such as `l l s shift-tab`
    #[arg(long, value_name = "KEYS", requires = "screen", default_value = "")]
    pub(in crate::cli) keys: String,
    /// The screen's columns and rows
    #[arg(long, value_name = "CxR", requires = "screen", default_value = "120x40")]
    pub(in crate::cli) size: Size,
    /// How pictures reach the terminal [default: the settings', or what the terminal is known to have]
    #[arg(long, value_enum, value_name = "HOW")]
    pub(in crate::cli) image_protocol: Option<ImageProtocol>,
    /// Colours for a dark ground, or for a light one [default: the settings', or the terminal's]
    #[arg(long, value_enum, value_name = "GROUND")]
    pub(in crate::cli) theme: Option<Ground>,
}

/// What can be set, in the help.
#[cfg(feature = "tui")]
fn settings() -> String {
    let example: String = crate::tui::config::EXAMPLE.lines().map(|line| format!("  {line}\n")).collect();
    format!("Settings:\n{example}\n`?` in the terminal shows every action with its keys and its name.")
}
