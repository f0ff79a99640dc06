//! The planted bug: whether it is there, and how soon it is found.
//!
//! With the feature `canary` a face that is cut through two of its sides gets the vertices of the wrong side of a seam ([`crate::mesh::refine`]): the
//! surface is the same, and most cuts cross no seam. If the fuzzers do not find that within seconds, what else they did not find
//! that night says nothing.

use super::{Finding, TARGETS, Target};
use crate::measure::Random;

/// Whether the bug is there. A program in which it is verifies nothing.
pub const IS_PLANTED: bool = cfg!(feature = "canary");

/// Whether a finding is of the planted bug, by the oracles that see it.
pub fn is_planted(finding: &str) -> bool {
    SEEN_BY.iter().any(|check| finding.strip_prefix(check).is_some_and(|rest| rest.starts_with(": ")))
}

/// The oracles that see the planted bug.
const SEEN_BY: [&str; 1] = ["MC/uv-affine"];

/// The inputs that were run until something was found, and what it was; none within so many.
pub fn hunt(seed: u64, inputs: u64) -> Option<(u64, Box<Finding>)> {
    let target = TARGETS.iter().find(|target| target.name == "canary")?;
    (0..inputs).find_map(|input| Some((input + 1, attempt(target, seed, input)?)))
}

fn attempt(target: &Target, seed: u64, input: u64) -> Option<Box<Finding>> {
    let mut random = Random::of(seed, input, "canary");
    let bytes: Vec<u8> = (0..super::fusion::BYTES).map(|_| random.any() as u8).collect();
    target.attempt(&bytes).err()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_planted_bug_is_found_and_without_it_there_is_nothing() {
        let found = hunt(1, 200);
        assert_eq!(found.is_some(), IS_PLANTED, "{found:?}");
        assert!(found.is_none_or(|(_, found)| is_planted(&found.to_string())));
    }
}
