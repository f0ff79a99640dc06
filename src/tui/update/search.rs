//! Searching: in the pane that has the keys, or, where nothing is found there, in the others.

use crate::tui::model::{Model, Pane};
use crate::tui::{panes, text};

/// Where is looked, in this order, after the focused pane.
const ORDER: [Pane; 6] =
    [Pane::Timeline, Pane::Tables, Pane::Checks, Pane::Stages, Pane::Differences, Pane::Mesh];

/// Searches for a text, upper and lower case alike, and goes to where it is found first. Nothing to search for ends the search.
pub(in crate::tui) fn find(model: &mut Model, text: &str) -> Result<(), String> {
    if text.trim().is_empty() {
        model.search.clear();
        return Ok(());
    }
    let focused = std::iter::once(model.focus);
    let found = focused.chain(ORDER).find(|pane| !matches(model, *pane, text).is_empty());
    let pane = found.ok_or_else(|| format!("nothing matches `{text}`"))?;
    text.clone_into(&mut model.search);
    model.focus = pane;
    let at = chosen(model, pane);
    let rows = matches(model, pane, text);
    let next = rows.iter().position(|row| *row >= at);
    go(model, &rows, next.unwrap_or(0), next.is_none());
    Ok(())
}

/// Goes to the next match, or to the one before; from the last on to the first.
pub(super) fn step(model: &mut Model, on: bool) {
    if model.search.is_empty() {
        return model.say("nothing was searched for");
    }
    let rows = matches(model, model.focus, &model.search);
    if rows.is_empty() {
        let again = model.search.clone();
        return find(model, &again).unwrap_or_else(|why| model.complain(why));
    }
    let at = chosen(model, model.focus);
    let next = match on {
        true => rows.iter().position(|row| *row > at),
        false => rows.iter().rposition(|row| *row < at),
    };
    go(model, &rows, next.unwrap_or(if on { 0 } else { rows.len() - 1 }), next.is_none());
}

fn go(model: &mut Model, rows: &[usize], at: usize, wrapped: bool) {
    panes::choose(model, model.focus, rows[at]);
    let (found, of) = (text::line(&model.search), rows.len());
    let wrapped = if wrapped && of > 1 { ", round the end" } else { "" };
    model.say(format!("{} of {of} that match `{found}` in {}{wrapped}", at + 1, model.focus.title()));
}

/// The rows of a pane in which a text is.
fn matches(model: &Model, pane: Pane, text: &str) -> Vec<usize> {
    let needle = text.to_lowercase();
    let texts = panes::texts(model, pane);
    (0..texts.len()).filter(|row| texts[*row].to_lowercase().contains(&needle)).collect()
}

fn chosen(model: &Model, pane: Pane) -> usize {
    let len = panes::len(model, pane);
    model.lists.get(pane).and_then(|list| list.selected(len)).unwrap_or(0)
}
