//! What things look like: a pane names a role, and the theme says its style.
//!
//! Each role has a style for dark and light grounds with all colours, the same with the sixteen, and one without colour; they are written
//! as a user writes them in `config.toml` (`bold white on blue`), in one table. Hues are those of Okabe and Ito ("Color Universal Design", 2008),
//! which people of every kind of colour vision tell apart, darkened for light grounds until they read well. Nothing is said by colour alone:
//! what is good, bad or to be noticed also has a mark ([`Role::mark`]). The ground itself stays the terminal's own.

use std::fmt;

use ratatui::buffer::Buffer;
use ratatui::style::{Color, Modifier, Style};

use super::colour::Rgb;
use super::environment::Environment;
use super::lower::{self, Depth};

/// What a piece of the screen is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Role {
    /// Ordinary text.
    Text,
    /// Text of less weight: units, what was skipped.
    Faint,
    /// A heading.
    Title,
    /// The border of a pane.
    Border,
    /// The border of the pane that has the keys.
    Focus,
    /// A value to notice.
    Accent,
    /// The name of a key.
    Key,
    /// An invariant that holds, a cut that was applied.
    Good,
    /// An invariant that is broken, a divergence, an error.
    Bad,
    /// A rejection, a warning.
    Warn,
    /// The selected row of the pane that has the keys.
    Selected,
    /// The selected row of any other pane.
    Idle,
    /// What is selected somewhere else, wherever it appears.
    Marked,
    /// What a search found.
    Match,
    /// The full part of a bar.
    Bar,
    /// The empty part of a bar.
    Track,
    /// The status line.
    Status,
}

/// A role, its name in `config.toml`, its mark, and its styles: dark and light with all colours, dark and light with sixteen, without any.
type Row = (Role, &'static str, &'static str, [&'static str; 5]);

#[rustfmt::skip]
const TABLE: [Row; 17] = [
    (Role::Text,     "text",     "",  ["", "", "", "", ""]),
    (Role::Faint,    "faint",    "·", ["#8a949e", "#5f6a75", "darkgray", "darkgray", "dim"]),
    (Role::Title,    "title",    "",  ["bold", "bold", "bold", "bold", "bold"]),
    (Role::Border,   "border",   "",  ["#66717c", "#7d8791", "darkgray", "darkgray", "dim"]),
    (Role::Focus,    "focus",    "",  ["bold #56b4e9", "bold #0072b2", "bold cyan", "bold blue", "bold"]),
    (Role::Accent,   "accent",   "",  ["#56b4e9", "#0072b2", "cyan", "blue", "bold"]),
    (Role::Key,      "key",      "",  ["bold #f0e442", "bold #7a5c00", "bold yellow", "bold blue", "bold"]),
    (Role::Good,     "good",     "✓", ["#1fb58a", "#00785a", "green", "green", ""]),
    (Role::Bad,      "bad",      "✗", ["bold #ee6a1f", "bold #b34700", "bold lightred", "bold red", "bold underline"]),
    (Role::Warn,     "warn",     "!", ["#e69f00", "#8a5e00", "yellow", "magenta", "underline"]),
    (Role::Selected, "selected", "▸", ["bold #ffffff on #264f78", "bold #000000 on #b6d7f2", "bold white on blue", "bold black on cyan", "reverse"]),
    (Role::Idle,     "idle",     "▸", ["#e1e6eb on #2f3842", "#1b2128 on #dde3e9", "white on darkgray", "black on gray", "underline"]),
    (Role::Marked,   "marked",   "◆", ["bold #cc79a7", "bold #9c3f72", "bold magenta", "bold magenta", "bold underline"]),
    (Role::Match,    "match",    "",  ["#000000 on #f0e442", "#000000 on #f0e442", "black on yellow", "black on yellow", "reverse"]),
    (Role::Bar,      "bar",      "",  ["#56b4e9", "#0072b2", "cyan", "blue", ""]),
    (Role::Track,    "track",    "",  ["#3a434d", "#c9d1d8", "darkgray", "gray", "dim"]),
    (Role::Status,   "status",   "",  ["#d0d7de on #1f272f", "#1b2128 on #e6ebf0", "", "", ""]),
];

impl Role {
    /// Every role, in the order of the table.
    pub fn all() -> impl Iterator<Item = Self> {
        TABLE.iter().map(|row| row.0)
    }

    /// Its name in `config.toml`.
    pub fn name(self) -> &'static str {
        TABLE[self as usize].1
    }

    /// The role of a name.
    pub fn named(name: &str) -> Option<Self> {
        Self::all().find(|role| role.name() == name)
    }

    /// The sign that says the same as its colour; empty for roles that say nothing.
    pub fn mark(self) -> &'static str {
        TABLE[self as usize].2
    }
}

/// What the screen lies on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Base {
    /// Light text on a dark ground.
    #[default]
    Dark,
    /// Dark text on a light ground.
    Light,
}

impl Base {
    /// What the terminal says it has (`COLORFGBG`); dark where it says nothing.
    pub fn of(environment: &Environment) -> Self {
        let ground = environment.colorfgbg.rsplit(';').next().and_then(|n| n.parse::<u8>().ok());
        // Of the sixteen, 7 and 9 to 15 are light; 8 is a dark grey.
        if matches!(ground, Some(7 | 9..=15)) { Self::Light } else { Self::Dark }
    }
}

/// What a user chose.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Choice {
    /// The ground; `None` to ask the terminal.
    pub base: Option<Base>,
    /// Roles that look otherwise.
    pub roles: Vec<(Role, Style)>,
}

/// The style of every role.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Theme {
    base: Base,
    depth: Depth,
    styles: [Style; TABLE.len()],
}

impl Default for Theme {
    fn default() -> Self {
        Self::new(Base::Dark, Depth::Full)
    }
}

impl Theme {
    /// The theme of a ground, with the colours that there are.
    pub fn new(base: Base, depth: Depth) -> Self {
        let column = match (depth, base) {
            (Depth::Full | Depth::Numbered, Base::Dark) => 0,
            (Depth::Full | Depth::Numbered, Base::Light) => 1,
            (Depth::Sixteen, Base::Dark) => 2,
            (Depth::Sixteen, Base::Light) => 3,
            (Depth::None, _) => 4,
        };
        // A test reads every style of the table.
        let styles = TABLE.map(|(.., styles)| style(styles[column]).unwrap_or_default());
        Self { base, depth, styles }
    }

    /// What was chosen, in what the terminal can show.
    pub fn chosen(choice: &Choice, environment: &Environment) -> Self {
        let base = choice.base.unwrap_or_else(|| Base::of(environment));
        let mut theme = Self::new(base, Depth::of(environment));
        // Without colour, a style that was thought of with colours may say nothing.
        if theme.depth != Depth::None {
            choice.roles.iter().for_each(|(role, style)| theme.styles[*role as usize] = *style);
        }
        theme
    }

    /// The style of a role.
    pub fn style(&self, role: Role) -> Style {
        self.styles[role as usize]
    }

    /// What the screen lies on.
    pub fn base(&self) -> Base {
        self.base
    }

    /// How many colours there are.
    pub fn depth(&self) -> Depth {
        self.depth
    }

    /// The ground's colour in a picture of the screen.
    pub fn ground(&self) -> Rgb {
        match self.base {
            Base::Dark => [0x10, 0x14, 0x18],
            Base::Light => [0xfb, 0xfc, 0xfd],
        }
    }

    /// The colour of ordinary text in a picture of the screen.
    pub fn ink(&self) -> Rgb {
        match self.base {
            Base::Dark => [0xd8, 0xde, 0xe4],
            Base::Light => [0x1b, 0x21, 0x28],
        }
    }

    /// Brings a finished screen down to the colours that there are: the last thing before it is shown.
    pub fn lower(&self, buffer: &mut Buffer) {
        lower::lower(buffer, self.depth, self.base);
    }
}

/// Why a text is no style.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StyleError {
    word: String,
}

impl fmt::Display for StyleError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "`{}` is neither a colour (`#rrggbb`, a number from 0 to 255, or a name such as `red` or `light-blue`) nor \
             one of bold, dim, italic, underline, reverse; a ground is written `on COLOUR`",
            self.word
        )
    }
}

impl std::error::Error for StyleError {}

/// Reads a style: a colour, a ground after `on`, and modifiers, in any order.
pub fn style(text: &str) -> Result<Style, StyleError> {
    let mut style = Style::new();
    let mut words = text.split_whitespace();
    while let Some(word) = words.next() {
        style = match (word, modifier(word)) {
            ("on", _) => style.bg(colour(words.next().unwrap_or("on"))?),
            (_, Some(modifier)) => style.add_modifier(modifier),
            _ => style.fg(colour(word)?),
        };
    }
    Ok(style)
}

fn colour(word: &str) -> Result<Color, StyleError> {
    word.parse().map_err(|_| StyleError { word: word.into() })
}

fn modifier(word: &str) -> Option<Modifier> {
    Some(match word {
        "bold" => Modifier::BOLD,
        "dim" => Modifier::DIM,
        "italic" => Modifier::ITALIC,
        "underline" => Modifier::UNDERLINED,
        "reverse" => Modifier::REVERSED,
        _ => return None,
    })
}

#[cfg(test)]
mod tests;
