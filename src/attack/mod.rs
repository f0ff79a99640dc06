//! What the fuzzers do: bytes become an input, the input is run, and what must hold is looked at.
//!
//! A **target** ([`Target`], a row of [`TARGETS`]) takes any bytes whatever. For some targets the bytes are the input itself, a file that may be
//! damaged in every way (`any_bytes`); for the others a generator draws a valid input from them, so that no bytes are wasted on what a
//! reader refuses. Either way the same bytes give the same input, so a corpus is a folder of files, and a crash a file.
//!
//! What must hold is told by **oracles**: a broken one is a [`Finding`]. Where the input is a recording, or can be said as one, the finding
//! carries it, so that it opens in `lancet tui` and in `lancet reduce`. What was reached on the way is counted ([`Hits`]).
//!
//! Three things drive the targets: libFuzzer (fuzz/, one thin file a target), the tests, which replay the corpora, and the nightly run.
//!
//! Not promised: that a panic is a finding. [`Target::run`] lets it pass, since libFuzzer ends before a stack is unwound; [`Target::attempt`]
//! makes one of it. What was being run then is [`under_way`].

pub mod canary;
mod cuts;
mod draw;
mod drive;
mod fusion;
pub mod matrix;
mod mesh_files;
pub mod nightly;
mod oracle;
mod paint;
mod pick;
mod recording;
mod scene;
pub mod storm;
mod trial;

use std::any::Any;
use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};

use crate::recording::{AnyRecording, SceneRef};

/// A way to attack the program.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// Its name, also that of its file in fuzz/ and of its corpus.
    pub name: &'static str,
    /// What it attacks, in a line.
    pub about: &'static str,
    /// Whether the bytes are the input, valid or not; else a valid input is drawn from them.
    pub any_bytes: bool,
    /// Runs the bytes, and says what was reached or what broke.
    pub run: fn(&[u8]) -> Outcome,
}

/// Every target.
pub const TARGETS: &[Target] = &[
    Target {
        name: "recording",
        about: "bytes to the decoder of recordings, with their checksums put right as well, and to the reader of scripts",
        any_bytes: true,
        run: recording::run,
    },
    Target {
        name: "fusion",
        about: "cuts with ends of chosen kinds into small meshes of hard-rounded coordinates",
        any_bytes: false,
        run: fusion::run,
    },
    Target {
        name: "cuts",
        about: "sequences of cuts over one another, with undo and redo, into scenes of hostile sizes and places",
        any_bytes: false,
        run: cuts::run,
    },
    Target {
        name: "paint",
        about: "gathering of faces and surface coordinates against brute force on skins that unroll",
        any_bytes: false,
        run: paint::run,
    },
    Target {
        name: "canary",
        about: "`fusion` with a bug planted in the engine, which must be found; without the bug there is nothing to find",
        any_bytes: false,
        run: fusion::run,
    },
    Target {
        name: "mesh_files",
        about: "bytes to the readers of OBJ, PLY and glTF; what is read is sound, and reads back as it was written",
        any_bytes: true,
        run: mesh_files::run,
    },
    Target {
        name: "scene",
        about: "bytes to the reader of scenes; what is read frames a square that is cut",
        any_bytes: true,
        run: scene::run,
    },
    Target {
        name: "pick",
        about: "rays on sheets that coincide, before and after edits, by the hierarchy and by brute force",
        any_bytes: false,
        run: pick::run,
    },
];

/// What came of an input: what it reached, or what it broke.
pub type Outcome = Result<Hits, Box<Finding>>;

/// How often things of a name were reached: cells of a matrix, kinds of outcome.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Hits(pub BTreeMap<String, u64>);

impl Hits {
    /// Something of that name was reached.
    pub fn note(&mut self, name: impl Into<String>) {
        *self.0.entry(name.into()).or_default() += 1;
    }

    /// Adds another's counts.
    pub fn add(&mut self, other: &Self) {
        other.0.iter().for_each(|(name, count)| *self.0.entry(name.clone()).or_default() += count);
    }
}

/// Something that does not hold.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// The oracle, in kebab case.
    pub check: String,
    /// What is wrong.
    pub detail: String,
    /// A `.lancet` file or a script that leads to it, where there is one.
    pub recording: Option<Vec<u8>>,
}

impl Finding {
    /// A finding without a recording.
    pub fn new(check: &str, detail: impl Into<String>) -> Box<Self> {
        Box::new(Self { check: check.into(), detail: detail.into(), recording: None })
    }

    /// The same with the recording that leads to it.
    #[must_use]
    pub fn with_recording(mut self: Box<Self>, recording: impl Into<Vec<u8>>) -> Box<Self> {
        self.recording = Some(recording.into());
        self
    }
}

impl std::fmt::Display for Finding {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}: {}", self.check, self.detail)
    }
}

/// The target of a name.
pub fn target(name: &str) -> Option<&'static Target> {
    TARGETS.iter().find(|target| target.name == name)
}

/// Runs bytes on the target of a name; `None` where there is none.
pub fn run(name: &str, data: &[u8]) -> Option<Outcome> {
    target(name).map(|target| (target.run)(data))
}

/// The name of the oracle that a recording breaks, if it breaks one. Of scenes in files nothing is said.
pub fn judge(recording: &AnyRecording) -> Option<String> {
    let AnyRecording::Wound(recording) = recording;
    if matches!(recording.scene, SceneRef::Mesh(_) | SceneRef::File(_)) {
        return None;
    }
    let judged = catch_unwind(AssertUnwindSafe(|| trial::judge(recording)));
    judged.map_or(Some("panic".into()), |outcome| Some(outcome.err()?.check))
}

impl Target {
    /// Runs bytes; a panic is a finding as well.
    pub fn attempt(&self, data: &[u8]) -> Outcome {
        attempt(|| (self.run)(data))
    }
}

/// The script of what is being run on this thread, up to the event that is under way; none where nothing is. It runs nothing, so that it can be
/// asked for within a panic.
pub fn under_way() -> Option<Vec<u8>> {
    trial::under_way()
}

/// Runs something; a panic is a finding as well, with the recording that leads to it where one was being run.
fn attempt(run: impl FnOnce() -> Outcome) -> Outcome {
    catch_unwind(AssertUnwindSafe(run)).unwrap_or_else(|panic| {
        let finding = Finding::new("panic", said(panic.as_ref()));
        Err(Box::new(Finding { recording: trial::take_under_way(), ..*finding }))
    })
}

/// What a panic says.
fn said(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().copied();
    text.or_else(|| panic.downcast_ref::<String>().map(String::as_str))
        .unwrap_or("a panic without words")
        .to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_is_a_finding_with_its_recording() {
        let broken = Target { run: |_| panic!("at {}", 7), ..TARGETS[0] };
        let finding = broken.attempt(b"x").expect_err("it panics");
        assert_eq!(*finding, *Finding::new("panic", "at 7"));
        let on_the_way = Target { run: |_| trial::broken_off(), ..TARGETS[0] };
        let finding = on_the_way.attempt(b"x").expect_err("it panics");
        let script = String::from_utf8(finding.recording.expect("there is one")).expect("a text");
        assert!(script.contains("\"cut\"") && script.contains("builtin:slab"), "{script}");
        assert_eq!(under_way(), None, "it was taken");
    }

    #[test]
    fn a_target_has_a_name_of_its_own() {
        for (i, one) in TARGETS.iter().enumerate() {
            assert!(TARGETS[..i].iter().all(|other| other.name != one.name), "{}", one.name);
            assert!(target(one.name).is_some_and(|found| found.about == one.about));
        }
        assert!(run("none", b"").is_none());
    }
}
