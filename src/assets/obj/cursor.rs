//! A place in the bytes of an OBJ file.

use fast_float2::FastFloat;

use crate::assets::error::{Fault, FaultKind};
use crate::report::quoted;

/// Reads words, and knows the line. Blanks never cross the end of a line, but for one continued by `\`.
pub(super) struct Cursor<'a> {
    bytes: &'a [u8],
    at: usize,
    /// The line that the cursor stands in, from 1.
    pub(super) line: u64,
}

impl<'a> Cursor<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        let mark: &[u8] = b"\xEF\xBB\xBF";
        Self { bytes: bytes.strip_prefix(mark).unwrap_or(bytes), at: 0, line: 1 }
    }

    #[inline]
    fn peek(&self) -> Option<u8> {
        self.bytes.get(self.at).copied()
    }

    #[inline]
    fn skip_blanks(&mut self) {
        loop {
            match self.peek() {
                Some(b' ' | b'\t' | b'\r' | 0x0b | 0x0c) => self.at += 1,
                Some(b'\\') if self.continues() => {}
                _ => return,
            }
        }
    }

    /// Steps over `\` and the end of the line behind it.
    fn continues(&mut self) -> bool {
        let behind = self.bytes.get(self.at + 1..).unwrap_or_default();
        let blanks = behind.iter().take_while(|b| matches!(b, b' ' | b'\t' | b'\r')).count();
        let last = behind.get(blanks) == Some(&b'\n');
        if last {
            self.at += blanks + 2;
            self.line += 1;
        }
        last
    }

    /// The first word of the next statement; `None` at the end of the file.
    pub(super) fn keyword(&mut self) -> Option<&'a [u8]> {
        loop {
            self.skip_blanks();
            match self.peek()? {
                b'\n' => {
                    self.at += 1;
                    self.line += 1;
                }
                b'#' => self.skip_comment(),
                _ => return Some(self.word()),
            }
        }
    }

    fn word(&mut self) -> &'a [u8] {
        let rest = &self.bytes[self.at..];
        let length = rest.iter().position(|b| b.is_ascii_whitespace()).unwrap_or(rest.len());
        self.at += length;
        &rest[..length]
    }

    fn skip_comment(&mut self) {
        let rest = &self.bytes[self.at..];
        self.at += rest.iter().position(|&b| b == b'\n').unwrap_or(rest.len());
    }

    /// Goes to the end of the statement.
    pub(super) fn skip_statement(&mut self) {
        while let Some(byte) = self.peek() {
            match byte {
                b'\n' => return,
                b'#' => return self.skip_comment(),
                b'\\' if self.continues() => {}
                _ => self.at += 1,
            }
        }
    }

    /// Whether the statement has no further word.
    #[inline]
    pub(super) fn at_end(&mut self) -> bool {
        self.skip_blanks();
        matches!(self.peek(), None | Some(b'\n' | b'#'))
    }

    /// Requires that.
    pub(super) fn end(&mut self) -> Result<(), Fault> {
        if self.at_end() { Ok(()) } else { Err(self.fault(FaultKind::Syntax, "is one too many")) }
    }

    /// A number, to the nearest float; nothing may stick to it.
    #[inline]
    pub(super) fn number<F: FastFloat>(&mut self) -> Result<F, Fault> {
        if self.at_end() {
            return Err(Fault::line(
                self.line,
                FaultKind::Syntax,
                "a number is missing at the end of the line",
            ));
        }
        match fast_float2::parse_partial(&self.bytes[self.at..]) {
            Ok((value, length)) if self.is_word_end(self.at + length) => {
                self.at += length;
                Ok(value)
            }
            _ => Err(self.fault(FaultKind::Number, "is not a number")),
        }
    }

    /// An integer of at most ten digits.
    #[inline]
    pub(super) fn integer(&mut self) -> Result<i64, Fault> {
        let start = self.at;
        let negative = self.peek() == Some(b'-');
        if negative || self.peek() == Some(b'+') {
            self.at += 1;
        }
        let (mut value, first) = (0i64, self.at);
        while let Some(digit @ b'0'..=b'9') = self.peek() {
            value = value * 10 + i64::from(digit - b'0');
            self.at += 1;
            if self.at - first > 10 {
                break;
            }
        }
        if self.at == first || self.at - first > 10 {
            self.at = start;
            return Err(self.fault(FaultKind::Number, "is not an index"));
        }
        Ok(if negative { -value } else { value })
    }

    #[inline]
    pub(super) fn take(&mut self, byte: u8) -> bool {
        let there = self.peek() == Some(byte);
        self.at += usize::from(there);
        there
    }

    pub(super) fn at_slash_or_blank(&self) -> bool {
        self.peek() == Some(b'/') || self.is_word_end(self.at)
    }

    /// Requires that the word ends here.
    #[inline]
    pub(super) fn end_of_word(&self) -> Result<(), Fault> {
        if self.is_word_end(self.at) {
            Ok(())
        } else {
            Err(self.fault(FaultKind::Syntax, "follows a corner"))
        }
    }

    #[inline]
    fn is_word_end(&self, at: usize) -> bool {
        self.bytes.get(at).is_none_or(|b| b.is_ascii_whitespace() || matches!(b, b'\\' | 0x0b))
    }

    fn fault(&self, kind: FaultKind, what: &str) -> Fault {
        let rest = &self.bytes[self.at..];
        let length = rest.iter().take(40).take_while(|b| !b.is_ascii_whitespace()).count();
        let word = quoted(String::from_utf8_lossy(&rest[..length]));
        Fault::line(self.line, kind, format!("{word} {what}"))
    }
}
