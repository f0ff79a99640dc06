//! A picture that the screen wants, and the picture that it gets.

use std::sync::Arc;

use crate::canvas::frame::{Orbit, View};
use crate::canvas::image::{Image, MapId};
use crate::report::{EventReport, Overlay};
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

impl Subject {
    /// All, in the order in which they are gone through.
    const ALL: [Self; 6] = [
        Self::Frame,
        Self::Map(MapId::Color),
        Self::Map(MapId::Discolor),
        Self::Map(MapId::Normal),
        Self::Map(MapId::Occlusion),
        Self::Map(MapId::Specular),
    ];

    /// The next one.
    pub(in crate::tui) fn next(self) -> Self {
        let at = Self::ALL.iter().position(|subject| *subject == self).unwrap_or(0);
        Self::ALL[(at + 1) % Self::ALL.len()]
    }

    /// Its name for people.
    pub(in crate::tui) fn name(self) -> &'static str {
        match self {
            Self::Frame => "frame",
            Self::Map(MapId::Color) => "colour map",
            Self::Map(MapId::Discolor) => "discoloration map",
            Self::Map(MapId::Normal) => "normal map",
            Self::Map(MapId::Occlusion) => "occlusion map",
            Self::Map(MapId::Specular) => "specular map",
        }
    }
}

/// How faces are coloured.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(in crate::tui) enum Tint {
    /// As they are rendered.
    #[default]
    None,
    /// By a group of the report's sets of faces.
    Group(String),
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

impl Drawn {
    /// Whether any of it comes from a report.
    pub(in crate::tui) fn is_of_a_report(&self) -> bool {
        self.lines || matches!(self.tint, Tint::Group(_))
    }
}

/// A picture that is wanted.
#[derive(Clone, Debug, Default, PartialEq)]
pub(in crate::tui) struct Shot {
    /// Tells it from others: the larger, the later.
    pub(in crate::tui) number: u64,
    /// What it is of.
    pub(in crate::tui) subject: Subject,
    /// Where to look from, if not from where the recording does.
    pub(in crate::tui) orbit: Option<Orbit>,
    /// Pixels that are worth rendering.
    pub(in crate::tui) limit: [u32; 2],
    /// Pixels that it is shown at: lines are as wide as one of these.
    pub(in crate::tui) shown: [u32; 2],
    /// What is drawn over it.
    pub(in crate::tui) drawn: Drawn,
}

impl Shot {
    /// Whether another one is of the same, whatever its number.
    pub(in crate::tui) fn is_like(&self, other: &Self) -> bool {
        *self == Self { number: self.number, ..other.clone() }
    }
}

/// What lies where in a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::tui) enum Sight {
    /// The surface as it is seen from somewhere.
    View(View),
    /// The skin, unrolled.
    Map,
}

/// A picture.
#[derive(Clone, Debug)]
pub(in crate::tui) struct Picture {
    /// What was asked for.
    pub(in crate::tui) shot: Shot,
    /// Where it was taken.
    pub(in crate::tui) place: Place,
    /// The pixels.
    pub(in crate::tui) image: Arc<Image>,
    /// What lies where in it.
    pub(in crate::tui) sight: Sight,
    /// The event whose lines and sets of faces there were to draw.
    pub(in crate::tui) of: Option<usize>,
    /// The sets of faces that are coloured, with their colours.
    pub(in crate::tui) legend: Vec<(String, [u8; 3])>,
    /// Milliseconds that it took.
    pub(in crate::tui) ms: f64,
}

/// The report that has something to draw at a place: that of the event that ran last, or else of the last one before it that has.
pub(in crate::tui) fn source<'a>(
    held: Option<&'a EventReport>,
    events: usize,
    report: impl Fn(usize) -> Option<&'a EventReport>,
) -> Option<&'a EventReport> {
    let before = (0..events).rev().filter_map(report);
    held.into_iter().chain(before).find(|report| !report.overlays.iter().all(Overlay::is_empty))
}

/// The groups of sets of faces that a report has, those without any face left out.
pub(in crate::tui) fn groups(overlays: &[Overlay]) -> Vec<&str> {
    let is_shown = |overlay: &&Overlay| matches!(overlay, Overlay::Faces { .. }) && !overlay.is_empty();
    let mut groups: Vec<&str> = Vec::new();
    for group in overlays.iter().filter(is_shown).map(Overlay::group) {
        if !groups.contains(&group) {
            groups.push(group);
        }
    }
    groups
}

#[cfg(test)]
mod tests {
    use super::*;

    fn report(index: usize, faces: &[(&str, Vec<u32>)]) -> EventReport {
        let set =
            |(name, faces): &(&str, Vec<u32>)| Overlay::Faces { name: (*name).into(), faces: faces.clone() };
        EventReport { overlays: faces.iter().map(set).collect(), ..EventReport::new(index, "any") }
    }

    #[test]
    fn every_subject_is_come_to_and_the_first_again() {
        let mut all = vec![Subject::Frame];
        all.extend(
            std::iter::successors(Some(Subject::Frame.next()), |s| Some(s.next()))
                .take_while(|s| *s != Subject::Frame),
        );
        assert_eq!(all, Subject::ALL);
    }

    #[test]
    fn what_is_drawn_is_of_the_event_or_of_the_last_one_before_it_that_has_any() {
        let reports = [report(0, &[("a", vec![1])]), report(1, &[("a", vec![])]), report(2, &[])];
        let find =
            |held, events| super::source(held, events, |event| reports.get(event)).map(|report| report.index);
        assert_eq!(
            [find(None, 3), find(None, 2), find(None, 1), find(None, 0)],
            [Some(0), Some(0), Some(0), None]
        );
        let held = report(7, &[("b", vec![3])]);
        assert_eq!(find(Some(&held), 1), Some(7));
        assert_eq!(find(Some(&reports[1]), 1), Some(0), "what is held has nothing yet");
    }

    #[test]
    fn groups_are_first_words_and_need_a_face() {
        let report =
            report(0, &[("kind A", vec![1]), ("none", vec![]), ("kind B", vec![2]), ("rim", vec![3])]);
        assert_eq!(groups(&report.overlays), ["kind", "rim"]);
    }
}
