//! The words of an event: its line of the script without brackets, its figures as short as they have to be.
//!
//! `{"click":[640.5,300.25]}` is `click 640.5 300.25`, in fewer cells `click 640 300`, in fewer still `click 640…`.

use crate::tui::text;

/// The words with all that they say, for searching and copying.
pub(super) fn whole(line: &str) -> String {
    join(line, None)
}

/// The words in so many cells.
pub(super) fn fitted(line: &str, room: usize) -> String {
    let tries = [None, Some(2), Some(1), Some(0)].into_iter().map(|decimals| join(line, decimals));
    let mut last = String::new();
    for words in tries {
        if text::width(&words) <= room {
            return text::line(&words);
        }
        last = words;
    }
    text::fit(&last, room)
}

/// The words, with at most so many decimals.
fn join(line: &str, decimals: Option<usize>) -> String {
    let words = line.split(|c: char| "{}[]\":,".contains(c) || c.is_whitespace());
    let words = words.filter(|word| !word.is_empty()).map(|word| short(word, decimals));
    words.collect::<Vec<_>>().join(" ")
}

/// A figure with at most so many decimals, and none that say nothing; any other word as it is.
fn short(word: &str, decimals: Option<usize>) -> String {
    // Names have no points in them; a whole number is short already.
    let Some(value) = word.parse::<f64>().ok().filter(|_| word.contains('.')) else { return word.into() };
    let whole = value.to_string();
    let Some(decimals) = decimals else { return whole };
    // Of an angle, or a share, the decimals are what it says.
    let decimals = if value.abs() < 10.0 { decimals.max(2) } else { decimals };
    let rounded = format!("{value:.decimals$}");
    if rounded.len() < whole.len() { rounded } else { whole }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_lose_decimals_before_words_are_cut() {
        let line = r#"{"click":[640.5,300.25]}"#;
        assert_eq!(whole(line), "click 640.5 300.25");
        assert_eq!(fitted(line, 18), "click 640.5 300.25");
        assert_eq!(fitted(line, 17), "click 640.5 300.2");
        assert_eq!(fitted(line, 15), "click 640 300");
        assert_eq!(fitted(line, 10), "click 640…");
        assert_eq!(fitted(line, 0), "");
        assert_eq!(fitted(r#"{"camera":{"azimuth":0.15625}}"#, 20), "camera azimuth 0.16");
    }

    #[test]
    fn what_is_no_figure_stays() {
        assert_eq!(whole(r#"{"checkpoint":"1e5"}"#), "checkpoint 1e5");
        assert_eq!(
            whole(r#"{"cut":{"from":{"node":17},"to":{"edge":[40,0.0]}}}"#),
            "cut from node 17 to edge 40 0"
        );
        assert_eq!(whole(r#"{"undo":{}}"#), "undo");
        assert_eq!(whole(""), "");
    }
}
