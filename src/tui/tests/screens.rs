//! What users see, cell by cell: the snapshots are read like screenshots, and a change of one is a change of the program's looks.
//!
//! On a light ground the same is said as on a dark one, so only the styles are kept. Without colour pictures are made of characters, so the whole
//! screen is.

use std::path::Path;

use super::opened;
use crate::tui::lower::Depth;
use crate::tui::screen;
use crate::tui::theme::{Base, Theme};

/// Screens, and the keys that lead there.
const SCREENS: [(&str, &str); 4] =
    [("start", ""), ("cut", "l l l"), ("stage", "l l s s"), ("rejected", "l l l l l l l l")];

const LARGE: [u16; 2] = [120, 40];
const USUAL: [u16; 2] = [80, 24];
const SMALL: [u16; 2] = [40, 12];

/// A screen, as text with its styles.
fn styled(keys: &str, theme: Theme, size: [u16; 2]) -> String {
    let mut stage = opened(Path::new("tests/fixtures/screen.json"), theme, size);
    stage.press(keys).expect("keys");
    screen::to_styled(&stage.screen())
}

fn check(name: &str, look: &str, [width, height]: [u16; 2], screen: &str) {
    let mut settings = insta::Settings::clone_current();
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| insta::assert_snapshot!(format!("{name}-{look}-{width}x{height}"), screen));
}

fn check_all(look: &str, theme: &Theme, size: [u16; 2]) {
    for (name, keys) in SCREENS {
        check(name, look, size, &styled(keys, theme.clone(), size));
    }
}

#[test]
fn dark_and_large() {
    check_all("dark", &Theme::default(), LARGE);
}

#[test]
fn dark_and_usual() {
    check_all("dark", &Theme::default(), USUAL);
}

#[test]
fn dark_and_small() {
    check_all("dark", &Theme::default(), SMALL);
}

#[test]
fn without_colour_nothing_is_missing() {
    for size in [USUAL, SMALL] {
        let plain = Theme::new(Base::Dark, Depth::None);
        check_all("plain", &plain, size);
    }
}

#[test]
fn on_a_light_ground_the_same_is_said() {
    for (name, keys) in SCREENS {
        let dark = styled(keys, Theme::default(), USUAL);
        let light = styled(keys, Theme::new(Base::Light, Depth::Full), USUAL);
        let [(dark, _), (light, styles)] =
            [&dark, &light].map(|screen| screen.split_once("styles\n").expect("styles"));
        assert_eq!(dark, light);
        check(name, "light", USUAL, styles);
    }
}
