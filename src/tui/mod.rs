//! The terminal: the same reports that the command line prints, to step through.

pub mod colour;
pub mod config;
pub mod environment;
pub mod key;
pub mod list;
pub mod lower;
pub mod screen;
pub mod terminal;
pub mod text;
pub mod theme;
