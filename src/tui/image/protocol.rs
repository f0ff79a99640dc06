//! How pictures reach a terminal, and how many pixels a pane has.
//!
//! **Nobody asks the terminal.** Its answers come through the keyboard, after a time that nobody knows, between the user's keys; a reader that gives up
//! leaves the answer to be typed, or eats keys. What the environment and the kernel know at once is enough: where neither tells for certain, and
//! within a multiplexer, half blocks are right everywhere, and `--image-protocol` says better.

use std::fmt;
use std::str::FromStr;

use crossterm::terminal::WindowSize;
use ratatui::layout::Size;

use crate::tui::environment::Environment;

/// What somebody asks for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ImageProtocol {
    /// Whatever the terminal is known to have.
    #[default]
    Auto,
    /// Kitty's graphics, with placeholders of Unicode.
    Kitty,
    /// Sixels.
    Sixel,
    /// iTerm2's inline images.
    Iterm2,
    /// Characters of two colours.
    Halfblocks,
    /// No pictures.
    None,
}

impl ImageProtocol {
    /// All of them.
    pub const ALL: [Self; 6] =
        [Self::Auto, Self::Kitty, Self::Sixel, Self::Iterm2, Self::Halfblocks, Self::None];

    /// As it is typed.
    pub fn name(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::Kitty => "kitty",
            Self::Sixel => "sixel",
            Self::Iterm2 => "iterm2",
            Self::Halfblocks => "halfblocks",
            Self::None => "none",
        }
    }
}

impl fmt::Display for ImageProtocol {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for ImageProtocol {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let known = || Self::ALL.map(Self::name).join(", ");
        let found = Self::ALL.into_iter().find(|protocol| protocol.name() == text);
        found.ok_or_else(|| format!("there is no such protocol; there are {}", known()))
    }
}

/// What carries pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Kitty's graphics.
    Kitty,
    /// Sixels.
    Sixel,
    /// iTerm2's inline images.
    Iterm2,
    /// Characters of two colours.
    Halfblocks,
    /// Nothing does.
    None,
}

impl Kind {
    /// Whether it is pixels of its own, which nothing can lie over.
    pub fn is_graphics(self) -> bool {
        !matches!(self, Self::Halfblocks | Self::None)
    }
}

/// How pictures reach the terminal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Medium {
    /// What carries them.
    pub kind: Kind,
    /// Pixels of a cell, across and down.
    pub cell: [u32; 2],
}

impl Default for Medium {
    fn default() -> Self {
        Self::BLOCKS
    }
}

/// The graphics that a terminal is known to have.
fn graphics(environment: &Environment) -> Option<Kind> {
    let Environment { term, program, kitty, wezterm, multiplexer, .. } = environment;
    let term = |names: &[&str]| names.iter().any(|name| term.starts_with(name));
    let program = |names: &[&str]| names.iter().any(|name| program.eq_ignore_ascii_case(name));
    if *multiplexer || term(&["tmux", "screen"]) || program(&["tmux"]) {
        // Its own graphics, if any, are not those of the terminal around it, whose variables are still set.
        None
    } else if program(&["WezTerm", "iTerm.app", "mintty", "rio"]) || *wezterm {
        Some(Kind::Iterm2)
    } else if term(&["xterm-kitty", "xterm-ghostty"]) || program(&["ghostty"]) || *kitty {
        Some(Kind::Kitty)
    } else if term(&["foot", "mlterm", "contour"]) {
        Some(Kind::Sixel)
    } else {
        None
    }
}

/// The largest picture that is worth rendering for a terminal.
pub const LARGEST: [u32; 2] = [1920, 1080];

/// Pixels that are rendered for one of a half block, in both directions: there is no other anti-aliasing.
const SUPERSAMPLED: u32 = 3;

/// A cell's pixels where a protocol was asked for and nobody says how large the font is.
const USUAL_CELL: [u32; 2] = [10, 20];

impl Medium {
    /// Half blocks, for tests, for screens that are printed, and until more is known.
    pub const BLOCKS: Self = Self { kind: Kind::Halfblocks, cell: [1, 2] };

    /// What is asked for; for `auto` what the terminal is known to have, if the font's size is known too.
    pub fn choose(asked: ImageProtocol, environment: &Environment, window: Option<&WindowSize>) -> Self {
        let font = window.and_then(font);
        let kind = match asked {
            ImageProtocol::Auto => {
                graphics(environment).filter(|_| font.is_some()).unwrap_or(Kind::Halfblocks)
            }
            ImageProtocol::Kitty => Kind::Kitty,
            ImageProtocol::Sixel => Kind::Sixel,
            ImageProtocol::Iterm2 => Kind::Iterm2,
            ImageProtocol::Halfblocks => Kind::Halfblocks,
            ImageProtocol::None => Kind::None,
        };
        let cell = match kind {
            Kind::Halfblocks | Kind::None => Self::BLOCKS.cell,
            _ => font.unwrap_or(USUAL_CELL),
        };
        Self { kind, cell }
    }

    /// The pixels of a pane.
    pub fn pixels(&self, area: Size) -> [u32; 2] {
        [u32::from(area.width) * self.cell[0], u32::from(area.height) * self.cell[1]]
    }

    /// The middle of a cell of a pane, in the pane's pixels.
    pub fn middle(&self, [column, row]: [u16; 2]) -> [f64; 2] {
        let middle = |cell: u16, side: u32| (f64::from(cell) + 0.5) * f64::from(side);
        [middle(column, self.cell[0]), middle(row, self.cell[1])]
    }

    /// The box of pixels that is worth rendering for a pane that is zoomed.
    pub fn box_size(&self, area: Size, zoom: f64) -> [u32; 2] {
        let more = match self.kind {
            Kind::None => return [0; 2],
            Kind::Halfblocks => f64::from(SUPERSAMPLED) * zoom,
            _ => zoom,
        };
        let pixels = self.pixels(area);
        // Casts end at the type's bounds.
        [0, 1].map(|k| ((f64::from(pixels[k]) * more).ceil() as u32).clamp(1, LARGEST[k]))
    }
}

/// The pixels of a cell, if the kernel knows.
fn font(window: &WindowSize) -> Option<[u32; 2]> {
    let side = |pixels: u16, cells: u16| pixels.checked_div(cells).filter(|side| (2..=256).contains(side));
    Some([side(window.width, window.columns)?.into(), side(window.height, window.rows)?.into()])
}

#[cfg(test)]
mod tests {
    use super::*;

    const WINDOW: WindowSize = WindowSize { rows: 24, columns: 80, width: 800, height: 480 };

    fn environment(variables: &[(&str, &str)]) -> Environment {
        let value = |(_, value): &(&str, &str)| value.to_string();
        Environment::of(|name| variables.iter().find(|(known, _)| *known == name).map(value))
    }

    fn auto(variables: &[(&str, &str)]) -> Kind {
        Medium::choose(ImageProtocol::Auto, &environment(variables), Some(&WINDOW)).kind
    }

    #[test]
    fn what_is_typed_is_what_is_shown() {
        for protocol in ImageProtocol::ALL {
            assert_eq!(protocol.to_string().parse(), Ok(protocol));
        }
        let error = "jpeg".parse::<ImageProtocol>().expect_err("no protocol");
        assert!(error.contains("auto, kitty, sixel, iterm2, halfblocks, none"), "{error}");
    }

    #[test]
    fn auto_takes_what_the_terminal_is_known_to_have() {
        for (variables, kind) in [
            (&[("TERM", "xterm-kitty")][..], Kind::Kitty),
            (&[("TERM", "xterm-256color"), ("KITTY_WINDOW_ID", "1")], Kind::Kitty),
            (&[("TERM", "xterm-ghostty")], Kind::Kitty),
            (&[("TERM_PROGRAM", "iTerm.app")], Kind::Iterm2),
            (&[("TERM", "xterm-256color"), ("WEZTERM_PANE", "0")], Kind::Iterm2),
            (&[("TERM", "foot-extra")], Kind::Sixel),
            (&[("TERM", "xterm-256color")], Kind::Halfblocks),
            (&[("TERM", "linux"), ("KITTY_WINDOW_ID", "")], Kind::Halfblocks),
            (&[], Kind::Halfblocks),
        ] {
            assert_eq!(auto(variables), kind, "{variables:?}");
        }
    }

    #[test]
    fn within_a_multiplexer_or_without_a_fonts_size_there_are_half_blocks() {
        assert_eq!(auto(&[("TERM", "xterm-kitty"), ("TMUX", "/tmp/tmux-0/default,1,0")]), Kind::Halfblocks);
        assert_eq!(auto(&[("TERM", "tmux-256color"), ("KITTY_WINDOW_ID", "1")]), Kind::Halfblocks);
        let kitty = environment(&[("TERM", "xterm-kitty")]);
        let none = WindowSize { width: 0, height: 0, ..WINDOW };
        let odd = WindowSize { rows: 0, columns: 0, ..WINDOW };
        for window in [None, Some(&none), Some(&odd)] {
            assert_eq!(Medium::choose(ImageProtocol::Auto, &kitty, window).kind, Kind::Halfblocks);
            let asked = Medium::choose(ImageProtocol::Sixel, &kitty, window);
            assert_eq!((asked.kind, asked.cell), (Kind::Sixel, USUAL_CELL), "what was asked for is done");
        }
    }

    #[test]
    fn a_pane_has_the_pixels_that_it_can_show() {
        let font = Medium::choose(ImageProtocol::Kitty, &Environment::default(), Some(&WINDOW));
        let area = Size::new(40, 12);
        assert_eq!(font.pixels(area), [400, 240]);
        assert_eq!(font.box_size(area, 1.0), [400, 240]);
        assert_eq!(font.middle([3, 0]), [35.0, 10.0]);
        let blocks = Medium::BLOCKS;
        assert_eq!(blocks.pixels(area), [40, 24]);
        assert_eq!(blocks.box_size(area, 1.0), [120, 72]);
        assert_eq!(blocks.box_size(area, 2.0), [240, 144]);
        assert_eq!(blocks.middle([3, 0]), [3.5, 1.0]);
        assert_eq!(font.box_size(Size::new(500, 300), 64.0), LARGEST);
        assert_eq!(font.box_size(Size::new(0, 0), f64::NAN), [1, 1]);
        let none = Medium::choose(ImageProtocol::None, &Environment::default(), Some(&WINDOW));
        assert_eq!(none.box_size(area, 1.0), [0, 0]);
    }
}
