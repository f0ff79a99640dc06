//! The session: recorded events through an engine's stages, with clock, digests, checks, undo, keyframes and seek.
//!
//! A [`Session`] knows its engine by type and loops over the rows of its stage table. Front ends and `verify` see it as a
//! [`Replay`], and know no engine by name.
//!
//! **Order of an event.** The engine begins it; each stage that takes part runs (only that is timed), gives its changed buffers to be
//! digested, then is checked; a rejection rolls everything back, else the work is committed as a patch. A broken invariant is
//! a finding: the first one is latched, and the replay goes on.
//!
//! **Seek.** The state before any event is reached by walking patches, or by running again from the nearest keyframe; both give the
//! bits that linear replay gives. What is kept for it lies under a byte budget; with none at all, seeking runs again
//! from the first state, which undoing everything always gives back.
//!
//! **Pixels.** A session may be given a renderer. Then a stage's job is carried out within the stage's time, a checkpoint has a frame, and the
//! maps follow undo and seek, by the list of paintings that is part of the state. Without one nothing but the pictures is missing: digests are those of
//! the jobs.

mod digest;
mod open;
mod pixels;
mod save;
mod session;
mod stages;
#[cfg(test)]
mod tests;
mod timeline;
#[cfg(test)]
pub(crate) mod toy;

pub use crate::engine::Input;
pub use digest::event_seed;
pub use open::{Case, OpenError, open, open_file, read, scene_at, wound_scene};
pub use save::{SaveError, require_form, save};
pub use session::Session;
pub use stages::{Plant, Planting};

use crate::canvas::RenderError;
use crate::canvas::frame::{Frame, Orbit, View};
use crate::canvas::image::{Image, MapId};
use crate::mesh::Mesh;
use crate::report::{EventDelta, EventReport, Finding, RunReport, StateReport};

/// How a recording is replayed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Options {
    /// The whole state's invariants are looked at every this many applied edits; 0 only at checkpoints and at the end.
    pub check_every: usize,
    /// Digests and checks the whole state after every event.
    pub paranoid: bool,
    /// Bytes that patches and keyframes may take, beside what undo and redo need; 0 runs again for every seek.
    pub budget_bytes: usize,
    /// Keeps the buffers that the stages changed, for [`Replay::take_deltas`].
    pub keep_deltas: bool,
    /// A defect to plant, to see that it is found.
    pub plant: Option<Plant>,
    /// Skips nothing of what pixels take: maps are painted and frames rendered in full, whether they are needed or not.
    pub everything: bool,
    /// Pictures will be asked for, at no checkpoint: [`Replay::shoot`] and [`Replay::map`].
    pub pictures: bool,
}

/// The largest frame of a checkpoint: larger views are rendered smaller, in their own shape.
pub const CHECKPOINT_SIZE: [u32; 2] = [640, 360];

/// A picture to take of the state as it is now.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Shot {
    /// Where to look from, if not from where the recording does.
    pub orbit: Option<Orbit>,
    /// What it is no larger than: larger views are rendered smaller, in their own shape.
    pub limit: Option<[u32; 2]>,
}

/// A checkpoint's frame.
#[derive(Clone, Debug, PartialEq)]
pub struct CheckpointFrame {
    /// The event.
    pub event: usize,
    /// The checkpoint's name.
    pub name: String,
    /// The frame.
    pub frame: Frame,
    /// The colour behind the model, as it is in the picture.
    pub background: [u8; 4],
}

impl Default for Options {
    fn default() -> Self {
        Self {
            check_every: 0,
            paranoid: false,
            budget_bytes: 256 << 20,
            keep_deltas: false,
            plant: None,
            everything: false,
            pictures: false,
        }
    }
}

/// A recording being replayed, whatever its engine.
pub trait Replay: Send {
    /// The engine's name.
    fn engine(&self) -> &'static str;
    /// The engine's stages: short name and title, in order.
    fn stages(&self) -> Vec<(&'static str, &'static str)>;
    /// How many events there are.
    fn len(&self) -> usize;
    /// Whether there is no event.
    fn is_empty(&self) -> bool {
        self.len() == 0
    }
    /// The state is the one before this event; `len` at the end.
    fn position(&self) -> usize;
    /// Runs the next event. None at the end.
    fn step(&mut self) -> Option<&EventReport>;
    /// Goes back to before the last event. False at the beginning.
    fn back(&mut self) -> bool;
    /// Goes to the state before an event, or to the end.
    fn seek(&mut self, event: usize) {
        self.seek_while(event, &mut |_| true);
    }
    /// The same, for as long as it is told to go on: asked with the position after every event on the way. False where it was stopped, at
    /// whatever event that was.
    fn seek_while(&mut self, event: usize, go_on: &mut dyn FnMut(usize) -> bool) -> bool;
    /// Runs an event up to and including a stage, and stays there: mesh and pictures are those within the event, until the next step, seek
    /// or hold, which takes it back first. An error says why there is no such place.
    fn hold(&mut self, event: usize, stage: &str) -> Result<EventReport, String>;
    /// Takes back what is held.
    fn release(&mut self);
    /// Adds what was done by hand to the end of the recording, under a key of its own. From then on nothing is an end: the whole state is looked
    /// at when that is asked for.
    fn append(&mut self, key: u32, input: &Input) -> Result<(), String>;
    /// Drops all events but the first few.
    fn truncate(&mut self, events: usize);
    /// The report of an event that was run.
    fn event(&self, index: usize) -> Option<&EventReport>;
    /// The whole state after the last event, once that was reached.
    fn end(&self) -> Option<&StateReport>;
    /// The first broken invariant.
    fn finding(&self) -> Option<&Finding>;
    /// The report of the run as far as it has gone, under the recording's name.
    fn run_report(&self, recording: &str) -> RunReport;
    /// Digests, counts and checks the whole state as it is now.
    fn state(&self) -> StateReport;
    /// The surface as it is now.
    fn mesh(&self) -> Option<&Mesh>;
    /// What the stages changed since this was last asked, event by event. Only events that were run, not walked, have any.
    fn take_deltas(&mut self) -> Vec<EventDelta>;
    /// What became of the defect to plant.
    fn planting(&self) -> &Planting;
    /// What the state is made of now, by name: what can be told quickly.
    fn sizes(&self) -> Vec<(&'static str, u64)>;
    /// Where the recording looks from now, where the engine has a camera.
    fn orbit(&self) -> Option<Orbit>;
    /// The mode in force.
    fn mode(&self) -> &'static str;
    /// Bytes that are kept for seeking, beside what undo and redo need.
    fn kept_bytes(&self) -> usize;
    /// Renders the state as it is now. None without a renderer.
    fn shoot(&mut self, shot: &Shot) -> Option<(Frame, View)>;
    /// A map as it is now. None without a renderer.
    fn map(&mut self, map: MapId) -> Option<Image>;
    /// The frames of the checkpoints that were run since this was last asked.
    fn take_frames(&mut self) -> Vec<CheckpointFrame>;
    /// Why the renderer was let go of.
    fn failure(&self) -> Option<&RenderError>;
    /// Runs all events that are left.
    fn finish(&mut self) {
        while self.step().is_some() {}
    }
}
