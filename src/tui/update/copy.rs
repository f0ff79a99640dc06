//! Copying: the rows of the focused pane that have to do with what is selected; or what is selected; or the chosen row. And the command for the whole screen.
//!
//! Rows are copied as they are searched, with tabs between their cells, and several of them with their heads, for a spreadsheet.

use crate::tui::model::{Effect, Model};
use crate::tui::{command, panes};

pub(super) fn copy(model: &mut Model) {
    let pane = model.focus;
    let texts = panes::texts(model, pane);
    let pick = |rows: &[usize]| rows.iter().filter_map(|row| texts.get(*row)).cloned().collect::<Vec<_>>();
    let marked = panes::marked(model, pane);
    let (text, what) = if !marked.is_empty() {
        let head = panes::head(model, pane).filter(|_| marked.len() > 1);
        let lines: Vec<String> = head.into_iter().chain(pick(&marked)).collect();
        (lines.join("\n"), rows(marked.len()))
    } else if !model.selected.is_empty() {
        (model.selected.join(" "), format!("what is selected, {}", elements(model.selected.len())))
    } else if let Some(row) = model.lists.get(pane).and_then(|list| list.selected(texts.len())) {
        (pick(&[row]).concat(), rows(1))
    } else {
        return model.say("there is nothing to copy here");
    };
    model.effects.push(Effect::Copy(text));
    model.say(format!("copied {what}"));
}

/// Copies the command that shows the same as this screen.
pub(super) fn command(model: &mut Model) {
    match command::whole(model) {
        Ok(text) => {
            model.say(format!("copied {text}"));
            model.effects.push(Effect::Copy(text));
        }
        Err(why) => model.complain(format!("there is no command for this: {why}")),
    }
}

fn rows(count: usize) -> String {
    if count == 1 { "the row".into() } else { format!("{count} rows that are selected") }
}

fn elements(count: usize) -> String {
    if count == 1 { "1 element".into() } else { format!("{count} elements") }
}
