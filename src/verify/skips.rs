//! What was skipped of rendering, and what that saved.
//!
//! Passes are added up by the first word of their id: `shadow 0` and `shadow 1` are shadows. What a skip saved is an estimate: a pass that
//! was not done counts as the mean of those that were, a tile like the mean of those worked through.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::report::{EventReport, Pass};

/// A kind of pass, over many frames.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Skips {
    /// The first word of its id, such as `shadow`.
    pub pass: String,
    /// How often it was done.
    pub done: usize,
    /// How often it was skipped, by reason.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub skipped: BTreeMap<String, usize>,
    /// How many tiles of the screen it worked through.
    pub tiles: u64,
    /// Of how many, where it was done.
    pub of: u64,
    /// Microseconds that it took.
    pub us: f64,
}

impl Skips {
    /// How often it was skipped, whatever the reason.
    pub fn times_skipped(&self) -> usize {
        self.skipped.values().sum()
    }

    /// Microseconds that the skips are estimated to have saved.
    pub fn saved_us(&self) -> f64 {
        let by_tiles = if self.tiles == 0 { 1.0 } else { self.of.max(self.tiles) as f64 / self.tiles as f64 };
        let in_full = self.us * by_tiles;
        in_full - self.us + in_full / self.done.max(1) as f64 * self.times_skipped() as f64
    }

    fn add(&mut self, other: &Self) {
        self.done += other.done;
        other.skipped.iter().for_each(|(why, n)| *self.skipped.entry(why.clone()).or_default() += n);
        (self.tiles, self.of, self.us) = (self.tiles + other.tiles, self.of + other.of, self.us + other.us);
    }
}

/// One pass of one frame.
fn once(pass: &Pass) -> Skips {
    let name = pass.id.split(' ').next().unwrap_or_default().to_owned();
    match &pass.skipped {
        Some(why) => Skips { pass: name, skipped: [(why.clone(), 1)].into(), ..Skips::default() },
        None => Skips {
            pass: name,
            done: 1,
            tiles: pass.tiles.into(),
            of: pass.of.into(),
            us: pass.us,
            ..Skips::default()
        },
    }
}

/// The passes of a run's frames.
pub(super) fn of_run(events: &[EventReport]) -> Vec<Skips> {
    let each: Vec<Skips> = events.iter().flat_map(|event| &event.passes).map(once).collect();
    sum(&each)
}

/// Adds up by pass, in the order in which they come first.
pub(super) fn sum<'a>(all: impl IntoIterator<Item = &'a Skips>) -> Vec<Skips> {
    let mut sums: Vec<Skips> = Vec::new();
    for skips in all {
        match sums.iter_mut().find(|sum| sum.pass == skips.pass) {
            Some(sum) => sum.add(skips),
            None => sums.push(skips.clone()),
        }
    }
    sums
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pass(id: &str, us: f64, skipped: Option<&str>, [tiles, of]: [u32; 2]) -> Pass {
        Pass { id: id.into(), us, skipped: skipped.map(Into::into), tiles, of }
    }

    #[test]
    fn passes_add_up_by_the_first_word_with_their_reasons() {
        let mut event = EventReport::new(0, "checkpoint");
        event.passes = vec![
            pass("shadow 0", 30.0, None, [0, 0]),
            pass("shadow 1", 0.0, Some("it reaches nothing"), [0, 0]),
            pass("scatter", 10.0, None, [5, 20]),
            pass("shadow 2", 50.0, None, [0, 0]),
        ];
        let skips = of_run(&[event.clone(), event]);
        assert_eq!(skips.iter().map(|s| s.pass.as_str()).collect::<Vec<_>>(), ["shadow", "scatter"]);
        assert_eq!((skips[0].done, skips[0].times_skipped()), (4, 2));
        assert_eq!(skips[0].skipped["it reaches nothing"], 2);
        assert_eq!(skips[0].saved_us(), 80.0, "two of 40 on average");
        assert_eq!((skips[1].tiles, skips[1].of), (10, 40));
        assert_eq!(skips[1].saved_us(), 60.0, "a quarter of the tiles took 20");
    }

    #[test]
    fn what_was_never_done_is_not_known_to_save_anything() {
        let never = once(&pass("skin", 0.0, Some("no skin in view"), [0, 0]));
        assert_eq!(never.saved_us(), 0.0);
    }
}
