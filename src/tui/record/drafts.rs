//! Drafts: recordings that are not saved, kept in the user's folder so that no crash and no closed terminal loses them.
//!
//! A draft is a recording like any other, `NAME-PROCESS.lancet`, written whole after every event. Two programs never write the same one, and while
//! that process runs nobody else is offered it. Who takes a draft up again gives it a name of his own first, which of several programs that want
//! it exactly one can do. Whoever was still writing to it, on another machine say, finds it gone, and writes it again with the next event, or when he leaves.

use std::path::{Path, PathBuf};

use crate::assets;
use crate::recording::{AnyRecording, SceneRef};
use crate::replay;

/// Where drafts are kept, if anywhere.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Drafts {
    folder: Option<PathBuf>,
}

/// A recording that was not saved.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(in crate::tui) struct Draft {
    /// Its file.
    pub(in crate::tui) path: PathBuf,
    /// What it was recorded on, and how many events there are; or why it cannot be read.
    pub(in crate::tui) content: Result<(String, usize), String>,
}

/// The file of the draft that is being written. No other program writes to it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(in crate::tui) struct Slot(Option<PathBuf>);

impl Slot {
    /// Its file, if there is one yet.
    pub(in crate::tui) fn path(&self) -> Option<&Path> {
        self.0.as_deref()
    }

    /// Removes what is in it: it is saved elsewhere, or there is nothing in it.
    pub(in crate::tui) fn clear(&mut self) -> Result<(), String> {
        let file = self.0.take();
        file.map_or(Ok(()), |file| assets::remove_file(&file)).map_err(|error| error.to_string())
    }

    /// Whether another program has taken the draft up, so that it is no longer where it was written.
    pub(in crate::tui) fn is_taken(&self) -> bool {
        self.path().is_some_and(|path| !assets::is_file(path))
    }

    /// Whether a file is what is written here.
    fn is(&self, path: &Path) -> bool {
        self.path() == Some(path)
    }
}

impl Drafts {
    /// In a folder.
    pub fn at(folder: impl Into<PathBuf>) -> Self {
        Self { folder: Some(folder.into()) }
    }

    /// Writes a recording, whose paths are relative to `folder`, as the draft of a slot.
    pub(in crate::tui) fn write(
        &self,
        slot: &mut Slot,
        recording: &AnyRecording,
        folder: &Path,
    ) -> Result<(), String> {
        let Some(drafts) = &self.folder else { return Ok(()) };
        let not_kept = |error: &dyn std::fmt::Display| format!("not kept as a draft: {error}");
        if slot.path().is_none() {
            let drafts = assets::real_folder(drafts).map_err(|error| not_kept(&error))?;
            slot.0 = Some(free(&drafts, &name(recording.scene())));
        }
        let written = slot.path().map_or(Ok(()), |own| replay::save(recording, folder, own).map(drop));
        written.map_err(|error| not_kept(&error))
    }

    /// Takes a draft up: from now on it is written here and nowhere else. An error says why not, such as that another program was quicker.
    pub(in crate::tui) fn take_up(&self, draft: &Path) -> Result<Slot, String> {
        let gone = || format!("{}: another program has taken this draft up, or saved it", draft.display());
        if !assets::is_file(draft) {
            return Err(gone());
        }
        if is_open_elsewhere(draft) {
            return Err(format!(
                "{}: is being recorded by another program, which still runs",
                draft.display()
            ));
        }
        let recording = replay::read(draft).map_err(|error| error.to_string())?;
        let own = free(draft.parent().unwrap_or(Path::new("")), &name(recording.scene()));
        let taken = assets::take_file(draft, &own).map_err(|error| format!("not taken up: {error}"))?;
        taken.then_some(Slot(Some(own))).ok_or_else(gone)
    }

    /// All of them but those that are being written, the newest first.
    pub(in crate::tui) fn list(&self, but: Option<&Slot>) -> Result<Vec<Draft>, String> {
        let Some(folder) = self.folder.as_ref().filter(|folder| assets::is_folder(folder)) else {
            return Ok(Vec::new());
        };
        let files = assets::real_folder(folder).and_then(|folder| assets::newest_files(&folder));
        let mut files = files.map_err(|error| error.to_string())?;
        files.retain(|path| {
            let is_ours = but.is_some_and(|slot| slot.is(path));
            path.extension().is_some_and(|end| end == "lancet") && !is_ours && !is_open_elsewhere(path)
        });
        Ok(files.into_iter().map(Draft::read).collect())
    }

    /// Whether a file that is there is a draft.
    pub(in crate::tui) fn has(&self, path: &Path) -> bool {
        let real = |folder: &Path| assets::real_folder(folder).ok();
        let folder = self.folder.as_ref().filter(|folder| assets::is_folder(folder));
        let beside = path.parent().filter(|beside| !beside.as_os_str().is_empty()).unwrap_or(Path::new("."));
        folder.and_then(|folder| real(folder)).is_some_and(|folder| real(beside) == Some(folder))
    }
}

impl Draft {
    fn read(path: PathBuf) -> Self {
        let content = match replay::read(&path) {
            Ok(recording) => Ok((recording.scene().to_string(), recording.event_count())),
            Err(error) => Err(error.to_string()),
        };
        Self { path, content }
    }
}

/// The first name that is not taken, of those that begin so and have this program's number.
fn free(folder: &Path, name: &str) -> PathBuf {
    let own = format!("{name}-{}", std::process::id());
    let numbered = (2..).map(|number| format!("{own}.{number}"));
    let names = std::iter::once(own.clone()).chain(numbered);
    let mut paths = names.map(|name| folder.join(format!("{name}.lancet")));
    paths.find(|path| !assets::is_file(path)).unwrap_or_default()
}

/// Whether the program that writes a draft is another one than this, and still runs.
fn is_open_elsewhere(draft: &Path) -> bool {
    writer(draft).is_some_and(|process| process != std::process::id() && runs(process))
}

/// The number of the program that writes a draft, from its name.
fn writer(draft: &Path) -> Option<u32> {
    let stem = draft.file_stem()?.to_str()?;
    let (_, number) = stem.rsplit_once('-')?;
    number.split('.').next()?.parse().ok()
}

/// Whether there is a process of that number. One that is another user's may not be asked, and runs.
#[cfg(unix)]
fn runs(process: u32) -> bool {
    use rustix::process::{Pid, test_kill_process};

    let process = i32::try_from(process).ok().and_then(Pid::from_raw);
    process.is_some_and(|process| test_kill_process(process) != Err(rustix::io::Errno::SRCH))
}

/// Nobody knows here.
#[cfg(not(unix))]
fn runs(_process: u32) -> bool {
    false
}

/// What a draft is called by its scene: letters and digits that any file system takes.
fn name(scene: &SceneRef) -> String {
    const LONGEST: usize = 40;
    let stem = |path: &Path| path.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into());
    let name: String = match scene {
        SceneRef::Builtin(name) => name.clone(),
        SceneRef::File(path) | SceneRef::Mesh(path) => stem(path),
        SceneRef::Inline(_) => "inline".into(),
    };
    let plain = |c: char| if c.is_ascii_alphanumeric() { c } else { '-' };
    name.chars().take(LONGEST).map(plain).collect()
}
