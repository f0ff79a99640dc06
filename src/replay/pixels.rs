//! The renderer of a session: it carries the stages' jobs out, follows undo and seek, and renders frames.
//!
//! A session may have none: then jobs are digested all the same, and checkpoints have no picture. A renderer that fails is let go of; why is
//! kept, and the replay goes on without pixels, so that nothing else is lost.

use std::sync::Arc;

use crate::canvas::frame::{Frame, FrameJob};
use crate::canvas::image::{Image, MapId};
use crate::canvas::job::Painting;
use crate::canvas::{RenderError, Renderer};
use crate::engine::Job;
use crate::report::Check;

/// A renderer, for as long as it works.
#[derive(Default)]
pub(super) struct Pixels {
    renderer: Option<Box<dyn Renderer>>,
    failure: Option<RenderError>,
}

impl Pixels {
    pub(super) fn new(renderer: Option<Box<dyn Renderer>>) -> Self {
        Self { renderer, failure: None }
    }

    /// Why the renderer was let go of.
    pub(super) fn failure(&self) -> Option<&RenderError> {
        self.failure.as_ref()
    }

    /// Makes the maps those of some paintings.
    pub(super) fn follow(&mut self, paintings: &[Arc<Painting>]) {
        self.ask(|renderer| renderer.follow(paintings));
    }

    pub(super) fn carry_out(&mut self, job: Job<'_>) {
        self.ask(|renderer| match job {
            Job::Patch(patch) => renderer.patch(patch),
            Job::Paint(painting) => renderer.paint(painting),
        });
    }

    /// Looks at the pixels that a job gave.
    pub(super) fn check(&mut self, job: Job<'_>) -> Vec<Check> {
        let checks = self.ask(|renderer| match job {
            Job::Patch(patch) => renderer.check_patch(patch),
            Job::Paint(_) => renderer.check_paint(),
        });
        checks.unwrap_or_default()
    }

    pub(super) fn frame(&mut self, paintings: &[Arc<Painting>], job: &FrameJob<'_>) -> Option<Frame> {
        self.follow(paintings);
        self.ask(|renderer| renderer.frame(job))
    }

    pub(super) fn map(&mut self, paintings: &[Arc<Painting>], map: MapId) -> Option<Image> {
        self.follow(paintings);
        self.ask(|renderer| renderer.map(map))
    }

    /// Asks the renderer, if there is one that works.
    fn ask<T>(&mut self, what: impl FnOnce(&mut dyn Renderer) -> Result<T, RenderError>) -> Option<T> {
        match what(self.renderer.as_deref_mut()?) {
            Ok(answer) => Some(answer),
            Err(error) => {
                (self.renderer, self.failure) = (None, Some(error));
                None
            }
        }
    }
}
