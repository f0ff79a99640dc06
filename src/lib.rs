//! lancet: deterministic replay and verification of recorded cuts.
//!
//! # The house
//!
//! | room | what it does |
//! | --- | --- |
//! | [`geometry`] | exact predicates, rays, frames, the bounding volume hierarchy; knows nothing of ours |
//! | [`mesh`] | typed ids, topology, edits, attributes, journal, checks |
//! | [`canvas`] | what can be asked of pixels, as data: jobs, frames, the traits of renderers |
//! | [`assets`] | files: OBJ, glTF, PLY, scenes, the binary cache, the built-in scenes |
//! | [`recording`] | the file format and its JSON script, the reducer |
//! | [`report`] | checks, outcomes, reports: plain data that any front end can show |
//! | [`engine`] | what an engine is; `wound` is one |
//! | [`render`] | who carries out what can be asked of pixels: the CPU reference, the GPU |
//! | [`replay`] | the session: events through stages, clock, digests, checks, journal, keyframes, seek |
//! | [`verify`] | goldens and their pictures: compare, bless, shard and merge, pages |
//! | [`measure`] | time against error, stability, scaling, the thesis's tables |
//! | [`attack`] | what the fuzzers make of bytes, and what must hold for it; the nightly run |
//! | [`cli`] | the command line |
//! | [`tui`] | the terminal: the same reports, to step through, and recordings made by hand |
//!
//! Data flows one way: recording → replay → engine → report → front end. `geometry` and `mesh` lie under the engines. `tests/layers.rs`
//! keeps it: it parses every path, and a room that it does not know fails.
//!
//! # Rules of the house
//!
//! - A stage is a row in a table ([`engine::Stage`]); the session alone loops over them. Digests are per event, stage and buffer.
//! - Topology is decided by exact signs, never by an epsilon. What rounding would collapse is caught exactly, before it happens.
//! - A cut is a transaction: the stages work in an open journal, and are rolled back without a trace or committed together.
//! - Four kinds of failure, never mixed: bad input (a typed error that names file, place and cause), a cut that cannot be made (a
//!   rejection with its reason), a broken invariant or divergence (a finding with culprits), our own bug (an assertion).
//!
//! # Decisions that a reader might look for
//!
//! - **Nothing is ever removed from a mesh.** A split face keeps its id as its first child, a split edge as its first part. Ids stay
//!   valid, undo truncates, and there is no free list to restore.
//! - **The line is a shortest way.** The section of plane and surface is a graph; FC runs Dijkstra over it, which at the usual two
//!   neighbours a place is following both arcs at once until the shorter arrives. Nodes with more branches need no case of their own. The
//!   wedge of the two rays does not bound the arcs: it only says where the shorter one usually is.
//! - **An opening is a displacement field along one direction,** so what folds can be straightened or narrowed as numbers. Where there is
//!   no room at all the line stays closed, and the longest part between such places is opened (counters `narrowed`, `closed`).
//! - **A subdivision is a stage too** (SD), so it has its time, digest and invariants like the rest.
//! - **Maps are a function of a list.** A state holds the paintings that were applied, not their texels; a renderer makes its maps those of exactly that
//!   list, from saved tiles or by painting again. Undo, rejection, seek and keyframes need nothing more, and GP's and PP's digests are those of jobs.
//! - **The skin around a cut is unrolled once,** face by face outward from the line, and painted in those coordinates. The faces under the line go in the
//!   parts that MC will make of them, so that the line is where the patch's middle is to the last digit.
//! - **Painting goes in two steps,** places and then texels, so that a texel is painted once whatever overlaps, and CPU and GPU agree to the byte but
//!   for single roundings. Every filter is written out; none is the hardware's, but for the scattering's colour.
//! - **Positions on a GPU are relative to the model's middle,** not to the eye: then a moved camera uploads nothing.
//! - **The inside of a cut is a formula,** three tissue colours over v, rather than a texture.
//! - **Frames of checkpoints are at most 640 x 360,** in the view's own shape.
//! - **A stop within an event is an open transaction.** The session holds it, so that mesh and pictures are those after a stage; the next step takes it
//!   back first.
//! - **What is done by hand is data** ([`engine::Input`]) until an engine makes an event of it, so that the terminal records for any engine.
//! - **The terminal asks nothing of the terminal.** Which pictures it can show is told by environment and window size: a question would eat keys.
//! - **FC is written twice.** `measure::exact` is a slow one in rational arithmetic that shares nothing with the engine but ids; fuzzers, ladders and error
//!   curves all compare with it.
//! - **A fuzzer's input is bytes, what it stands for a recording,** so that whatever drives it (libFuzzer, a test, the night) finds the same, and a finding opens
//!   in the terminal.
//! - **Instructions are counted by a harness of ours,** since the kept counts come with a reason each, and callgrind needs no library for that.
//! - **Seeking walks patches;** keyframes and re-running take over where the byte budget let patches go.
#![warn(missing_docs)]

pub mod assets;
#[cfg(feature = "attack")]
pub mod attack;
pub mod canvas;
pub mod cli;
pub mod engine;
pub mod geometry;
pub mod measure;
pub mod mesh;
pub mod recording;
pub mod render;
pub mod replay;
pub mod report;
#[cfg(feature = "tui")]
pub mod tui;
pub mod verify;
