//! The picture as the screen wants it: what it is of, from where, what is drawn over it, which part is seen, and which one is there.
//!
//! It is made in two steps, each away from the screen: the worker renders a [`Shot`], and the encoder makes it ready for the terminal. What is there
//! stays until the next one is.

pub(in crate::tui) mod golden;

use std::sync::Arc;

use ratatui::layout::{Position, Rect};

use crate::canvas::frame::Orbit;
use crate::canvas::image::Image;
use crate::report::EventReport;
use crate::tui::image::encoder::{Encoded, Request};
use crate::tui::image::protocol::Medium;
use crate::tui::image::window::{Fit, Window};
use crate::tui::model::{Model, Pane, Place};
use crate::tui::record::cross;
use crate::tui::shot::{self, Drawn, Picture, Shot, Subject};
use crate::tui::view;
use golden::{Beside, Golden};

/// See the module.
#[derive(Debug, Default)]
pub(in crate::tui) struct PictureState {
    /// How pictures reach the terminal.
    pub(in crate::tui) medium: Medium,
    /// What it is of.
    pub(in crate::tui) subject: Subject,
    /// Where to look from, if not from where the recording does.
    pub(in crate::tui) orbit: Option<Orbit>,
    /// What is drawn over it; what is selected comes with it when it is asked for.
    pub(in crate::tui) drawn: Drawn,
    /// The part that is seen.
    pub(in crate::tui) window: Window,
    /// How the golden picture is shown.
    pub(in crate::tui) golden: Golden,
    /// How far the line between golden and actual is from the middle, in shares of the pane's width.
    pub(in crate::tui) split: f64,
    /// The golden picture of the place that is shown.
    pub(in crate::tui) beside: Option<Beside>,
    /// How often that was another one.
    pub(in crate::tui) goldens: u64,
    /// The picture that is there.
    pub(in crate::tui) got: Option<Picture>,
    /// The picture that was asked for last, and where.
    pub(in crate::tui) asked: Option<(Place, Shot)>,
    /// The number of the last picture that was asked for.
    pub(in crate::tui) number: u64,
    /// The number of the last one that came, or failed.
    pub(in crate::tui) answered: u64,
    /// Why there is none.
    pub(in crate::tui) missing: Option<String>,
    /// The picture as it is drawn.
    pub(in crate::tui) encoded: Option<Encoded>,
    /// What the mouse does while its button is down.
    pub(in crate::tui) drag: Option<Drag>,
}

/// What the mouse does while its button is down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::tui) struct Drag {
    /// Does what.
    pub(in crate::tui) pull: Pull,
    /// Where it was last.
    pub(in crate::tui) last: Position,
    /// Whether it has moved: else it is a click.
    pub(in crate::tui) moved: bool,
}

/// What a drag moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::tui) enum Pull {
    /// Turns the model.
    Orbit,
    /// Moves the enlarged picture.
    Pan,
    /// Moves the line between golden and actual.
    Split,
}

impl PictureState {
    /// Whether a picture was asked for that has not come.
    pub(in crate::tui) fn is_awaited(&self) -> bool {
        self.answered < self.number
    }

    /// What stays when another recording is opened.
    pub(in crate::tui) fn anew(self) -> Self {
        let Self { medium, drawn, goldens, number, answered, .. } = self;
        Self { medium, drawn, goldens, number, answered, ..Self::default() }
    }

    /// A picture has come.
    pub(in crate::tui) fn take(&mut self, picture: Picture) {
        self.answered = self.answered.max(picture.shot.number);
        self.missing = None;
        self.got = Some(picture);
    }

    /// A picture that was asked for cannot be had.
    pub(in crate::tui) fn miss(&mut self, number: u64, why: String) {
        self.answered = self.answered.max(number);
        (self.missing, self.got, self.encoded) = (Some(why), None, None);
    }

    /// No picture comes that was asked for before, and those that are there may be of another state.
    pub(in crate::tui) fn forget(&mut self) {
        (self.asked, self.answered) = (None, self.number);
    }

    /// The share of the pane that the golden has beside the actual picture.
    pub(in crate::tui) fn share(&self) -> f64 {
        (0.5 + self.split).clamp(0.0, 1.0)
    }

    /// Whether there is nothing to look at from another side.
    pub(in crate::tui) fn is_flat(&self) -> bool {
        self.subject != Subject::Frame || self.golden != Golden::Off
    }

    /// The picture to ask for: none where nothing is open, the pane is not on the screen, or it was asked for already.
    pub(in crate::tui) fn shot(&self, model: &Model) -> Option<Shot> {
        let area = area(model)?;
        let viewport = model.opened.as_ref()?.viewport;
        // Zoomed in, it is rendered larger in steps, and not anew with every turn of the wheel.
        let zoom = [1.0, 2.0, 4.0, 8.0, 16.0, 32.0].into_iter().find(|step| *step >= self.window.zoom);
        let zoom = zoom.unwrap_or(crate::tui::image::window::MOST);
        let shown = self.medium.pixels(area.as_size()).map(|side| (f64::from(side) * zoom) as u32);
        let most = self.medium.box_size(area.as_size(), zoom);
        let limit = match self.subject {
            Subject::Frame => [0, 1].map(|k| most[k].min(viewport[k])),
            Subject::Map(_) => shown,
        };
        let drawn = Drawn { marked: model.selected.clone(), ..self.drawn.clone() };
        let orbit = self.orbit.filter(|_| self.subject == Subject::Frame);
        let shot = Shot { number: self.number + 1, subject: self.subject, orbit, limit, shown, drawn };
        let known = self.asked.as_ref().is_some_and(|(at, asked)| *at == model.place && shot.is_like(asked));
        (!known && self.golden == Golden::Off && most.iter().all(|side| *side > 0)).then_some(shot)
    }
}

/// The picture's place on the screen, if it is there and not empty.
pub(in crate::tui) fn area(model: &Model) -> Option<Rect> {
    places(model).map(|[area, _]| area).filter(|area| !area.is_empty())
}

/// The places of the picture and of the line below it: on the border where there is one, else a line of the pane where it has enough of them.
pub(in crate::tui) fn places(model: &Model) -> Option<[Rect; 2]> {
    let areas = view::areas(model);
    let inner = areas.inner(Pane::Picture)?;
    let own = u16::from(inner.height > 3);
    let [height, y] = [inner.height - own, inner.bottom() - own];
    Some(match areas.foot(Pane::Picture) {
        Some(foot) => [inner, foot],
        None => [Rect { height, ..inner }, Rect { y, height: own, ..inner }],
    })
}

/// The picture to make ready: the golden one and the actual one, or the one that the worker took.
pub(in crate::tui) fn request(model: &Model) -> Option<Request> {
    let PictureState { medium, window, .. } = model.picture;
    let (number, image, beside) = shown(model)?;
    let area = area(model)?.as_size();
    let marks = cross::marks(model);
    Some(Request { beside, window, medium, marks, ..Request::whole(number, image, area) })
}

type Beheld = (u64, Arc<Image>, Option<(Arc<Image>, f64)>);

/// The picture that is to be seen, with its number, and what lies beside it.
fn shown(model: &Model) -> Option<Beheld> {
    let picture = &model.picture;
    if picture.golden != Golden::Off {
        return golden::shown(picture);
    }
    let got = picture.got.as_ref()?;
    Some((own_number(got), Arc::clone(&got.image), None))
}

/// What tells a picture of the worker's from golden ones.
fn own_number(got: &Picture) -> u64 {
    2 * got.shot.number
}

/// Width and height of what is to be seen; those of the recorded view until there is anything.
pub(in crate::tui) fn size(model: &Model) -> Option<[u32; 2]> {
    let image = shown(model).map(|(_, image, _)| image.size);
    image.or(model.opened.as_ref().map(|opened| opened.viewport))
}

/// How the picture lies in its pane.
pub(in crate::tui) fn fit(model: &Model) -> Option<Fit> {
    let pane = model.picture.medium.pixels(area(model)?.as_size());
    Some(model.picture.window.fit(size(model)?, pane))
}

/// The picture of the worker's that is drawn, if it is one of those and not just about to be another.
pub(in crate::tui) fn seen(model: &Model) -> Option<(&Picture, &Encoded)> {
    let (got, encoded) = (model.picture.got.as_ref()?, model.picture.encoded.as_ref()?);
    let is_it = encoded.number() == own_number(got) && Some(encoded.area()) == area(model).map(Rect::as_size);
    (is_it && model.picture.golden == Golden::Off).then_some((got, encoded))
}

/// The report whose lines and sets of faces are drawn at the place that is shown.
pub(in crate::tui) fn source(model: &Model) -> Option<&EventReport> {
    let held = model.here().and_then(|standing| standing.within.as_deref());
    shot::source(held, model.place.events, |event| model.report(event))
}

#[cfg(test)]
mod tests;
