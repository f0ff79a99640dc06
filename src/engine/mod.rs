//! What an engine is: a state, events, and a table of stages.
//!
//! **A stage is a row in a table.** An engine exports its pipeline as rows: a name, what it runs, what it checks, what it changed. The
//! session (`replay`) alone loops over them: clock, run, digest, checks, report. So no stage can forget its time, its digest
//! or its invariants, and any front end shows any engine.
//!
//! An engine knows no front end, file, clock, thread of its own, renderer, nor another engine.

mod input;
pub mod wound;

use std::fmt::Debug;
use std::sync::Arc;

use schemars::JsonSchema;
use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::canvas::frame::{FrameJob, Orbit};
use crate::canvas::job::{Painting, PatchJob};
use crate::mesh::Mesh;
use crate::report::{Buffer, Check, Counters, Outcome, Overlay, Rejection, Table};

pub use input::Input;

/// What the session itself does with an event.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Control<'a> {
    /// The engine's own work.
    Step,
    /// Take the last applied edit back.
    Undo,
    /// Do the last undone edit again.
    Redo,
    /// Digest everything, and render a frame under this name.
    Checkpoint(&'a str),
}

/// One recorded input.
pub trait Event:
    Clone + Debug + PartialEq + Send + Sync + Serialize + DeserializeOwned + JsonSchema + 'static
{
    /// A word for it, such as `cut`.
    fn kind(&self) -> &'static str;
    /// What the session does with it.
    fn control(&self) -> Control<'_>;
    /// What is wrong with the values in it, if anything (not finite, out of range, a name that does not exist).
    fn validate(&self) -> Result<(), String>;
    /// The modes that can be chosen by hand, in the order in which they go further.
    const MODES: &'static [&'static str] = &[];
    /// The event that something done by hand is. None where the engine has no such thing.
    fn by_hand(_input: &Input) -> Option<Self> {
        None
    }
}

/// How an event began.
#[derive(Debug)]
pub enum Start<W> {
    /// It is done: nothing to run through stages.
    Done(Outcome),
    /// It cannot be done.
    Rejected(Rejection),
    /// Work for the stages; a transaction is open until `commit` or `rollback`.
    Run(W),
}

/// Whether a stage takes part in a piece of work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// It runs.
    Run,
    /// It belongs to this kind of work, but is not needed here, for this reason.
    Skip(&'static str),
    /// It does not belong to this kind of work: no row in the report.
    Absent,
}

/// What a stage asks of the renderer. Its time is part of the stage's.
#[derive(Clone, Copy, Debug)]
pub enum Job<'a> {
    /// Make a wound patch.
    Patch(&'a PatchJob),
    /// Paint.
    Paint(&'a Arc<Painting>),
}

/// A row of an engine's table of stages.
#[allow(clippy::type_complexity, reason = "each is one function pointer over the engine's own types")]
pub struct Stage<E: Engine> {
    /// Short name, such as `FC`.
    pub id: &'static str,
    /// Name for people.
    pub title: &'static str,
    /// Whether it takes part in a piece of work.
    pub part: fn(&E::Work) -> Part,
    /// Does it. Only this is timed. An error ends the event, and the session rolls back.
    pub run: fn(&mut E::State, &mut E::Work) -> Result<(), Rejection>,
    /// What the renderer has to do for it, once it ran.
    pub job: fn(&E::Work) -> Option<Job<'_>>,
    /// What it changed, buffer by buffer, in a fixed order.
    pub buffers: fn(&E::State, &E::Work) -> Vec<Buffer>,
    /// Its invariants, looked at around what it touched.
    pub check: fn(&E::State, &E::Work) -> Vec<Check>,
}

/// What there is to show of a piece of work, whether it was done or not.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Shown {
    /// Counts.
    pub counters: Counters,
    /// Tables.
    pub tables: Vec<Table>,
    /// Things to draw.
    pub overlays: Vec<Overlay>,
}

/// A cutting system that the session can drive.
///
/// The state has two parts: the **body** (a mesh, with a journal), which only stages change and patches walk back and forth, and
/// the **control** (camera, mode, a pending click), which is small and copied.
pub trait Engine: Sized + 'static {
    /// Its name in recordings.
    const NAME: &'static str;
    /// Its stages, in the order in which they run.
    const STAGES: &'static [Stage<Self>];
    /// What is recorded.
    type Event: Event;
    /// Everything that a run changes.
    type State: Clone + Send;
    /// The small part of the state.
    type Control: Clone + Send;
    /// One event on its way through the stages.
    type Work: Send;
    /// What a committed piece of work changed in the body.
    type Patch: Send + Sync;

    /// Begins an event of control [`Control::Step`]. `seed` is the hash of the recording's seed and the event's key.
    fn start(state: &mut Self::State, event: &Self::Event, seed: u64) -> Start<Self::Work>;
    /// Told of an undo, redo or checkpoint before the session does it; returns true if that cancels something pending.
    fn interrupt(state: &mut Self::State, event: &Self::Event) -> bool;
    /// Keeps what the stages did.
    fn commit(state: &mut Self::State, work: &mut Self::Work) -> Self::Patch;
    /// Takes back what the stages did, bit for bit.
    fn rollback(state: &mut Self::State, work: &mut Self::Work);
    /// Takes a patch back. Newest first.
    fn revert(state: &mut Self::State, patch: &Self::Patch);
    /// Does a patch again that was taken back.
    fn apply(state: &mut Self::State, patch: &Self::Patch);
    /// What there is to show. Asked while the transaction is still open, before `commit` or `rollback`.
    fn show(state: &Self::State, work: &Self::Work) -> Shown;

    /// The small part of the state.
    fn control(state: &Self::State) -> Self::Control;
    /// Puts the small part of the state back.
    fn set_control(state: &mut Self::State, control: Self::Control);
    /// The mode in force, for reports.
    fn mode(state: &Self::State) -> &'static str;
    /// Every buffer of the whole state, for full digests.
    fn buffers(state: &Self::State) -> Vec<Buffer>;
    /// The invariants of the whole state.
    fn check(state: &Self::State) -> Vec<Check>;
    /// What the body is made of, by name (`faces`, `nodes`, …), in a fixed order. Asked before and after every edit, so it has to be quick.
    fn sizes(_state: &Self::State) -> Vec<(&'static str, u64)> {
        Vec::new()
    }
    /// Counts of the whole state by name (`faces`, `nodes`, `euler`, …), in a fixed order.
    fn counts(state: &Self::State) -> Vec<(&'static str, i64)>;
    /// The surface to show and to export, where the engine has one.
    fn mesh(_state: &Self::State) -> Option<&Mesh> {
        None
    }
    /// What was painted on the maps so far, in order.
    fn paintings(_state: &Self::State) -> &[Arc<Painting>] {
        &[]
    }
    /// Where one looks from, where the engine has a camera.
    fn orbit(_state: &Self::State) -> Option<Orbit> {
        None
    }
    /// Looks from elsewhere, for a picture: what is recorded stays, since the control state is put back after it.
    fn look(_state: &mut Self::State, _orbit: Orbit) {}
    /// The picture to render, where the engine has one. A version names a state of the mesh; with `everything` nothing is skipped.
    fn frame(_state: &Self::State, _version: u64, _everything: bool) -> Option<FrameJob<'_>> {
        None
    }
    /// Whether a piece of work counts as a cut in the sums of a run.
    fn is_cut(_work: &Self::Work) -> bool {
        true
    }
    /// Bytes that the state holds.
    fn state_bytes(state: &Self::State) -> usize;
    /// Bytes that a patch holds.
    fn patch_bytes(patch: &Self::Patch) -> usize;
    /// Plants a defect within the open transaction, as a broken stage would: adds `ulps` to one scalar of an element of a buffer.
    /// An error says why there is no such place.
    fn plant(state: &mut Self::State, buffer: &str, element: u32, ulps: i64) -> Result<(), String>;
}
