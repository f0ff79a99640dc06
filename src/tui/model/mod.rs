//! All that the screen knows. Drawing reads it; only `update` changes it.
//!
//! The reports of the events that have run are all there, so that walking among them shows each at once; the worker follows with mesh and picture.

mod memory;
mod place;
mod timing;

use std::sync::Arc;
use std::time::Duration;

pub(in crate::tui) use memory::Memory;
pub(in crate::tui) use place::{Place, ran};
pub(in crate::tui) use timing::{Spread, Timing};

use crate::canvas::frame::Orbit;
use crate::report::{EventReport, Finding, StateReport, Stop};
use crate::tui::ahead::Ahead;
use crate::tui::compare::{Comparing, Comparisons, Differences};
use crate::tui::list::List;
use crate::tui::picture::PictureState;
use crate::tui::popups::Popup;
use crate::tui::record::{Kept, Recorder};
use crate::tui::worker::{Ask, Opened, Standing};

/// A part of the screen that can be focused.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(in crate::tui) enum Pane {
    /// The events.
    #[default]
    Timeline,
    /// The stages of the event that is shown.
    Stages,
    /// What the state is made of.
    Mesh,
    /// The picture.
    Picture,
    /// The tables of the report.
    Tables,
    /// The invariants.
    Checks,
    /// What is not as in what the run is compared with.
    Differences,
}

impl Pane {
    /// All, in the order of their numbers, which begin at 1.
    pub(in crate::tui) const ALL: [Self; 7] = [
        Self::Timeline,
        Self::Stages,
        Self::Mesh,
        Self::Picture,
        Self::Tables,
        Self::Checks,
        Self::Differences,
    ];

    /// Its title.
    pub(in crate::tui) fn title(self) -> &'static str {
        match self {
            Self::Timeline => "timeline",
            Self::Stages => "stages",
            Self::Mesh => "mesh",
            Self::Picture => "picture",
            Self::Tables => "tables",
            Self::Checks => "invariants",
            Self::Differences => "differences",
        }
    }
}

/// What the program around the screen has to do.
#[derive(Clone, Debug)]
pub(in crate::tui) enum Effect {
    /// Ask the worker.
    Ask(Ask),
    /// Put a text on the clipboard.
    Copy(String),
    /// Go to the background.
    Suspend,
    /// Draw everything anew.
    Redraw,
}

/// Something to say in the status line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(in crate::tui) struct Message {
    /// What.
    pub(in crate::tui) text: String,
    /// Whether something went wrong.
    pub(in crate::tui) wrong: bool,
}

/// How far the worker is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::tui) struct Progress {
    /// What it does.
    pub(in crate::tui) what: &'static str,
    /// How much of it is done.
    pub(in crate::tui) done: usize,
    /// Of how much; 0 where that is not known.
    pub(in crate::tui) of: usize,
}

/// See the module.
#[derive(Default)]
pub(in crate::tui) struct Model {
    /// What is open.
    pub(in crate::tui) opened: Option<Opened>,
    /// The reports of the events that have run, from the first on.
    pub(in crate::tui) reports: Vec<Arc<EventReport>>,
    /// The whole state after the last event.
    pub(in crate::tui) end: Option<StateReport>,
    /// The whole state, where it was last looked at, and where that was.
    pub(in crate::tui) checked: Option<(Place, StateReport)>,
    /// The first broken invariant.
    pub(in crate::tui) finding: Option<Finding>,
    /// The place that is shown.
    pub(in crate::tui) place: Place,
    /// Where the worker is.
    pub(in crate::tui) standing: Option<Standing>,
    /// What the worker does.
    pub(in crate::tui) progress: Option<Progress>,
    /// How often each stage ran, and how long that took.
    pub(in crate::tui) timing: Timing,
    /// What has to be known before the step that was asked for can be made.
    pub(in crate::tui) wanted: Option<crate::tui::action::Action>,
    /// The pause after each event while playing.
    pub(in crate::tui) playing: Option<Duration>,
    /// How fast it plays.
    pub(in crate::tui) pace: Pace,
    /// The breakpoints.
    pub(in crate::tui) stops: Vec<Stop>,
    /// The focused pane.
    pub(in crate::tui) focus: Pane,
    /// Whether it is shown alone.
    pub(in crate::tui) maximised: bool,
    /// The rows that are shown and chosen, by pane.
    pub(in crate::tui) lists: Lists,
    /// Which of the report's tables is shown.
    pub(in crate::tui) table: usize,
    /// The elements that are selected.
    pub(in crate::tui) selected: Vec<String>,
    /// The picture.
    pub(in crate::tui) picture: PictureState,
    /// What it is compared with, and how it differs.
    pub(in crate::tui) differences: Option<Differences>,
    /// The comparison that is being made.
    pub(in crate::tui) comparing: Option<Comparing>,
    /// Those that were begun, and that are to be.
    pub(in crate::tui) comparisons: Comparisons,
    /// The recording that is being made.
    pub(in crate::tui) recorder: Option<Recorder>,
    /// What becomes of what was recorded.
    pub(in crate::tui) kept: Kept,
    /// What lies over the panes.
    pub(in crate::tui) popup: Option<Popup>,
    /// What was done before, and is offered again.
    pub(in crate::tui) memory: Memory,
    /// What was searched for.
    pub(in crate::tui) search: String,
    /// What is said in the status line.
    pub(in crate::tui) message: Option<Message>,
    /// Columns and rows of the screen.
    pub(in crate::tui) size: [u16; 2],
    /// How many urgent things the worker was asked, and how many of them it is done with.
    pub(in crate::tui) asked: u64,
    /// The second of the two.
    pub(in crate::tui) answered: u64,
    /// What was typed while something is being opened.
    pub(in crate::tui) ahead: Ahead,
    /// What is to be done outside.
    pub(in crate::tui) effects: Vec<Effect>,
    /// Whether it is over once the recording is saved.
    pub(in crate::tui) leaving: bool,
    /// Whether it is over.
    pub(in crate::tui) done: bool,
}

/// The pause between two events while playing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::tui) struct Pace(pub(in crate::tui) Duration);

impl Default for Pace {
    fn default() -> Self {
        Self(Duration::from_millis(500))
    }
}

/// A list for each pane that has rows.
#[derive(Clone, Debug, Default)]
pub(in crate::tui) struct Lists {
    pub(in crate::tui) stages: List,
    pub(in crate::tui) timeline: List,
    pub(in crate::tui) mesh: List,
    pub(in crate::tui) tables: List,
    pub(in crate::tui) checks: List,
    pub(in crate::tui) differences: List,
}

impl Lists {
    /// The list of a pane; none of the picture.
    pub(in crate::tui) fn of(&mut self, pane: Pane) -> Option<&mut List> {
        Some(match pane {
            Pane::Timeline => &mut self.timeline,
            Pane::Stages => &mut self.stages,
            Pane::Mesh => &mut self.mesh,
            Pane::Tables => &mut self.tables,
            Pane::Checks => &mut self.checks,
            Pane::Differences => &mut self.differences,
            Pane::Picture => return None,
        })
    }

    /// The same, to look at.
    pub(in crate::tui) fn get(&self, pane: Pane) -> Option<&List> {
        Some(match pane {
            Pane::Timeline => &self.timeline,
            Pane::Stages => &self.stages,
            Pane::Mesh => &self.mesh,
            Pane::Tables => &self.tables,
            Pane::Checks => &self.checks,
            Pane::Differences => &self.differences,
            Pane::Picture => return None,
        })
    }
}

impl Model {
    /// Asks the worker for something.
    pub(in crate::tui) fn ask(&mut self, ask: Ask) {
        self.asked += u64::from(ask.is_urgent());
        if ask.opens() {
            self.ahead.begin(self.asked);
        }
        self.effects.push(Effect::Ask(ask));
    }

    /// Chooses the rows of the place in the timeline and among the stages.
    pub(in crate::tui) fn follow(&mut self) {
        let row = self.place.event().map_or(0, |event| event + 1);
        self.lists.timeline.select(row, self.len() + 1);
        if let Some(row) = self.shown().and_then(|report| self.place.row(report)) {
            self.lists.stages.select(row, usize::MAX);
        }
    }

    /// Says something.
    pub(in crate::tui) fn say(&mut self, text: impl Into<String>) {
        self.message = Some(Message { text: text.into(), wrong: false });
    }

    /// Says that something is wrong.
    pub(in crate::tui) fn complain(&mut self, text: impl Into<String>) {
        self.message = Some(Message { text: text.into(), wrong: true });
    }

    /// How many events there are.
    pub(in crate::tui) fn len(&self) -> usize {
        self.opened.as_ref().map_or(0, |opened| opened.lines.len())
    }

    /// The report of an event that has run.
    pub(in crate::tui) fn report(&self, event: usize) -> Option<&EventReport> {
        self.reports.get(event).map(Arc::as_ref)
    }

    /// The report of the event that is shown.
    pub(in crate::tui) fn shown(&self) -> Option<&EventReport> {
        self.report(self.place.event()?)
    }

    /// A place in a few letters: `12` after twelve events, `12+MC` within the next after a stage.
    pub(in crate::tui) fn name(&self, place: Place) -> String {
        let id = place.stage.and_then(|stage| Some(&self.report(place.events)?.stages.get(stage)?.id));
        id.map_or(place.events.to_string(), |id| format!("{}+{id}", place.events))
    }

    /// Where the worker is, if it is at the place that is shown.
    pub(in crate::tui) fn here(&self) -> Option<&Standing> {
        self.standing.as_ref().filter(|standing| standing.place == self.place)
    }

    /// Where the picture is looked at from.
    pub(in crate::tui) fn orbit(&self) -> Option<Orbit> {
        self.picture.orbit.or(self.standing.as_ref()?.orbit)
    }

    /// Whether an element is among those that are selected.
    pub(in crate::tui) fn is_selected(&self, id: &str) -> bool {
        self.selected.iter().any(|selected| selected == id)
    }

    /// Whether any of some elements is.
    pub(in crate::tui) fn any_selected(&self, ids: &[String]) -> bool {
        ids.iter().any(|id| self.is_selected(id))
    }
}
