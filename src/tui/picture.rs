//! The picture as the screen wants it: what it is of, from where, what is drawn over it, and which one is there.

use crate::canvas::frame::Orbit;
use crate::tui::model::{Model, Pane, Place};
use crate::tui::shot::{Drawn, Picture, Shot, Subject};
use crate::tui::view;

/// See the module.
#[derive(Clone, Debug, Default)]
pub(in crate::tui) struct PictureState {
    /// What it is of.
    pub(in crate::tui) subject: Subject,
    /// Where to look from, if not from where the recording does.
    pub(in crate::tui) orbit: Option<Orbit>,
    /// What is drawn over it; what is selected comes with it when it is asked for.
    pub(in crate::tui) drawn: Drawn,
    /// The picture that is there.
    pub(in crate::tui) got: Option<Picture>,
    /// The picture that was asked for last, and where.
    pub(in crate::tui) asked: Option<(Place, Shot)>,
}

impl PictureState {
    /// Whether a picture was asked for that has not come.
    pub(in crate::tui) fn is_awaited(&self) -> bool {
        self.asked.as_ref().is_some_and(|(_, asked)| self.got.as_ref().is_none_or(|got| got.shot != *asked))
    }

    /// The picture to ask for: none where nothing is open, the pane is not on the screen, or it was asked for already.
    pub(in crate::tui) fn shot(&self, model: &Model) -> Option<Shot> {
        let area = view::areas(model).inner(Pane::Picture)?;
        model.opened.as_ref()?;
        let drawn = Drawn { marked: model.selected.clone(), ..self.drawn.clone() };
        let limit = [u32::from(area.width), 2 * u32::from(area.height)];
        let shot = Shot { number: 0, subject: self.subject, orbit: self.orbit, limit, drawn };
        let known = self.asked.as_ref().is_some_and(|(place, asked)| *place == model.place && *asked == shot);
        (!known && limit.iter().all(|side| *side > 0)).then_some(shot)
    }
}
