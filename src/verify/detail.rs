//! What a page shows of a recording beyond its report: events and stages in few words, and the pictures as files.

use serde::{Deserialize, Serialize};

use super::golden::{Found, Stored};
use super::html::base64;
use super::image::{ImageReport, ImageVerdict};
use crate::assets::write_png;
use crate::report::{Check, EventReport, Outcome, Pass, StageReport};

/// A recording, as a page shows it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Detail {
    /// Its name.
    pub recording: String,
    /// The engine's name.
    pub engine: String,
    /// The events, in order.
    pub events: Vec<EventDetail>,
    /// The checkpoints' pictures.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub pictures: Vec<PictureDetail>,
}

/// An event, in few words.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EventDetail {
    /// Its place in the recording.
    pub index: usize,
    /// What it is.
    pub kind: String,
    /// The mode in force.
    pub mode: String,
    /// What became of it.
    pub outcome: Outcome,
    /// The reason of a rejection, or a checkpoint's name.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub note: Option<String>,
    /// The stages.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub stages: Vec<StageDetail>,
    /// What was done for a checkpoint's frame.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub passes: Vec<Pass>,
    /// How many invariants of the whole state held.
    pub held: usize,
    /// Those that did not.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub broken: Vec<String>,
}

/// A stage of an event.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StageDetail {
    /// Its short name.
    pub id: String,
    /// Microseconds that it took.
    pub us: f64,
    /// Why it did not run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub skipped: Option<String>,
    /// How many invariants held.
    pub held: usize,
    /// Those that did not.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub broken: Vec<String>,
}

/// A checkpoint's picture and its golden, as PNG files in base64. What is equal is there once.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PictureDetail {
    /// The checkpoint.
    pub checkpoint: String,
    /// The golden; none where there is none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub golden: Option<String>,
    /// What was rendered, where it is not the golden.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub actual: Option<String>,
}

impl Detail {
    /// A run with its goldens and what was said of its pictures.
    pub(super) fn new(found: &Found, stored: &Stored, images: &[ImageReport]) -> Self {
        Self {
            recording: found.run.recording.clone(),
            engine: found.run.engine.clone(),
            events: found.run.events.iter().map(event).collect(),
            pictures: images.iter().map(|image| picture(image, found, stored)).collect(),
        }
    }

    /// The same with every time at zero.
    #[must_use]
    pub(super) fn without_times(mut self) -> Self {
        for event in &mut self.events {
            event.stages.iter_mut().for_each(|stage| stage.us = 0.0);
            event.passes.iter_mut().for_each(|pass| pass.us = 0.0);
        }
        self
    }
}

fn event(event: &EventReport) -> EventDetail {
    EventDetail {
        index: event.index,
        kind: event.kind.clone(),
        mode: event.mode.clone(),
        outcome: event.outcome,
        note: event.reason.clone().or_else(|| event.checkpoint.clone()),
        stages: event.stages.iter().map(stage).collect(),
        passes: event.passes.clone(),
        held: held(&event.checks),
        broken: broken(&event.checks),
    }
}

fn stage(stage: &StageReport) -> StageDetail {
    StageDetail {
        id: stage.id.clone(),
        us: stage.us,
        skipped: stage.skipped.clone(),
        held: held(&stage.checks),
        broken: broken(&stage.checks),
    }
}

fn held(checks: &[Check]) -> usize {
    checks.iter().filter(|check| check.ok).count()
}

fn broken(checks: &[Check]) -> Vec<String> {
    checks.iter().filter(|check| !check.ok).map(|check| format!("{}: {}", check.name, check.detail)).collect()
}

fn picture(image: &ImageReport, found: &Found, stored: &Stored) -> PictureDetail {
    let name = &image.checkpoint;
    let golden = stored.pictures.get(name).map(|picture| base64(&picture.png));
    let other = found.frame(name).filter(|_| image.verdict != ImageVerdict::Equal);
    // A frame without a pixel has no file.
    let actual = other.and_then(|frame| write_png(&frame.frame.image).ok()).map(|png| base64(&png));
    PictureDetail { checkpoint: name.clone(), golden, actual }
}
