//! What makes exact coordinates hard: last bits, slivers, points that nearly coincide, another place and size.

use glam::DVec3;

use super::Dice;
use super::shape::Shape;

/// How thin slivers are: their aspect is the inverse.
const THIN: f64 = 1e-6;

/// Spoils a mesh a little, or leaves it as it is.
pub(super) fn draw(shape: &mut Shape, dice: &mut Dice<'_>) {
    for _ in 0..dice.below(3) {
        match dice.below(4) {
            0 => last_bits(shape, dice),
            1 => sliver(shape, dice),
            2 => near_duplicate(shape, dice),
            _ => squeeze(shape, dice),
        }
    }
    place(shape, dice);
}

/// Moves a node by a few ulps.
fn last_bits(shape: &mut Shape, dice: &mut Dice<'_>) {
    let (node, axis) = (dice.below(shape.nodes.len()), dice.below(3));
    let value = &mut shape.nodes[node][axis];
    // Around zero an ulp would be no size at all beside the rest.
    *value += f64::EPSILON * dice.one_of([0.5, 1.0, -1.0, 2.0, -4.0]);
}

/// Moves a corner of a face nearly onto the side across from it.
fn sliver(shape: &mut Shape, dice: &mut Dice<'_>) {
    let mut face = shape.faces[dice.below(shape.faces.len())];
    face.rotate_left(dice.below(3));
    let [a, b, c] = face.map(|i| shape.nodes[i as usize]);
    let foot = a + (b - a) * dice.one_of([0.5, 0.25, 0.75]);
    shape.nodes[face[2] as usize] = foot + (c - foot) * (THIN * dice.one_of([1.0, 0.25]));
}

/// Moves a node next to a neighbour of it.
fn near_duplicate(shape: &mut Shape, dice: &mut Dice<'_>) {
    let mut face = shape.faces[dice.below(shape.faces.len())];
    face.rotate_left(dice.below(3));
    let [a, b] = [face[0], face[1]].map(|i| shape.nodes[i as usize]);
    let near = dice.one_of([1e-9, 1e-12, 1e-14, 4.0 * f64::EPSILON]);
    shape.nodes[face[1] as usize] = a + (b - a) * near;
}

/// Makes all of it thin along an axis.
fn squeeze(shape: &mut Shape, dice: &mut Dice<'_>) {
    // A power of two: what was exactly in line stays so.
    let (axis, factor) = (dice.below(3), 1.0 / 1_048_576.0);
    shape.nodes.iter_mut().for_each(|p| p[axis] *= factor);
}

/// Puts it elsewhere, or makes it of another size: exactly, or so that coordinates are rounded.
fn place(shape: &mut Shape, dice: &mut Dice<'_>) {
    let by = dice.one_of([0.0, 0.0, 0.0, 1.0, 4.0, 1_048_576.0, 0.1]);
    let axes = DVec3::new(f64::from(dice.byte() & 1), 1.0, f64::from(dice.byte() & 1));
    let scale = dice.one_of([1.0, 1.0, 1.0, 0.5, 2.0, 0.1, 1.0 / 3.0]);
    shape.nodes.iter_mut().for_each(|p| *p = (*p + axes * by) * scale);
}
