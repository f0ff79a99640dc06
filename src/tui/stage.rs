//! The screen without a terminal: the same model, update and view, with a desk that does one thing after the other.
//!
//! Tests type on it and look at it, and `lancet tui --screen` writes what a person would see. Nothing runs beside it, so what it shows is the same every
//! time; with steady times it is the same on every machine, too.

use std::sync::Arc;

use crossterm::event::{Event, KeyEvent};
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use super::compare::Comparisons;
use super::image::encoder::encode;
use super::key::Key;
use super::keys::Keys;
use super::model::{Effect, Model};
use super::run::Start;
use super::theme::Theme;
use super::worker::{Desk, Line, Told};
use super::{events, picture, update, view};
use crate::report::EventReport;

/// Rounds of asking and telling after which nothing new can come of it.
const ROUNDS: usize = 10_000;

/// See the module.
pub struct Stage {
    pub(in crate::tui) model: Model,
    theme: Theme,
    keys: Keys,
    desk: Desk,
    steady: bool,
    /// What was copied, in order.
    copied: Vec<String>,
}

impl Stage {
    /// The screen as it is once everything is done that it begins with. With steady times no figure depends on the machine.
    pub fn open(start: &Start, theme: Theme, size: [u16; 2], steady: bool) -> Self {
        let comparisons = Comparisons::first(start.compare.clone());
        let model = Model { size, comparisons, ..Model::default() };
        let keys = Keys::new(&start.config.keys);
        let desk = Desk::new(start.renderer, start.budget_bytes).with_drafts(start.drafts.clone());
        let mut stage = Self { model, theme, keys, desk, steady, copied: Vec::new() };
        update::begin(&mut stage.model, start.recording.clone());
        stage.settle();
        stage
    }

    /// Types keys, with blanks between them, and waits after each until all is done. An error names the one that is none; then none is typed.
    pub fn press(&mut self, keys: &str) -> Result<(), String> {
        Self::keys(keys)?.into_iter().for_each(|key| self.press_key(key));
        Ok(())
    }

    /// The keys that a text names, with blanks between them.
    pub fn keys(text: &str) -> Result<Vec<Key>, String> {
        text.split_whitespace().map(|word| word.parse().map_err(|error| format!("{error}"))).collect()
    }

    /// Types a key, and waits until all is done.
    pub fn press_key(&mut self, key: Key) {
        self.take(Event::Key(KeyEvent::new(key.code(), key.modifiers())));
    }

    /// Takes an event of a terminal, and waits until all is done.
    pub fn take(&mut self, event: Event) {
        events::take(&mut self.model, &self.keys, event);
        self.settle();
    }

    /// Whether it was left.
    pub fn is_over(&self) -> bool {
        self.model.done
    }

    /// Leaves at once.
    #[cfg(test)]
    pub(in crate::tui) fn leave(self) -> Result<(), String> {
        self.desk.leave()
    }

    /// What the screen knows.
    #[cfg(test)]
    pub(in crate::tui) fn model(&mut self) -> &mut Model {
        &mut self.model
    }

    /// Why nothing is open, where something was to be.
    pub fn failure(&self) -> Option<&str> {
        let message = self.model.message.as_ref().filter(|message| message.wrong);
        message.filter(|_| self.model.opened.is_none()).map(|message| message.text.as_str())
    }

    /// What the last comparison came to: whether all is the same; an error says why there is none.
    pub fn compared(&self) -> Option<Result<bool, &str>> {
        let refused = self.model.comparisons.refused.as_deref().map(Err);
        refused.or_else(|| self.model.differences.as_ref().map(|found| Ok(found.verified)))
    }

    /// Whether an invariant broke on the way.
    pub fn has_finding(&self) -> bool {
        self.model.finding.is_some()
    }

    /// What was copied, in order.
    pub fn copied(&self) -> &[String] {
        &self.copied
    }

    /// What the screen shows.
    pub fn screen(&self) -> Buffer {
        let [width, height] = self.model.size;
        let mut buffer = Buffer::empty(Rect::new(0, 0, width, height));
        view::draw(&self.model, &self.theme, &self.keys, &mut buffer);
        buffer
    }

    /// Does what is asked, until nothing is.
    pub(in crate::tui) fn settle(&mut self) {
        for _ in 0..ROUNDS {
            update::picture::want(&mut self.model);
            let effects = std::mem::take(&mut self.model.effects);
            if effects.is_empty() && !self.show() {
                return;
            }
            effects.into_iter().for_each(|effect| self.carry_out(effect));
        }
        debug_assert!(false, "one thing leads to another without end");
    }

    /// Makes the picture ready that is to be seen. Whether it is another.
    fn show(&mut self) -> bool {
        let Some(request) = picture::request(&self.model) else { return false };
        let other = self.model.picture.encoded.as_ref().is_none_or(|encoded| !encoded.answers(&request));
        if other {
            update::picture::encoded(&mut self.model, encode(&request));
        }
        other && self.model.picture.encoded.is_some()
    }

    fn carry_out(&mut self, effect: Effect) {
        match effect {
            Effect::Ask(ask) => {
                let mut heard = Heard::default();
                self.desk.handle(ask, &mut heard);
                let steady = self.steady;
                let told = heard.0.into_iter().map(|told| if steady { steadied(told) } else { told });
                for told in told {
                    update::told(&mut self.model, told);
                    events::catch_up(&mut self.model, &self.keys);
                }
            }
            Effect::Copy(text) => self.copied.push(text),
            Effect::Suspend | Effect::Redraw => {}
        }
    }
}

/// What the desk told. Nothing else is ever wanted.
#[derive(Default)]
struct Heard(Vec<Told>);

impl Line for Heard {
    fn tell(&mut self, told: Told) {
        self.0.push(told);
    }

    fn is_interrupted(&mut self) -> bool {
        false
    }

    fn is_wanted(&mut self) -> bool {
        false
    }
}

/// The same with times that depend on nothing but what they are the times of.
fn steadied(told: Told) -> Told {
    match told {
        Told::Report(report) => Told::Report(Arc::new(steady_report(&report))),
        Told::Picture(picture) => Told::Picture(Box::new(super::shot::Picture { ms: 12.0, ..*picture })),
        Told::At(standing) => {
            let within = standing.within.as_ref().map(|report| Arc::new(steady_report(report)));
            Told::At(Box::new(super::worker::Standing { within, ..*standing }))
        }
        other => other,
    }
}

fn steady_report(report: &EventReport) -> EventReport {
    let mut report = report.clone();
    let event = report.index as f64;
    for (row, stage) in (1u32..).zip(report.stages.iter_mut().filter(|stage| stage.skipped.is_none())) {
        stage.us = 10.0 * f64::from(row * row) + event;
    }
    report.passes.iter_mut().for_each(|pass| pass.us = if pass.skipped.is_some() { 0.0 } else { 100.0 });
    report
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A recording of a square that is cut once, then not.
    const SCRIPT: &str = r#"{ "version": 1, "viewport": [100, 100], "seed": 3,
        "scene": { "inline": { "nodes": [[0, 0, 0], [4, 0, 0], [4, 4, 0], [0, 4, 0]], "faces": [[0, 1, 2], [0, 2, 3]] } },
        "events": [ { "mode": "merge" }, { "click": [45, 40] }, { "click": [60, 55] }, { "click": [0.5, 0.5] },
                    { "checkpoint": "end" } ] }"#;

    #[test]
    fn stepping_shows_each_event_and_what_became_of_it() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("square.json");
        crate::assets::write_file(&path, SCRIPT.as_bytes()).expect("written");
        let start = Start { recording: Some(path), ..Start::default() };
        let mut stage = Stage::open(&start, Theme::default(), [120, 40], true);
        stage.press("l l l").expect("keys");
        let text = super::super::screen::to_text(&stage.screen());
        assert!(text.contains("3/5") && text.contains(" miss"), "{text}");
        assert!(stage.press("nokey").is_err());
        stage.press("q").expect("a key");
        assert!(stage.is_over());
    }
}
