//! For tests: a recording with goldens in a folder of its own, and the screen with what is in it.

use std::path::PathBuf;

use crate::cli::{Console, Status};
use crate::render::Choice;
use crate::tui::action::Action;
use crate::tui::config::Config;
use crate::tui::model::Model;
use crate::tui::theme::Theme;
use crate::tui::worker::Ask;
use crate::tui::{Drafts, Stage, Start, With, update};

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

    /// The screen with the recording open, and all its events run.
    pub(in crate::tui) fn screen(&self) -> Screen {
        self.screen_with(None)
    }

    /// The same, compared at once.
    pub(in crate::tui) fn screen_with(&self, compare: Option<With>) -> Screen {
        let start = Start {
            recording: Some(self.recording().into()),
            renderer: Choice::Reference,
            budget_bytes: 1 << 20,
            drafts: Drafts::default(),
            compare,
            config: Config::default(),
        };
        let stage = Stage::open(&start, Theme::default(), [120, 40], false);
        assert!(stage.model.opened.is_some(), "{:?}", stage.model.message);
        Screen(stage)
    }
}

/// A screen, and all that comes of what is done on it.
pub(in crate::tui) struct Screen(pub(in crate::tui) Stage);

impl Screen {
    pub(in crate::tui) fn model(&mut self) -> &mut Model {
        &mut self.0.model
    }

    /// Does something.
    pub(in crate::tui) fn act(&mut self, action: Action) {
        update::act(&mut self.0.model, action);
        self.0.settle();
    }

    /// Opens another file.
    pub(in crate::tui) fn open(&mut self, path: &str) {
        self.0.model.ask(Ask::Open(path.into()));
        self.0.settle();
    }

    /// What is said in the status line, and whether it is a complaint.
    pub(in crate::tui) fn said(&self) -> (&str, bool) {
        self.0.model.message.as_ref().map_or(("", false), |message| (message.text.as_str(), message.wrong))
    }
}
