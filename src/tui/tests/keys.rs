//! Every key, on every screen: nothing panics, and there is a screen afterwards.
//!
//! A screen is come to anew before each key, by keys; what a key did to the run, the picture or the recording stays, so that the next one finds
//! ever other states. A single key never writes a file: whoever asks for a name is asked for one with a folder that is not there.

use crossterm::event::{Event, KeyCode, KeyEvent, KeyModifiers, MouseButton, MouseEvent, MouseEventKind};

use super::opened;
use super::suite::SQUARE;
use crate::assets;
use crate::tui::screen;
use crate::tui::stage::Stage;
use crate::tui::theme::Theme;
use crate::tui::worker::{Ask, Opened};

/// The keys that lead to each pane.
const PANES: [&str; 7] = ["1", "2", "3", "4", "5", "6", "7"];

/// What lies over the panes: whether something is being recorded then, and the key that opens it.
const POPUPS: [(bool, &str); 12] = [
    (false, "?"),
    (false, ":"),
    (false, "b"),
    (false, "/"),
    (false, "#"),
    (false, "+"),
    (false, "ctrl-o"),
    (false, "ctrl-n"),
    (false, "P"),
    (true, "a"),
    (true, "n"),
    (true, "ctrl-s"),
];

/// Those that write a file when they are answered.
const WRITING: [&str; 2] = ["P", "ctrl-s"];

#[test]
fn every_key_on_a_usual_screen() {
    Typist::new([80, 24]).type_all();
}

#[test]
fn every_key_where_there_is_no_room() {
    for size in [[1, 1], [2, 2], [5, 3]] {
        Typist::new(size).type_all();
    }
}

struct Typist {
    stage: Stage,
    size: [u16; 2],
    folder: tempfile::TempDir,
}

impl Typist {
    fn new(size: [u16; 2]) -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("square.json");
        assets::write_file(&path, SQUARE.as_bytes()).expect("written");
        Self { stage: opened(&path, None, Theme::default(), size), size, folder }
    }

    fn type_all(&mut self) {
        let events = events(self.size);
        let panes = PANES.iter().map(|keys| (false, *keys, false));
        let popups = POPUPS.iter().map(|(recording, keys)| (*recording, *keys, true));
        // Whoever leaves after something was recorded is asked what becomes of it.
        let recorded = [(true, "4", false), (true, "q", true)];
        for (recording, keys, is_popup) in panes.chain(recorded).chain(popups) {
            for event in &events {
                self.come_to(recording, keys, is_popup);
                self.stage.take(event.clone());
                self.assert_drawn(&format!("{keys:?} and then {event:?}"));
            }
        }
    }

    /// Closes what is open, and goes to a screen.
    fn come_to(&mut self, recording: bool, keys: &str, is_popup: bool) {
        self.stage.model().popup = None;
        if self.stage.model().opened.as_ref().is_none_or(|opened| !is_small(opened)) {
            let path = self.folder.path().join("square.json");
            self.stage.model().ask(Ask::Open(path));
            self.stage.settle();
        }
        if self.stage.model().recorder.is_some() != recording {
            self.press("end r");
        }
        self.press(keys);
        assert_eq!(self.stage.model().popup.is_some(), is_popup, "{keys}");
        if WRITING.contains(&keys) {
            let nowhere = self.folder.path().join("no/folder/file").display().to_string();
            self.stage.take(Event::Paste(nowhere));
        }
    }

    fn press(&mut self, keys: &str) {
        self.stage.press(keys).expect("keys");
    }

    fn assert_drawn(&self, what: &str) {
        let text = screen::to_text(&self.stage.screen());
        let [width, height] = self.size.map(usize::from);
        assert_eq!(text.lines().count(), height, "{what}");
        assert!(width < 40 || text.starts_with("lancet"), "{what}:\n{text}");
        // A popup leaves nothing of a screen of a few cells but what it asks for, which is nothing yet.
        assert!(width < 8 || !text.trim().is_empty(), "{what}");
    }
}

/// What can be opened by a key may be large, and every key after that would be slow.
fn is_small(opened: &Opened) -> bool {
    opened.scene.contains("inline") && opened.lines.len() < 40
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
