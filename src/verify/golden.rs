//! The goldens of one recording: what they are now, and what is stored.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::facts::{self, Fact, Kind, Place};
use super::home;
use super::values::Values;
use crate::assets;
use crate::report::{EventDelta, RunReport};

/// A run as goldens would have it.
pub(super) struct Found {
    pub(super) run: RunReport,
    pub(super) deltas: Vec<EventDelta>,
}

impl Found {
    /// The facts of the run.
    pub(super) fn facts(&self) -> Vec<Fact> {
        facts::of_run(&self.run)
    }

    /// The facts of each checkpoint, by name, with its event.
    pub(super) fn checkpoints(&self) -> BTreeMap<&str, (usize, Vec<Fact>)> {
        let named = self.run.events.iter().filter_map(|e| Some((e.checkpoint.as_deref()?, e)));
        named.map(|(name, event)| (name, (event.index, facts::of_checkpoint(event)))).collect()
    }

    /// The names of its files.
    pub(super) fn file_names(&self) -> Vec<String> {
        let texts = self.checkpoints().into_keys().map(home::checkpoint_text);
        [home::RUN_TEXT.into(), home::RUN_VALUES.into()].into_iter().chain(texts).collect()
    }

    /// Its files: name and content.
    pub(super) fn files(&self, reason: &str) -> Vec<(String, Vec<u8>)> {
        let values = Values::file(&self.deltas, &self.run.totals.digest);
        let texts = self.checkpoints().into_iter();
        let texts =
            texts.map(|(name, (_, facts))| (home::checkpoint_text(name), facts::write(reason, &facts)));
        let run = (home::RUN_TEXT.to_string(), facts::write(reason, &self.facts()));
        let texts = std::iter::once(run).chain(texts).map(|(name, text)| (name, text.into_bytes()));
        texts.chain([(home::RUN_VALUES.to_string(), values)]).collect()
    }
}

/// Goldens as they are stored. What cannot be read is among the problems.
#[derive(Default)]
pub(super) struct Stored {
    pub(super) run: Option<Vec<Fact>>,
    pub(super) values: Option<Values>,
    /// By name.
    pub(super) checkpoints: BTreeMap<String, Vec<Fact>>,
    /// What is missing or damaged.
    pub(super) problems: Vec<String>,
    /// What the run does not ask for.
    pub(super) orphans: Vec<String>,
}

impl Stored {
    /// Reads the goldens of a run from their folder.
    pub(super) fn read(folder: &Path, found: &Found) -> Self {
        let mut stored = Self::default();
        stored.run = stored.facts(&folder.join(home::RUN_TEXT));
        for name in found.checkpoints().into_keys() {
            if let Some(facts) = stored.facts(&folder.join(home::checkpoint_text(name))) {
                stored.checkpoints.insert(name.into(), facts);
            }
        }
        stored.values = stored.values(&folder.join(home::RUN_VALUES));
        stored.find_orphans(folder, &found.file_names());
        stored
    }

    /// Whether nothing at all is stored.
    pub(super) fn is_empty(&self) -> bool {
        self.run.is_none() && self.values.is_none() && self.checkpoints.is_empty()
    }

    fn facts(&mut self, file: &Path) -> Option<Vec<Fact>> {
        let read = read(file).and_then(|bytes| facts::parse(&bytes).map_err(|why| damaged(file, &why)));
        self.keep(read)
    }

    fn values(&mut self, file: &Path) -> Option<Values> {
        // A text that cannot be read has been reported; nothing tells then whether the values belong to it.
        let run = self.run.as_ref()?.iter().find(|f| f.place == Place::Total && f.name == "digest")?;
        debug_assert!(run.kind == Kind::Count);
        let read =
            read(file).and_then(|bytes| Values::read(&bytes, &run.value).map_err(|why| damaged(file, &why)));
        self.keep(read)
    }

    fn keep<T>(&mut self, read: Result<T, String>) -> Option<T> {
        read.map_err(|problem| self.problems.push(problem)).ok()
    }

    fn find_orphans(&mut self, folder: &Path, known: &[String]) {
        let files = assets::list_files(folder).unwrap_or_default();
        let own = files.into_iter().filter(|file| file.parent() == Some(folder));
        let orphaned =
            own.filter(|file| !known.iter().any(|name| file.file_name().is_some_and(|f| f == name.as_str())));
        self.orphans.extend(orphaned.map(|file| orphan(&file)));
    }
}

fn read(file: &Path) -> Result<Vec<u8>, String> {
    if !assets::is_file(file) {
        return Err(format!("{}: missing", file.display()));
    }
    assets::read_file(file).map_err(|e| e.to_string())
}

fn damaged(file: &Path, why: &str) -> String {
    format!("{}: damaged: {why}", file.display())
}

/// What is said of a golden that no recording asks for.
pub(super) fn orphan(file: &Path) -> String {
    format!("{}: orphaned: no recording has such a golden", file.display())
}

/// Goldens under a folder of recordings of which no recording is left.
pub(super) fn orphaned_folders(folder: &Path, recordings: &[PathBuf]) -> Vec<PathBuf> {
    let Some(goldens) = home::goldens_of_folder(folder) else { return Vec::new() };
    let homes: Vec<PathBuf> = recordings.iter().map(|r| home::goldens(r)).collect();
    let files = assets::list_files(&goldens).unwrap_or_default();
    files.into_iter().filter(|f| f.parent().is_none_or(|p| !homes.iter().any(|home| home == p))).collect()
}
