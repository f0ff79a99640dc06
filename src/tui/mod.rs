//! The terminal: recorded cuts, stepped through, looked at and made.
//!
//! **State, update, view.** The `model` is all that the screen knows; keys, the mouse and the worker change it in `update` and nowhere else; `view`
//! draws it, and draws nothing else. What can be done is a row in the table of `action`, from which come keys, help, palette and the commands that do
//! the same. So a test can type every key and look at every screen without a terminal, and with a worker that does one thing after the other.
//!
//! **Long work is elsewhere.** The `worker` has the replay and its renderer on a thread of its own, and the pictures are encoded on another: the
//! screen never waits for a cut. Reports of events that have run stay in the model, so walking among them shows each at once, and mesh and
//! picture follow.
//!
//! It shows any engine by its reports, and knows none by name.

mod action;
mod ahead;
pub mod colour;
mod command;
mod compare;
pub mod config;
mod edit;
pub mod environment;
mod events;
mod fuzzy;
pub mod image;
pub mod key;
mod keys;
pub mod list;
pub mod lower;
mod model;
mod panes;
mod picture;
mod popups;
mod record;
mod run;
pub mod screen;
mod shot;
mod stage;
mod status;
mod tabs;
pub mod terminal;
#[cfg(test)]
mod tests;
pub mod text;
pub mod theme;
mod update;
mod view;
mod worker;

pub use compare::With;
pub use record::Drafts;
pub use run::{Start, run};
pub use stage::Stage;

/// All actions, as the configuration gives them keys.
pub fn actions() -> Vec<config::Known> {
    action::ACTIONS.iter().map(|row| config::Known { name: row.name, scope: row.scope as usize }).collect()
}
