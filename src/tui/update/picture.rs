//! The picture by keys: what it is of, what is drawn over it, where it is looked at from, which part is seen; and saving it.
//!
//! All of it is for looking only: no recording is changed.

mod mouse;

use std::f64::consts::PI;
use std::path::PathBuf;
use std::sync::Arc;

pub(in crate::tui) use mouse::mouse;

use crate::assets;
use crate::canvas::frame::Orbit;
use crate::report::{EventReport, printable};
use crate::tui::action::Action;
use crate::tui::image::encoder::Encoded;
use crate::tui::image::window::Window;
use crate::tui::model::Model;
use crate::tui::picture::golden::{self, Golden};
use crate::tui::picture::{self, PictureState};
use crate::tui::popups::Question;
use crate::tui::shot::{Drawn, Shot, Subject, Tint, groups};
use crate::tui::worker::{Ask, Frame};

/// A key's turn, radians.
const TURN: f64 = 0.05;
/// What a key makes the distance.
const NEARER: f64 = 0.9;
/// How far away or near one can go, over where the recording looks from.
const REACH: f64 = 1000.0;
/// What a key enlarges the picture by.
const ZOOM: f64 = 1.25;
/// The share of the pane by which a key moves the picture, or the line between two.
const STEP: f64 = 0.05;

pub(super) fn act(model: &mut Model, action: Action) {
    use Action as A;
    let drawn = &mut model.picture.drawn;
    match action {
        A::Wire => drawn.wire = !drawn.wire,
        A::Lines => drawn.lines = !drawn.lines,
        A::Tint => next_tint(model),
        A::Subject => show(model, model.picture.subject.next()),
        A::Split => show_golden(model, model.picture.golden.next()),
        A::SplitLeft => split(model, -STEP),
        A::SplitRight => split(model, STEP),
        A::OrbitLeft => turn(model, [-1.0, 0.0]),
        A::OrbitRight => turn(model, [1.0, 0.0]),
        A::OrbitUp => turn(model, [0.0, -1.0]),
        A::OrbitDown => turn(model, [0.0, 1.0]),
        A::Nearer => look(model, [0.0, 0.0], NEARER),
        A::Farther => look(model, [0.0, 0.0], 1.0 / NEARER),
        A::ZoomIn => zoom(model, None, ZOOM),
        A::ZoomOut => zoom(model, None, 1.0 / ZOOM),
        A::PanLeft => pan(model, [STEP, 0.0]),
        A::PanRight => pan(model, [-STEP, 0.0]),
        A::PanUp => pan(model, [0.0, STEP]),
        A::PanDown => pan(model, [0.0, -STEP]),
        A::ResetView => (model.picture.orbit, model.picture.window) = (None, Window::default()),
        _ => super::popup::ask(model, Question::SavePicture),
    }
}

/// Colours the faces by what comes next: the groups of the report that is drawn, the charts, nothing.
fn next_tint(model: &mut Model) {
    let overlays = picture::source(model).map_or(&[][..], |report: &EventReport| &report.overlays);
    let tints = groups(overlays).into_iter().map(|group| Tint::Group(group.into()));
    let tints: Vec<Tint> = [Tint::None].into_iter().chain(tints).chain([Tint::Charts]).collect();
    // A group that is not there any more comes before all others.
    let now = tints.iter().position(|tint| *tint == model.picture.drawn.tint).unwrap_or(0);
    model.picture.drawn.tint = tints[(now + 1) % tints.len()].clone();
    if model.picture.golden != Golden::Off {
        show_golden(model, Golden::Off);
    }
}

fn show(model: &mut Model, subject: Subject) {
    let picture = &mut model.picture;
    (picture.subject, picture.golden, picture.window) = (subject, Golden::Off, Window::default());
}

fn show_golden(model: &mut Model, golden: Golden) {
    let picture = &mut model.picture;
    if picture.golden == Golden::Off || golden == Golden::Off {
        picture.window = Window::default();
    }
    picture.golden = golden;
}

/// Moves the line between golden and actual.
fn split(model: &mut Model, by: f64) {
    let picture = &mut model.picture;
    picture.split = (picture.split + by).clamp(-0.5, 0.5);
}

/// What the keys do that look from elsewhere: where there is nothing to look at from another side, they move the picture.
fn turn(model: &mut Model, by: [f64; 2]) {
    match model.picture.is_flat() {
        true => pan(model, by.map(|by| -STEP * by)),
        false => look(model, by.map(|by| TURN * by), 1.0),
    }
}

/// Looks from elsewhere: turned by some radians to the right and down, at some factor of the distance.
fn look(model: &mut Model, [right, down]: [f64; 2], factor: f64) {
    let recorded = model.standing.as_ref().and_then(|standing| standing.orbit);
    let (Some(now), Some(recorded)) = (model.orbit(), recorded) else {
        return model.complain("there is no view here to look from");
    };
    let range = [recorded.distance / REACH, recorded.distance * REACH];
    model.picture.orbit = Some(Orbit {
        azimuth: libm::remainder(now.azimuth + right, 2.0 * PI),
        zenith: (now.zenith + down).clamp(0.0, PI),
        distance: (now.distance * factor).max(range[0]).min(range[1]),
    });
}

/// Enlarges the picture, and keeps what is at a point of the pane, or in its middle.
fn zoom(model: &mut Model, at: Option<[f64; 2]>, factor: f64) {
    let Some((size, pane)) = sizes(model) else { return };
    let at = at.unwrap_or(pane.map(|side| f64::from(side) / 2.0));
    model.picture.window.zoom_at(at, factor, size, pane);
}

/// Moves the picture by shares of the pane.
fn pan(model: &mut Model, by: [f64; 2]) {
    let Some((size, pane)) = sizes(model) else { return };
    let by = [0, 1].map(|k| by[k] * f64::from(pane[k]));
    model.picture.window.pan(by, size, pane);
}

/// The picture's pixels, and its pane's.
fn sizes(model: &Model) -> Option<([u32; 2], [u32; 2])> {
    let area = picture::area(model)?;
    Some((picture::size(model)?, model.picture.medium.pixels(area.as_size())))
}

/// Asks for what is missing of the picture that is wanted.
pub(in crate::tui) fn want(model: &mut Model) {
    golden::follow(model);
    let Some(shot) = model.picture.shot(model) else { return };
    model.picture.number = shot.number;
    model.picture.asked = Some((model.place, shot.clone()));
    model.ask(Ask::Shoot(Box::new(shot)));
}

/// A picture is ready to be drawn, or cannot be.
pub(in crate::tui) fn encoded(model: &mut Model, encoded: Result<Encoded, String>) {
    match encoded {
        Ok(encoded) => model.picture.encoded = Some(encoded),
        Err(why) => {
            model.picture.encoded = None;
            model.picture.missing = Some(why);
        }
    }
}

/// Somebody clicked on a face, or beside all of them.
pub(super) fn identified(model: &mut Model, face: Option<String>) {
    match face {
        Some(face) => {
            model.say(format!("selected {face}"));
            model.selected = vec![face];
        }
        None => {
            model.say("there is no face there");
            model.selected.clear();
        }
    }
}

/// Writes the picture that is shown as PNG: as large as it is recorded, with all that is drawn over it.
pub(in crate::tui) fn save(model: &mut Model, text: &str) -> Result<(), String> {
    let path = file(text)?;
    let what = match frame(model) {
        Some(what) => what,
        None if model.picture.golden != Golden::Off => return Err(golden::lack(model)),
        None => return Err("there is no picture".into()),
    };
    model.ask(Ask::SavePicture { path, what });
    Ok(())
}

fn file(text: &str) -> Result<PathBuf, String> {
    let mut path = PathBuf::from(text.trim());
    let name = path.file_name().ok_or("name a file to write it to, such as frame.png")?.to_owned();
    match path.extension() {
        None => drop(path.set_extension("png")),
        Some(end) if end.eq_ignore_ascii_case("png") => {}
        Some(_) => return Err(format!("{}: a picture is written as PNG", printable(name.display()))),
    }
    match assets::is_file(&path) {
        true => Err(format!("{}: is there already", printable(path.display()))),
        false => Ok(path),
    }
}

fn frame(model: &Model) -> Option<Frame> {
    let PictureState { subject, orbit, drawn, golden, .. } = &model.picture;
    if *golden != Golden::Off {
        let request = picture::request(model)?;
        let image = match &request.beside {
            Some((right, share)) => {
                Arc::new(crate::tui::image::compare::slider(&request.image, right, *share))
            }
            None => request.image,
        };
        return Some(Frame::Image(image));
    }
    let size = match subject {
        Subject::Frame => model.opened.as_ref()?.viewport,
        Subject::Map(_) => [u32::MAX; 2],
    };
    let drawn = Drawn { marked: model.selected.clone(), ..drawn.clone() };
    Some(Frame::Shot(Box::new(Shot {
        number: 0,
        subject: *subject,
        orbit: *orbit,
        limit: size,
        shown: size,
        drawn,
    })))
}

#[cfg(test)]
mod tests;
