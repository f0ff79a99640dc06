//! The whole screen at every size: panes, tabs, hints, title and messages.

use super::*;
use crate::tui::model::{Message, Place};
use crate::tui::screen::to_text;
use crate::tui::update::kit;

fn screen(model: &Model) -> Buffer {
    let [width, height] = model.size;
    let mut buffer = Buffer::empty(Rect::new(0, 0, width, height));
    draw(model, &Theme::default(), &Keys::new(&[]), &mut buffer);
    buffer
}

fn text(model: &Model) -> Vec<String> {
    to_text(&screen(model)).lines().map(str::to_owned).collect()
}

/// The kit's model after its cut, on a screen of this size.
fn model(width: u16, height: u16) -> Model {
    let mut model = Model { size: [width, height], ..kit::model() };
    model.place = Place::after(3);
    model.follow();
    model
}

#[test]
fn every_size_is_drawn_whatever_is_focused() {
    let mut model = model(1, 1);
    model.message = Some(Message { text: "something that is longer than the line".into(), wrong: true });
    model.selected = vec!["f1".into(), "e2".into()];
    model.search = "cut".into();
    for (pane, maximised) in Pane::ALL.into_iter().flat_map(|pane| [(pane, false), (pane, true)]) {
        (model.focus, model.maximised) = (pane, maximised);
        for (width, height) in (1..=130).flat_map(|width| (1..=45).map(move |height| (width, height))) {
            // Sizes at which nothing begins or ends are drawn only now and then.
            if maximised && width % 7 + height % 5 > 0 {
                continue;
            }
            model.size = [width, height];
            let areas = areas(&model);
            let drawn = areas.panes.iter().map(|(_, area)| area.area()).sum::<u32>();
            let bars = if height > 3 { 2 * u32::from(width) } else { 0 };
            assert_eq!(drawn + bars, u32::from(width) * u32::from(height), "{width} x {height} are filled");
            assert!(areas.panes.iter().any(|(other, _)| *other == pane), "{pane:?} at {width} x {height}");
            screen(&model);
        }
    }
}

#[test]
fn a_small_screen_has_one_pane_and_tabs_that_say_which_there_are() {
    let mut model = model(40, 12);
    let shown = text(&model);
    assert_eq!(shown[1], "1 timeline 2sta 3mes 4pic 5tab 6inv 7dif");
    assert!(shown[2].contains("start") && shown[5].contains("cut"), "{shown:#?}");
    model.focus = Pane::Tables;
    assert_eq!(text(&model)[1], "1tim 2sta 3mes 4pic 5 tables 6inv 7dif ─");
    model.size = [12, 12];
    // With less room still, as many as there is room for.
    assert_eq!(text(&model)[1], "1 2 3 4 5 ta");
}

#[test]
fn panes_that_share_a_place_are_tabs_of_each_other() {
    let mut model = model(80, 24);
    let lower =
        |model: &Model| text(model).into_iter().find(|line| line.contains("6 invariants")).expect("a title");
    assert!(lower(&model).contains("3mesh 5tables 6 invariants 7differences"));
    assert!(text(&model)[1].contains("1 timeline") && text(&model)[1].contains("4 picture"));
    model.size = [120, 40];
    assert!(lower(&model).contains("5 tables") && lower(&model).contains("6 invariants 7differences"));
}

#[test]
fn hints_are_whole_and_help_comes_before_all_others() {
    for width in 1..=130 {
        let model = model(width, 12);
        let shown = text(&model).pop().expect("a status line");
        let whole = [
            "l next-event",
            "h previous-event",
            "s next-stage",
            "c next-cut",
            "space play",
            "b breakpoints",
            ": palette",
            "? help",
        ];
        let said: Vec<&str> = shown.split("  ").map(str::trim).filter(|hint| !hint.is_empty()).collect();
        assert!(said.iter().all(|hint| whole.contains(hint)), "{width}: {shown:?}");
        assert_eq!(said.last().copied(), (width >= 6).then_some("? help"), "{width}");
    }
}

#[test]
fn at_the_start_and_at_the_end_no_hint_leads_beyond() {
    let mut model = model(130, 12);
    let hint = |model: &Model, name: &str| text(model).pop().expect("a status line").contains(name);
    model.place = Place::START;
    assert!(hint(&model, "next-event") && !hint(&model, "previous-event"));
    model.place = Place::after(model.len());
    let beyond = ["next-event", "next-stage", "next-cut", "play"];
    assert!(hint(&model, "previous-event") && !beyond.iter().any(|name| hint(&model, name)));
}

#[test]
fn the_title_line_says_what_is_selected_and_keeps_the_place() {
    let mut model = model(80, 24);
    model.selected = vec!["f1".into(), "e2".into()];
    assert_eq!(
        text(&model)[0].trim_end(),
        format!("{:<73}◆ f1 e2", "lancet some/where.lancet · an-engine  3/4")
    );
    model.size = [20, 12];
    assert_eq!(text(&model)[0], "…e/where.lancet  3/4", "cut at its beginning");
}

#[test]
fn a_long_message_takes_more_lines_and_is_cut_only_after_those() {
    let mut model = model(40, 12);
    let words = "recordings/a.lancet: event 3: no such node: n77, where the mesh has 12 nodes";
    model.message = Some(Message { text: words.into(), wrong: true });
    let shown = text(&model);
    let joined = shown[10..].join(" ");
    assert_eq!(joined.split_whitespace().collect::<Vec<_>>().join(" "), format!("✗ {words}"));
    model.size = [12, 5];
    assert!(text(&model)[4].ends_with('…'), "{:#?}", text(&model));
}
