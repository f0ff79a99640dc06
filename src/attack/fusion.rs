//! The target `fusion`: a small mesh with hard-rounded coordinates, and cuts whose ends are of chosen kinds, so that their links come in each of the nine
//! configurations, alone and in sequence, in every rotation of a face's corners.
//!
//! Every string of bytes is a valid input. What is made of it is a recording with the mesh in it.

use super::Outcome;
use super::draw::{Dice, events, shape};
use super::trial::{Look, Trial};
use crate::engine::wound::WoundEvent;
use crate::recording::{Recording, SceneRef};

/// As many bytes as an input seldom needs more of.
pub(super) const BYTES: usize = 256;
/// The most cuts of an input.
const CUTS: usize = 6;
/// One in so many inputs is cut into a mesh with seams, which no mesh within a recording has.
const SEAMS: usize = 12;

/// Draws the recording, runs it, and looks at it with every oracle.
pub(super) fn run(data: &[u8]) -> Outcome {
    look(data, Look::Everything)
}

/// The same, looked at by so much.
pub(super) fn look(data: &[u8], look: Look) -> Outcome {
    let mut dice = Dice::new(data);
    match Trial::begin(begin(&mut dice), look) {
        Some(mut trial) => {
            draw(&mut trial, &mut dice);
            trial.end()
        }
        None => Err(super::Finding::new("scene", "a drawn mesh is refused")),
    }
}

fn begin(dice: &mut Dice<'_>) -> Recording<WoundEvent> {
    let scene = match dice.once_in(SEAMS) {
        true => SceneRef::Builtin("sphere:20".into()),
        false => SceneRef::Inline(shape::draw(dice)),
    };
    Trial::blank(scene, u64::from(dice.byte()))
}

fn draw(trial: &mut Trial, dice: &mut Dice<'_>) {
    events::view(trial, dice);
    let cuts = 1 + dice.below(CUTS);
    for _ in 0..cuts {
        if trial.is_over() {
            return;
        }
        events::cut(trial, dice);
    }
}
