//! A finished screen brought down to the colours that the terminal has.
//!
//! Themes come in every depth already; what is left is what names its colours itself, a picture of half blocks above all. With numbered or
//! sixteen colours each becomes the nearest one. Without colour a cell of a picture becomes a character as dark or light as its two halves
//! are on average, so that the picture still shows. Cells of a picture that goes by a protocol of its own are left alone.

use ratatui::buffer::{Buffer, Cell, CellDiffOption};
use ratatui::style::Color;

use super::colour;
use super::environment::Environment;
use super::theme::Base;

/// How many colours the terminal has.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Depth {
    /// None.
    None,
    /// The sixteen named ones.
    Sixteen,
    /// 256, by number.
    Numbered,
    /// Any.
    Full,
}

/// Terminals that show any colour, and do not always say so in `COLORTERM`, above all across ssh.
const FULL: [&str; 8] =
    ["direct", "truecolor", "kitty", "alacritty", "wezterm", "ghostty", "foot", "contour"];
/// Terminals of a single colour.
const PLAIN: [&str; 4] = ["dumb", "mono", "vt100", "vt220"];

impl Depth {
    /// What the environment says of the terminal; the user's wish for no colour comes first.
    pub fn of(environment: &Environment) -> Self {
        let is = |kinds: &[&str]| kinds.iter().any(|kind| environment.term.contains(kind));
        let says_full = matches!(environment.colorterm.as_str(), "truecolor" | "24bit");
        match () {
            () if !environment.no_color.is_empty() || is(&PLAIN) => Self::None,
            () if says_full || is(&FULL) => Self::Full,
            () if is(&["256color"]) => Self::Numbered,
            () => Self::Sixteen,
        }
    }
}

/// From nothing to full on a dark ground.
const RAMP: [&str; 10] = [" ", ".", ":", "-", "=", "+", "*", "#", "%", "@"];

/// Brings every cell down to the colours that there are.
pub fn lower(buffer: &mut Buffer, depth: Depth, base: Base) {
    if depth == Depth::Full {
        return;
    }
    for cell in buffer.content.iter_mut().filter(|cell| !is_picture_by_protocol(cell)) {
        match depth {
            Depth::None => without_colour(cell, base),
            Depth::Sixteen => recolour(cell, colour::nearest_named),
            _ => recolour(cell, colour::nearest_numbered),
        }
    }
}

/// Such cells hold escape sequences, or numbers instead of colours.
pub(super) fn is_picture_by_protocol(cell: &Cell) -> bool {
    matches!(cell.diff_option, CellDiffOption::Skip | CellDiffOption::ForcedWidth(_))
}

fn recolour(cell: &mut Cell, nearest: fn(colour::Rgb) -> Color) {
    for color in [&mut cell.fg, &mut cell.bg] {
        if let Color::Rgb(r, g, b) = *color {
            *color = nearest([r, g, b]);
        }
    }
}

fn without_colour(cell: &mut Cell, base: Base) {
    if let Some(luma) = picture(cell, base) {
        let light = usize::from(luma) * RAMP.len() / 256;
        let full = RAMP.len() - 1;
        cell.set_symbol(RAMP[if base == Base::Dark { light } else { full - light }]);
    }
    (cell.fg, cell.bg) = (Color::Reset, Color::Reset);
}

/// How bright a cell is that is part of a picture: blocks in colours that no role has here.
fn picture(cell: &Cell, base: Base) -> Option<u8> {
    let is_exact = |color: Color| matches!(color, Color::Rgb(..));
    let ground = if base == Base::Dark { 0 } else { u8::MAX };
    let luma = |color: Color| colour::rgb(color).map_or(ground, colour::luma);
    let (ink, paper) = (luma(cell.fg), luma(cell.bg));
    match cell.symbol() {
        "▀" | "▄" if is_exact(cell.fg) || is_exact(cell.bg) => Some(ink.midpoint(paper)),
        "█" if is_exact(cell.fg) => Some(ink),
        " " if is_exact(cell.bg) => Some(paper),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use std::num::NonZeroU16;

    use super::*;
    use ratatui::layout::Rect;
    use ratatui::style::Style;

    /// A grey ramp of half blocks.
    fn picture() -> Buffer {
        let mut buffer = Buffer::empty(Rect::new(0, 0, 10, 1));
        for x in 0..10u8 {
            let grey = Color::Rgb(x * 28, x * 28, x * 28);
            buffer[(u16::from(x), 0)].set_symbol("▀").set_fg(grey).set_bg(grey);
        }
        buffer
    }

    fn text(buffer: &Buffer) -> String {
        buffer.content.iter().map(Cell::symbol).collect()
    }

    #[test]
    fn the_users_wish_comes_before_what_the_terminal_says() {
        let depth = |no_color: &str, term: &str, colorterm: &str| {
            let [no_color, term, colorterm] = [no_color, term, colorterm].map(String::from);
            Depth::of(&Environment { no_color, term, colorterm, ..Environment::default() })
        };
        assert_eq!(depth("1", "xterm-256color", "truecolor"), Depth::None);
        assert_eq!(depth("", "xterm", "truecolor"), Depth::Full);
        assert_eq!(depth("", "xterm-kitty", ""), Depth::Full);
        assert_eq!(depth("", "tmux-256color", ""), Depth::Numbered);
        assert_eq!(depth("", "linux", ""), Depth::Sixteen);
        assert_eq!(depth("", "", ""), Depth::Sixteen);
        assert_eq!(depth("", "vt100", ""), Depth::None);
    }

    #[test]
    fn a_picture_without_colour_is_a_ramp_of_characters() {
        let [mut dark, mut light] = [picture(), picture()];
        lower(&mut dark, Depth::None, Base::Dark);
        lower(&mut light, Depth::None, Base::Light);
        assert_eq!(text(&dark), " .:-=+*#%@");
        assert_eq!(text(&light), "@%#*+=-:. ");
        assert!(dark.content.iter().all(|cell| (cell.fg, cell.bg) == (Color::Reset, Color::Reset)));
    }

    #[test]
    fn both_halves_count() {
        let mut buffer = Buffer::empty(Rect::new(0, 0, 1, 1));
        buffer[(0, 0)].set_symbol("▄").set_fg(Color::Rgb(255, 255, 255)).set_bg(Color::Rgb(0, 0, 0));
        lower(&mut buffer, Depth::None, Base::Dark);
        assert_eq!(text(&buffer), "=");
    }

    #[test]
    fn bars_and_words_stay_what_they_are() {
        let mut buffer = Buffer::empty(Rect::new(0, 0, 4, 1));
        buffer.set_string(0, 0, "█▌ x", Style::new().fg(Color::Red).bg(Color::Blue));
        lower(&mut buffer, Depth::None, Base::Dark);
        assert_eq!(text(&buffer), "█▌ x");
        buffer.set_string(3, 0, "x", Style::new().bg(Color::Rgb(9, 9, 9)));
        lower(&mut buffer, Depth::None, Base::Dark);
        assert_eq!(text(&buffer), "█▌ x");
        assert_eq!(buffer[(3, 0)].bg, Color::Reset);
    }

    #[test]
    fn fewer_colours_are_the_nearest_ones() {
        let colours = |depth| {
            let mut buffer = picture();
            lower(&mut buffer, depth, Base::Dark);
            assert_eq!(text(&buffer), "▀".repeat(10), "{depth:?}");
            [0, 5, 9].map(|x| buffer[(x, 0)].fg)
        };
        assert_eq!(colours(Depth::Sixteen), [Color::Black, Color::DarkGray, Color::White]);
        assert_eq!(colours(Depth::Numbered), [Color::Indexed(16), Color::Indexed(245), Color::Indexed(231)]);
        assert_eq!(colours(Depth::Full)[1], Color::Rgb(140, 140, 140));
    }

    #[test]
    fn a_picture_by_protocol_is_left_alone() {
        let mut buffer = picture();
        buffer[(3, 0)].set_diff_option(CellDiffOption::ForcedWidth(NonZeroU16::MIN));
        buffer[(4, 0)].set_diff_option(CellDiffOption::Skip);
        let before = [3, 4].map(|x| buffer[(x, 0)].clone());
        lower(&mut buffer, Depth::None, Base::Dark);
        assert_eq!([3, 4].map(|x| buffer[(x, 0)].clone()), before);
    }
}
