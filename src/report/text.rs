//! Text that may have come from a file, made safe to show.

/// A text that may hold a file's name, with what could write over the terminal or turn its reading direction spelled out.
pub fn printable(text: impl ToString) -> String {
    let text = text.to_string();
    // Nearly all that is ever shown is as harmless as it looks.
    if !text.contains(misleads) {
        return text;
    }
    let spelled = |c: char| if misleads(c) { c.escape_default().collect() } else { c.to_string() };
    text.chars().map(spelled).collect()
}

/// The same as a part of a line, between quotation marks.
pub fn quoted(text: impl ToString) -> String {
    format!("\"{}\"", printable(text).replace('\n', "\\n"))
}

/// Controls but for line ends, and the marks that reorder text.
fn misleads(c: char) -> bool {
    let reorders = matches!(c, '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    reorders || (c.is_control() && c != '\n')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_cannot_write_over_the_terminal() {
        assert_eq!(printable("a\u{1b}[31m\u{1}é\t\r"), "a\\u{1b}[31m\\u{1}é\\t\\r");
        assert_eq!(printable("two\nlines"), "two\nlines");
    }

    #[test]
    fn what_is_quoted_reads_as_it_was_written() {
        assert_eq!(quoted("e\u{301}\\\n\u{1b}"), "\"e\u{301}\\\\n\\u{1b}\"");
    }

    #[test]
    fn a_name_cannot_be_turned_round() {
        assert_eq!(printable("\u{202e}txt.lancet"), "\\u{202e}txt.lancet");
    }
}
