//! A fuzzer without libFuzzer: seeds, mutations, and what was reached as the only guide.
//!
//! For machines without a nightly compiler, and for whatever has to be the same every time: which inputs are tried depends on the seed and
//! the seeds alone. An input that reaches something of a new name joins the seeds. Weaker than libFuzzer by far, since it sees no branch.
//!
//! A round of a [`Storm`] is one input; whoever drives it says when to stop, so that no clock is known here.

use super::{Finding, Hits, Target};
use crate::measure::Random;

/// The longest input that is made.
const LONGEST: usize = 4096;
/// Mutations of an input, at most.
const MOST_MUTATIONS: usize = 8;
/// How often an input is drawn anew instead of mutated: once in so many, where there are seeds.
const NEW_EVERY: usize = 8;
/// Numbers at which things break: ends of ranges, signs, and what stands between elements of a text.
const TELLING: [u64; 16] = [
    0,
    1,
    2,
    3,
    0x20,
    0x30,
    0x7f,
    0xff,
    0x8000,
    0xffff,
    0x7fff_ffff,
    0xffff_ffff,
    0x7ff0_0000_0000_0000,
    0x7ff8_0000_0000_0000,
    0x8000_0000_0000_0000,
    u64::MAX,
];

/// A run of inputs against a target.
#[derive(Clone, Debug)]
pub struct Storm {
    target: &'static Target,
    seeds: Vec<Vec<u8>>,
    random: Random,
    /// How many inputs were run.
    pub runs: u64,
    /// What they reached.
    pub hits: Hits,
}

impl Storm {
    /// Against a target, from some inputs that are known.
    pub fn new(target: &'static Target, seeds: Vec<Vec<u8>>, seed: u64) -> Self {
        Self { target, seeds, random: Random::of(seed, 0, target.name), runs: 0, hits: Hits::default() }
    }

    /// Runs the next input; a finding comes with the input that led to it.
    pub fn round(&mut self) -> Result<(), (Box<Finding>, Vec<u8>)> {
        let data = self.next();
        self.runs += 1;
        match self.target.attempt(&data) {
            Err(finding) => Err((finding, data)),
            Ok(hits) => {
                let is_new = hits.0.keys().any(|name| !self.hits.0.contains_key(name));
                self.hits.add(&hits);
                if is_new {
                    self.seeds.push(data);
                }
                Ok(())
            }
        }
    }

    /// The seeds first, as they are; then mutations of them and inputs of chance.
    fn next(&mut self) -> Vec<u8> {
        if let Some(seed) = usize::try_from(self.runs).ok().and_then(|run| self.seeds.get(run)) {
            return seed.clone();
        }
        if self.seeds.is_empty() || self.random.once_in(NEW_EVERY) {
            let length = self.random.below(LONGEST / 4);
            return (0..length).map(|_| self.random.any() as u8).collect();
        }
        let mut data = self.any_seed();
        for _ in 0..=self.random.below(MOST_MUTATIONS) {
            self.mutate(&mut data);
        }
        data.truncate(LONGEST);
        data
    }

    fn any_seed(&mut self) -> Vec<u8> {
        let at = self.random.below(self.seeds.len());
        self.seeds.get(at).cloned().unwrap_or_default()
    }

    fn mutate(&mut self, data: &mut Vec<u8>) {
        let at = self.random.below(data.len() + 1);
        let end = (at + 1 + self.random.below(16)).min(data.len());
        match self.random.below(7) {
            0 => flip(data, at, self.random.below(8)),
            1 => self.overwrite(data, at),
            2 => drop(data.drain(at.min(end)..end)),
            3 => data.insert(at, self.random.any() as u8),
            4 => {
                let copy = data[at.min(end)..end].to_vec();
                let to = self.random.below(data.len() + 1);
                data.splice(to..to, copy);
            }
            5 => {
                let other = self.any_seed();
                let from = self.random.below(other.len() + 1);
                data.truncate(at);
                data.extend_from_slice(&other[from..]);
            }
            _ => data.truncate(at),
        }
    }

    /// Writes a telling number of one to eight bytes over what is there, either way around.
    fn overwrite(&mut self, data: &mut [u8], at: usize) {
        let number = self.random.one_of(&TELLING).unwrap_or_default();
        let width = self.random.one_of(&[1, 2, 4, 8]).unwrap_or(1);
        let mut bytes = number.to_le_bytes();
        if self.random.once_in(2) {
            bytes[..width].reverse();
        }
        data.iter_mut().skip(at).zip(&bytes[..width]).for_each(|(byte, new)| *byte = *new);
    }
}

fn flip(data: &mut [u8], at: usize, bit: usize) {
    if let Some(byte) = data.get_mut(at) {
        *byte ^= 1 << bit;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::attack::TARGETS;

    /// Breaks on an input that has three letters in a row, each of which it tells of.
    const PICKY: Target = Target {
        name: "picky",
        run: |data| {
            let mut hits = Hits::default();
            for letters in [&b"a"[..], b"ab", b"abc"] {
                if !data.windows(letters.len()).any(|w| w == letters) {
                    return Ok(hits);
                }
                hits.note(format!("{letters:?}"));
            }
            Err(Finding::new("abc", "it is there"))
        },
        ..TARGETS[0]
    };

    fn find(seed: u64) -> Option<(u64, Vec<u8>)> {
        let mut storm = Storm::new(&PICKY, Vec::new(), seed);
        (0..200_000).find_map(|run| storm.round().err().map(|(_, data)| (run, data)))
    }

    #[test]
    fn it_finds_what_is_reached_step_by_step_and_the_same_every_time() {
        let found = find(1).expect("it is found");
        assert_eq!(find(1), Some(found.clone()));
        assert_ne!(find(2), Some(found));
    }

    #[test]
    fn every_target_withstands_a_gust() {
        for target in TARGETS {
            let mut storm = Storm::new(target, vec![target.name.as_bytes().to_vec()], 3);
            for _ in 0..40 {
                storm
                    .round()
                    .unwrap_or_else(|(finding, data)| panic!("{}: {finding} of {data:?}", target.name));
            }
            assert!(storm.runs == 40 && !storm.hits.0.is_empty());
        }
    }
}
