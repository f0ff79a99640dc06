//! The goldens of one recording: what they are now, and what is stored.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::facts::{self, Fact, Kind, Place};
use super::home;
use super::picture::Picture;
use super::values::Values;
use crate::assets;
use crate::canvas::{Adapter, Kind as Renderer};
use crate::replay::CheckpointFrame;
use crate::report::{EventDelta, RunReport};

/// A run as goldens would have it.
pub(super) struct Found {
    pub(super) run: RunReport,
    pub(super) deltas: Vec<EventDelta>,
    /// The checkpoints' frames.
    pub(super) frames: Vec<CheckpointFrame>,
    /// Who rendered them; none where nobody was asked to.
    pub(super) adapter: Option<Adapter>,
}

impl Found {
    /// A run without pictures.
    pub(super) fn new(run: RunReport, deltas: Vec<EventDelta>) -> Self {
        Self { run, deltas, frames: Vec::new(), adapter: None }
    }

    /// The facts of the run.
    pub(super) fn facts(&self) -> Vec<Fact> {
        facts::of_run(&self.run)
    }

    /// The facts of each checkpoint, by name, with its event.
    pub(super) fn checkpoints(&self) -> BTreeMap<&str, (usize, Vec<Fact>)> {
        let named = self.run.events.iter().filter_map(|e| Some((e.checkpoint.as_deref()?, e)));
        named
            .map(|(name, event)| {
                let frame = self.frame(name).map(|f| facts::of_frame(&f.frame.image, self.is_exact()));
                let facts = [facts::of_checkpoint(event), frame.unwrap_or_default()].concat();
                (name, (event.index, facts))
            })
            .collect()
    }

    /// A checkpoint's frame.
    pub(super) fn frame(&self, checkpoint: &str) -> Option<&CheckpointFrame> {
        self.frames.iter().find(|frame| frame.name == checkpoint)
    }

    /// Whether its pictures have to be the goldens, byte for byte.
    fn is_exact(&self) -> bool {
        self.adapter.as_ref().is_some_and(|adapter| adapter.kind == Renderer::Reference)
    }

    /// The names of its files.
    pub(super) fn file_names(&self) -> Vec<String> {
        let texts = self.checkpoints().into_keys().map(home::checkpoint_text);
        let pictures = self.frames.iter().map(|frame| home::checkpoint_picture(&frame.name));
        let run = [home::RUN_TEXT.into(), home::RUN_VALUES.into()];
        run.into_iter().chain(texts).chain(pictures).collect()
    }

    /// Its files: name and content. An error says which of them cannot be.
    pub(super) fn files(&self, reason: &str) -> Result<Vec<(String, Vec<u8>)>, String> {
        let values = Values::file(&self.deltas, &self.run.totals.digest);
        let run = facts::write(&facts::remarks(reason, None), &self.facts());
        let mut files =
            vec![(home::RUN_TEXT.to_owned(), run.into_bytes()), (home::RUN_VALUES.to_owned(), values)];
        for (name, (_, facts)) in self.checkpoints() {
            let frame = self.frame(name);
            let remarks = facts::remarks(reason, self.adapter.as_ref().filter(|_| frame.is_some()));
            files.push((home::checkpoint_text(name), facts::write(&remarks, &facts).into_bytes()));
            if let Some(frame) = frame {
                let file = home::checkpoint_picture(name);
                let picture = Picture::file(&frame.frame.image).map_err(|why| format!("{file}: {why}"))?;
                files.push((file, picture));
            }
        }
        Ok(files)
    }
}

/// Goldens as they are stored. What cannot be read is among the problems.
#[derive(Default)]
pub(super) struct Stored {
    pub(super) run: Option<Vec<Fact>>,
    pub(super) values: Option<Values>,
    /// By name.
    pub(super) checkpoints: BTreeMap<String, Vec<Fact>>,
    /// What another run's invariants came to, where it is a run rather than goldens.
    pub(super) checks: Vec<Fact>,
    /// By the checkpoint's name; none is there that is not of the frame's size.
    pub(super) pictures: BTreeMap<String, Picture>,
    /// The checkpoints whose text tells of a frame.
    pub(super) drawn: Vec<String>,
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
            stored.read_checkpoint(folder, name, found);
        }
        stored.values = stored.values(&folder.join(home::RUN_VALUES));
        stored.find_orphans(folder, &stored.known(found));
        stored
    }

    fn read_checkpoint(&mut self, folder: &Path, name: &str, found: &Found) {
        let facts = self.facts(&folder.join(home::checkpoint_text(name)));
        if let Some(frame) = found.frame(name) {
            let digest = facts.iter().flatten().find(|fact| fact.is_image_digest());
            let file = folder.join(home::checkpoint_picture(name));
            let read = read(&file).and_then(|png| {
                let picture = Picture::read(png, digest.map(|fact| fact.value.as_str()), &frame.frame.image);
                picture.map_err(|why| format!("{}: {why}", file.display()))
            });
            self.keep(read).map(|picture| self.pictures.insert(name.into(), picture));
        }
        let Some(mut facts) = facts else { return };
        if facts.iter().any(|fact| fact.place == Place::Frame) {
            self.drawn.push(name.into());
        }
        // What nobody rendered cannot be compared, and what comes from a device goes by its gates.
        let rendered = found.adapter.is_some();
        facts.retain(|fact| {
            fact.place != Place::Frame || rendered && (found.is_exact() || !fact.is_image_digest())
        });
        self.checkpoints.insert(name.into(), facts);
    }

    /// The names of the files that belong to a run; without a renderer its pictures are left alone.
    fn known(&self, found: &Found) -> Vec<String> {
        let drawn = self.drawn.iter().filter(|_| found.adapter.is_none());
        let pictures = drawn.map(|name| home::checkpoint_picture(name));
        found.file_names().into_iter().chain(pictures).collect()
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
    let gates = home::gates(folder);
    let files = assets::list_files(&goldens).unwrap_or_default();
    let others = files.into_iter().filter(|f| f.parent().is_none_or(|p| !homes.iter().any(|home| home == p)));
    others.filter(|file| *file != gates).collect()
}
