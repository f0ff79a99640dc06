//! A session, and the model beside it: every deed is done to both.

use std::path::Path;

use lancet::recording::{AnyRecording, SceneRef};
use lancet::replay::{Case, Input, Options, Replay};
use lancet::report::{EventReport, Finding};

use crate::deeds::{Deed, SIDE};
use crate::linear::{Linear, Stand};
use crate::story::Story;

/// See the module.
pub(crate) struct Machine {
    case: Case,
    replay: Box<dyn Replay>,
    options: Options,
    // From here on it is the model.
    recording: AnyRecording,
    /// Made anew when events come.
    linear: Linear,
    position: usize,
    /// How far the run has ever gone.
    ran: usize,
    /// Whether it stands within the event at the position.
    held: bool,
    /// Whether events may still come.
    live: bool,
    /// Checkpoints so far, those that were dropped too.
    named: usize,
    /// How many events' reports were compared.
    compared: usize,
}

type Done = Result<(), String>;

impl Machine {
    /// Stands before the first of some events.
    pub(crate) fn begin(
        scene: &SceneRef,
        first: &[Input],
        budget_bytes: usize,
        story: &mut Story,
    ) -> Result<Self, String> {
        let recording = AnyRecording::begin("wound", scene.clone(), [SIDE; 2])?;
        let case = Case::new(recording, Path::new("")).map_err(|error| error.to_string())?;
        let (mut recording, mut named) = (case.recording.clone(), 0);
        for input in first {
            recording.append(&with_name(input, &mut named))?;
        }
        story.recording = Some(recording.clone());
        recording
            .event_lines()
            .iter()
            .for_each(|line| story.tell(format_args!("from the beginning: {line}")));
        // The whole state's invariants are looked at often, and how often depends on what was done so far.
        let options = Options { budget_bytes, check_every: 2, ..Options::default() };
        let replay = case.replay(&recording, options.clone(), None).map_err(|error| error.to_string())?;
        let linear = Linear::of(&case, &recording, &options)?;
        let (position, ran, held, live) = (0, 0, false, false);
        Ok(Self { case, replay, options, recording, linear, position, ran, held, live, named, compared: 0 })
    }

    fn len(&self) -> usize {
        self.recording.event_count()
    }

    /// Does something, and tells what.
    pub(crate) fn carry_out(&mut self, deed: &Deed, story: &mut Story) -> Done {
        match *deed {
            Deed::Record(ref inputs) => self.record(inputs, story),
            Deed::RecordNonsense => self.record_nonsense(story),
            Deed::Truncate(events) => self.truncate(events % (self.len() + 2), story),
            Deed::Step(times) => (0..times).try_for_each(|_| self.step(story)),
            Deed::Back(times) => (0..times).try_for_each(|_| self.back(story)),
            Deed::Seek(event) => self.seek(event % (self.len() + 2), story),
            Deed::SeekAndStop(event, after) => self.seek_and_stop(event % (self.len() + 1), after, story),
            Deed::Hold(event, stage) => self.hold(event % (self.len() + 1), stage, story),
            Deed::Release => {
                story.tell("release");
                self.replay.release();
                self.held = false;
                Ok(())
            }
            Deed::Finish => {
                story.tell("run all");
                self.replay.finish();
                self.stand_at(self.len());
                Ok(())
            }
        }
    }

    /// The kinds of the events that ran, the stages that they went through, what became of them and why.
    pub(crate) fn seen(&self) -> Vec<String> {
        let of = |report: &EventReport| {
            let ran = report.stages.iter().filter(|row| row.skipped.is_none());
            let stages = ran.map(|row| row.id.clone()).collect::<Vec<_>>();
            let what = [report.kind.clone(), format!("{:?}", report.outcome)];
            stages.into_iter().chain(what).chain(report.reason.clone())
        };
        (0..self.len()).filter_map(|event| self.replay.event(event)).flat_map(of).collect()
    }

    /// Goes back to an event; how, as far as the places on the way tell.
    pub(crate) fn way_back(&mut self, event: usize) -> &'static str {
        let mut before = Vec::new();
        self.replay.seek_while(event, &mut |at| {
            before.extend((at < event).then_some(at));
            true
        });
        match before.first() {
            None => "step by step",
            Some(1) => "from the beginning",
            Some(_) => "from a keyframe",
        }
    }

    /// It stands before an event, and has run all up to it.
    fn stand_at(&mut self, event: usize) {
        (self.position, self.held) = (event, false);
        self.ran = self.ran.max(event);
    }

    fn record(&mut self, inputs: &[Input], story: &mut Story) -> Done {
        for input in inputs {
            let input = with_name(input, &mut self.named);
            let key = self.recording.append(&input)?;
            story.recording = Some(self.recording.clone());
            story.tell(format_args!(
                "record {}",
                self.recording.event_lines().last().map_or("", String::as_str)
            ));
            self.replay.append(key, &input)?;
            self.live = true;
        }
        self.linear.grow(&self.case, &self.recording, &self.options)
    }

    fn record_nonsense(&mut self, story: &mut Story) -> Done {
        story.tell("record what is no event");
        let refused =
            [r#"{"cut": 3}"#, "{"].iter().all(|text| self.replay.append(99, &script(text)).is_err());
        ensure(refused, || "nonsense is recorded".into())
    }

    fn truncate(&mut self, events: usize, story: &mut Story) -> Done {
        story.tell(format_args!("drop all but {events} events"));
        self.replay.truncate(events);
        if events < self.len() {
            self.recording.truncate(events);
            story.recording = Some(self.recording.clone());
            self.linear.truncate(events);
            self.compared = self.compared.min(events);
            (self.position, self.ran) = (self.position.min(events), self.ran.min(events));
            (self.held, self.live) = (false, true);
        }
        Ok(())
    }

    fn step(&mut self, story: &mut Story) -> Done {
        story.tell("step");
        let report = self.replay.step().map(EventReport::without_times);
        let expected = self.linear.reports.get(self.position);
        ensure(report.as_ref() == expected, || {
            format!("a step reports {report:#?}\nrather than {expected:#?}")
        })?;
        self.stand_at((self.position + 1).min(self.len()));
        Ok(())
    }

    fn back(&mut self, story: &mut Story) -> Done {
        story.tell("back");
        let went = self.replay.back();
        ensure(went == (self.position > 0), || format!("back from {} answers {went}", self.position))?;
        if went {
            self.stand_at(self.position - 1);
        }
        Ok(())
    }

    fn seek(&mut self, event: usize, story: &mut Story) -> Done {
        story.tell(format_args!("seek {event}"));
        self.replay.seek(event);
        self.stand_at(event.min(self.len()));
        Ok(())
    }

    /// Where a seek is stopped is the session's to say, as long as it is on the way.
    fn seek_and_stop(&mut self, event: usize, after: usize, story: &mut Story) -> Done {
        story.tell(format_args!("seek {event}, stop after {after}"));
        let mut left = after;
        let arrived = self.replay.seek_while(event, &mut |_| {
            left = left.saturating_sub(1);
            left > 0
        });
        let at = self.replay.position();
        let on_the_way = at <= self.position.max(event) && (at == event || !arrived);
        ensure(on_the_way, || format!("a seek from {} to {event} ends at {at}", self.position))?;
        self.stand_at(at);
        Ok(())
    }

    /// What is held has run as far as the stage, as it does in the whole event.
    fn hold(&mut self, event: usize, stage: &str, story: &mut Story) -> Done {
        story.tell(format_args!("hold {event}.{stage}"));
        let held = self.replay.hold(event, stage);
        let known = self.replay.stages().iter().any(|(id, _)| *id == stage);
        let Some(whole) = self.linear.reports.get(event).filter(|_| known) else {
            return ensure(held.is_err(), || format!("{event}.{stage} is held, which is not there"));
        };
        let row = whole.stages.iter().position(|row| row.id == stage);
        let ran = held.as_ref().ok().map(|held| held.without_times().stages);
        let same = match (&ran, row) {
            (Some(ran), Some(row)) => ran.len() == whole.stages.len() && ran[..=row] == whole.stages[..=row],
            (ran, row) => ran.is_none() && row.is_none(),
        };
        ensure(same, || format!("held at {event}.{stage}: {held:#?}\nthe whole event: {:#?}", whole.stages))?;
        self.stand_at(event);
        self.held = row.is_some();
        Ok(())
    }

    /// Compares all that can be seen of the session with the model.
    pub(crate) fn compare(&mut self) -> Done {
        let (replay, at) = (self.replay.as_ref(), self.position);
        let place = [replay.position(), replay.len()];
        ensure(place == [at, self.len()], || {
            format!("it stands at {place:?}, not at {at} of {}", self.len())
        })?;
        let (finding, expected) = (replay.finding(), self.finding());
        ensure(finding == expected, || format!("a finding: {finding:#?}\nnot: {expected:#?}"))?;
        let (kept, budget) = (replay.kept_bytes(), self.options.budget_bytes);
        ensure(kept <= budget, || format!("{kept} bytes are kept, of {budget}"))?;
        if !self.held {
            self.compare_stand()?;
        }
        self.compare_reports(self.compared)?;
        self.compared = self.ran;
        Ok(())
    }

    /// The same, and all that was ever reported.
    pub(crate) fn compare_all(&mut self) -> Done {
        self.compare()?;
        self.compare_reports(0)
    }

    /// The first broken invariant among the events that ever ran, or of the end.
    fn finding(&self) -> Option<&Finding> {
        let ended = !self.live && self.ran == self.len();
        self.linear.finding.as_ref().filter(|finding| finding.event.map_or(ended, |event| event < self.ran))
    }

    fn compare_stand(&self) -> Done {
        let (stand, expected) = (Stand::of(self.replay.as_ref()), &self.linear.stands[self.position]);
        ensure(stand == *expected, || {
            format!("before event {}: {stand:#?}\nnot: {expected:#?}", self.position)
        })
    }

    /// Every event that ever ran is reported as it should be, and no other.
    fn compare_reports(&self, from: usize) -> Done {
        let known = (0..=self.len()).filter(|event| self.replay.event(*event).is_some()).count();
        ensure(known == self.ran, || format!("{known} events have a report, where {} ran", self.ran))?;
        for event in from..=self.ran {
            let report = self.replay.event(event).map(EventReport::without_times);
            let expected = self.linear.reports.get(event).filter(|_| event < self.ran);
            ensure(report.as_ref() == expected, || {
                format!("event {event}: {report:#?}\nnot: {expected:#?}")
            })?;
        }
        let end = self.linear.stands.last().map(|stand| &stand.state);
        let expected = end.filter(|_| !self.live && self.ran == self.len());
        ensure(self.replay.end() == expected, || format!("the end is {:#?}", self.replay.end()))
    }
}

fn ensure(holds: bool, otherwise: impl FnOnce() -> String) -> Done {
    if holds { Ok(()) } else { Err(otherwise()) }
}

fn script(text: &&str) -> Input {
    Input::Script((*text).into())
}

/// The event, with a name of its own if it is a checkpoint.
fn with_name(input: &Input, named: &mut usize) -> Input {
    match input {
        Input::Checkpoint(_) => {
            *named += 1;
            Input::Checkpoint(format!("c-{named}"))
        }
        other => other.clone(),
    }
}
