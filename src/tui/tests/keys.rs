//! Every key, on every screen: nothing panics, and there is a screen afterwards.
//!
//! A screen is come to anew before each key, by keys; what a key did to the run, the picture or the recording stays, so that the next one finds
//! ever other states. A single key never writes a file: whoever asks for a name is asked for one with a folder that is not there.

use std::path::Path;

use crossterm::event::{Event, KeyCode, KeyEvent, KeyModifiers, MouseButton, MouseEvent, MouseEventKind};

use super::opened;
use crate::tui::screen;
use crate::tui::stage::Stage;
use crate::tui::theme::Theme;

/// A recording of a square that is cut once, then missed.
const SQUARE: &str = r#"{ "version": 1, "viewport": [16, 16], "seed": 3,
    "scene": { "inline": { "nodes": [[0, 0, 0], [4, 0, 0], [4, 4, 0], [0, 4, 0]], "faces": [[0, 1, 2], [0, 2, 3]] } },
    "events": [ { "mode": "merge" }, { "click": [7, 6] }, { "click": [10, 9] }, { "click": [0.5, 0.5] },
                { "checkpoint": "end" } ] }"#;

/// Screens: whether something is being recorded there, and the keys that lead there.
const SCREENS: [(bool, &str); 18] = [
    (false, "1"),
    (false, "2"),
    (false, "3"),
    (false, "4"),
    (false, "5"),
    (false, "6"),
    (false, "7"),
    (false, "?"),
    (false, ":"),
    (false, "b"),
    (false, "/"),
    (false, "#"),
    (false, "+"),
    (false, "ctrl-o"),
    (false, "ctrl-n"),
    (true, "4"),
    (true, "a"),
    (true, "n"),
];

/// Screens where a name is asked for, under which something is written.
const WRITING: [(bool, &str); 2] = [(true, "ctrl-s"), (false, "P")];

#[test]
fn every_key_on_every_screen() {
    for size in [[80, 24], [1, 1], [2, 2], [5, 3]] {
        type_all(size);
    }
}

fn type_all(size: [u16; 2]) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("square.json");
    crate::assets::write_file(&path, SQUARE.as_bytes()).expect("written");
    let mut stage = opened(Path::new(&path), Theme::default(), size);
    let nowhere = Event::Paste(folder.path().join("no/folder/file").display().to_string());
    let events = events(size);
    for (recording, keys) in SCREENS.into_iter().chain(WRITING) {
        for event in &events {
            come_to(&mut stage, recording, keys);
            if WRITING.contains(&(recording, keys)) {
                stage.take(nowhere.clone());
            }
            stage.take(event.clone());
            assert_drawn(&mut stage, size, &format!("{keys:?} and then {event:?}"));
        }
    }
}

/// Closes what is open, and goes to a screen.
fn come_to(stage: &mut Stage, recording: bool, keys: &str) {
    stage.model().popup = None;
    if stage.model().recorder.is_some() != recording {
        stage.press("r").expect("a key");
    }
    stage.press(keys).expect("keys");
}

fn assert_drawn(stage: &mut Stage, [width, height]: [u16; 2], what: &str) {
    let text = screen::to_text(&stage.screen());
    assert_eq!(stage.model().size, [width, height], "{what}");
    assert_eq!(text.lines().count(), usize::from(height), "{what}");
    assert!(width < 40 || text.starts_with("lancet"), "{what}:\n{text}");
}

/// Every key with every modifier that terminals send with it; the mouse in all corners; a text that is pasted.
fn events(size: [u16; 2]) -> Vec<Event> {
    let modifiers = (0..8).map(KeyModifiers::from_bits_truncate);
    let named = modifiers.flat_map(|modifiers| named().map(move |code| KeyEvent::new(code, modifiers)));
    let characters = (' '..='~').chain(['é', '界', '\u{301}', '\u{7f}']).flat_map(|character| {
        let modifiers = [KeyModifiers::NONE, KeyModifiers::CONTROL, KeyModifiers::ALT];
        modifiers.map(|modifiers| KeyEvent::new(KeyCode::Char(character), modifiers))
    });
    let pasted = Event::Paste("two lines\n\u{1b}[2J界".into());
    named.chain(characters).map(Event::Key).chain(mouse(size)).chain([pasted, Event::FocusLost]).collect()
}

fn named() -> impl Iterator<Item = KeyCode> {
    use KeyCode as K;
    let arrows = [K::Left, K::Right, K::Up, K::Down, K::Home, K::End, K::PageUp, K::PageDown];
    let others = [K::Enter, K::Esc, K::Tab, K::BackTab, K::Backspace, K::Delete, K::Insert, K::Null, K::Menu];
    arrows.into_iter().chain(others).chain((1..=12).map(K::F))
}

fn mouse([width, height]: [u16; 2]) -> Vec<Event> {
    use MouseEventKind as M;
    let kinds = [
        M::Down(MouseButton::Left),
        M::Drag(MouseButton::Left),
        M::Up(MouseButton::Left),
        M::Down(MouseButton::Right),
        M::Moved,
        M::ScrollUp,
        M::ScrollDown,
    ];
    let rows = [0, height / 2, height - 1, u16::MAX];
    let columns = [0, width / 2, width - 1, u16::MAX];
    let places = rows.into_iter().flat_map(|row| columns.map(|column| [column, row]));
    let events = places.flat_map(|[column, row]| {
        kinds.map(|kind| MouseEvent { kind, column, row, modifiers: KeyModifiers::NONE })
    });
    events.map(Event::Mouse).collect()
}
