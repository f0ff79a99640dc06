//! The target `cuts`: a scene, as it is or of a hostile size and place, and a sequence of cuts over one another, with undo and redo between them.
//!
//! The first cuts are drawn anywhere; later ones go for what is there: across earlier lines, from their ends, along their gutters, the same
//! again. Scenes of code are there for their seams and for being larger than a cut, so that cuts can have nothing to do with each other.

use super::draw::{Dice, events, shape};
use super::trial::{Look, Trial, builtins};
use super::{Finding, Outcome};
use crate::engine::wound::WoundEvent;
use crate::recording::{InlineMesh, Recording, SceneRef};

/// The most cuts of an input.
const CUTS: usize = 16;
/// The same in a scene of more faces than these.
const FEW: usize = 4;
const LARGE: usize = 600;
/// What coordinates are multiplied by.
const SCALES: [f64; 8] = [1.0, 1e-9, 1e-6, 1e-3, 1e3, 1e6, 1e9, 16.0];
/// What is added to them after that, in largest coordinates.
const SHIFTS: [f64; 6] = [0.0, 0.0, 1.0, 1e3, 1e6, -1e9];

/// Draws the recording, runs it, and looks at it with every oracle.
pub(super) fn run(data: &[u8]) -> Outcome {
    let mut dice = Dice::new(data);
    match Trial::begin(begin(&mut dice), Look::Everything) {
        Some(mut trial) => {
            draw(&mut trial, &mut dice);
            trial.end()
        }
        None => Err(Finding::new("scene", "a drawn scene is refused")),
    }
}

fn begin(dice: &mut Dice<'_>) -> Recording<WoundEvent> {
    let [tiny, small, large @ ..] = builtins();
    let scene = match dice.below(16) {
        0..=5 => SceneRef::Inline(elsewhere(&shape::draw(dice), dice)),
        6..=9 => SceneRef::Builtin(tiny.into()),
        10..=14 => SceneRef::Builtin(small.into()),
        // A cut costs more there, and most of it is the same.
        _ => SceneRef::Builtin(dice.one_of(large).into()),
    };
    Trial::blank(scene, u64::from(dice.byte()))
}

/// The same mesh of another size and in another place; as it was, should rounding make it another mesh.
fn elsewhere(mesh: &InlineMesh, dice: &mut Dice<'_>) -> InlineMesh {
    let (scale, shift) = (dice.one_of(SCALES), dice.one_of(SHIFTS));
    let largest = mesh.nodes.iter().flatten().fold(0.0, |most: f64, v| most.max(v.abs()));
    let nodes = mesh.nodes.iter().map(|p| p.map(|v| v * scale + shift * largest * scale)).collect();
    let moved = InlineMesh { nodes, ..mesh.clone() };
    if shape::has_area(&moved) { moved } else { mesh.clone() }
}

fn draw(trial: &mut Trial, dice: &mut Dice<'_>) {
    events::view(trial, dice);
    let is_large = trial.state.mesh.face_count() > LARGE;
    let cuts = 2 + dice.below(if is_large { FEW } else { CUTS });
    for _ in 0..cuts {
        // Where the bytes end so does the input: what follows would be the first choice again and again.
        if trial.is_over() || dice.is_empty() {
            return;
        }
        events::cut(trial, dice);
    }
}
