//! Events: views, modes, cuts, and what is taken back.

use std::f64::consts::{FRAC_PI_2, PI};

use super::Dice;
use super::picks::Picker;
use crate::attack::trial::Trial;
use crate::engine::wound::{CameraChange, Mode, Pick, WoundEvent};

/// Runs one more cut, with whatever comes before and after it.
pub(in super::super) fn cut(trial: &mut Trial, dice: &mut Dice<'_>) {
    if dice.once_in(3) {
        trial.run(WoundEvent::Camera(camera(dice)));
    }
    if dice.once_in(2) {
        trial.run(WoundEvent::Mode(dice.one_of([Mode::Carve, Mode::Merge, Mode::Patch])));
    }
    let event = match dice.below(16) {
        0 => subdivision(trial, dice),
        1 => clicks(trial, dice),
        2 => again(trial, dice),
        _ => by_ids(trial, dice),
    };
    trial.run(event);
    aftermath(trial, dice);
}

/// The first view: mostly from straight above, from where the eye is exact.
pub(in super::super) fn view(trial: &mut Trial, dice: &mut Dice<'_>) {
    let above = CameraChange { azimuth: Some(0.0), zenith: Some(0.0), distance: Some(64.0) };
    let change = if dice.once_in(3) { camera(dice) } else { above };
    trial.run(WoundEvent::Camera(change));
}

fn camera(dice: &mut Dice<'_>) -> CameraChange {
    let angle = PI * dice.inside();
    let zenith = dice.one_of([0.0, 0.0, FRAC_PI_2, PI, angle]);
    let angle = 2.0 * PI * dice.inside();
    let azimuth = dice.one_of([0.0, FRAC_PI_2, PI, angle]);
    let distance = dice.one_of([Some(64.0), Some(4.0), None, Some(0.5), Some(1024.0)]);
    CameraChange { azimuth: Some(azimuth), zenith: Some(zenith), distance }
}

fn by_ids(trial: &Trial, dice: &mut Dice<'_>) -> WoundEvent {
    let (mesh, gutter) = (&trial.state.mesh, &trial.gutter()[..]);
    let [from, to] = Picker { mesh, gutter, dice }.pair();
    WoundEvent::Cut { from, to }
}

/// An earlier cut once more, or the other way round.
fn again(trial: &Trial, dice: &mut Dice<'_>) -> WoundEvent {
    let cuts: Vec<[Pick; 2]> =
        trial.recording.events.iter().filter_map(|keyed| picks(&keyed.event)).collect();
    match dice.any_of(&cuts) {
        Some([from, to]) if dice.once_in(2) => WoundEvent::Cut { from: to, to: from },
        Some([from, to]) => WoundEvent::Cut { from, to },
        None => by_ids(trial, dice),
    }
}

fn picks(event: &WoundEvent) -> Option<[Pick; 2]> {
    match event {
        WoundEvent::Cut { from, to } => Some([*from, *to]),
        _ => None,
    }
}

/// Between two pixels, over nodes or beside them.
fn clicks(trial: &Trial, dice: &mut Dice<'_>) -> WoundEvent {
    let pixel = |dice: &mut Dice<'_>| {
        let node = trial.state.mesh.positions()[dice.below(trial.state.mesh.node_count())];
        let [x, y] = trial.state.control.camera.project(node).unwrap_or([0.0; 2]);
        let off = dice.one_of([0.0, 0.5, 7.0, -31.0]);
        Pick::Pixel([x + off, y - 0.5 * off])
    };
    WoundEvent::Cut { from: pixel(dice), to: pixel(dice) }
}

fn subdivision(trial: &Trial, dice: &mut Dice<'_>) -> WoundEvent {
    let [width, height] = trial.recording.viewport.map(f64::from);
    let at = [width * (0.25 + 0.5 * dice.inside()), height * (0.25 + 0.5 * dice.inside())];
    WoundEvent::Subdivide { at, into: dice.one_of([3, 4, 6]) }
}

/// Now and then what was done is taken back, and perhaps done again.
fn aftermath(trial: &mut Trial, dice: &mut Dice<'_>) {
    match dice.below(8) {
        0 => trial.run(WoundEvent::Undo {}),
        1 => {
            trial.run(WoundEvent::Undo {});
            trial.run(WoundEvent::Redo {});
        }
        2 => trial.run(WoundEvent::Checkpoint(format!("c{}", trial.recording.events.len()))),
        _ => {}
    }
}
