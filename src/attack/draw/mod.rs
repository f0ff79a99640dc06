//! What a fuzzer's bytes stand for: a mesh, a view, picks. Every string of bytes gives a valid input.

mod blemish;
mod dice;
pub(super) mod events;
mod picks;
pub(super) mod shape;

pub(super) use dice::Dice;
