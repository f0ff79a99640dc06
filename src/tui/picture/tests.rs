//! When a picture is asked for, how large, and what becomes of an answer.

use super::*;
use crate::canvas::image::MapId;
use crate::tui::image::protocol::Kind;
use crate::tui::model::Effect;
use crate::tui::shot::{Sight, Tint};
use crate::tui::update::{kit, picture as update};
use crate::tui::worker::Ask;

/// The shots that are asked for now.
fn wanted(model: &mut Model) -> Vec<Shot> {
    update::want(model);
    let asked = std::mem::take(&mut model.effects).into_iter().filter_map(|effect| match effect {
        Effect::Ask(Ask::Shoot(shot)) => Some(*shot),
        _ => None,
    });
    asked.collect()
}

fn answer(model: &mut Model, shot: &Shot, size: [u32; 2]) {
    let image = Arc::new(Image::filled(size, [9, 9, 9, 255]));
    let (shot, place, sight) = (shot.clone(), model.place, Sight::Map);
    model.picture.take(Picture { shot, place, image, sight, of: None, legend: Vec::new(), ms: 1.0 });
}

#[test]
fn a_picture_is_asked_for_once_and_again_when_anything_about_it_is_another() {
    let mut model = kit::model();
    let first = wanted(&mut model).pop().expect("the first");
    assert!(model.picture.is_awaited() && wanted(&mut model).is_empty());
    answer(&mut model, &first, [30, 20]);
    assert!(!model.picture.is_awaited() && wanted(&mut model).is_empty());
    let changes: [fn(&mut Model); 7] = [
        |model| model.place = Place::after(1),
        |model| model.selected.push("f1".into()),
        |model| model.picture.drawn.wire = true,
        |model| model.picture.drawn.tint = Tint::Charts,
        |model| model.picture.subject = Subject::Map(MapId::Color),
        |model| model.picture.window.zoom = 3.0,
        |model| model.size = [100, 40],
    ];
    for (at, change) in changes.into_iter().enumerate() {
        change(&mut model);
        let shots = wanted(&mut model);
        assert_eq!((shots.len(), model.picture.is_awaited()), (1, true), "{at}");
        assert!(shots[0].number > first.number);
    }
    model.picture.forget();
    assert!(
        !model.picture.is_awaited() && wanted(&mut model).len() == 1,
        "what was there may be of another state"
    );
}

#[test]
fn more_is_rendered_than_a_half_block_shows_and_no_more_than_was_recorded() {
    let mut model = kit::model();
    let area = area(&model).expect("a place").as_size();
    let cells = [u32::from(area.width), u32::from(area.height)];
    let shot = wanted(&mut model).pop().expect("a shot");
    assert_eq!((shot.limit, shot.shown), ([3 * cells[0], 6 * cells[1]], [cells[0], 2 * cells[1]]));
    model.picture.window.zoom = 1.4;
    let larger = wanted(&mut model).pop().expect("a larger one");
    assert_eq!(larger.limit, [6 * cells[0], 12 * cells[1]]);
    model.picture.window.zoom = 1.9;
    assert!(wanted(&mut model).is_empty(), "it is large enough");
    model.picture.window.zoom = 64.0;
    assert_eq!(wanted(&mut model).pop().expect("the largest").limit, [640, 480]);
}

#[test]
fn where_no_picture_can_be_seen_none_is_asked_for() {
    let mut model = kit::model();
    model.picture.medium.kind = Kind::None;
    assert!(wanted(&mut model).is_empty());
    model = kit::model();
    (model.focus, model.maximised) = (Pane::Timeline, true);
    assert!(wanted(&mut model).is_empty());
    assert!(wanted(&mut Model { size: [80, 24], ..Model::default() }).is_empty());
}

#[test]
fn another_recording_has_another_picture_and_the_terminal_stays_what_it_is() {
    let mut picture = PictureState { number: 7, answered: 6, ..PictureState::default() };
    picture.medium.kind = Kind::Sixel;
    (picture.orbit, picture.drawn.wire) = (Some(Orbit { azimuth: 1.0, zenith: 1.0, distance: 1.0 }), true);
    picture.missing = Some("why".into());
    let anew = picture.anew();
    assert_eq!((anew.medium.kind, anew.number, anew.drawn.wire), (Kind::Sixel, 7, true));
    assert!(anew.orbit.is_none() && anew.missing.is_none());
}

#[test]
fn the_line_below_has_its_own_place() {
    for (width, height) in (0..70).flat_map(|width| (0..40).map(move |height| (width, height))) {
        for maximised in [false, true] {
            let mut model = Model { size: [width, height], maximised, ..kit::model() };
            model.focus = Pane::Picture;
            let [picture, below] = places(&model).expect("a pane");
            assert!(picture.intersection(below).is_empty(), "{width} x {height}");
            assert!(picture.bottom() <= height && below.bottom() <= height && below.height <= 1);
        }
    }
}
