//! What a run is compared with, and how it differs.

use crate::tui::model::{Model, Place};
use crate::verify::ComparedPicture;

/// See the module.
#[derive(Clone, Debug, Default)]
pub(in crate::tui) struct Differences {
    /// The checkpoints' pictures beside their goldens.
    pub(in crate::tui) pictures: Vec<ComparedPicture>,
}

/// The compared picture of a place.
pub(in crate::tui) fn picture(model: &Model, place: Place) -> Option<&ComparedPicture> {
    let event = place.event().filter(|_| place.stage.is_none())?;
    model.differences.as_ref()?.pictures.iter().find(|picture| picture.event == event)
}
