//! Many recordings: found, replayed several at a time, and reported in the order of their paths.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Instant;

use super::blob::Blob;
use super::image::{GatesFile, Rules};
use super::one::{Open, open_file, verify_one};
use super::report::{Verdict, VerifyReport};
use super::shard::Shard;
use super::{golden, home};
use crate::assets;
use crate::canvas::{Adapter, Studio};
use crate::replay::Options;

/// How recordings are verified.
#[derive(Clone, Default)]
pub struct VerifyOptions {
    /// Only recordings with this in their name.
    pub filter: Option<String>,
    /// How many at a time; 0 is 1.
    pub jobs: usize,
    /// Leaves out what comes after the first recording that fails.
    pub fail_fast: bool,
    /// How they are replayed.
    pub replay: Options,
    /// Who renders the checkpoints' pictures. Without anybody, pictures are not looked at.
    pub studio: Option<Arc<dyn Studio>>,
    /// Only this part of the recordings.
    pub shard: Option<Shard>,
    /// Keeps what a page shows of each recording.
    pub details: bool,
}

impl fmt::Debug for VerifyOptions {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { filter, jobs, fail_fast, replay, studio, shard, details } = self;
        let adapter = studio.as_ref().map(|studio| studio.adapter());
        let mut text = f.debug_struct("VerifyOptions");
        text.field("filter", filter).field("jobs", jobs).field("fail_fast", fail_fast);
        text.field("replay", replay).field("adapter", &adapter).field("shard", shard);
        text.field("details", details).finish()
    }
}

/// Told how far a longer piece of work is; from any thread.
pub trait Progress: Sync {
    /// So many of so many recordings are done, this one last.
    fn done(&self, done: usize, of: usize, recording: &str);
}

/// Nobody wants to know.
impl Progress for () {
    fn done(&self, _: usize, _: usize, _: &str) {}
}

/// Replays recordings, and folders of them, and compares them with their goldens.
pub fn verify(paths: &[PathBuf], options: &VerifyOptions, progress: &dyn Progress) -> VerifyReport {
    verify_with(paths, options, progress, &open_file).report
}

/// The same, with what a page shows of them, if the options ask for details.
pub fn verify_to_blob(paths: &[PathBuf], options: &VerifyOptions, progress: &dyn Progress) -> Blob {
    verify_with(paths, options, progress, &open_file)
}

pub(super) fn verify_with(
    paths: &[PathBuf],
    options: &VerifyOptions,
    progress: &dyn Progress,
    open: &Open<'_>,
) -> Blob {
    let clock = Instant::now();
    let mut found = find(paths, options.filter.as_deref());
    let shard = options.shard.map(|shard| shard.take(&mut found.recordings));
    let adapter = options.studio.as_ref().map(|studio| studio.adapter());
    let rules = adapter.map(|adapter| found.rules(adapter)).unwrap_or_default();
    // The first recording known to fail; what comes before it is finished, so that the report does not depend on the threads.
    let failed = AtomicUsize::new(usize::MAX);
    let job = |at: usize, path: &Path| {
        if at > failed.load(Ordering::Relaxed) {
            return None;
        }
        let verified = verify_one(path, options, rules.get(&home::gates(path)), open);
        if options.fail_fast && verified.0.verdict != Verdict::Verified {
            failed.fetch_min(at, Ordering::Relaxed);
        }
        Some(verified)
    };
    let verified = in_parallel(&found.recordings, options.jobs, progress, &job);
    let kept = verified.into_iter().flatten().take(failed.into_inner().saturating_add(1));
    let (recordings, details): (Vec<_>, Vec<_>) = kept.unzip();
    let report = VerifyReport {
        shard,
        left_out: found.recordings.len() - recordings.len(),
        orphans: found.orphans,
        errors: found.errors,
        ms: clock.elapsed().as_secs_f64() * 1e3,
        ..VerifyReport::new(adapter.cloned(), recordings)
    };
    Blob::new(report, details.into_iter().flatten().collect())
}

/// The recordings that some paths stand for.
#[derive(Default)]
pub(super) struct Recordings {
    /// Sorted, each once.
    pub(super) recordings: Vec<PathBuf>,
    /// Goldens of recordings that are no more.
    pub(super) orphans: Vec<String>,
    /// Paths that stand for none.
    pub(super) errors: Vec<String>,
}

/// Finds the recordings that paths stand for; a filter leaves out those whose names do not hold it.
pub(super) fn find(paths: &[PathBuf], filter: Option<&str>) -> Recordings {
    let mut found = Recordings::default();
    paths.iter().for_each(|path| found.add(path));
    found.recordings.sort();
    found.recordings.dedup();
    found.orphans.sort();
    found.orphans.dedup();
    let all = found.recordings.len();
    found.recordings.retain(|r| filter.is_none_or(|filter| home::name(r).contains(filter)));
    if let (Some(filter), true, true) = (filter, found.recordings.is_empty(), all > 0) {
        found.errors.push(format!("none of {all} recordings has `{filter}` in its name"));
    }
    found
}

impl Recordings {
    /// How pictures of an adapter are judged, by the file of gates that a recording goes by. Without a file no adapter is known; a damaged one is an
    /// error, and counts as none.
    pub(super) fn rules(&mut self, adapter: &Adapter) -> BTreeMap<PathBuf, Rules> {
        let files: BTreeSet<PathBuf> = self.recordings.iter().map(|r| home::gates(r)).collect();
        let mut rules = BTreeMap::new();
        for file in files {
            let gates = read_gates(&file).unwrap_or_else(|why| {
                self.errors.push(why);
                GatesFile::default()
            });
            rules.insert(file, Rules::new(&gates, adapter));
        }
        rules
    }

    fn add(&mut self, path: &Path) {
        if !assets::is_folder(path) {
            self.recordings.push(path.into());
            return;
        }
        let files = assets::list_files(path).unwrap_or_else(|e| {
            self.errors.push(e.to_string());
            Vec::new()
        });
        let recordings: Vec<PathBuf> =
            files.into_iter().filter(|f| f.extension().is_some_and(|e| e == home::RECORDING)).collect();
        if recordings.is_empty() {
            self.errors.push(format!("{}: there is no recording in it", path.display()));
        }
        self.orphans
            .extend(golden::orphaned_folders(path, &recordings).iter().map(|file| golden::orphan(file)));
        self.recordings.extend(recordings);
    }
}

/// Reads a file of gates; without one no adapter is known.
pub(super) fn read_gates(file: &Path) -> Result<GatesFile, String> {
    if !assets::is_file(file) {
        return Ok(GatesFile::default());
    }
    let text = assets::read_file(file).map_err(|error| error.to_string())?;
    GatesFile::parse(&text).map_err(|error| format!("{}: {error}", file.display()))
}

/// Does a job for each recording, some at a time. The results are in the order of the recordings.
pub(super) fn in_parallel<T: Send>(
    recordings: &[PathBuf],
    jobs: usize,
    progress: &dyn Progress,
    job: &(dyn Fn(usize, &Path) -> T + Sync),
) -> Vec<T> {
    let (next, done) = (AtomicUsize::new(0), AtomicUsize::new(0));
    let results = Mutex::new(Vec::with_capacity(recordings.len()));
    let work = || {
        while let Some((at, path)) = take(recordings, &next) {
            let result = job(at, path);
            results.lock().unwrap_or_else(PoisonError::into_inner).push((at, result));
            progress.done(done.fetch_add(1, Ordering::Relaxed) + 1, recordings.len(), &home::name(path));
        }
    };
    std::thread::scope(|scope| {
        // This thread works too.
        (1..jobs.min(recordings.len())).for_each(|_| drop(scope.spawn(work)));
        work();
    });
    let mut results = results.into_inner().unwrap_or_else(PoisonError::into_inner);
    results.sort_by_key(|(at, _)| *at);
    results.into_iter().map(|(_, result)| result).collect()
}

fn take<'a>(recordings: &'a [PathBuf], next: &AtomicUsize) -> Option<(usize, &'a PathBuf)> {
    let at = next.fetch_add(1, Ordering::Relaxed);
    Some((at, recordings.get(at)?))
}
