//! A picture that the screen wants, and the picture that it gets.

use crate::canvas::frame::Orbit;
use crate::canvas::image::{Image, MapId};
use crate::tui::model::Place;

/// What a picture is of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::tui) enum Subject {
    /// The rendered frame.
    #[default]
    Frame,
    /// A map, in texture space.
    Map(MapId),
}

/// How faces are coloured.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::tui) enum Tint {
    /// As they are rendered.
    #[default]
    None,
    /// By a group of the report's sets of faces: its place among the groups that there are.
    Group(usize),
    /// By chart.
    Charts,
}

/// What is drawn over a picture.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(in crate::tui) struct Drawn {
    /// The mesh's edges.
    pub(in crate::tui) wire: bool,
    /// The lines and points that the report has to show.
    pub(in crate::tui) lines: bool,
    /// How faces are coloured.
    pub(in crate::tui) tint: Tint,
    /// The elements that are selected.
    pub(in crate::tui) marked: Vec<String>,
}

/// A picture that is wanted.
#[derive(Clone, Debug, Default, PartialEq)]
pub(in crate::tui) struct Shot {
    /// Tells it from others.
    pub(in crate::tui) number: u64,
    /// What it is of.
    pub(in crate::tui) subject: Subject,
    /// Where to look from, if not from where the recording does.
    pub(in crate::tui) orbit: Option<Orbit>,
    /// Pixels that are worth rendering.
    pub(in crate::tui) limit: [u32; 2],
    /// What is drawn over it.
    pub(in crate::tui) drawn: Drawn,
}

/// A picture.
#[derive(Clone, Debug)]
pub(in crate::tui) struct Picture {
    /// What was asked for.
    pub(in crate::tui) shot: Shot,
    /// Where it was taken.
    pub(in crate::tui) place: Place,
    /// The pixels.
    pub(in crate::tui) image: Image,
    /// Milliseconds that it took.
    pub(in crate::tui) ms: f64,
}
