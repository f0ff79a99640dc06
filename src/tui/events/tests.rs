//! The mouse: what a click, a second one and the wheel do.

use crossterm::event::KeyModifiers;

use super::*;
use crate::report::{Check, EventReport, Row, Table};
use crate::tui::model::{Effect, Place};
use crate::tui::update::kit;

/// The kit's model after its cut, which has a table of thirty rows and a broken invariant, on a large screen.
fn model() -> Model {
    let mut model = Model { size: [120, 40], ..kit::model() };
    let rows =
        (0..30).map(|i| Row { ids: vec![format!("f{i}")], cells: vec![format!("f{i}"), "0.5".into()] });
    let table =
        Table { title: "links".into(), columns: vec!["face".into(), "length".into()], rows: rows.collect() };
    let mut cut: EventReport = kit::reports()[2].clone();
    cut.tables = vec![table];
    cut.stages[2].checks = vec![Check::fail("closed", "a hole").culprits(["f25", "f26"])];
    model.reports[2] = std::sync::Arc::new(cut);
    model.place = Place::after(3);
    model.follow();
    model
}

fn key(model: &mut Model, keys: &str) {
    for word in keys.split(' ') {
        let key: Key = word.parse().expect("a key");
        let event = crossterm::event::KeyEvent::new(key.code(), key.modifiers());
        take(model, &Keys::new(&[]), Event::Key(event));
    }
}

fn mouse(model: &mut Model, kind: MouseEventKind, [column, row]: [u16; 2]) -> bool {
    let event = MouseEvent { kind, column, row, modifiers: KeyModifiers::NONE };
    take(model, &Keys::new(&[]), Event::Mouse(event))
}

fn click(model: &mut Model, at: [u16; 2]) {
    assert!(mouse(model, MouseEventKind::Down(MouseButton::Left), at));
}

/// The cell of a row of a pane, a few cells in.
fn cell(model: &Model, pane: Pane, row: u16) -> [u16; 2] {
    let body = body(&view::areas(model), pane);
    [body.x + 3, body.y + row]
}

#[test]
fn a_click_goes_to_the_row_and_a_second_one_selects_it() {
    let mut model = model();
    let at = cell(&model, Pane::Tables, 4);
    click(&mut model, at);
    assert_eq!((model.focus, model.lists.tables.selected(30)), (Pane::Tables, Some(4)));
    assert!(model.selected.is_empty(), "choosing alone selects nothing");
    click(&mut model, at);
    assert_eq!(model.selected, ["f4"]);
    let at = cell(&model, Pane::Timeline, 1);
    click(&mut model, at);
    assert_eq!((model.focus, model.place), (Pane::Timeline, Place::after(1)));
}

#[test]
fn a_click_on_a_title_focuses_and_another_maximises() {
    let mut model = model();
    let head = view::areas(&model).head(Pane::Mesh).expect("a title");
    click(&mut model, [head.x, head.y]);
    assert_eq!((model.focus, model.maximised), (Pane::Mesh, false));
    click(&mut model, [head.x, head.y]);
    assert!(model.maximised);
    // Alone, the panes are tabs: the third cell of "1tim" goes to the timeline.
    click(&mut model, [2, 1]);
    assert_eq!(model.focus, Pane::Timeline);
}

#[test]
fn the_wheel_scrolls_what_is_under_it_and_goes_nowhere() {
    let mut model = model();
    let at = cell(&model, Pane::Tables, 0);
    assert!(mouse(&mut model, MouseEventKind::ScrollDown, at));
    let height = body(&view::areas(&model), Pane::Tables).height as usize;
    assert_eq!(model.lists.tables.window(height, 30).start, 3);
    assert_eq!((model.focus, model.lists.tables.selected(30)), (Pane::Timeline, Some(0)));
    assert!(!mouse(&mut model, MouseEventKind::Moved, at), "nothing to draw anew");
}

#[test]
fn what_is_selected_comes_into_view_elsewhere() {
    let mut model = model();
    key(&mut model, "6 enter");
    assert_eq!(model.selected, ["f25", "f26"]);
    let height = body(&view::areas(&model), Pane::Tables).height as usize;
    assert!(model.lists.tables.window(height, 30).contains(&25));
    assert_eq!(model.lists.tables.selected(30), Some(0), "the chosen row stays");
    key(&mut model, "x");
    assert!(model.selected.is_empty());
}

#[test]
fn searching_goes_to_matches_in_turn_and_round_the_end() {
    let mut model = model();
    key(&mut model, "5 / F 2 9 enter");
    assert_eq!(model.lists.tables.selected(30), Some(29));
    key(&mut model, "g / f 1 enter");
    let mut rows = vec![model.lists.tables.selected(30).unwrap_or(0)];
    for _ in 0..11 {
        key(&mut model, "n");
        rows.push(model.lists.tables.selected(30).unwrap_or(0));
    }
    assert_eq!(rows, [1, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 1]);
    let said = model.message.as_ref().map_or("", |message| &message.text);
    assert_eq!(said, "1 of 11 that match `f1` in tables, round the end");
    key(&mut model, "N");
    assert_eq!(model.lists.tables.selected(30), Some(19));
}

#[test]
fn searching_from_the_picture_finds_the_pane_and_nothing_found_says_so() {
    let mut model = model();
    key(&mut model, "4 / h o l e enter");
    assert_eq!(model.focus, Pane::Checks);
    key(&mut model, "/ m i s s enter");
    assert_eq!((model.focus, model.place), (Pane::Timeline, Place::after(2)));
    key(&mut model, "/ q q q enter");
    assert!(model.popup.is_some(), "the question stays, with what is wrong");
    assert_eq!(model.search, "miss", "what was found before stays found");
}

fn copied(model: &mut Model) -> (String, String) {
    key(model, "y");
    let copied = model.effects.iter().rev().find_map(|effect| match effect {
        Effect::Copy(text) => Some(text.clone()),
        _ => None,
    });
    (copied.unwrap_or_default(), model.message.take().map_or(String::new(), |message| message.text))
}

#[test]
fn rows_are_copied_with_tabs_and_what_is_selected_goes_before_the_row() {
    let mut model = model();
    key(&mut model, "5 j");
    assert_eq!(copied(&mut model), ("f1\t0.5".into(), "copied the row".into()));
    key(&mut model, "6 enter 5");
    let rows = "face\tlength\nf25\t0.5\nf26\t0.5";
    assert_eq!(copied(&mut model), (rows.into(), "copied 2 rows that are selected".into()));
    key(&mut model, "1");
    assert_eq!(copied(&mut model), ("f25 f26".into(), "copied what is selected, 2 elements".into()));
    key(&mut model, "x");
    assert_eq!(copied(&mut model).0, "2\tcut\tapplied\tAB/closed broken");
}

#[test]
fn what_was_said_goes_with_the_next_key_and_what_went_wrong_stays() {
    let mut model = model();
    model.say("something");
    key(&mut model, "2");
    assert_eq!(model.message, None);
    model.complain("something");
    key(&mut model, "5 j");
    assert!(model.message.is_some());
    key(&mut model, "esc");
    assert_eq!(model.message, None);
}
