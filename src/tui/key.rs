//! A key with its modifiers, as it comes from the terminal and as a person writes it: `q`, `Q`, `ctrl-p`, `alt-x`, `shift-tab`, `pgup`, `f5`, `?`.
//!
//! A terminal sends some keys as the same byte (`ctrl-i` is a tab, `ctrl-[` an escape) and leaves others to the layout (a capital letter has shift in
//! it already). Each such key has one form here, whichever way it was named, so that two keys are equal exactly if a terminal cannot tell them apart.

use std::fmt;
use std::str::FromStr;

use ratatui::crossterm::event::{KeyCode, KeyEvent, KeyEventKind, KeyModifiers};

/// A key with its modifiers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Key {
    code: KeyCode,
    modifiers: KeyModifiers,
}

/// Names of keys that are no characters. The first name of a key is the one that is shown.
const NAMES: [(&str, KeyCode); 25] = [
    ("enter", KeyCode::Enter),
    ("esc", KeyCode::Esc),
    ("tab", KeyCode::Tab),
    ("space", KeyCode::Char(' ')),
    ("backspace", KeyCode::Backspace),
    ("left", KeyCode::Left),
    ("right", KeyCode::Right),
    ("up", KeyCode::Up),
    ("down", KeyCode::Down),
    ("home", KeyCode::Home),
    ("end", KeyCode::End),
    ("pgup", KeyCode::PageUp),
    ("pgdn", KeyCode::PageDown),
    ("ins", KeyCode::Insert),
    ("del", KeyCode::Delete),
    ("return", KeyCode::Enter),
    ("escape", KeyCode::Esc),
    ("pageup", KeyCode::PageUp),
    ("pagedown", KeyCode::PageDown),
    ("pgdown", KeyCode::PageDown),
    ("insert", KeyCode::Insert),
    ("delete", KeyCode::Delete),
    ("minus", KeyCode::Char('-')),
    ("plus", KeyCode::Char('+')),
    ("backtab", KeyCode::BackTab),
];
const MODIFIERS: [(&str, KeyModifiers); 3] =
    [("ctrl-", KeyModifiers::CONTROL), ("alt-", KeyModifiers::ALT), ("shift-", KeyModifiers::SHIFT)];
/// There is no keyboard with more.
const FUNCTION_KEYS: std::ops::RangeInclusive<u8> = 1..=24;

impl Key {
    /// A key with its modifiers; `None` where it has no name.
    pub fn new(code: KeyCode, modifiers: KeyModifiers) -> Option<Self> {
        let named = NAMES.iter().any(|(_, named)| *named == code);
        let known = match code {
            KeyCode::Char(c) => !c.is_control(),
            KeyCode::F(n) => FUNCTION_KEYS.contains(&n),
            _ => named,
        };
        let all = MODIFIERS.iter().fold(KeyModifiers::NONE, |all, (_, one)| all | *one);
        (known && all.contains(modifiers)).then(|| Self { code, modifiers }.normal())
    }

    /// The key that was pressed or is held down; `None` when it was let go, or has no name.
    pub fn pressed(event: KeyEvent) -> Option<Self> {
        let pressed = matches!(event.kind, KeyEventKind::Press | KeyEventKind::Repeat);
        if pressed { Self::new(event.code, event.modifiers) } else { None }
    }

    /// A character without modifiers.
    pub fn plain(c: char) -> Option<Self> {
        Self::new(KeyCode::Char(c), KeyModifiers::NONE)
    }

    /// The character that it types, if it is text.
    pub fn typed(self) -> Option<char> {
        match self.code {
            KeyCode::Char(c) if self.modifiers.is_empty() => Some(c),
            _ => None,
        }
    }

    /// Its code.
    pub fn code(self) -> KeyCode {
        self.code
    }

    /// Its modifiers.
    pub fn modifiers(self) -> KeyModifiers {
        self.modifiers
    }

    /// The one form of a key.
    fn normal(self) -> Self {
        let Self { code, mut modifiers } = self;
        let ctrl = modifiers.contains(KeyModifiers::CONTROL);
        let code = match code {
            KeyCode::BackTab => {
                modifiers |= KeyModifiers::SHIFT;
                KeyCode::Tab
            }
            KeyCode::Char(c) if ctrl => controlled(c),
            KeyCode::Char(c) if modifiers.contains(KeyModifiers::SHIFT) => KeyCode::Char(capital(c)),
            code => code,
        };
        if matches!(self.code, KeyCode::Char(_)) {
            modifiers.remove(KeyModifiers::SHIFT);
        }
        // The byte of a control character is the key itself, without ctrl.
        if ctrl && matches!(self.code, KeyCode::Char(_)) && !matches!(code, KeyCode::Char(_)) {
            modifiers.remove(KeyModifiers::CONTROL);
        }
        Self { code, modifiers }
    }
}

/// What a terminal makes of a character with ctrl.
fn controlled(c: char) -> KeyCode {
    match c.to_ascii_lowercase() {
        'i' => KeyCode::Tab,
        'm' => KeyCode::Enter,
        '[' => KeyCode::Esc,
        '4' => KeyCode::Char('\\'),
        '5' => KeyCode::Char(']'),
        '6' => KeyCode::Char('^'),
        '7' | '/' => KeyCode::Char('_'),
        '@' => KeyCode::Char(' '),
        c => KeyCode::Char(c),
    }
}

fn capital(c: char) -> char {
    let mut capitals = c.to_uppercase();
    match (capitals.next(), capitals.next()) {
        (Some(capital), None) => capital,
        // Some letters have no capital of their own, such as ß.
        _ => c,
    }
}

impl fmt::Display for Key {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (name, _) in MODIFIERS.iter().filter(|(_, modifier)| self.modifiers.contains(*modifier)) {
            f.write_str(name)?;
        }
        match self.code {
            KeyCode::F(n) => write!(f, "f{n}"),
            KeyCode::Char(c) if c != ' ' => write!(f, "{c}"),
            code => f.write_str(NAMES.iter().find(|(_, named)| *named == code).map_or("", |(name, _)| name)),
        }
    }
}

/// Why a text names no key.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct KeyError {
    text: String,
}

impl fmt::Display for KeyError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "`{}` is no key: a key is a character, f1 to f24", self.text)?;
        NAMES[..15].iter().try_for_each(|(name, _)| write!(f, ", {name}"))?;
        write!(f, ", each after any of ctrl-, alt-, shift-")
    }
}

impl std::error::Error for KeyError {}

impl FromStr for Key {
    type Err = KeyError;

    fn from_str(text: &str) -> Result<Self, KeyError> {
        let (mut rest, mut modifiers) = (text, KeyModifiers::NONE);
        while let Some((after, modifier)) = modifier(rest) {
            (rest, modifiers) = (after, modifiers | modifier);
        }
        let key = code(rest).and_then(|code| Self::new(code, modifiers));
        key.ok_or_else(|| KeyError { text: text.into() })
    }
}

/// A modifier before something, and that.
fn modifier(text: &str) -> Option<(&str, KeyModifiers)> {
    let begins = |name: &str| text.get(..name.len()).is_some_and(|start| start.eq_ignore_ascii_case(name));
    MODIFIERS.iter().find(|(name, _)| begins(name)).map(|(name, modifier)| (&text[name.len()..], *modifier))
}

fn code(text: &str) -> Option<KeyCode> {
    let mut chars = text.chars();
    if let (Some(c), None) = (chars.next(), chars.next()) {
        return Some(KeyCode::Char(c));
    }
    let lower = text.to_lowercase();
    let named = NAMES.iter().find(|(name, _)| *name == lower).map(|(_, code)| *code);
    // "f+5" and "f05" are numbers to Rust.
    let function = || lower.strip_prefix('f')?.parse().ok().filter(|n| lower == format!("f{n}"));
    named.or_else(|| function().map(KeyCode::F))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn key(text: &str) -> Key {
        text.parse().unwrap_or_else(|error| panic!("{error}"))
    }

    /// Every combination of modifiers.
    fn modifiers() -> impl Iterator<Item = KeyModifiers> {
        (0..8u8).map(KeyModifiers::from_bits_truncate)
    }

    fn codes() -> impl Iterator<Item = KeyCode> {
        let characters = (0..0x250u32).chain([0x3b2, 0x42f, 0x4e16, 0x1f600]).filter_map(char::from_u32);
        let named = NAMES.iter().map(|(_, code)| *code);
        characters.map(KeyCode::Char).chain(named).chain((0..=255).map(KeyCode::F))
    }

    #[test]
    fn every_key_reads_as_it_is_written() {
        let mut count = 0;
        for key in codes().flat_map(|code| modifiers().filter_map(move |m| Key::new(code, m))) {
            let written = key.to_string();
            assert_eq!(written.parse(), Ok(key), "{written}");
            assert!(!written.is_empty() && !written.contains(char::is_control));
            count += 1;
        }
        assert!(count > 4000, "{count}");
    }

    #[test]
    fn a_key_has_one_form() {
        for key in codes().flat_map(|code| modifiers().filter_map(move |m| Key::new(code, m))) {
            assert_eq!(Key::new(key.code, key.modifiers), Some(key), "{key}");
        }
        let same = [
            ("ctrl-i", "tab"),
            ("ctrl-shift-i", "tab"),
            ("ctrl-m", "enter"),
            ("ctrl-[", "esc"),
            ("ctrl-P", "ctrl-p"),
            ("ctrl-/", "ctrl-_"),
            ("ctrl-4", "ctrl-\\"),
            ("shift-q", "Q"),
            ("shift-é", "É"),
            ("backtab", "shift-tab"),
            ("PageUp", "pgup"),
            ("CTRL-ALT-Delete", "alt-ctrl-del"),
            ("minus", "-"),
            (" ", "space"),
        ];
        same.iter().for_each(|(a, b)| assert_eq!(key(a), key(b), "{a} and {b}"));
        assert_ne!(key("q"), key("Q"));
        assert_ne!(key("alt-q"), key("alt-Q"));
    }

    #[test]
    fn written_forms_are_those_that_people_write() {
        let forms =
            ["q", "Q", "?", "-", "ctrl--", "alt-x", "shift-tab", "ctrl-space", "ctrl-alt-pgdn", "f12"];
        forms.iter().for_each(|form| assert_eq!(key(form).to_string(), *form));
    }

    #[test]
    fn what_the_terminal_sends_is_the_key_that_was_named() {
        let sent = |code, modifiers| Key::pressed(KeyEvent::new(code, modifiers));
        assert_eq!(sent(KeyCode::Char('Q'), KeyModifiers::SHIFT), Some(key("Q")));
        assert_eq!(sent(KeyCode::Char('?'), KeyModifiers::NONE), Some(key("?")));
        assert_eq!(sent(KeyCode::BackTab, KeyModifiers::SHIFT), Some(key("shift-tab")));
        assert_eq!(sent(KeyCode::Char('p'), KeyModifiers::CONTROL), Some(key("ctrl-p")));
        assert_eq!(sent(KeyCode::Char('7'), KeyModifiers::CONTROL), Some(key("ctrl-/")));
        assert_eq!(sent(KeyCode::CapsLock, KeyModifiers::NONE), None);
        assert_eq!(sent(KeyCode::Char('x'), KeyModifiers::SUPER), None);
        let mut released = KeyEvent::new(KeyCode::Char('q'), KeyModifiers::NONE);
        released.kind = KeyEventKind::Release;
        assert_eq!(Key::pressed(released), None);
        released.kind = KeyEventKind::Repeat;
        assert_eq!(Key::pressed(released), Some(key("q")));
    }

    #[test]
    fn text_is_typed_by_characters_alone() {
        let typed = ["a", "A", "space", "ctrl-a", "alt-a", "enter", "ß"].map(|text| key(text).typed());
        assert_eq!(typed, [Some('a'), Some('A'), Some(' '), None, None, None, Some('ß')]);
    }

    #[test]
    fn what_names_no_key_says_what_does() {
        for text in
            ["", "ctrl-", "ctrl-shift-", "qq", "f0", "f25", "f05", "f+5", "\u{1b}", "ctrl-\u{7}", "super-x"]
        {
            let error = text.parse::<Key>().expect_err(text).to_string();
            assert!(error.contains(text) && error.contains("pgup") && !error.contains("pageup"), "{error}");
        }
    }
}
