//! What the panes draw of a run.

use std::sync::Arc;

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use super::*;
use crate::report::{Check, Outcome, Pass, Row, StateReport, Table};
use crate::tui::model::Place;
use crate::tui::screen::to_text;
use crate::tui::theme::Role;
use crate::tui::update::kit;

/// The kit's model after its cut, which has a table, sizes and invariants, one of them broken.
fn model() -> Model {
    let mut model = kit::model();
    let row = |ids: [&str; 2], cells: [&str; 3]| Row {
        ids: ids.map(String::from).to_vec(),
        cells: cells.map(String::from).to_vec(),
    };
    let rows = vec![row(["f1", "e2"], ["FE", "f1", "0.25"]), row(["f9", "e2"], ["EE", "f9", "12.5"])];
    let columns = ["kind", "face", "length"].map(String::from).to_vec();
    let mut cut = kit::reports()[2].clone();
    cut.tables = vec![Table { title: "links".into(), columns, rows }];
    cut.sizes = [("faces".into(), [9354, 9424]), ("nodes".into(), [10, 10])].into();
    cut.stages[0].checks = vec![Check::pass("join"), Check::at_most("distance", 0.125, 1.0)];
    cut.stages[2].checks = vec![Check::fail("closed", "a hole").culprits(["f9"])];
    model.reports[2] = Arc::new(cut);
    model.reports.iter().for_each(|report| model.timing.add(report));
    model.place = Place::after(3);
    model.follow();
    model
}

fn screen(pane: Pane, model: &Model, width: u16, height: u16) -> Buffer {
    let area = Rect::new(0, 0, width, height);
    let mut buffer = Buffer::empty(area);
    draw(pane, model, &Theme::default(), area, &mut buffer);
    buffer
}

fn lines(pane: Pane, model: &Model, width: u16, height: u16) -> Vec<String> {
    to_text(&screen(pane, model, width, height)).lines().map(str::to_owned).collect()
}

#[test]
fn the_timeline_says_what_became_of_each_event() {
    let mut model = model();
    model.stops = vec!["rejected".parse().expect("a stop")];
    let shown = lines(Pane::Timeline, &model, 40, 6);
    assert_eq!(
        shown,
        [
            "   ── start",
            "  0   mode",
            "● 1 ! click miss",
            "  2 ✗ cut AB/closed               720 µs",
            "  3   cut",
            ""
        ]
    );
    let buffer = screen(Pane::Timeline, &model, 40, 6);
    let faint = Theme::default().style(Role::Faint).fg;
    assert_eq!(buffer[(6, 4)].style().fg, faint, "what has not run is fainter");
    assert_ne!(buffer[(6, 1)].style().fg, faint);
}

#[test]
fn outcomes_have_a_mark_each() {
    let mut model = model();
    let outcomes = [Outcome::Applied, Outcome::Pending, Outcome::Cancelled];
    for (event, outcome) in outcomes.into_iter().enumerate() {
        let report = crate::report::EventReport::new(event, "click");
        model.reports[event] = Arc::new(crate::report::EventReport { outcome, ..report });
    }
    let mut checkpoint = crate::report::EventReport::new(3, "checkpoint");
    checkpoint.checkpoint = Some("end".into());
    model.reports.push(Arc::new(checkpoint));
    let marks: Vec<String> = lines(Pane::Timeline, &model, 30, 5)[1..]
        .iter()
        .map(|line| line.chars().skip(4).take(1).collect())
        .collect();
    assert_eq!(marks, ["✓", "…", "⊘", "⚑"]);
}

#[test]
fn the_place_within_an_event_is_shown_on_its_row_and_among_the_stages() {
    let mut model = model();
    model.place = Place { events: 2, stage: Some(0) };
    model.follow();
    assert!(lines(Pane::Timeline, &model, 50, 6)[3].contains("✗ cut ▸ after AA"));
    let stages = lines(Pane::Stages, &model, 40, 3);
    assert!(stages[0].starts_with("▸ AA   700 µs"), "{stages:?}");
    assert!(stages[1].starts_with("  SO  skipped: mode"), "{stages:?}");
    let buffer = screen(Pane::Stages, &model, 40, 3);
    assert_eq!(buffer[(2, 2)].style().fg, Theme::default().style(Role::Faint).fg, "it comes later");
}

#[test]
fn bars_are_as_long_as_the_time_and_have_the_spread_of_the_run() {
    let mut model = model();
    for us in [350.0, 350.0, 350.0, 525.0] {
        let mut report = kit::reports()[2].clone();
        report.stages[0].us = us;
        model.timing.add(&report);
    }
    let shown = lines(Pane::Stages, &model, 54, 3);
    assert_eq!(shown[0].matches(['█', '┼']).count(), 54 - 14, "the longest fills its bar: {}", shown[0]);
    assert_eq!(shown[0].chars().position(|c| c == '┼'), Some(14 + 20), "the median is half as long");
    let wide = lines(Pane::Stages, &model, 110, 3);
    assert!(wide[0].contains("a stage") && wide[0].contains("median 350 µs (350 µs…525 µs, 5 runs)"), "{}", wide[0]);
}

#[test]
fn choosing_a_stage_goes_to_after_it_and_skipped_ones_can_be_passed() {
    let mut model = model();
    model.focus = Pane::Stages;
    let place = |model: &Model| (model.place, model.lists.stages.selected(3));
    choose(&mut model, Pane::Stages, 0);
    assert_eq!(place(&model), (Place { events: 2, stage: Some(0) }, Some(0)));
    choose(&mut model, Pane::Stages, 1);
    assert_eq!(place(&model), (Place { events: 2, stage: Some(0) }, Some(1)));
    choose(&mut model, Pane::Stages, 2);
    assert_eq!(place(&model), (Place::after(3), Some(2)));
}

#[test]
fn the_passes_of_a_frame_are_listed() {
    let mut model = model();
    let pass = |id: &str, us, skipped: Option<&str>| Pass {
        id: id.into(),
        us,
        skipped: skipped.map(String::from),
        tiles: 3,
        of: 12,
    };
    let mut checkpoint = crate::report::EventReport::new(2, "checkpoint");
    checkpoint.passes = vec![pass("skin", 1500.0, None), pass("scatter", 0.0, Some("no light"))];
    model.reports[2] = Arc::new(checkpoint);
    let shown = lines(Pane::Stages, &model, 44, 2);
    assert!(shown[0].starts_with("  skin     1.50 ms ███") && shown[0].ends_with(" 3/12 tiles"), "{shown:?}");
    assert!(shown[1].starts_with("  scatter  skipped: no light"), "{shown:?}");
}

#[test]
fn broken_invariants_come_first_with_their_culprits() {
    let mut model = model();
    let shown = lines(Pane::Checks, &model, 60, 4);
    assert_eq!(shown, ["✗ AB closed             a hole  f9", "✓ AA join", "✓ AA distance 1.25e-1", ""]);
    assert_eq!(about(Pane::Checks, &model), "1 of 3 broken");
    assert_eq!(ids(&model, Pane::Checks), ["f9"]);
    model.checked =
        Some((Place::after(1), StateReport { checks: vec![Check::pass("whole")], ..StateReport::default() }));
    assert!(lines(Pane::Checks, &model, 60, 4)[3].starts_with("✓ at 1 whole"));
}

#[test]
fn tables_stand_in_columns_and_what_is_selected_has_a_mark() {
    let mut model = model();
    model.selected = vec!["f9".into()];
    let shown = lines(Pane::Tables, &model, 30, 4);
    assert_eq!(shown, ["  kind  face  length", "  FE    f1      0.25", "◆ EE    f9      12.5", ""]);
    assert!(lines(Pane::Timeline, &model, 30, 6)[3].starts_with("  2◆✗"), "the event, too");
    assert!(lines(Pane::Checks, &model, 60, 4)[0].contains("◆ a hole"), "and the invariant");
    next_table(&mut model);
    assert_eq!(about(Pane::Tables, &model), "counters (3), 2 of 2");
    let shown = lines(Pane::Tables, &model, 30, 4);
    assert_eq!(shown, ["  counter  count", "  hops         3", "  sorts x      2", "  sorts y      0"]);
    next_table(&mut model);
    assert_eq!(about(Pane::Tables, &model), "links (2), 1 of 2");
}

#[test]
fn the_mesh_says_what_changed() {
    let mut model = model();
    model.standing = Some(crate::tui::worker::Standing {
        sizes: vec![("faces", 9400), ("nodes", 10)],
        kept_bytes: 1_214_000,
        ..kit::standing(Place { events: 2, stage: Some(0) })
    });
    let shown = lines(Pane::Mesh, &model, 40, 4);
    assert_eq!(
        shown[..3],
        ["       before  after  change", "faces   9,354  9,424     +70", "nodes      10     10       ·"]
    );
    model.place = Place { events: 2, stage: Some(0) };
    let shown = lines(Pane::Mesh, &model, 40, 5);
    assert_eq!(shown[..2], ["       before   here  change", "faces   9,354  9,400     +46"]);
    assert!(texts(&model, Pane::Mesh).contains(&"kept\t1.21 MB for going back".into()));
}

#[test]
fn the_whole_state_is_told_where_it_was_looked_at() {
    let mut model = model();
    let counts = [("euler".into(), -2), ("faces".into(), 9424)].into();
    let state = StateReport { digest: "abc".into(), counts, ..StateReport::default() };
    model.checked = Some((Place::after(3), state));
    let told = texts(&model, Pane::Mesh);
    assert!(told.contains(&"euler\t\t−2\t".into()) && told.contains(&"digest\tabc".into()), "{told:?}");
    assert_eq!(told.iter().filter(|row| row.starts_with("faces")).count(), 1, "known from the sizes");
    model.place = Place::after(2);
    assert!(!texts(&model, Pane::Mesh).iter().any(|row| row.starts_with("digest")));
}

#[test]
fn what_was_found_is_marked_also_where_it_is_cut_off() {
    let mut model = model();
    model.search = "MISS".into();
    let style = Theme::default().style(Role::Match);
    let marked = |buffer: &Buffer, y: u16| -> String {
        let cells = (0..buffer.area.width).map(|x| &buffer[(x, y)]);
        cells.filter(|cell| Some(cell.bg) == style.bg).map(ratatui::buffer::Cell::symbol).collect()
    };
    assert_eq!(marked(&screen(Pane::Timeline, &model, 40, 6), 2), "miss");
    assert_eq!(marked(&screen(Pane::Timeline, &model, 10, 6), 2), " ", "the row's beginning");
    assert_eq!(marked(&screen(Pane::Timeline, &model, 40, 6), 1), "");
}

#[test]
fn wide_characters_are_found_and_marked_as_they_stand() {
    let mut model = model();
    let mut cut = model.reports[2].as_ref().clone();
    cut.tables[0].rows[0].cells[0] = "漢字".into();
    model.reports[2] = Arc::new(cut);
    model.search = "字".into();
    let buffer = screen(Pane::Tables, &model, 30, 4);
    let style = Theme::default().style(Role::Match);
    let marked: Vec<u16> = (0..30).filter(|x| Some(buffer[(*x, 1)].bg) == style.bg).collect();
    assert_eq!(marked, [4, 5]);
}

#[test]
fn panes_with_nothing_to_show_say_why() {
    let model = Model::default();
    for pane in [Pane::Stages, Pane::Tables, Pane::Checks] {
        assert_eq!(lines(pane, &model, 30, 1), ["no event has run here"], "{pane:?}");
    }
    assert_eq!(lines(Pane::Mesh, &model, 30, 1), ["nothing is open"]);
}
