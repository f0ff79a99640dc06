//! What the picture pane says of what it shows, and of what it cannot show.

use std::sync::Arc;

use ratatui::buffer::Buffer;

use super::*;
use crate::canvas::image::Image;
use crate::tui::compare::{Differences, With};
use crate::tui::image::encoder::encode;
use crate::tui::model::{Pane, Place};
use crate::tui::picture::request;
use crate::tui::screen::to_text;
use crate::tui::shot::{Drawn, Shot, Sight};
use crate::tui::update::kit;
use crate::verify::{ComparedPicture, Diff};

fn model() -> Model {
    let mut model = kit::model();
    (model.size, model.focus, model.place) = ([80, 24], Pane::Picture, Place::after(3));
    let drawn = Drawn { wire: true, tint: Tint::Group("kind".into()), ..Drawn::default() };
    let legend = vec![("kind A".into(), [230, 159, 0]), ("kind B".into(), [86, 180, 233])];
    model.picture.got = Some(Picture {
        shot: Shot { number: 1, drawn, ..Shot::default() },
        place: model.place,
        image: Arc::new(Image::filled([64, 48], [200, 100, 50, 255])),
        sight: Sight::Map,
        of: Some(0),
        legend,
        ms: 12.0,
    });
    model.picture.answered = 1;
    make(&mut model);
    model
}

fn make(model: &mut Model) {
    model.picture.encoded = request(model).map(|request| encode(&request).expect("a picture"));
}

fn drawn(model: &Model) -> Buffer {
    let mut buffer = Buffer::empty(Rect::new(0, 0, model.size[0], model.size[1]));
    draw(model, &Theme::default(), &mut buffer);
    buffer
}

#[test]
fn the_title_says_what_is_seen_and_of_which_event() {
    let mut model = model();
    assert_eq!(about(&model), "frame, edges, kind, as of event 0, 12 ms");
    model.picture.number = 2;
    assert!(about(&model).ends_with('…'), "another one is on its way");
    model.picture.got.as_mut().expect("a picture").of = Some(2);
    model.picture.window.zoom = 2.0;
    assert_eq!(about(&model), "frame, edges, kind, 2.0×, 12 ms…");
}

#[test]
fn the_legend_names_each_colour() {
    let text = to_text(&drawn(&model()));
    assert!(text.contains("■ kind A  ■ kind B"), "{text}");
}

#[test]
fn where_there_is_no_picture_the_pane_says_why() {
    let mut model = model();
    let painted = |model: &Model| {
        drawn(model).content.iter().filter(|cell| cell.bg == Color::Rgb(200, 100, 50)).count()
    };
    assert!(painted(&model) > 100);
    model.picture.golden = Golden::Split;
    assert!(to_text(&drawn(&model)).contains("`compare` first") && painted(&model) == 0);
    model.picture.golden = Golden::Off;
    model.picture.miss(2, "the device is lost\u{1b}[2J".into());
    let text = to_text(&drawn(&model));
    assert!(text.contains("the device is lost") && !text.contains('\u{1b}'), "{text}");
}

#[test]
fn a_golden_picture_is_shown_beside_the_actual_one_with_its_measures() {
    let mut model = model();
    model.differences = Some(differences([0, 0, 250, 255], [250, 0, 0, 255]));
    model.picture.golden = Golden::Split;
    golden::follow(&mut model);
    make(&mut model);
    let buffer = drawn(&model);
    let cells = |colour| buffer.content.iter().filter(|cell| cell.bg == colour).count();
    let [golden, actual] = [Color::Rgb(0, 0, 250), Color::Rgb(250, 0, 0)].map(cells);
    assert!(golden > 20 && actual > 20, "{golden} {actual}");
    let text = to_text(&buffer);
    assert!(text.contains("beyond") && text.contains("tile 9.0000/1.0000"), "{text}");
    model.picture.split = 0.5;
    make(&mut model);
    assert_eq!(drawn(&model).content.iter().filter(|cell| cell.bg == Color::Rgb(250, 0, 0)).count(), 0);
    model.place = Place::after(1);
    golden::follow(&mut model);
    assert!(to_text(&drawn(&model)).contains("no checkpoint here"));
}

/// A comparison with one picture, at event 2.
fn differences(golden: [u8; 4], actual: [u8; 4]) -> Differences {
    let of = |colour| Arc::new(Image::filled([64, 48], colour));
    let far = |tile| crate::verify::Distance { tile, ..Default::default() };
    let report = ImageReport {
        checkpoint: "end".into(),
        event: 2,
        size: [64, 48],
        verdict: ImageVerdict::Beyond,
        distance: Some(far(9.0)),
        worst_tile: None,
        gate: crate::verify::Gate { of: "any".into(), most: far(1.0) },
        proven_by: "any".into(),
        proof: Default::default(),
    };
    let picture = ComparedPicture {
        checkpoint: "end".into(),
        event: 2,
        golden: Some(of(golden)),
        actual: of(actual),
        difference: Some(of([255; 4])),
        report,
    };
    let mut differences = Differences::from_run(With::Goldens, Diff::default());
    differences.pictures.push(picture);
    differences
}
