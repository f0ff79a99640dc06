//! What the pane shows of a comparison, at the sizes that it has to be of use at.

use super::*;
use crate::tui::action::Action;
use crate::tui::tests::suite::{Screen, Suite};
use crate::tui::{panes, screen};

/// The pane's lines at a size.
fn shown(screen: &mut Screen, width: u16, height: u16) -> String {
    let area = Rect::new(0, 0, width, height);
    let mut buffer = Buffer::empty(area);
    panes::draw(Pane::Differences, screen.model(), &Theme::default(), area, &mut buffer);
    screen::to_text(&buffer)
}

/// A recording with goldens that say another value at an event, and have another picture.
fn spoilt() -> (Suite, Screen) {
    let suite = Suite::new();
    suite.change("golden/square/_run.txt", |text| {
        text.replace("event 3 = click rejected miss", "event 3 = click applied")
    });
    let mut screen = suite.screen();
    screen.act(Action::Compare);
    screen.model().focus = Pane::Differences;
    (suite, screen)
}

#[test]
fn both_values_show_in_columns_where_there_is_room_and_below_where_there_is_none() {
    let (_suite, mut screen) = spoilt();
    let wide = shown(&mut screen, 100, 12);
    let lines: Vec<&str> = wide.lines().map(str::trim_end).collect();
    assert_eq!(lines[0], "✗ not as the goldens: 1 values differ");
    let words: Vec<&str> = lines[1].split_whitespace().collect();
    assert_eq!(words, ["3", "✗", "outcome", "click", "applied", "click", "rejected", "miss"]);
    assert!(lines[2].contains("4 ✓ picture cut") && lines[2].ends_with("equal"), "{wide}");
    assert!(
        wide.contains("expected click applied") && wide.contains("found    click rejected miss"),
        "{wide}"
    );
    let small = shown(&mut screen, 38, 8);
    for expected in ["3 ✗ outcome", "expected click applied", "found    click rejected miss"] {
        assert!(small.contains(expected), "{expected} is not in\n{small}");
    }
}

#[test]
fn a_picture_says_how_far_it_is_and_how_far_it_may_be() {
    let (_suite, mut screen) = spoilt();
    screen.model().lists.differences.select(1, 2);
    let text = shown(&mut screen, 80, 10);
    assert!(text.contains("found    equal") && text.contains("at most  tile 0.000"), "{text}");
    assert!(text.contains("(exact)"), "{text}");
}

#[test]
fn there_is_no_size_at_which_it_fails_and_what_was_not_compared_says_so() {
    let (suite, mut screen) = spoilt();
    let mut fresh = suite.screen();
    for (width, height) in [(1, 1), (2, 3), (9, 4), (0, 0), (40, 1), (1, 40)] {
        shown(&mut screen, width, height);
        shown(&mut fresh, width, height);
    }
    assert!(shown(&mut fresh, 100, 4).contains("nothing is compared yet: `compare`"));
}

#[test]
fn rows_are_searched_and_copied_with_both_values() {
    let (_suite, mut screen) = spoilt();
    let texts = texts(screen.model());
    assert_eq!(texts[0], "3\toutcome\tclick applied\tclick rejected miss");
    assert!(texts[1].starts_with("4\tpicture cut\tequal\t"), "{texts:?}");
}
