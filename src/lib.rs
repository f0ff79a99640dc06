//! lancet: deterministic replay and verification of recorded cuts.
//!
//! # The house
//!
//! | room | what it does |
//! | --- | --- |
//! | [`geometry`] | exact predicates, rays, frames, the bounding volume hierarchy; knows nothing of ours |
//! | [`mesh`] | typed ids, topology, edits, attributes, journal, checks |
//! | [`assets`] | files: OBJ, glTF, PLY, scenes, the binary cache, the built-in scenes |
//! | [`recording`] | the file format and its JSON script, the reducer |
//! | [`report`] | checks, outcomes, reports: plain data that any front end can show |
//! | [`engine`] | what an engine is; `wound` is one |
//! | [`replay`] | the session: events through stages, clock, digests, checks, journal, keyframes, seek |
//! | [`verify`] | goldens: compare, bless |
//! | [`measure`] | time against error, stability, scaling, the thesis's tables |
//! | [`cli`] | the command line |
//!
//! Data flows one way: recording → replay → engine → report → front end. `tests/layers.rs` keeps it.
#![warn(missing_docs)]

pub mod assets;
pub mod cli;
pub mod engine;
pub mod geometry;
pub mod measure;
pub mod mesh;
pub mod recording;
pub mod replay;
pub mod report;
pub mod verify;
