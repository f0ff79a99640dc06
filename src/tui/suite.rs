//! For tests: a recording with goldens in a folder of its own, and the screen and the worker's desk with it, one thing after the other.

use std::path::PathBuf;

use crate::cli::{Console, Status};
use crate::render::Choice;
use crate::tui::action::Action;
use crate::tui::model::{Effect, Model};
use crate::tui::update;
use crate::tui::worker::{Ask, Desk, Line, Told};

/// A square of two triangles with texture coordinates, cut by two clicks, missed by a third, and cut back.
pub(in crate::tui) const SQUARE: &str = r#"{ "version": 1, "viewport": [100, 100], "seed": 3,
  "scene": { "inline": { "nodes": [[0, 0, 0], [4, 0, 0], [4, 4, 0], [0, 4, 0]], "faces": [[0, 1, 2], [0, 2, 3]],
                         "uv": [[0, 0], [1, 0], [1, 1], [0, 1]] } },
  "events": [ { "mode": "merge" }, { "click": [45, 40] }, { "click": [60, 55] }, { "click": [0.5, 0.5] },
              { "checkpoint": "cut" }, { "undo": {} } ] }"#;

/// Runs the program; its status, answer and complaints.
pub(in crate::tui) fn lancet(arguments: &[&str]) -> (Status, String, String) {
    let (mut out, mut err) = (Vec::new(), Vec::new());
    let words = ["lancet"].iter().chain(arguments).map(Into::into);
    let status = crate::cli::run(words, &mut Console::plain(&mut out, &mut err));
    (status, String::from_utf8(out).expect("text"), String::from_utf8(err).expect("text"))
}

/// A folder with `recordings/square.lancet` and its goldens.
pub(in crate::tui) struct Suite(tempfile::TempDir);

impl Suite {
    pub(in crate::tui) fn new() -> Self {
        let suite = Self(tempfile::tempdir().expect("a folder"));
        std::fs::write(suite.at("square.json"), SQUARE).expect("written");
        suite.does(&["pack", &suite.text("square.json"), "-o", &suite.recording()]);
        suite.does(&["bless", &suite.recording(), "--reason", "a test"]);
        suite
    }

    pub(in crate::tui) fn at(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub(in crate::tui) fn text(&self, name: &str) -> String {
        self.at(name).to_str().expect("a plain path").to_owned()
    }

    pub(in crate::tui) fn recording(&self) -> String {
        self.text("recordings/square.lancet")
    }

    /// Runs the program, which has to manage.
    #[track_caller]
    fn does(&self, arguments: &[&str]) {
        let (status, _, err) = lancet(arguments);
        assert_eq!((status, err.as_str()), (Status::Verified, ""), "{arguments:?}");
    }

    /// Changes a file of text.
    pub(in crate::tui) fn change(&self, name: &str, change: impl FnOnce(String) -> String) {
        let text = std::fs::read_to_string(self.at(name)).expect("it is there");
        let changed = change(text.clone());
        assert_ne!(changed, text, "{name} is as it was");
        std::fs::write(self.at(name), changed).expect("written");
    }
}

/// The screen, with the worker's desk beside it.
pub(in crate::tui) struct Screen {
    pub(in crate::tui) model: Model,
    desk: Desk,
}

/// What the desk told.
#[derive(Default)]
struct Heard(Vec<Told>);

impl Line for Heard {
    fn tell(&mut self, told: Told) {
        self.0.push(told);
    }

    fn is_interrupted(&mut self) -> bool {
        false
    }

    fn is_wanted(&mut self) -> bool {
        false
    }
}

impl Screen {
    /// With a file open, and all its events run.
    pub(in crate::tui) fn with(path: &str) -> Self {
        let model = Model { size: [120, 40], ..Model::default() };
        let mut screen = Self { model, desk: Desk::new(Choice::Reference, 1 << 20) };
        screen.model.ask(Ask::Open(path.into()));
        screen.settle();
        assert!(screen.model.opened.is_some(), "{:?}", screen.model.message);
        screen
    }

    /// Does something, and all that comes of it.
    pub(in crate::tui) fn act(&mut self, action: Action) {
        update::act(&mut self.model, action);
        self.settle();
    }

    /// Does what was asked, until nothing is left to do.
    pub(in crate::tui) fn settle(&mut self) {
        while !self.model.effects.is_empty() {
            for effect in std::mem::take(&mut self.model.effects) {
                let Effect::Ask(ask) = effect else { continue };
                let mut heard = Heard::default();
                self.desk.handle(ask, &mut heard);
                heard.0.into_iter().for_each(|told| update::told(&mut self.model, told));
            }
        }
    }

    /// What is said in the status line, and whether it is a complaint.
    pub(in crate::tui) fn said(&self) -> (&str, bool) {
        self.model.message.as_ref().map_or(("", false), |message| (message.text.as_str(), message.wrong))
    }
}
