//! A line that is typed: its text, where the cursor is in it, and what the keys of a line editor do.
//!
//! The cursor stands between graphemes, so that a letter goes with its accents and an emoji is one thing. What could write over the terminal or
//! turn its reading direction is not taken in. What is wider than its place is scrolled, no further than the cursor needs.

use std::cell::Cell;

use ratatui::style::Style;
use ratatui::text::Span;

use super::key::Key;
use super::text;
use crate::report::printable;

/// See the module.
#[derive(Clone, Debug, Default)]
pub(in crate::tui) struct Edit {
    text: String,
    /// Where in the text, in bytes.
    cursor: usize,
    /// The first byte in view, as it was when last drawn.
    first: Cell<usize>,
}

/// What a key did to a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::tui) enum Typed {
    /// The text is another.
    Changed,
    /// The cursor was moved.
    Moved,
    /// It is no key of a line editor.
    Unknown,
}

/// What is in view of a line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(in crate::tui) struct View<'a> {
    /// Before the cursor.
    pub(in crate::tui) before: &'a str,
    /// Under the cursor; empty at the end of the text.
    pub(in crate::tui) under: &'a str,
    /// After the cursor.
    pub(in crate::tui) after: &'a str,
}

impl Edit {
    /// A line with this in it, and the cursor at its end.
    pub(in crate::tui) fn new(text: &str) -> Self {
        let mut edit = Self::default();
        edit.insert(text);
        edit
    }

    /// What was typed.
    pub(in crate::tui) fn text(&self) -> &str {
        &self.text
    }

    /// Puts another text in its place, and the cursor at its end.
    pub(in crate::tui) fn set(&mut self, text: &str) {
        *self = Self::new(text);
    }

    /// Types a text; line ends become blanks.
    pub(in crate::tui) fn insert(&mut self, text: &str) {
        let typed: String = text.trim_end_matches(['\r', '\n']).chars().filter_map(harmless).collect();
        self.text.insert_str(self.cursor, &typed);
        // An accent joins the letter before it.
        self.cursor = self.ends().find(|end| *end >= self.cursor + typed.len()).unwrap_or(self.text.len());
    }

    /// Takes a key.
    pub(in crate::tui) fn key(&mut self, key: Key) -> Typed {
        if let Some(c) = key.typed() {
            self.insert(c.encode_utf8(&mut [0; 4]));
            return Typed::Changed;
        }
        let name = key.to_string();
        let target = match name.as_str() {
            "left" | "ctrl-b" | "backspace" | "ctrl-h" => self.left(),
            "right" | "ctrl-f" | "del" | "ctrl-d" => self.right(),
            "home" | "ctrl-a" | "ctrl-u" => 0,
            "end" | "ctrl-e" | "ctrl-k" => self.text.len(),
            "ctrl-left" | "alt-left" | "alt-b" | "ctrl-w" | "alt-backspace" => self.word_left(),
            "ctrl-right" | "alt-right" | "alt-f" => self.word_right(),
            _ => return Typed::Unknown,
        };
        let drops = ["backspace", "ctrl-h", "del", "ctrl-d", "ctrl-u", "ctrl-k", "ctrl-w", "alt-backspace"];
        if !drops.contains(&name.as_str()) {
            self.cursor = target;
            return Typed::Moved;
        }
        self.text.drain(target.min(self.cursor)..target.max(self.cursor));
        self.cursor = target.min(self.cursor);
        Typed::Changed
    }

    /// What is in view in this many cells, the cursor's among them.
    pub(in crate::tui) fn view(&self, width: usize) -> View<'_> {
        let under = self.cursor..self.right();
        let cell = text::width(&self.text[under.clone()]).max(1);
        let starts = || std::iter::once(0).chain(self.ends());
        let needed = |first: &usize| text::width(&self.text[*first..self.cursor]) + cell <= width;
        let fits = |first: &usize| text::width(&self.text[*first..]) < width;
        let least = starts().take_while(|start| *start <= self.cursor).find(needed).unwrap_or(self.cursor);
        let most = starts().find(fits).unwrap_or(self.cursor).clamp(least, self.cursor);
        let first = self.first.get().clamp(least, most);
        self.first.set(first);
        let room = width.saturating_sub(text::width(&self.text[first..self.cursor]) + cell);
        let last =
            starts().rfind(|end| *end >= under.end && text::width(&self.text[under.end..*end]) <= room);
        View {
            before: &self.text[first..under.start],
            under: &self.text[under.clone()],
            after: &self.text[under.end..last.unwrap_or(under.end)],
        }
    }

    /// Where graphemes end.
    fn ends(&self) -> impl DoubleEndedIterator<Item = usize> + use<> {
        let span = Span::raw(self.text.as_str());
        let mut end = 0;
        let ends: Vec<usize> = span
            .styled_graphemes(Style::default())
            .map(|grapheme| {
                end += grapheme.symbol.len();
                end
            })
            .collect();
        ends.into_iter()
    }

    fn left(&self) -> usize {
        self.ends().rfind(|end| *end < self.cursor).unwrap_or(0)
    }

    fn right(&self) -> usize {
        self.ends().find(|end| *end > self.cursor).unwrap_or(self.text.len())
    }

    /// Where the word before the cursor begins.
    fn word_left(&self) -> usize {
        let before = self.text[..self.cursor].trim_end_matches(is_gap);
        before.rfind(is_gap).map_or(0, |at| at + before[at..].chars().next().map_or(0, char::len_utf8))
    }

    /// Where the word after the cursor ends.
    fn word_right(&self) -> usize {
        let after = self.text[self.cursor..].trim_start_matches(is_gap);
        self.text.len() - after.find(is_gap).map_or(0, |at| after.len() - at)
    }
}

/// What stands between words, also those of a path.
fn is_gap(c: char) -> bool {
    c.is_whitespace() || matches!(c, '/' | '\\' | '=' | '>')
}

/// A character as it may stand in a line.
fn harmless(c: char) -> Option<char> {
    match c {
        '\n' | '\t' => Some(' '),
        c => (printable(c) == c.to_string()).then_some(c),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A line after these keys.
    fn typed(text: &str, keys: &str) -> Edit {
        let mut edit = Edit::new(text);
        press(&mut edit, keys);
        edit
    }

    fn press(edit: &mut Edit, keys: &str) {
        for key in keys.split_whitespace() {
            edit.key(key.parse().expect("a key"));
        }
    }

    #[test]
    fn keys_edit_where_the_cursor_is() {
        let cases = [
            ("", "a b left c", "acb"),
            ("abc", "home x del", "xbc"),
            ("abc", "left backspace", "ac"),
            ("abc", "ctrl-a ctrl-k", ""),
            ("abc", "left ctrl-u", "c"),
            ("one two/three", "ctrl-w", "one two/"),
            ("one two/", "ctrl-w", "one "),
            ("one two", "ctrl-left ctrl-left ctrl-right x", "onex two"),
            ("counter=FE", "alt-backspace", "counter="),
            ("abc", "backspace backspace backspace backspace del left", ""),
        ];
        for (text, keys, after) in cases {
            assert_eq!(typed(text, keys).text(), after, "{text:?} after {keys}");
        }
    }

    #[test]
    fn the_cursor_steps_over_whole_graphemes() {
        assert_eq!(typed("e\u{301}漢👩‍👩‍👧", "backspace").text(), "e\u{301}漢");
        assert_eq!(typed("e\u{301}漢👩‍👩‍👧", "left left left x").text(), "xe\u{301}漢👩‍👩‍👧");
        let mut edit = typed("ea", "left");
        edit.insert("\u{301}");
        assert_eq!(edit.key("del".parse().expect("a key")), Typed::Changed);
        assert_eq!(edit.text(), "e\u{301}", "the cursor stood behind the accent");
    }

    #[test]
    fn what_could_write_over_the_terminal_is_not_taken_in() {
        assert_eq!(Edit::new("a\u{1b}[31m\u{202e}b\nc\r\n").text(), "a[31mb c");
    }

    #[test]
    fn keys_that_edit_nothing_are_left_to_others() {
        for key in ["enter", "esc", "tab", "up", "down", "pgdn", "f1", "ctrl-o", "alt-x"] {
            assert_eq!(Edit::new("x").key(key.parse().expect("a key")), Typed::Unknown, "{key}");
        }
    }

    #[test]
    fn the_cursor_is_in_view_whatever_the_width() {
        for text in ["", "abcdefgh", "漢字かなカナ", "e\u{301}x👩‍👩‍👧 y", "a\u{200b}b"] {
            for width in 1..12 {
                let mut edit = Edit::new(text);
                for key in ["left"; 10].into_iter().chain(["right"; 10]) {
                    let view = edit.view(width);
                    let cell = text::width(view.under).max(1);
                    let used = text::width(view.before) + cell + text::width(view.after);
                    assert!(used <= width.max(cell), "{text:?} in {width}: {view:?}");
                    assert!(text.contains(&format!("{}{}{}", view.before, view.under, view.after)));
                    edit.key(key.parse().expect("a key"));
                }
            }
            assert_eq!(Edit::new(text).view(0).before, "");
        }
    }

    #[test]
    fn what_is_in_view_moves_no_further_than_it_must() {
        let edit = Edit::new("abcdefgh");
        assert_eq!(edit.view(5), View { before: "efgh", under: "", after: "" });
        let edit = typed("abcdefgh", "home");
        assert_eq!(edit.view(5), View { before: "", under: "a", after: "bcde" });
        let mut edit = Edit::new("abcdefgh");
        edit.view(5);
        press(&mut edit, "left left");
        assert_eq!(edit.view(5), View { before: "ef", under: "g", after: "h" });
        assert_eq!(edit.view(20).before, "abcdef", "all of it, once there is room");
    }
}
