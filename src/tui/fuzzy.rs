//! Finding by a few letters: they have to occur in their order, with anything between them (`nce` finds `next-event`).
//!
//! Where they can be found in several ways, the best is taken, by dynamic programming over letters and places: a letter counts more at the beginning
//! of a word, and right after the one before it. In long texts nearly any few letters occur somehow; there every run of letters has
//! to begin a word ([`find_words`]).

/// What a letter counts that is found anywhere.
const FOUND: i32 = 1;
/// What it counts more right after the one before.
const ADJACENT: i32 = 5;
/// What it counts more at the beginning of a word.
const BEGINS: i32 = 4;
/// What it counts more at the beginning of everything.
const FIRST: i32 = 2;

/// How well letters were found, and which.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(in crate::tui) struct Found {
    /// More is better.
    pub(in crate::tui) score: i32,
    /// The places of the letters, counted in characters.
    pub(in crate::tui) at: Vec<usize>,
}

/// Finds letters in a name, whatever their case; blanks are passed over.
pub(in crate::tui) fn find(letters: &str, text: &str) -> Option<Found> {
    search(letters, text, true)
}

/// Finds letters in a longer text: those that do not follow the one before begin a word.
pub(in crate::tui) fn find_words(letters: &str, text: &str) -> Option<Found> {
    search(letters, text, false)
}

/// The best that ends with some letter at some place, and the place of the letter before.
type Best = Option<(i32, Option<usize>)>;

fn search(letters: &str, text: &str, anywhere: bool) -> Option<Found> {
    let letters: Vec<char> = letters.chars().filter(|c| !c.is_whitespace()).map(plain).collect();
    let text: Vec<char> = text.chars().map(plain).collect();
    let mut layers: Vec<Vec<Best>> = Vec::new();
    for letter in &letters {
        let layer = layer(*letter, &text, layers.last().map(Vec::as_slice), anywhere);
        layers.push(layer);
    }
    let Some(last) = layers.last() else { return Some(Found::default()) };
    let ends = last.iter().enumerate().filter_map(|(at, best)| Some((best.as_ref()?.0, at)));
    // Of equals the first.
    let (score, end) = ends.min_by_key(|(score, at)| (-score, *at))?;
    Some(Found { score, at: trace(&layers, end) })
}

/// Where a letter may be, after the letters before it.
fn layer(letter: char, text: &[char], before: Option<&[Best]>, anywhere: bool) -> Vec<Best> {
    // The best of the letter before that is not right before this place.
    let mut far: Best = None;
    let places = text.iter().enumerate().map(|(at, c)| {
        let near = before.zip(at.checked_sub(1)).and_then(|(before, at)| Some((before[at]?.0, at)));
        let begins = at == 0 || !text[at - 1].is_alphanumeric();
        let start = match before {
            None => Some((0, None)),
            Some(_) => far,
        };
        let start = start.filter(|_| anywhere || begins);
        let follows = near.map(|(score, at)| (score + ADJACENT, Some(at)));
        let best = [start, follows].into_iter().flatten().max_by_key(|(score, _)| *score);
        far = far.max(near.map(|(score, at)| (score, Some(at))));
        let bonus = FOUND + if begins { BEGINS } else { 0 } + if at == 0 { FIRST } else { 0 };
        best.filter(|_| *c == letter).map(|(score, from)| (score + bonus, from))
    });
    places.collect()
}

/// The places of all letters, from that of the last.
fn trace(layers: &[Vec<Best>], end: usize) -> Vec<usize> {
    let mut at = vec![end];
    for layer in layers.iter().rev() {
        at.extend(at.last().and_then(|last| layer[*last]).and_then(|(_, from)| from));
    }
    at.reverse();
    at
}

/// A letter without its case.
fn plain(c: char) -> char {
    c.to_lowercase().next().unwrap_or(c)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Those that are found, the best first.
    fn order<'t>(letters: &str, texts: &[&'t str]) -> Vec<&'t str> {
        let mut found: Vec<_> =
            texts.iter().filter_map(|text| Some((find(letters, text)?.score, *text))).collect();
        found.sort_by_key(|(score, _)| -score);
        found.into_iter().map(|(_, text)| text).collect()
    }

    #[test]
    fn letters_are_found_in_their_order_alone() {
        assert_eq!(find("nxt", "next-event").map(|found| found.at), Some(vec![0, 2, 3]));
        assert_eq!(find("NE", "next-event").map(|found| found.at), Some(vec![0, 1]));
        assert_eq!(find("tn", "next-event").map(|found| found.at), Some(vec![3, 8]));
        assert_eq!(find("xn ", "Xenon").map(|found| found.at), Some(vec![0, 2]));
        for (letters, text) in [("txen", "next"), ("nextt", "next"), ("a", ""), ("é", "e")] {
            assert_eq!(find(letters, text), None, "{letters} in {text}");
        }
        assert_eq!(find(" ", "anything"), Some(Found::default()));
    }

    #[test]
    fn the_best_of_several_ways_is_taken() {
        assert_eq!(find("ce", "compare-next-ce").map(|found| found.at), Some(vec![13, 14]));
        assert_eq!(find("sp", "step-split").map(|found| found.at), Some(vec![5, 6]));
        assert_eq!(find("fs", "focus-stages").map(|found| found.at), Some(vec![0, 6]));
    }

    #[test]
    fn words_that_begin_so_come_before_letters_that_are_strewn() {
        let names = ["pan-left", "previous-cut", "checkpoint", "compare", "copy", "palette"];
        assert_eq!(order("p", &names)[..3], ["pan-left", "previous-cut", "palette"]);
        assert_eq!(order("cop", &names), ["copy", "compare"]);
        assert_eq!(order("pc", &names), ["previous-cut"]);
        assert_eq!(order("pt", &names), ["pan-left", "palette", "previous-cut", "checkpoint"]);
    }

    #[test]
    fn in_long_texts_every_run_of_letters_begins_a_word() {
        let text = "Go to the next checkpoint";
        assert_eq!(find_words("nech", text).map(|found| found.at), Some(vec![10, 11, 15, 16]));
        assert_eq!(find_words("nxt", text), None);
        assert!(find("nxt", text).is_some());
    }
}
