//! Text that may have come from a file, made safe to show.

/// A text that may hold a file's name, with what could write over the terminal or turn its reading direction spelled out.
pub fn printable(text: impl ToString) -> String {
    let spelled = |c: char| if misleads(c) { c.escape_default().collect() } else { c.to_string() };
    text.to_string().chars().map(spelled).collect()
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
    fn a_name_cannot_be_turned_round() {
        assert_eq!(printable("\u{202e}txt.lancet"), "\\u{202e}txt.lancet");
    }
}
