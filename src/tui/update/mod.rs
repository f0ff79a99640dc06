//! What happens: keys, the mouse and the worker's words change the model, and nothing else does.
//!
//! A key goes to what lies on top: a popup takes it first; then the actions that count where the focus is; then those that count everywhere.

pub(in crate::tui) mod compare;
mod copy;
mod focus;
#[cfg(test)]
pub(in crate::tui) mod kit;
pub(in crate::tui) mod picture;
pub(in crate::tui) mod popup;
pub(in crate::tui) mod record;
mod search;
mod step;
pub(in crate::tui) mod stops;
mod told;

pub(in crate::tui) use focus::reveal;
pub(in crate::tui) use step::{beat, go};
pub(in crate::tui) use told::told;

use std::path::PathBuf;

use crate::tui::action::Action;
use crate::tui::model::{Effect, Model, Pane};
use crate::tui::popups::{Question, What};
use crate::tui::worker::Ask;

/// Begins: with a recording, or with what could be opened.
pub(in crate::tui) fn begin(model: &mut Model, recording: Option<PathBuf>) {
    match recording {
        Some(path) => model.ask(Ask::Open(path)),
        None => popup::open(model),
    }
    model.ask(Ask::Drafts);
}

/// Does something.
pub(in crate::tui) fn act(model: &mut Model, action: Action) {
    use Action as A;
    match action {
        A::NextEvent
        | A::PreviousEvent
        | A::NextStage
        | A::PreviousStage
        | A::NextCut
        | A::PreviousCut
        | A::NextCheckpoint
        | A::PreviousCheckpoint
        | A::First
        | A::Last
        | A::FirstFinding
        | A::Play
        | A::Faster
        | A::Slower
        | A::RunOn
        | A::Cancel
        | A::Check => step::act(model, action),
        A::Compare | A::NextDivergence => compare::act(model, action),
        A::Select if model.focus == Pane::Differences => compare::act(model, action),
        A::Up
        | A::Down
        | A::PageUp
        | A::PageDown
        | A::Top
        | A::Bottom
        | A::Select
        | A::SelectNothing
        | A::NextTable
        | A::FocusNext
        | A::FocusPrevious
        | A::FocusTimeline
        | A::FocusStages
        | A::FocusMesh
        | A::FocusPicture
        | A::FocusTables
        | A::FocusChecks
        | A::FocusDifferences
        | A::Maximise => focus::act(model, action),
        A::Copy => copy::copy(model),
        A::CopyCommand => copy::command(model),
        A::Search => popup::ask(model, Question::Search),
        A::NextMatch => search::step(model, true),
        A::PreviousMatch => search::step(model, false),
        A::GoTo => popup::ask(model, Question::GoTo),
        A::CompareWith => popup::ask(model, Question::CompareWith),
        A::Record
        | A::RecordNew
        | A::Point
        | A::CrossLeft
        | A::CrossRight
        | A::CrossUp
        | A::CrossDown
        | A::NudgeLeft
        | A::NudgeRight
        | A::NudgeUp
        | A::NudgeDown
        | A::Mode
        | A::Undo
        | A::Redo
        | A::Checkpoint
        | A::Event
        | A::Drop
        | A::Save => record::act(model, action),
        A::Wire
        | A::Lines
        | A::Tint
        | A::Subject
        | A::Split
        | A::SplitLeft
        | A::SplitRight
        | A::OrbitLeft
        | A::OrbitRight
        | A::OrbitUp
        | A::OrbitDown
        | A::Nearer
        | A::Farther
        | A::ZoomIn
        | A::ZoomOut
        | A::PanLeft
        | A::PanRight
        | A::PanUp
        | A::PanDown
        | A::ResetView
        | A::SaveFrame => picture::act(model, action),
        A::Suspend => model.effects.push(Effect::Suspend),
        A::Redraw => model.effects.push(Effect::Redraw),
        A::Stops => popup::choose(model, What::Stops),
        A::Open => popup::open(model),
        A::Help => popup::choose(model, What::Help),
        A::Palette => popup::choose(model, What::Palette),
        A::Quit => popup::quit(model),
        A::Leave => model.done = true,
    }
}
