//! Text fitted to cells, numbers for people, and bars.
//!
//! What is fitted is made safe first: it may have come from a file. Widths are counted as the terminal draws them, grapheme by grapheme.

use ratatui::style::Style;
use ratatui::text::Span;

use crate::report::printable;

const ELLIPSIS: &str = "…";

/// A text as a single line: control characters and line ends spelled out.
pub fn line(text: &str) -> String {
    let text = printable(text);
    if text.contains('\n') { text.replace('\n', "\\n") } else { text }
}

/// How many cells a text takes.
pub fn width(text: &str) -> usize {
    match is_plain(text) {
        true => text.len(),
        false => cells(&Span::raw(text)).iter().map(|(_, width)| width).sum(),
    }
}

/// Whether every byte is a cell of its own.
fn is_plain(text: &str) -> bool {
    text.bytes().all(|byte| (b' '..=b'~').contains(&byte))
}

/// A line in at most this many cells; of what is longer, the beginning.
pub fn fit(text: &str, width: usize) -> String {
    shorten(text, width, |room| (room, 0))
}

/// A line in at most this many cells; of what is longer, the end, as for paths.
pub fn fit_end(text: &str, width: usize) -> String {
    shorten(text, width, |room| (0, room))
}

/// A line in at most this many cells; of what is longer, both ends.
pub fn fit_middle(text: &str, width: usize) -> String {
    shorten(text, width, |room| (room.div_ceil(2), room / 2))
}

/// A line in exactly this many cells, its beginning on the left.
pub fn pad(text: &str, width: usize) -> String {
    let text = fit(text, width);
    let blanks = " ".repeat(width - self::width(&text));
    text + &blanks
}

/// A line in exactly this many cells, its end on the right, as for numbers.
pub fn pad_start(text: &str, width: usize) -> String {
    let text = fit(text, width);
    " ".repeat(width - self::width(&text)) + &text
}

/// A text in lines of at most so many cells, broken between words where that can be; what is beyond the last line is cut off.
pub fn wrap(text: &str, width: usize, lines: usize) -> Vec<String> {
    let mut rest = line(text);
    let mut wrapped = Vec::new();
    while wrapped.len() + 1 < lines && self::width(&rest) > width && width > 0 {
        let head = head(&rest, width);
        if self::width(&rest[..head]) > width {
            break;
        }
        // A blank may come right after what fits. A word that is longer than the line is broken anywhere.
        let reach = rest[head..].chars().next().map_or(head, |next| head + next.len_utf8());
        let at = rest[..reach].rfind(' ').filter(|at| *at > 0).unwrap_or(head);
        let next = rest.split_off(at);
        wrapped.push(std::mem::replace(&mut rest, next.trim_start().to_owned()));
    }
    wrapped.push(fit(&rest, width));
    wrapped
}

/// How many bytes of a line fit in so many cells; at least its first grapheme.
fn head(line: &str, width: usize) -> usize {
    let span = Span::raw(line);
    let cells = cells(&span);
    let count = count_within(cells.iter(), width).max(1);
    cells[..count.min(cells.len())].iter().map(|(symbol, _)| symbol.len()).sum()
}

/// Its graphemes and their widths.
fn cells<'a>(span: &'a Span<'a>) -> Vec<(&'a str, usize)> {
    let symbols = span.styled_graphemes(Style::default()).map(|grapheme| grapheme.symbol);
    symbols.map(|symbol| (symbol, Span::raw(symbol).width())).collect()
}

/// `share` says how many of the cells beside the ellipsis are for the beginning and for the end.
fn shorten(text: &str, width: usize, share: impl FnOnce(usize) -> (usize, usize)) -> String {
    let text = line(text);
    if self::width(&text) <= width {
        return text;
    }
    let span = Span::raw(text.as_str());
    let cells = cells(&span);
    let Some(room) = width.checked_sub(1) else { return String::new() };
    let (start, end) = share(room);
    let head = count_within(cells.iter(), start);
    let tail = count_within(cells.iter().rev(), end);
    let symbols = |cells: &[(&str, usize)]| cells.iter().map(|(symbol, _)| *symbol).collect::<String>();
    symbols(&cells[..head]) + ELLIPSIS + &symbols(&cells[cells.len() - tail..])
}

/// How many graphemes fit.
fn count_within<'a>(cells: impl Iterator<Item = &'a (&'a str, usize)>, room: usize) -> usize {
    let mut taken = 0;
    cells
        .take_while(|(_, width)| {
            taken += width;
            taken <= room
        })
        .count()
}

/// A time given in microseconds, in three digits and the unit that fits: `12.3 µs`, `4.56 ms`, `1.20 s`.
pub fn us(us: f64) -> String {
    match us {
        us if !us.is_finite() => "–".into(),
        us if us.abs() < 999.5 => format!("{} µs", digits(us)),
        us if us.abs() < 999.5e3 => format!("{} ms", digits(us / 1e3)),
        us => format!("{} s", digits(us / 1e6)),
    }
}

/// A size in bytes, in three digits and the unit that fits: `512 B`, `1.21 MB`.
pub fn bytes(bytes: u64) -> String {
    let (mut size, mut unit) = (bytes as f64, "B");
    for larger in ["kB", "MB", "GB", "TB"] {
        if size < 999.5 {
            break;
        }
        (size, unit) = (size / 1e3, larger);
    }
    if unit == "B" { format!("{bytes} B") } else { format!("{} {unit}", digits(size)) }
}

/// Three digits, or as many as stand before the point.
fn digits(value: f64) -> String {
    let decimals = match value.abs() {
        size if size < 9.995 => 2,
        size if size < 99.95 => 1,
        _ => 0,
    };
    format!("{value:.decimals$}")
}

/// A count with its thousands set apart: `12,345`.
pub fn count(count: u64) -> String {
    let digits = count.to_string();
    let separated = |(i, digit): (usize, char)| {
        let comma = i > 0 && (digits.len() - i).is_multiple_of(3);
        comma.then_some(',').into_iter().chain([digit])
    };
    digits.chars().enumerate().flat_map(separated).collect()
}

/// Parts of a block, from an eighth.
const EIGHTHS: [&str; 7] = ["▏", "▎", "▍", "▌", "▋", "▊", "▉"];

/// A bar of this many cells, of which a share from 0 to 1 is full, in eighths; what is more than nothing shows.
pub fn bar(share: f64, width: usize) -> String {
    let share = if share.is_nan() { 0.0 } else { share.clamp(0.0, 1.0) };
    let most = width.saturating_mul(8);
    let eighths = ((share * most as f64).round() as usize).max(usize::from(share > 0.0)).min(most);
    let part = (eighths % 8).checked_sub(1).map_or("", |i| EIGHTHS[i]);
    let full = "█".repeat(eighths / 8) + part;
    full + &" ".repeat(width - eighths.div_ceil(8))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fitted_text_never_takes_more_cells_than_there_are() {
        let texts =
            ["", "a", "plain text", "漢字かな", "é\u{301}", "👩‍👩‍👧 x", "a\u{200b}b", "\u{1b}[31m", "x\ny"];
        for (text, room) in texts.iter().flat_map(|text| (0..14).map(move |room| (text, room))) {
            for fitted in [fit(text, room), fit_end(text, room), fit_middle(text, room)] {
                assert!(width(&fitted) <= room, "{text:?} in {room}: {fitted:?}");
                assert!(!fitted.contains(char::is_control), "{fitted:?}");
            }
            assert_eq!(width(&pad(text, room)), room, "{text:?}");
            assert_eq!(width(&pad_start(text, room)), room, "{text:?}");
        }
    }

    #[test]
    fn what_is_too_long_keeps_the_end_that_was_asked_for() {
        let text = "recordings/bust.lancet";
        assert_eq!(fit(text, 8), "recordi…");
        assert_eq!(fit_end(text, 8), "….lancet");
        assert_eq!(fit_middle(text, 8), "reco…cet");
        assert_eq!(fit(text, 22), text);
        assert_eq!(fit(text, 1), "…");
        assert_eq!(fit(text, 0), "");
        assert_eq!(fit("漢字漢字", 4), "漢…", "half a character is none");
        assert_eq!(pad("漢字漢字", 4), "漢… ");
        assert_eq!(pad_start("12", 5), "   12");
    }

    #[test]
    fn long_texts_go_over_several_lines_and_only_the_last_is_cut() {
        assert_eq!(wrap("one two three four", 9, 3), ["one two", "three", "four"]);
        assert_eq!(wrap("one two three four", 9, 2), ["one two", "three fo…"]);
        assert_eq!(wrap("one two", 7, 3), ["one two"]);
        assert_eq!(wrap("one two", 3, 3), ["one", "two"]);
        assert_eq!(wrap("some/where/far.lancet", 8, 3), ["some/whe", "re/far.l", "ancet"]);
        assert_eq!(wrap("漢字 漢字", 5, 3), ["漢字", "漢字"]);
        assert_eq!(wrap("a", 0, 3), [""]);
        for (width, lines) in (0..9).flat_map(|width| (0..4).map(move |lines| (width, lines))) {
            for line in wrap("漢字 👩‍👩‍👧 plain\u{1b} text of words", width, lines) {
                assert!(self::width(&line) <= width, "{line:?} in {width}");
            }
        }
    }

    #[test]
    fn times_have_three_digits_and_a_unit() {
        let times = [0.0, 0.423, 9.996, 12.34, 999.4, 999.6, 4560.0, 999_600.0, 1.2e6, 1234.5e6, f64::NAN];
        let written = [
            "0.00 µs", "0.42 µs", "10.0 µs", "12.3 µs", "999 µs", "1.00 ms", "4.56 ms", "1.00 s", "1.20 s",
            "1234 s", "–",
        ];
        assert_eq!(times.map(us), written);
    }

    #[test]
    fn sizes_and_counts_read_at_a_glance() {
        let sizes = [0, 512, 999, 1000, 1_214_000, 999_700_000, u64::MAX].map(bytes);
        assert_eq!(sizes, ["0 B", "512 B", "999 B", "1.00 kB", "1.21 MB", "1.00 GB", "18446744 TB"]);
        let counts = [0, 12, 999, 1000, 12345, 1_000_000].map(count);
        assert_eq!(counts, ["0", "12", "999", "1,000", "12,345", "1,000,000"]);
    }

    #[test]
    fn a_bar_is_as_full_as_its_share() {
        assert_eq!(bar(0.5, 4), "██  ");
        assert_eq!(bar(0.28, 4), "█▏  ");
        assert_eq!(bar(1.0, 3), "███");
        assert_eq!(bar(1e-9, 3), "▏  ");
        for share in [0.0, -1.0, f64::NAN] {
            assert_eq!(bar(share, 3), "   ");
        }
        assert_eq!(bar(f64::INFINITY, 2), "██");
        assert_eq!(bar(0.7, 0), "");
        for i in 0..=100 {
            assert_eq!(width(&bar(f64::from(i) / 100.0, 7)), 7);
        }
    }
}
