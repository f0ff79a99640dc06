//! Many recordings: found, replayed several at a time, and reported in the order of their paths.

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

use super::one::{Open, open_file, verify_one};
use super::report::{RecordingReport, Verdict, VerifyReport};
use super::{golden, home};
use crate::assets;
use crate::replay::Options;
use crate::report::SCHEMA;

/// How recordings are verified.
#[derive(Clone, Debug, Default)]
pub struct VerifyOptions {
    /// Only recordings with this in their name.
    pub filter: Option<String>,
    /// How many at a time; 0 is 1.
    pub jobs: usize,
    /// Leaves out what comes after the first recording that fails.
    pub fail_fast: bool,
    /// How they are replayed.
    pub replay: Options,
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
    verify_with(paths, options, progress, &open_file)
}

pub(super) fn verify_with(
    paths: &[PathBuf],
    options: &VerifyOptions,
    progress: &dyn Progress,
    open: &Open<'_>,
) -> VerifyReport {
    let clock = Instant::now();
    let found = find(paths, options.filter.as_deref());
    // The first recording known to fail; what comes before it is finished, so that the report does not depend on the threads.
    let failed = AtomicUsize::new(usize::MAX);
    let job = |at: usize, path: &Path| {
        if at > failed.load(Ordering::Relaxed) {
            return None;
        }
        let report = verify_one(path, options, open);
        if options.fail_fast && report.verdict != Verdict::Verified {
            failed.fetch_min(at, Ordering::Relaxed);
        }
        Some(report)
    };
    let reports = in_parallel(&found.recordings, options.jobs, progress, &job);
    let mut recordings: Vec<RecordingReport> = reports.into_iter().flatten().collect();
    recordings.truncate(failed.into_inner().saturating_add(1));
    VerifyReport {
        schema: SCHEMA,
        left_out: found.recordings.len() - recordings.len(),
        recordings,
        orphans: found.orphans,
        errors: found.errors,
        ms: clock.elapsed().as_secs_f64() * 1e3,
    }
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
