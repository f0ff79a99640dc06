//! What the screen asks of the worker, and what the worker tells it. Plain data, so that a test can play either side.

use std::path::PathBuf;
use std::sync::Arc;

use crate::canvas::frame::Orbit;
use crate::canvas::image::Image;
use crate::replay::Input;
use crate::report::{EventReport, Finding, StateReport, Stop};
use crate::tui::compare::{Differences, Job};
use crate::tui::model::Place;
use crate::tui::record::Draft;
use crate::tui::shot::{Picture, Shot, Sight};

/// Something to do.
#[derive(Clone, Debug)]
pub(in crate::tui) enum Ask {
    /// Open a recording or a script, or begin a recording on a scene.
    Open(PathBuf),
    /// Go to a place, and run what has not run yet on the way.
    Go(Place),
    /// Run on until an event meets a breakpoint, or to the end.
    Run {
        /** The first event that may meet one. */
        from: usize,
        /** The breakpoints. */
        stops: Vec<Stop>,
    },
    /// Run what has not run yet, while nothing else is wanted, and come back.
    Learn,
    /// Take a picture of where the worker is. Only the newest is taken.
    Shoot(Box<Shot>),
    /// Tell which face is seen at a place of a picture.
    Identify {
        /** Where it was taken. */
        place: Place,
        /** What lies where in it. */
        sight: Sight,
        /** The place, in shares of its width and height. */
        at: [f64; 2],
    },
    /// Write a picture to a file.
    SavePicture {
        /** The file. */
        path: PathBuf,
        /** The picture. */
        what: Frame,
    },
    /// Look at the invariants of the whole state, as it is now.
    Check,
    /// Begin a recording.
    Begin {
        /** The scene, as a person types it. */
        scene: String,
        /** Width and height of its view. */
        viewport: [u32; 2],
    },
    /// Record on from after so many events, in a copy without those that follow.
    GoOn(usize),
    /// Record something at the end.
    Record(Hand),
    /// Drop the last event.
    DropLast,
    /// Save the recording to a file.
    Save(PathBuf),
    /// Tell what unsaved recordings there are.
    Drafts,
    /// Compare a recording's file with its goldens or with another run, beside everything else.
    Compare(Job),
    /// Stop comparing.
    StopComparing,
    /// Stop what is being done, if anything is.
    Cancel,
}

/// A picture to write.
#[derive(Clone, Debug)]
pub(in crate::tui) enum Frame {
    /// One that is still to be taken.
    Shot(Box<Shot>),
    /// One that is there.
    Image(Arc<Image>),
}

/// Something to record. What it is depends on the state that it is done to, which the worker knows.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::tui) enum Hand {
    /// Pointed at a position of the view, when looking from here. A view that is another than the recorded one is recorded first.
    Point {
        /** The position, pixels. */
        at: [f64; 2],
        /** Where from, if not from where the recording looks. */
        from: Option<Orbit>,
    },
    /// Went on to the next mode.
    NextMode,
    /// Anything else.
    Other(Input),
}

impl Ask {
    /// Whether something else is shown afterwards.
    pub(in crate::tui) fn opens(&self) -> bool {
        matches!(self, Self::Open(_) | Self::Begin { .. })
    }

    /// Whether it comes before pictures, and before what nobody waits for.
    pub(in crate::tui) fn is_urgent(&self) -> bool {
        let quiet = matches!(self, Self::Shoot(_) | Self::Learn);
        !quiet && !matches!(self, Self::Compare(_) | Self::StopComparing)
    }

    /// Whether it leaves the state as it is.
    pub(in crate::tui) fn keeps_the_state(&self) -> bool {
        let looks = matches!(self, Self::Shoot(_) | Self::Identify { .. } | Self::SavePicture { .. });
        let tells = matches!(self, Self::Check | Self::Learn | Self::Save(_) | Self::Drafts | Self::Cancel);
        looks || tells || matches!(self, Self::Compare(_) | Self::StopComparing)
    }

    /// Whether it puts an end to what is being done.
    pub(in crate::tui) fn interrupts(&self) -> bool {
        let looks = matches!(self, Self::Check | Self::Identify { .. } | Self::SavePicture { .. });
        self.is_urgent() && !looks && !matches!(self, Self::Drafts)
    }
}

/// What is known of a recording once it is open.
#[derive(Clone, Debug)]
pub(in crate::tui) struct Opened {
    /// Its file.
    pub(in crate::tui) path: Option<PathBuf>,
    /// The engine's name.
    pub(in crate::tui) engine: String,
    /// The engine's stages: short name and title.
    pub(in crate::tui) stages: Vec<(String, String)>,
    /// The events as they stand in a script.
    pub(in crate::tui) lines: Vec<String>,
    /// What it was recorded on.
    pub(in crate::tui) scene: String,
    /// Width and height of the recorded view.
    pub(in crate::tui) viewport: [u32; 2],
    /// Who renders.
    pub(in crate::tui) renderer: String,
}

/// Something to know.
#[derive(Clone, Debug)]
pub(in crate::tui) enum Told {
    /// A recording is open, and stands before its first event.
    Opened(Box<Opened>),
    /// An event ran for the first time.
    Report(Arc<EventReport>),
    /// The whole state after the last event, when that was reached for the first time.
    End(Box<StateReport>),
    /// The first broken invariant.
    Finding(Box<Finding>),
    /// The worker is at a place.
    At(Box<Standing>),
    /// How far it is with what it does.
    Progress {
        /** What it does. */
        what: &'static str,
        /** How much of it is done. */
        done: usize,
        /** Of how much. */
        of: usize,
    },
    /// It is done with what it was asked, or was stopped.
    Idle {
        /** Whether that was something urgent. */
        urgent: bool,
    },
    /// The picture that was asked for.
    Picture(Box<Picture>),
    /// The picture of this number cannot be had, and why.
    NoPicture {
        /** The number. */
        number: u64,
        /** Why. */
        why: String,
    },
    /// The face that was asked for, if there is one.
    Identified(Option<String>),
    /// A picture was written to a file.
    PictureSaved {
        /** The file. */
        path: PathBuf,
        /** Width and height. */
        size: [u32; 2],
    },
    /// The invariants of the whole state.
    Checked(Box<StateReport>),
    /// What is recorded, up to which event it is as before, and what comes after that.
    Recorded(Box<Recorded>),
    /// It is saved.
    Saved(PathBuf),
    /// The unsaved recordings, the newest first.
    Drafts(Vec<Draft>),
    /// How far a comparison is.
    Comparing {
        /** Which. */
        number: u64,
        /** How many events have run. */
        done: usize,
        /** Of how many. */
        of: usize,
    },
    /// What a comparison came to, or why there is none.
    Compared {
        /** Which. */
        number: u64,
        /** What was found. */
        found: Box<Result<Differences, String>>,
    },
    /// A run stopped at an event, for this reason.
    Stopped(String),
    /// The program broke one of its own assertions, and what was open is closed.
    Broken(String),
    /// Something went wrong: what, and why.
    Failed(String),
}

/// A change of the recording.
#[derive(Clone, Debug, Default, PartialEq)]
pub(in crate::tui) struct Recorded {
    /// How many events are as before.
    pub(in crate::tui) kept: usize,
    /// Those after them, as they stand in a script.
    pub(in crate::tui) lines: Vec<String>,
    /// Where the last of them pointed at.
    pub(in crate::tui) pointed: Option<[f64; 2]>,
    /// Whether something else was shown until now, and recording begins with it.
    pub(in crate::tui) begins: bool,
    /// Whether there is anything that is not saved.
    pub(in crate::tui) unsaved: bool,
}

/// Where the worker is, and what there is.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::tui) struct Standing {
    /// The place.
    pub(in crate::tui) place: Place,
    /// The report of the event that it is within, as far as it has run.
    pub(in crate::tui) within: Option<Arc<EventReport>>,
    /// What the state is made of, by name.
    pub(in crate::tui) sizes: Vec<(&'static str, u64)>,
    /// Where the recording looks from.
    pub(in crate::tui) orbit: Option<Orbit>,
    /// The mode in force.
    pub(in crate::tui) mode: &'static str,
    /// Bytes that are kept for seeking.
    pub(in crate::tui) kept_bytes: usize,
}
