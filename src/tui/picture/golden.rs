//! The golden picture of a checkpoint, beside the actual one, alone, or as the difference of the two.

use std::sync::Arc;

use super::{Beheld, PictureState};
use crate::canvas::image::Image;
use crate::tui::compare;
use crate::tui::model::Model;
use crate::verify::ComparedPicture;

/// How it is shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::tui) enum Golden {
    /// Not at all.
    #[default]
    Off,
    /// Left of a line, and the actual one right of it.
    Split,
    /// Alone.
    Alone,
    /// As the difference of the two.
    Difference,
}

impl Golden {
    /// The next way.
    pub(in crate::tui) fn next(self) -> Self {
        match self {
            Self::Off => Self::Split,
            Self::Split => Self::Alone,
            Self::Alone => Self::Difference,
            Self::Difference => Self::Off,
        }
    }

    /// What is seen, for people.
    pub(in crate::tui) fn name(self) -> &'static str {
        match self {
            Self::Off => "",
            Self::Split => "golden | actual",
            Self::Alone => "golden",
            Self::Difference => "difference",
        }
    }
}

/// A golden picture, ready to be shown.
#[derive(Clone, Debug)]
pub(in crate::tui) struct Beside {
    /// Tells it from others.
    number: u64,
    golden: Arc<Image>,
    actual: Arc<Image>,
    difference: Arc<Image>,
}

impl Beside {
    fn of(picture: &ComparedPicture, number: u64) -> Option<Self> {
        let (golden, difference) = (picture.golden.clone()?, picture.difference.clone()?);
        Some(Self { number, golden, actual: Arc::clone(&picture.actual), difference })
    }

    fn is_the_same(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.golden, &other.golden) && Arc::ptr_eq(&self.actual, &other.actual)
    }
}

/// The compared picture of the place that is shown.
pub(in crate::tui) fn compared(model: &Model) -> Option<&ComparedPicture> {
    compare::picture(model, model.place)
}

/// Makes the golden picture of the place that is shown ready, if it is to be seen.
pub(in crate::tui) fn follow(model: &mut Model) {
    if model.picture.golden == Golden::Off {
        return;
    }
    let (number, before) = (model.picture.goldens + 1, model.picture.beside.as_ref());
    let now = compared(model).and_then(|picture| Beside::of(picture, number));
    if now.as_ref().zip(before).is_none_or(|(now, before)| !now.is_the_same(before)) {
        model.picture.goldens += u64::from(now.is_some());
        model.picture.beside = now;
    }
}

/// What is to be seen of it.
pub(super) fn shown(picture: &PictureState) -> Option<Beheld> {
    let Beside { number, golden, actual, difference } = picture.beside.as_ref()?;
    // Numbers of golden pictures are odd, and each has three.
    let number = |kind: u64| 2 * (3 * number + kind) + 1;
    Some(match picture.golden {
        Golden::Difference => (number(0), Arc::clone(difference), None),
        Golden::Alone => (number(1), Arc::clone(golden), None),
        _ => (number(2), Arc::clone(golden), Some((Arc::clone(actual), picture.share()))),
    })
}

/// Why no golden picture is seen.
pub(in crate::tui) fn lack(model: &Model) -> String {
    let compare = crate::tui::action::Action::Compare.row().name;
    match (compared(model), &model.differences) {
        (Some(picture), _) => format!("{} has no golden picture", picture.checkpoint),
        (None, None) => format!("nothing is compared yet: `{compare}` first"),
        (None, Some(differences)) if differences.pictures.is_empty() => "no picture was compared".into(),
        (None, Some(_)) => "there is no checkpoint here".into(),
    }
}
