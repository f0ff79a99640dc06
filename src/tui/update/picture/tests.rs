//! Keys and the mouse on a picture: orbit, tints, subjects, picks.

use ratatui::crossterm::event::{Event, KeyModifiers, MouseButton, MouseEvent, MouseEventKind};

use super::*;
use crate::render::Choice;
use crate::report::Overlay;
use crate::tui::action::ACTIONS;
use crate::tui::image::encoder::encode;
use crate::tui::model::{Effect, Pane};
use crate::tui::run::Start;
use crate::tui::shot::{Picture, Sight};
use crate::tui::stage::Stage;
use crate::tui::theme::Theme;
use crate::tui::update::{act as do_it, kit};

const RECORDED: Orbit = Orbit { azimuth: 0.5, zenith: 1.0, distance: 10.0 };

/// A model with its picture on the screen.
fn shown() -> Model {
    let mut model = kit::model();
    model.focus = Pane::Picture;
    model.standing.as_mut().expect("it stands").orbit = Some(RECORDED);
    give(&mut model);
    model
}

/// Answers what is asked of worker and encoder.
fn give(model: &mut Model) {
    want(model);
    for effect in std::mem::take(&mut model.effects) {
        if let Effect::Ask(Ask::Shoot(shot)) = effect {
            let image = Arc::new(crate::canvas::image::Image::filled([64, 48], [200, 100, 50, 255]));
            let (place, sight, legend) = (model.place, Sight::Map, vec![("a set".into(), [1, 2, 3])]);
            model.picture.take(Picture { shot: *shot, place, image, sight, of: None, legend, ms: 1.0 });
        }
    }
    let ready = picture::request(model).map(|request| encode(&request));
    ready.into_iter().for_each(|ready| encoded(model, ready));
}

fn at(kind: MouseEventKind, column: u16, row: u16) -> MouseEvent {
    MouseEvent { kind, column, row, modifiers: KeyModifiers::NONE }
}

const DOWN: MouseEventKind = MouseEventKind::Down(MouseButton::Left);
const DRAG: MouseEventKind = MouseEventKind::Drag(MouseButton::Left);
const UP: MouseEventKind = MouseEventKind::Up(MouseButton::Left);

fn orbit(model: &Model) -> Orbit {
    model.picture.orbit.expect("turned")
}

#[test]
fn keys_turn_the_model_as_far_as_there_are_poles() {
    let mut model = shown();
    do_it(&mut model, Action::OrbitRight);
    assert!((orbit(&model).azimuth - 0.55).abs() < 1e-12);
    (0..100).for_each(|_| do_it(&mut model, Action::OrbitUp));
    assert_eq!(orbit(&model).zenith, 0.0);
    (0..100).for_each(|_| do_it(&mut model, Action::OrbitDown));
    assert_eq!(orbit(&model).zenith, PI);
    (0..1000).for_each(|_| do_it(&mut model, Action::Nearer));
    assert_eq!(orbit(&model).distance, 0.01);
    (0..1000).for_each(|_| do_it(&mut model, Action::Farther));
    assert_eq!(orbit(&model).distance, 1e4);
    do_it(&mut model, Action::ResetView);
    assert_eq!(model.picture.orbit, None);
    let asks = model.effects.iter().filter(|effect| !matches!(effect, Effect::Ask(Ask::Shoot(_))));
    assert_eq!(asks.count(), 0, "looking changes no recording");
}

#[test]
fn tints_are_gone_through_and_a_group_that_is_gone_gives_way() {
    let mut model = shown();
    let set = |name: &str| Overlay::Faces { name: name.into(), faces: vec![1] };
    let mut report = model.reports[2].as_ref().clone();
    report.overlays = vec![set("kind A"), set("kind B"), set("rim")];
    model.reports[2] = Arc::new(report);
    model.place.events = 3;
    let mut seen = Vec::new();
    for _ in 0..4 {
        do_it(&mut model, Action::Tint);
        seen.push(model.picture.drawn.tint.clone());
    }
    let group = |name: &str| Tint::Group(name.into());
    assert_eq!(seen, [group("kind"), group("rim"), Tint::Charts, Tint::None]);
    model.picture.drawn.tint = group("gone");
    do_it(&mut model, Action::Tint);
    assert_eq!(model.picture.drawn.tint, group("kind"));
}

#[test]
fn a_drag_turns_and_a_click_asks_for_the_face_under_it() {
    let mut model = shown();
    let area = picture::area(&model).expect("a place");
    let (x, y) = (area.x + area.width / 2, area.y + area.height / 2);
    mouse(&mut model, at(DOWN, x, y));
    mouse(&mut model, at(UP, x, y));
    let asked = model.effects.drain(..).find_map(|effect| match effect {
        Effect::Ask(Ask::Identify { at, .. }) => Some(at),
        _ => None,
    });
    let share = asked.expect("a click");
    assert!(share.iter().all(|share| (share - 0.5).abs() < 0.1), "{share:?}");
    mouse(&mut model, at(DOWN, x, y));
    mouse(&mut model, at(DRAG, x + 3, y));
    mouse(&mut model, at(DRAG, x + 3, 0));
    mouse(&mut model, at(UP, x + 3, 0));
    assert!(orbit(&model).azimuth < RECORDED.azimuth, "dragged to the right it is seen from further left");
    assert!(orbit(&model).zenith > RECORDED.zenith, "dragged up, from further down");
    assert!(model.effects.is_empty() && model.picture.drag.is_none());
}

#[test]
fn the_wheel_enlarges_what_is_under_the_pointer_and_shift_moves_it() {
    let mut model = shown();
    let area = picture::area(&model).expect("a place");
    let (x, y) = (area.x + area.width / 2 + 5, area.y + 3);
    model.picture.window.zoom = 4.0;
    let medium = model.picture.medium;
    let under = |model: &Model| {
        let point = medium.middle([x - area.x, y - area.y]);
        picture::fit(model).and_then(|fit| fit.to_share(point)).expect("on the picture")
    };
    let before = under(&model);
    for _ in 0..5 {
        mouse(&mut model, at(MouseEventKind::ScrollUp, x, y));
    }
    assert!(model.picture.window.zoom > 2.5);
    assert!((0..2).all(|k| (under(&model)[k] - before[k]).abs() < 1e-6));
    let shifted = |kind, column| MouseEvent { modifiers: KeyModifiers::SHIFT, ..at(kind, column, y) };
    mouse(&mut model, shifted(DOWN, x));
    mouse(&mut model, shifted(DRAG, x + 2));
    assert!(under(&model)[0] < before[0], "what is dragged comes along");
    assert_eq!(model.picture.orbit, None);
}

#[test]
fn what_cannot_be_a_picture_of_its_own_is_refused() {
    let mut model = shown();
    let folder = tempfile::tempdir().expect("a folder");
    let there = folder.path().join("there.png");
    assets::write_file(&there, b"x").expect("written");
    for text in ["", "  ", "frame.jpg", "..", &there.display().to_string()] {
        assert!(save(&mut model, text).is_err(), "{text}");
    }
    assert_eq!(save(&mut model, "some/frame"), Ok(()));
    let Some(Effect::Ask(Ask::SavePicture { path, what: Frame::Shot(shot) })) = model.effects.pop() else {
        panic!("it is asked for")
    };
    assert_eq!((path, shot.limit), (PathBuf::from("some/frame.png"), [640, 480]));
    model.picture.golden = Golden::Alone;
    assert!(save(&mut model, "golden.png").expect_err("there is none").contains("compare"));
}

#[test]
fn no_key_no_mouse_and_no_size_is_too_odd() {
    let kinds = [
        DOWN,
        DRAG,
        UP,
        MouseEventKind::ScrollUp,
        MouseEventKind::ScrollDown,
        MouseEventKind::Down(MouseButton::Right),
    ];
    let rows = ACTIONS.iter().map(|row| row.action);
    let actions: Vec<Action> =
        rows.filter(|action| (Action::Wire..=Action::ResetView).contains(action)).collect();
    for (width, height) in
        [0, 1, 2, 3, 5, 13, 61, 121].into_iter().flat_map(|w| [0, 1, 3, 4, 17, 31].map(|h| (w, h)))
    {
        let mut model = Model { size: [width, height], ..shown() };
        for (round, action) in actions.iter().chain(&actions).enumerate() {
            do_it(&mut model, *action);
            let kind = kinds[round % kinds.len()];
            for (column, row) in [(0, 0), (width / 2, height / 2), (width, height), (u16::MAX, u16::MAX)] {
                mouse(&mut model, at(kind, column, row));
            }
            give(&mut model);
            let mut buffer = ratatui::buffer::Buffer::empty(ratatui::layout::Rect::new(0, 0, width, height));
            let keys = crate::tui::keys::Keys::new(&[]);
            crate::tui::view::draw(&model, &Theme::default(), &keys, &mut buffer);
        }
    }
}

/// A square of two triangles that nearly fills its view, and a cut along a part of it.
const SCRIPT: &str = r#"{ "version": 1, "viewport": [100, 100], "seed": 3,
    "scene": { "inline": { "nodes": [[0, 0, 0], [4, 0, 0], [4, 4, 0], [0, 4, 0]], "faces": [[0, 1, 2], [0, 2, 3]] } },
    "events": [ { "mode": "merge" }, { "click": [45, 40] }, { "click": [60, 55] }, { "checkpoint": "end" } ] }"#;

#[test]
fn a_click_on_the_picture_selects_the_face_and_saving_writes_what_is_seen() {
    let folder = tempfile::tempdir().expect("a folder");
    let script = folder.path().join("square.json");
    assets::write_file(&script, SCRIPT.as_bytes()).expect("written");
    let start = Start { recording: Some(script), renderer: Choice::Reference, ..Start::default() };
    let mut stage = Stage::open(&start, Theme::default(), [120, 40], true);
    let text = |stage: &Stage| crate::tui::screen::to_text(&stage.screen());
    stage.press("4 z").expect("keys");
    for kind in [DOWN, UP] {
        stage.take(Event::Mouse(at(kind, 70, 24)));
    }
    assert!(text(&stage).contains("selected f0"), "{}", text(&stage));
    for kind in [DOWN, UP] {
        stage.take(Event::Mouse(at(kind, 1, 3)));
    }
    let png = folder.path().join("frame.png");
    let whole = crate::tui::screen::to_text(&stage.screen());
    stage.press("P").expect("a key");
    stage.take(Event::Paste(png.display().to_string()));
    stage.press("enter").expect("a key");
    let image = assets::read_file(&png).map(|bytes| assets::read_png(&bytes).expect("a picture"));
    let image = image.unwrap_or_else(|error| panic!("{error}: {whole}\n{}", text(&stage)));
    assert_eq!(image.size, [100, 100]);
    assert!(text(&stage).contains("100 x 100"), "{}", text(&stage));
}

#[test]
fn within_an_event_the_picture_is_that_of_the_state_there() {
    let folder = tempfile::tempdir().expect("a folder");
    let script = folder.path().join("square.json");
    assets::write_file(&script, SCRIPT.as_bytes()).expect("written");
    let start = Start { recording: Some(script), renderer: Choice::Reference, ..Start::default() };
    let screen = |keys: &str| {
        let mut stage = Stage::open(&start, Theme::default(), [120, 40], true);
        stage.press("4 z w o o o o").expect("keys");
        stage.press(keys).expect("keys");
        stage.screen()
    };
    let edges = |buffer: &ratatui::buffer::Buffer| {
        let area = ratatui::layout::Rect::new(0, 3, 120, 34);
        let cells = area.positions().map(|at| buffer[at].clone());
        cells.collect::<Vec<_>>()
    };
    // The first stage divides no face, the last one does: so the edges over the picture are others.
    let [before, within, after] = ["l l", "l l s", "l l l"].map(screen);
    assert!(edges(&within) != edges(&after), "the line is merged by the last stage");
    assert!(crate::tui::screen::to_text(&before) != crate::tui::screen::to_text(&within));
}
