//! Panes and their rows: which is focused, which row is chosen, what that selects.
//!
//! Choosing a row selects nothing by itself: only `select` does, and what is selected then shows everywhere, until something else is.

use crate::tui::action::Action;
use crate::tui::list::List;
use crate::tui::model::{Model, Pane};
use crate::tui::{panes, view};

pub(super) fn act(model: &mut Model, action: Action) {
    match action {
        Action::Up => rows(model, |list, len, _| list.up(1, len)),
        Action::Down => rows(model, |list, len, _| list.down(1, len)),
        Action::PageUp => rows(model, |list, len, page| list.up(page, len)),
        Action::PageDown => rows(model, |list, len, page| list.down(page, len)),
        Action::Top => rows(model, |list, _, _| list.top()),
        Action::Bottom => rows(model, |list, len, _| list.bottom(len)),
        Action::Select => select(model),
        Action::SelectNothing => model.selected.clear(),
        Action::NextTable => panes::next_table(model),
        Action::FocusNext => cycle(model, 1),
        Action::FocusPrevious => cycle(model, Pane::ALL.len() - 1),
        Action::FocusTimeline => model.focus = Pane::Timeline,
        Action::FocusStages => model.focus = Pane::Stages,
        Action::FocusMesh => model.focus = Pane::Mesh,
        Action::FocusPicture => model.focus = Pane::Picture,
        Action::FocusTables => model.focus = Pane::Tables,
        Action::FocusChecks => model.focus = Pane::Checks,
        Action::FocusDifferences => model.focus = Pane::Differences,
        _ => model.maximised = !model.maximised,
    }
}

fn cycle(model: &mut Model, by: usize) {
    model.focus = Pane::ALL[(model.focus as usize + by) % Pane::ALL.len()];
}

/// Chooses another row in the focused pane.
fn rows(model: &mut Model, choose: impl FnOnce(&mut List, usize, usize)) {
    let (pane, len) = (model.focus, panes::len(model, model.focus));
    let page = List::page(height(model, pane));
    if let Some(list) = model.lists.of(pane) {
        choose(list, len, page);
    }
    panes::chosen(model, pane);
}

/// Selects what the chosen row is about.
fn select(model: &mut Model) {
    let ids = panes::ids(model, model.focus);
    if ids.is_empty() {
        return model.say("this row names no elements");
    }
    let mut selected: Vec<String> = Vec::new();
    // In the order of the row, each once.
    ids.into_iter().for_each(|id| {
        if !selected.contains(&id) {
            selected.push(id)
        }
    });
    model.selected = selected;
}

/// Rows of a pane that are in view; one, where it is not on the screen.
fn height(model: &Model, pane: Pane) -> usize {
    view::areas(model).inner(pane).map_or(1, |area| panes::body(pane, area).height as usize)
}

/// Brings what is selected into view where the keys are not, if it was not selected before.
pub(in crate::tui) fn reveal(model: &mut Model, before: &[String]) {
    if model.selected.is_empty() || model.selected == before {
        return;
    }
    for pane in [Pane::Tables, Pane::Checks].into_iter().filter(|pane| *pane != model.focus) {
        let Some(first) = panes::marked(model, pane).first().copied() else { continue };
        let (height, len) = (height(model, pane), panes::len(model, pane));
        if let Some(list) = model.lists.of(pane) {
            list.reveal(first, height, len);
        }
    }
}
