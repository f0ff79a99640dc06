//! What users see, cell by cell: the snapshots are read like screenshots, and a change of one is a change of the program's looks.
//!
//! On a light ground the same is said as on a dark one, so only the styles are kept. Without colour pictures are made of characters, so the whole
//! screen is.

use std::path::Path;

use crossterm::event::Event;

use super::opened;
use crate::tui::lower::Depth;
use crate::tui::screen;
use crate::tui::theme::{Base, Theme};
use crate::tui::{Stage, With};

/// Screens, and the keys that lead there.
const SCREENS: [(&str, &str); 10] = [
    ("start", ""),
    ("cut", "l l l"),
    ("stage", "l l s s"),
    ("rejected", "l l l l l l l l"),
    ("help", "?"),
    ("palette", ": s t e p"),
    ("search", "/ u n d o enter"),
    ("breakpoints", "b a r e j e c t e d enter"),
    ("pending", "l l r enter"),
    (DIFFERENCES, "7 j"),
];

/// The screen of a run that is compared with another one.
const DIFFERENCES: &str = "differences";

const LARGE: [u16; 2] = [120, 40];
const USUAL: [u16; 2] = [80, 24];
const SMALL: [u16; 2] = [40, 12];

/// A screen.
fn led(name: &str, keys: &str, theme: Theme, size: [u16; 2]) -> Stage {
    let other = (name == DIFFERENCES).then(|| With::Run("tests/fixtures/screen-other.json".into()));
    let mut stage = opened(Path::new("tests/fixtures/screen.json"), other, theme, size);
    stage.press(keys).expect("keys");
    stage
}

/// It, as text with its styles.
fn styled(stage: &Stage) -> String {
    screen::to_styled(&stage.screen())
}

fn check(name: &str, look: &str, [width, height]: [u16; 2], screen: &str) {
    let mut settings = insta::Settings::clone_current();
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| insta::assert_snapshot!(format!("{name}-{look}-{width}x{height}"), screen));
}

/// All screens, first at one size, and then as they follow the terminal to others.
fn check_all(look: &str, theme: &Theme, sizes: &[[u16; 2]]) {
    for (name, keys) in SCREENS {
        let mut stage = led(name, keys, theme.clone(), USUAL);
        for [width, height] in sizes {
            stage.take(Event::Resize(*width, *height));
            check(name, look, [*width, *height], &styled(&stage));
        }
    }
}

#[test]
fn at_every_size() {
    check_all("dark", &Theme::default(), &[USUAL, LARGE, SMALL]);
}

#[test]
fn without_colour_nothing_is_missing() {
    check_all("plain", &Theme::new(Base::Dark, Depth::None), &[USUAL, SMALL]);
}

#[test]
fn on_a_light_ground_the_same_is_said() {
    for (name, keys) in SCREENS {
        let [dark, light] = [Base::Dark, Base::Light]
            .map(|base| styled(&led(name, keys, Theme::new(base, Depth::Full), USUAL)));
        let [(dark, _), (light, styles)] =
            [&dark, &light].map(|screen| screen.split_once("styles\n").expect("styles"));
        assert_eq!(dark, light);
        check(name, "light", USUAL, styles);
    }
}
