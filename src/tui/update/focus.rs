//! Panes and their rows: which is focused, which row is chosen, what that selects.

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
        Action::Select => model.selected = panes::ids(model, model.focus),
        Action::SelectNothing => model.selected.clear(),
        Action::NextTable => model.table += 1,
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
    let height = view::areas(model).inner(pane).map_or(1, |area| area.height);
    if let Some(list) = model.lists.of(pane) {
        choose(list, len, List::page(height as usize));
    }
    panes::chosen(model, pane);
}
