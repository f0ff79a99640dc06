//! Prompts: answers, what is wrong with them, completion, and what was typed before.

use super::*;
use crate::tui::model::Place;
use crate::tui::update::kit;

fn press(model: &mut Model, keys: &str) {
    keys.split_whitespace().for_each(|name| assert!(key(model, name.parse().expect("a key")), "{name}"));
}

fn prompt(model: &Model) -> &Prompt {
    match &model.popup {
        Some(Popup::Prompt(prompt)) => prompt,
        other => panic!("{other:?} is no prompt"),
    }
}

#[test]
fn an_answer_is_done_or_says_in_its_place_what_is_wrong() {
    let mut model = kit::model();
    ask(&mut model, Question::GoTo);
    press(&mut model, "9 9 enter");
    assert_eq!(prompt(&model).error.as_deref(), Some("there is no event `99`; there are 0 to 3"));
    press(&mut model, "ctrl-u 2");
    assert_eq!(prompt(&model).error, None);
    press(&mut model, "enter");
    assert!(model.popup.is_none());
    assert_eq!(model.place, Place::after(3));
}

#[test]
fn answers_come_back_and_what_was_being_typed_too() {
    let mut model = kit::model();
    for number in ["1", "2"] {
        ask(&mut model, Question::GoTo);
        press(&mut model, &format!("{number} enter"));
    }
    ask(&mut model, Question::GoTo);
    let mut seen = |keys: &str| {
        press(&mut model, keys);
        prompt(&model).edit.text().to_owned()
    };
    assert_eq!(["3 up", "up", "up", "down", "down", "down"].map(&mut seen), ["2", "1", "1", "2", "3", "3"]);
}

#[test]
fn stages_are_completed_and_gone_to() {
    let mut model = kit::model();
    ask(&mut model, Question::GoTo);
    press(&mut model, "2 .");
    assert_eq!(prompt(&model).choices, ["2.AA", "2.AB"]);
    press(&mut model, "tab");
    assert_eq!(prompt(&model).edit.text(), "2.A");
    press(&mut model, "tab enter");
    assert_eq!(model.place, Place { events: 2, stage: Some(0) });
    for (answer, error) in [
        ("2.zz", "event 2 has no stage `zz`; there are 1 to 2: AA, AB"),
        ("2.so", "stage so of event 2 was skipped: mode; there are 1 to 2: AA, AB"),
        ("3.1", "event 3 has not run yet, so its stages are not known: go to `3` first"),
        ("x", "there is no event `x`; there are 0 to 3"),
    ] {
        confirm(&mut model, Question::GoTo, answer);
        press(&mut model, "enter");
        assert_eq!(prompt(&model).error.as_deref(), Some(error));
        press(&mut model, "esc");
    }
}

#[test]
fn paths_are_completed_folder_by_folder() {
    let folder = tempfile::tempdir().expect("a folder");
    let root = folder.path().to_str().expect("a plain name").to_owned();
    for name in ["cuts/one.lancet", "cuts/only.lancet", "cuts/two.lancet", "curve.txt"] {
        crate::assets::write_file(&folder.path().join(name), b"").expect("written");
    }
    let mut model = kit::model();
    confirm(&mut model, Question::CompareWith, &format!("{root}/cut"));
    press(&mut model, "tab");
    assert_eq!(prompt(&model).edit.text(), format!("{root}/cuts/"));
    press(&mut model, "o tab");
    assert_eq!(prompt(&model).edit.text(), format!("{root}/cuts/on"));
    let seen = ["tab", "tab", "tab", "shift-tab"].map(|keys| {
        press(&mut model, keys);
        prompt(&model).edit.text().trim_start_matches(&root).to_owned()
    });
    assert_eq!(seen, ["/cuts/one.lancet", "/cuts/only.lancet", "/cuts/one.lancet", "/cuts/only.lancet"]);
    confirm(&mut model, Question::CompareWith, &format!("{root}/nowhere/x"));
    press(&mut model, "tab");
    assert!(prompt(&model).error.as_deref().is_some_and(|error| error.contains("nowhere")));
}
