//! Recording on the desk: what is done by hand goes into the recording, into its draft, and through the replay, in this order, so that what
//! breaks the program is kept too.
//!
//! Nothing here is interrupted: an input that was given is recorded, whatever is wanted next.

use std::path::Path;

use super::ask::{Hand, Recorded, Told};
use super::desk::{Line, Open};
use crate::recording::{AnyRecording, ENGINES, SceneRef};
use crate::replay::{self, Case, Input};
use crate::tui::model::Place;
use crate::tui::record::{Drafts, Slot};

/// What is kept of a recording that is being made.
#[derive(Debug, Default)]
pub(super) struct Making {
    /// Its draft.
    slot: Slot,
    /// How many events are a copy of what is kept elsewhere. Nothing is lost with them.
    copied: usize,
    /// Whether there is anything that is not in a file of the user's.
    unsaved: bool,
    /// Whether it is a file of the user's, as it was when it was saved.
    filed: bool,
}

/// A recording of nothing yet.
pub(super) fn begin(scene: SceneRef, viewport: [u32; 2]) -> Result<Case, String> {
    let recording = AnyRecording::begin(ENGINES[0], scene, viewport)?;
    Case::new(recording, Path::new("")).map_err(|error| error.to_string())
}

impl Making {
    /// One that goes on with a draft.
    pub(super) fn taking_up(slot: Slot) -> Self {
        Self { slot, unsaved: true, ..Self::default() }
    }

    /// Its draft.
    pub(super) fn slot(&self) -> &Slot {
        &self.slot
    }
}

impl Open {
    /// Tells that this is being recorded, as it is; `begins` where it was just opened for that.
    pub(super) fn tell_recording(&mut self, begins: bool, line: &mut dyn Line) {
        let unsaved = self.making.get_or_insert_default().unsaved;
        let kept = self.case.recording.event_count();
        line.tell(Told::Recorded(Box::new(Recorded { kept, begins, unsaved, ..Recorded::default() })));
    }

    /// Goes on from after some events. What is made already is gone on with, if nothing of it is dropped.
    pub(super) fn go_on(&mut self, events: usize, line: &mut dyn Line) -> Result<(), String> {
        let events = events.min(self.replay.len());
        if events < self.replay.len() || self.making.is_none() {
            self.making = Some(Making { copied: events, ..Making::default() });
        }
        self.cut_off(events, line);
        self.tell_recording(false, line);
        self.stand(line);
        Ok(())
    }

    /// Records something at the end, runs it, and stands after it.
    pub(super) fn record(&mut self, hand: Hand, drafts: &Drafts, line: &mut dyn Line) -> Result<(), String> {
        let kept = self.replay.len();
        self.run_out(line);
        let pointed = match hand {
            Hand::Point { at, .. } => Some(at),
            _ => None,
        };
        for input in self.inputs(hand)? {
            if let Err(why) = self.append(&input) {
                self.cut_off(kept, line);
                return Err(why);
            }
        }
        let lines = self.case.recording.event_lines().split_off(kept);
        let drafted = self.changed(Recorded { kept, lines, pointed, ..Recorded::default() }, drafts, line);
        self.run_out(line);
        self.stand(line);
        drafted
    }

    /// Drops the last event.
    pub(super) fn drop_last(&mut self, drafts: &Drafts, line: &mut dyn Line) -> Result<(), String> {
        let kept = self.replay.len().checked_sub(1).ok_or("there is no event to drop")?;
        self.cut_off(kept, line);
        let drafted = self.changed(Recorded { kept, ..Recorded::default() }, drafts, line);
        self.stand(line);
        drafted
    }

    /// Saves it. From then on it is that file's.
    pub(super) fn save(&mut self, path: &Path, line: &mut dyn Line) -> Result<(), String> {
        let case = &mut self.case;
        case.recording =
            replay::save(&case.recording, &case.folder, path).map_err(|error| error.to_string())?;
        case.folder = path.parent().unwrap_or(Path::new("")).to_owned();
        line.tell(Told::Saved(path.to_owned()));
        match &mut self.making {
            Some(making) => {
                (making.unsaved, making.filed, making.copied) = (false, true, self.replay.len());
                making.slot.clear()
            }
            None => Ok(()),
        }
    }

    /// Writes the draft again, if it is gone while what is in it is in no other file.
    pub(super) fn keep(&mut self, drafts: &Drafts) -> Result<(), String> {
        let Open { making, case, .. } = self;
        match making.as_mut().filter(|making| making.unsaved && making.slot.is_taken()) {
            Some(making) => drafts.write(&mut making.slot, &case.recording, &case.folder),
            None => Ok(()),
        }
    }

    /// The events that something done by hand is, in the state as it is now.
    fn inputs(&self, hand: Hand) -> Result<Vec<Input>, String> {
        Ok(match hand {
            Hand::Point { at, from } => {
                let look = from.filter(|from| self.replay.orbit() != Some(*from)).map(Input::Look);
                look.into_iter().chain([Input::Point(at)]).collect()
            }
            Hand::NextMode => {
                let modes = self.case.recording.modes();
                let now = modes.iter().position(|mode| *mode == self.replay.mode());
                let next = modes.get(now.map_or(0, |now| (now + 1) % modes.len()));
                vec![Input::Mode((*next.ok_or("this engine has no modes")?).into())]
            }
            Hand::Other(input) => vec![input],
        })
    }

    /// Recording and replay take the same, or neither does.
    fn append(&mut self, input: &Input) -> Result<(), String> {
        let key = self.case.recording.append(input)?;
        self.replay.append(key, input)
    }

    /// Drops all events but the first few, from recording and replay alike, and stands after them at the latest.
    fn cut_off(&mut self, events: usize, line: &mut dyn Line) {
        self.case.recording.truncate(events);
        self.within = None;
        self.replay.truncate(events);
        self.told = self.told.min(events);
        self.found = self.replay.finding().is_some();
        self.ended = false;
        self.run_out(line);
    }

    /// Runs everything that has not run, and stands at the end.
    fn run_out(&mut self, line: &mut dyn Line) {
        let end = self.replay.len();
        self.within = None;
        self.replay.seek(self.told.min(end));
        while self.replay.step().is_some() {
            self.tell_news(line);
            line.tell(Told::Progress { what: "running", done: self.told, of: end });
        }
        self.place = Place::after(end);
    }

    /// Tells of a change, and keeps the recording as a draft. An error says that it is not kept, which stops nothing.
    fn changed(&mut self, recorded: Recorded, drafts: &Drafts, line: &mut dyn Line) -> Result<(), String> {
        let making = self.making.get_or_insert_default();
        let left = recorded.kept + recorded.lines.len();
        making.copied = making.copied.min(recorded.kept);
        // A copy of which nothing new is left needs no draft.
        let nothing_new = left <= making.copied;
        making.unsaved = making.filed || !nothing_new;
        line.tell(Told::Recorded(Box::new(Recorded { unsaved: making.unsaved, ..recorded })));
        let Open { making, case, .. } = self;
        let slot = &mut making.get_or_insert_default().slot;
        if nothing_new { slot.clear() } else { drafts.write(slot, &case.recording, &case.folder) }
    }
}
