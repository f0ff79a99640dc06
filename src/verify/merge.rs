//! One report from the reports of all shards: but for its times the report that one machine would have made.

use std::collections::BTreeMap;
use std::fmt;

use super::blob::Blob;
use super::detail::Detail;
use super::report::{RecordingReport, VerifyReport};

/// A message names no more shards that are missing.
const MOST_NAMED: usize = 20;

/// Why reports are not the shards of one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum MergeError {
    /// There is none.
    Nothing,
    /// A report is none of a shard, and there are others.
    NoShard {
        /** Its file. */
        file: String,
    },
    /// A report says that it is a shard which there cannot be.
    Impossible {
        /** Its file. */
        file: String,
    },
    /// Two reports are of different lists of recordings, or of different numbers of shards.
    Different {
        /** The two files. */
        files: [String; 2],
        /** What differs. */
        what: &'static str,
    },
    /// Two reports are of one shard.
    Doubled {
        /** The two files. */
        files: [String; 2],
        /** The shard. */
        shard: u32,
    },
    /// There is no report of some shards.
    Missing {
        /** The first of them. */
        shards: Vec<u32>,
        /** Of how many. */
        of: u32,
    },
}

impl fmt::Display for MergeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Nothing => f.write_str("there is nothing to merge"),
            Self::NoShard { file } => write!(f, "{file}: it is no shard: it was verified without --shard"),
            Self::Impossible { file } => write!(f, "{file}: there is no such shard as it says it is"),
            Self::Different { files: [a, b], what } => write!(f, "{b}: {what} is not that of {a}"),
            Self::Doubled { files: [a, b], shard } => write!(f, "{b}: shard {shard} is in {a} already"),
            Self::Missing { shards, of } => {
                let list: Vec<String> = shards.iter().map(u32::to_string).collect();
                let more = if list.len() == MOST_NAMED { ", …" } else { "" };
                write!(f, "missing of {of} shards: {}{more}", list.join(", "))
            }
        }
    }
}

impl std::error::Error for MergeError {}

/// Puts the blobs of all shards together, each with the name of its file. One that is no shard stands for itself.
pub fn merge(mut blobs: Vec<(String, Blob)>) -> Result<Blob, MergeError> {
    if blobs.len() == 1 && blobs[0].1.report.shard.is_none() {
        return Ok(blobs.remove(0).1);
    }
    let shards = in_order(blobs)?;
    let (mut queues, mut details) = (Vec::new(), Vec::new());
    let mut rest = VerifyReport::new(None, Vec::new());
    for mut shard in shards {
        queues.push(std::mem::take(&mut shard.report.recordings).into_iter());
        details.extend(shard.details);
        rest = with(rest, shard.report);
    }
    let recordings = dealt_back(queues);
    sort_like(&mut details, &recordings);
    let skips = VerifyReport::new(None, recordings);
    Ok(Blob::new(VerifyReport { recordings: skips.recordings, skips: skips.skips, ..rest }, details))
}

/// The shards by index, each once.
fn in_order(blobs: Vec<(String, Blob)>) -> Result<Vec<Blob>, MergeError> {
    let mut by_index: BTreeMap<u32, (String, Blob)> = BTreeMap::new();
    for (file, blob) in blobs {
        let shard = blob.report.shard.clone().ok_or_else(|| MergeError::NoShard { file: file.clone() })?;
        if !(1..=shard.of).contains(&shard.index) {
            return Err(MergeError::Impossible { file });
        }
        if let Some((first, other)) = by_index.values().next()
            && let Some(what) = difference(&other.report, &blob.report)
        {
            return Err(MergeError::Different { files: [first.clone(), file], what });
        }
        match by_index.remove(&shard.index) {
            Some((first, _)) => {
                return Err(MergeError::Doubled { files: [first, file], shard: shard.index });
            }
            None => by_index.insert(shard.index, (file, blob)),
        };
    }
    let of = by_index.values().next().and_then(|(_, blob)| Some(blob.report.shard.as_ref()?.of));
    let of = of.ok_or(MergeError::Nothing)?;
    let shards: Vec<u32> = (1..=of).filter(|index| !by_index.contains_key(index)).take(MOST_NAMED).collect();
    if shards.is_empty() {
        Ok(by_index.into_values().map(|(_, blob)| blob).collect())
    } else {
        Err(MergeError::Missing { shards, of })
    }
}

/// What keeps two reports from being shards of one.
fn difference(a: &VerifyReport, b: &VerifyReport) -> Option<&'static str> {
    let list = |report: &VerifyReport| report.shard.as_ref().map(|s| (s.list.clone(), s.recordings));
    let of = |report: &VerifyReport| report.shard.as_ref().map(|s| s.of);
    if list(a) != list(b) {
        Some("its list of recordings")
    } else if of(a) != of(b) {
        Some("its number of shards")
    } else if a.adapter != b.adapter {
        Some("its renderer")
    } else {
        (a.schema != b.schema).then_some("its layout")
    }
}

/// One recording from each in turn, as they were dealt.
fn dealt_back(mut queues: Vec<std::vec::IntoIter<RecordingReport>>) -> Vec<RecordingReport> {
    let mut recordings = Vec::new();
    loop {
        let round: Vec<RecordingReport> = queues.iter_mut().filter_map(Iterator::next).collect();
        if round.is_empty() {
            return recordings;
        }
        recordings.extend(round);
    }
}

/// Every shard looks at all goldens for orphans, so they are the same in each.
fn with(mut report: VerifyReport, shard: VerifyReport) -> VerifyReport {
    let united = |mut all: Vec<String>, more: Vec<String>| {
        let new: Vec<String> = more.into_iter().filter(|line| !all.contains(line)).collect();
        all.extend(new);
        all
    };
    report.orphans = united(report.orphans, shard.orphans);
    report.errors = united(report.errors, shard.errors);
    report.adapter = shard.adapter;
    report.left_out += shard.left_out;
    report.ms += shard.ms;
    report
}

fn sort_like(details: &mut [Detail], recordings: &[RecordingReport]) {
    let at = recordings.iter().enumerate().map(|(at, recording)| (recording.recording.as_str(), at));
    let at: BTreeMap<&str, usize> = at.collect();
    details.sort_by_key(|detail| at.get(detail.recording.as_str()).copied());
}
