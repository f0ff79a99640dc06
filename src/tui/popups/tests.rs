//! Every popup at every size: it is drawn whole, no key does harm, and Esc leads out.

use ratatui::buffer::Buffer;

use super::*;
use crate::tui::action::Action;
use crate::tui::key::Key;
use crate::tui::screen;
use crate::tui::update::{self, kit, popup};

/// Every popup, over a run of which a part has run.
fn popups() -> Vec<(String, Model)> {
    let open = |model: &mut Model, action| update::act(model, action);
    let mut all: Vec<(String, Model)> = Vec::new();
    for action in [Action::Help, Action::Palette, Action::Stops, Action::Open, Action::GoTo, Action::Search] {
        let mut model = kit::model();
        ["rejected", "sorts=x"].iter().for_each(|stop| update::stops::add(&mut model, stop).expect(stop));
        open(&mut model, action);
        all.push((action.row().name.to_owned(), model));
    }
    let questions = [Question::Stop, Question::CompareWith, Question::Save, Question::Scene];
    for question in questions.into_iter().chain([Question::Checkpoint, Question::Event]) {
        let mut model = kit::model();
        popup::ask(&mut model, question);
        all.push((format!("{question:?}"), model));
    }
    let mut model = kit::model();
    model.kept.unsaved = true;
    open(&mut model, Action::Quit);
    all.push(("leave".into(), model));
    all
}

fn drawn(model: &Model) -> Buffer {
    let [width, height] = model.size;
    let mut buffer = Buffer::empty(Rect::new(0, 0, width, height));
    crate::tui::view::draw(model, &Theme::default(), &Keys::new(&[]), &mut buffer);
    buffer
}

fn text(model: &Model) -> String {
    screen::to_text(&drawn(model))
}

fn press(model: &mut Model, key: &str) {
    popup::key(model, key.parse().expect("a key"));
}

fn keys() -> impl Iterator<Item = Key> {
    let named = [
        "enter",
        "esc",
        "tab",
        "shift-tab",
        "backspace",
        "left",
        "right",
        "up",
        "down",
        "home",
        "end",
        "pgup",
        "pgdn",
        "ins",
        "del",
        "ctrl-home",
        "ctrl-end",
        "alt-b",
        "alt-f",
        "alt-backspace",
        "f5",
    ];
    let named = named.map(str::to_owned).into_iter();
    let plain = (' '..='~').map(|c| c.to_string());
    let ctrl = ('a'..='z').map(|c| format!("ctrl-{c}"));
    named.chain(plain).chain(ctrl).chain(["漢".into(), "é".into()]).filter_map(|name| name.parse().ok())
}

#[test]
fn no_key_does_harm_and_esc_leads_out() {
    for (name, _) in popups() {
        let again = || popups().into_iter().find(|(other, _)| *other == name).map(|(_, model)| model);
        let mut model = again().expect("the same popup");
        for key in keys() {
            // Those that close it, or do something, are followed by the same popup anew.
            if model.popup.is_none() {
                model = again().expect("the same popup");
            }
            model.size = [40, 12];
            popup::key(&mut model, key);
            drawn(&model);
            popup::mouse(&mut model, click(20, 6));
            drawn(&model);
        }
        for _ in 0..4 {
            press(&mut model, "esc");
        }
        assert!(model.popup.is_none(), "{name}: {:?}", model.popup);
    }
}

fn click(column: u16, row: u16) -> crossterm::event::MouseEvent {
    use crossterm::event::{KeyModifiers, MouseButton, MouseEvent, MouseEventKind};
    let kind = MouseEventKind::Down(MouseButton::Left);
    MouseEvent { kind, column, row, modifiers: KeyModifiers::NONE }
}

#[test]
fn no_screen_is_too_small() {
    for (_, mut model) in popups() {
        for size in [[0, 0], [1, 1], [2, 2], [3, 9], [80, 1], [12, 5], [13, 6], [40, 12], [300, 100]] {
            model.size = size;
            drawn(&model);
            press(&mut model, "down");
        }
    }
}

#[test]
fn every_question_has_a_border_with_what_is_asked_in_it() {
    use Question as Q;
    let all = [
        Q::GoTo,
        Q::Search,
        Q::Stop,
        Q::CompareWith,
        Q::Checkpoint,
        Q::Event,
        Q::Save,
        Q::SavePicture,
        Q::Scene,
    ];
    for question in all {
        let mut model = Model { size: [120, 40], ..Model::default() };
        popup::ask(&mut model, question);
        let Some(Popup::Prompt(prompt)) = &mut model.popup else { panic!("no question") };
        prompt.choices.clear();
        let [title, hints] = prompt.words();
        let (area, screen) =
            (model.popup.as_ref().map(|popup| popup.area(&model)).unwrap_or_default(), drawn(&model));
        let row = |y: u16| (area.left()..area.right()).map(|x| screen[(x, y)].symbol()).collect::<String>();
        let [top, bottom] = [row(area.top()), row(area.bottom() - 1)];
        assert!(top.starts_with(&format!("┌ {title} ─")) && top.ends_with('┐'), "{question:?}: {top}");
        assert!(
            bottom.starts_with(&format!("└ {hints} ─")) && bottom.ends_with('┘'),
            "{question:?}: {bottom}"
        );
    }
}

#[test]
fn on_a_small_screen_a_popup_still_shows_what_it_is_for() {
    let expected = [
        ("help", "Step one event on"),
        ("palette", "next-event"),
        ("breakpoints", "sorts=x"),
        ("open", "recordings/"),
        ("go-to", "such as 12"),
        ("Stop", "rejected=miss"),
        ("leave", "leave it as a draft"),
    ];
    let popups = popups();
    for (name, words) in expected {
        let (_, model) = popups.iter().find(|(other, _)| other == name).expect(name);
        assert!(model.size == [80, 24] && text(model).contains(words), "{}", text(model));
        let mut small = popups_of(name);
        small.size = [40, 12];
        assert!(text(&small).contains(words), "{}", text(&small));
    }
}

fn popups_of(name: &str) -> Model {
    popups().into_iter().find(|(other, _)| other == name).map(|(_, model)| model).expect(name)
}

#[test]
fn the_help_has_every_action_with_its_keys_and_finds_by_words() {
    let mut model = popups_of("help");
    model.size = [120, 120];
    let all = text(&model);
    for row in crate::tui::action::ACTIONS {
        assert!(all.contains(row.does) && row.keys.iter().all(|key| all.contains(key)), "{}", row.name);
    }
    "check".chars().for_each(|c| press(&mut model, &c.to_string()));
    let found = text(&model);
    assert!(found.contains("Go to the next checkpoint") && !found.contains("Play faster"), "{found}");
    let own = Keys::new(&[("quit".into(), vec!["f9".parse().expect("a key")])]);
    let mut buffer = Buffer::empty(Rect::new(0, 0, 120, 120));
    draw(&popups_of_size("help", [120, 120]), &Theme::default(), &own, &mut buffer);
    assert!(screen::to_text(&buffer).contains("f9"));
}

fn popups_of_size(name: &str, size: [u16; 2]) -> Model {
    Model { size, ..popups_of(name) }
}

#[test]
fn the_palette_does_what_was_found_and_offers_it_first_the_next_time() {
    let mut model = popups_of("palette");
    "focchk".chars().for_each(|c| press(&mut model, &c.to_string()));
    assert!(text(&model).contains("focus-checks"));
    press(&mut model, "enter");
    assert_eq!((model.focus, model.popup.is_none()), (crate::tui::model::Pane::Checks, true));
    update::act(&mut model, Action::Palette);
    press(&mut model, "enter");
    assert_eq!(model.memory.actions()[0], Action::FocusChecks, "the first row was the last action");
    let order: Vec<&str> = actions(&Default::default(), "ne").iter().take(2).map(|e| e.row.name).collect();
    assert_eq!(order, ["next-event", "next-stage"], "names that begin so come first");
    assert_eq!(actions(&Default::default(), "broken inv")[0].row.name, "first-finding", "by what it does");
}

#[test]
fn breakpoints_are_added_dropped_and_gone_to() {
    let mut model = kit::model();
    update::act(&mut model, Action::Stops);
    press(&mut model, "a");
    "rej".chars().for_each(|c| press(&mut model, &c.to_string()));
    assert!(text(&model).contains("rejected=miss"));
    ["tab", "enter"].iter().for_each(|key| press(&mut model, key));
    assert_eq!(model.stops.iter().map(ToString::to_string).collect::<Vec<_>>(), ["rejected"]);
    assert!(text(&model).contains("1 event") && text(&model).contains("met by events 1 so far"));
    press(&mut model, "enter");
    assert_eq!((model.place.events, model.popup.is_none()), (2, true));
    update::act(&mut model, Action::Stops);
    press(&mut model, "d");
    assert!(model.stops.is_empty() && text(&model).contains("no breakpoints"));
}

#[test]
fn leaving_asks_only_where_something_is_not_saved() {
    let mut model = kit::model();
    update::act(&mut model, Action::Quit);
    assert!(model.done);
    for (key, done, asked) in [("d", true, false), ("esc", false, false), ("s", false, true)] {
        let mut model = popups_of("leave");
        press(&mut model, key);
        assert_eq!((model.done, model.popup.is_some()), (done, asked), "{key}");
    }
    let mut model = popups_of("leave");
    press(&mut model, "s");
    update::told(&mut model, crate::tui::worker::Told::Saved("a.lancet".into()));
    assert!(model.done);
    let mut model = popups_of("leave");
    ["s", "esc"].iter().for_each(|key| press(&mut model, key));
    update::told(&mut model, crate::tui::worker::Told::Saved("a.lancet".into()));
    assert!(!model.done, "it was called off");
    update::act(&mut model, Action::Leave);
    assert!(model.done, "at once");
}

#[test]
fn a_click_chooses_and_another_one_does_it() {
    let mut model = popups_of("palette");
    let Some(Popup::Menu(menu)) = &model.popup else { panic!("no menu") };
    let rows = rows_area(&model, menu);
    let second = click(rows.x + 3, rows.y + 1);
    popup::mouse(&mut model, second);
    assert!(model.popup.is_some());
    popup::mouse(&mut model, second);
    assert_eq!(model.memory.actions(), [Action::PreviousEvent]);
    let mut model = popups_of("palette");
    popup::mouse(&mut model, click(0, 0));
    assert!(model.popup.is_none(), "beside it");
}

#[test]
fn without_a_recording_there_is_what_can_be_opened() {
    let mut model = Model { size: [80, 24], ..Model::default() };
    update::begin(&mut model, None);
    "bui:sphere".chars().for_each(|c| press(&mut model, &c.to_string()));
    press(&mut model, "enter");
    let Some(Popup::Prompt(prompt)) = &model.popup else { panic!("the number of faces is asked for") };
    assert_eq!((prompt.question, prompt.edit.text()), (Question::Scene, "builtin:sphere:"));
    update::act(&mut model, Action::Open);
    "./nowhere.lancet".chars().for_each(|c| press(&mut model, &c.to_string()));
    press(&mut model, "enter");
    assert!(text(&model).contains("nowhere.lancet: there is no such file"), "{}", text(&model));
}
