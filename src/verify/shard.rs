//! A part of the recordings, for one of several machines.
//!
//! Shard K of N takes every Nth recording of the sorted list, from the Kth on: so folders of heavy recordings are spread over all. A report says which part
//! it is and of which list, so that [`merge`](super::merge()) can tell when a part is missing or of another list.

use std::fmt;
use std::path::PathBuf;
use std::str::FromStr;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::home;

/// A shard has no more siblings.
const MOST: u32 = 10_000;

/// One part of so many.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// Which, from 1.
    index: u32,
    /// Of how many.
    of: u32,
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers = text.split_once('/').and_then(|(k, n)| Some((k.parse().ok()?, n.parse().ok()?)));
        match numbers {
            Some((index, of)) if (1..=of).contains(&index) && of <= MOST => Ok(Self { index, of }),
            _ => Err(format!("not K/N, such as 2/7, with K from 1 to N and N up to {MOST}")),
        }
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.index, self.of)
    }
}

/// Which part of the recordings a report is of.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct ShardReport {
    /// Which, from 1.
    pub index: u32,
    /// Of how many.
    pub of: u32,
    /// How many recordings the whole list has.
    pub recordings: usize,
    /// Digest of the names in the whole list, 32 hexadecimal digits.
    pub list: String,
}

impl Shard {
    /// Takes this part out of a sorted list.
    pub(super) fn take(self, recordings: &mut Vec<PathBuf>) -> ShardReport {
        let report = ShardReport {
            index: self.index,
            of: self.of,
            recordings: recordings.len(),
            list: digest(recordings),
        };
        let step = self.of as usize;
        let own = std::mem::take(recordings).into_iter().skip(self.index as usize - 1).step_by(step);
        *recordings = own.collect();
        report
    }
}

fn digest(recordings: &[PathBuf]) -> String {
    let mut hasher = blake3::Hasher::new();
    for name in recordings.iter().map(|recording| home::name(recording)) {
        hasher.update(&(name.len() as u64).to_le_bytes());
        hasher.update(name.as_bytes());
    }
    hasher.finalize().to_hex()[..32].into()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn list() -> Vec<PathBuf> {
        (0..10).map(|i| format!("recordings/r{i}.lancet").into()).collect()
    }

    #[test]
    fn shards_are_a_partition() {
        for of in [1, 2, 7, 13] {
            let mut all = Vec::new();
            for index in 1..=of {
                let mut own = list();
                let report = Shard { index, of }.take(&mut own);
                assert_eq!((report.index, report.of, report.recordings), (index, of, 10));
                assert!(own.len().abs_diff(10 / of as usize) <= 1, "{index}/{of}: {own:?}");
                all.extend(own);
            }
            all.sort();
            assert_eq!(all, list(), "of {of}");
        }
    }

    #[test]
    fn a_list_goes_by_its_names() {
        let of = |mut list: Vec<PathBuf>| Shard { index: 1, of: 2 }.take(&mut list).list;
        assert_eq!(of(list()), of(list()));
        assert_ne!(of(list()), of(list()[1..].to_vec()));
        assert_ne!(of(vec!["recordings/ab.lancet".into(), "recordings/c.lancet".into()]), {
            of(vec!["recordings/a.lancet".into(), "recordings/bc.lancet".into()])
        });
    }

    #[test]
    fn what_is_typed_is_looked_at() {
        assert_eq!("2/7".parse(), Ok(Shard { index: 2, of: 7 }));
        assert_eq!("7/7".parse::<Shard>().map(|s| s.to_string()), Ok("7/7".into()));
        for wrong in ["", "3", "0/7", "8/7", "1/0", "-1/2", "1/2/3", "a/b", "1/4294967295"] {
            assert!(wrong.parse::<Shard>().is_err(), "{wrong}");
        }
    }
}
