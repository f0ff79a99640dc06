//! A question that is answered by typing a line.
//!
//! ```text
//! ┌ add a breakpoint ─────────────────────────┐
//! │ rej█                                      │
//! │ such as finding, rejected, MC>0.5         │  or what was wrong with the last answer
//! │ rejected                                  │  what it could be completed to
//! │ rejected=miss                             │
//! └ enter do it · tab complete · esc close ───┘
//! ```

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use super::{Popup, frame};
use crate::tui::edit::Edit;
use crate::tui::text;
use crate::tui::theme::{Role, Theme};

/// What is asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(in crate::tui) enum Question {
    /// The event or stage to go to.
    GoTo,
    /// The text to find.
    Search,
    /// A breakpoint to add.
    Stop,
    /// The run to compare with.
    CompareWith,
    /// The name of a checkpoint.
    Checkpoint,
    /// An event, as it stands in a script.
    Event,
    /// The file to save the recording in.
    Save,
    /// The file to write the picture in.
    SavePicture,
    /// The scene to record on.
    Scene,
}

impl Question {
    /// The question, and an example of an answer.
    fn words(self) -> [&'static str; 2] {
        match self {
            Self::GoTo => [
                "go to an event, or to a stage of it",
                "12 for the event, 12.1 for its first stage, 12.NAME for the stage of that name",
            ],
            Self::Search => ["search the timeline and the tables", "a name, an id or a reason"],
            Self::Stop => [
                "add a breakpoint",
                "finding, rejected, rejected=REASON, COUNTER=NAME, COUNTER=N, STAGE>MILLISECONDS",
            ],
            Self::CompareWith => ["compare with another run's JSON", "other-run.json"],
            Self::Checkpoint => ["set a checkpoint", "a name of its own, such as after-the-second-cut"],
            Self::Event => ["type an event as it stands in a script", r#"{"undo": {}}"#],
            Self::Save => ["save the recording", "recordings/mine.lancet"],
            Self::SavePicture => ["write the picture", "frame.png"],
            Self::Scene => ["record on a scene", "builtin:bust, or a scene's or mesh's file"],
        }
    }

    /// Whether the answer is a file.
    pub(in crate::tui) fn is_file(self) -> bool {
        matches!(self, Self::CompareWith | Self::Save | Self::SavePicture | Self::Scene)
    }
}

/// See the module.
#[derive(Clone, Debug)]
pub(in crate::tui) struct Prompt {
    /// What is asked.
    pub(in crate::tui) question: Question,
    /// The answer so far.
    pub(in crate::tui) edit: Edit,
    /// What was wrong with the last answer.
    pub(in crate::tui) error: Option<String>,
    /// What the answer could be completed to.
    pub(in crate::tui) choices: Vec<String>,
    /// Which of them the answer is, while going through them.
    pub(in crate::tui) chosen: Option<usize>,
    /// How many answers ago the one that is shown was given, and what had been typed before going there.
    pub(in crate::tui) recalled: Option<(usize, String)>,
    /// What was there before, and is again afterwards.
    pub(in crate::tui) under: Option<Box<Popup>>,
}

/// How wide it is, where there is room.
const WIDTH: usize = 72;
/// How many lines of what is said are in view.
const SAID: usize = 4;
/// How many choices are in view.
const CHOICES: usize = 8;

impl Prompt {
    /// Asks a question.
    pub(in crate::tui) fn new(question: Question) -> Self {
        Self {
            question,
            edit: Edit::default(),
            error: None,
            choices: Vec::new(),
            chosen: None,
            recalled: None,
            under: None,
        }
    }

    /// With an answer that only has to be confirmed.
    #[must_use]
    pub(in crate::tui) fn with(mut self, answer: &str) -> Self {
        self.edit.set(answer);
        self
    }

    pub(super) fn wants(&self) -> [usize; 2] {
        let said = text::wrap(&self.said(), WIDTH - 4, SAID).len();
        [WIDTH, 3 + said + self.choices.len().min(CHOICES)]
    }

    pub(super) fn words(&self) -> [String; 2] {
        let [title, _] = self.question.words();
        let tab = if self.question.is_file() || !self.choices.is_empty() { " · tab complete" } else { "" };
        [title.into(), format!("enter do it{tab} · esc close")]
    }

    /// The error, or else the example.
    fn said(&self) -> String {
        let [_, example] = self.question.words();
        match &self.error {
            Some(error) => format!("{} {error}", Role::Bad.mark()),
            None => format!("such as {example}"),
        }
    }

    pub(super) fn draw(&self, theme: &Theme, area: Rect, buffer: &mut Buffer) {
        frame::edit(&self.edit, theme, frame::row(area, 0), buffer);
        let said = if self.error.is_some() { Role::Bad } else { Role::Faint };
        let lines = text::wrap(&self.said(), usize::from(area.width), SAID);
        let from = frame::lines(&lines, theme.style(said), area, 1, buffer);
        let (chosen, room) = (self.chosen.unwrap_or(0), usize::from(area.height).saturating_sub(from));
        let first = (chosen + 1).saturating_sub(room);
        for (row, (at, choice)) in self.choices.iter().enumerate().skip(first).take(room).enumerate() {
            let role = if self.chosen == Some(at) { Role::Selected } else { Role::Text };
            let fitted = text::pad(choice, usize::from(area.width));
            frame::lines(&[fitted], theme.style(role), area, from + row, buffer);
        }
    }
}
