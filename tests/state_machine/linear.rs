//! What a fresh replay of a list of events reports and is, event by event, from the first to the last.
//!
//! Whether the engine keeps its invariants on these events is for others to find out: what breaks here has to break there, and nothing else.

use lancet::canvas::frame::Orbit;
use lancet::recording::AnyRecording;
use lancet::replay::{Case, Options, Replay};
use lancet::report::{EventReport, Finding, StateReport};

/// See the module.
pub(crate) struct Linear {
    /// Of every event, without its times.
    pub(crate) reports: Vec<EventReport>,
    /// Before every event, and after the last.
    pub(crate) stands: Vec<Stand>,
    /// The first broken invariant.
    pub(crate) finding: Option<Finding>,
}

/// All that can be seen of a session without looking back.
#[derive(Debug, PartialEq)]
pub(crate) struct Stand {
    pub(crate) state: StateReport,
    pub(crate) sizes: Vec<(&'static str, u64)>,
    pub(crate) orbit: Option<Orbit>,
    pub(crate) mode: &'static str,
}

impl Linear {
    /// An error says why it cannot be replayed.
    pub(crate) fn of(case: &Case, recording: &AnyRecording, options: &Options) -> Result<Self, String> {
        let mut linear = Self { reports: Vec::new(), stands: Vec::new(), finding: None };
        linear.grow(case, recording, options)?;
        Ok(linear)
    }

    /// Replays a list that goes on as the one before ended, from its first event on. What is known is not looked at again; it has to be reported again.
    pub(crate) fn grow(
        &mut self,
        case: &Case,
        recording: &AnyRecording,
        options: &Options,
    ) -> Result<(), String> {
        // It keeps all it can, and is never sent back.
        let options = Options { budget_bytes: usize::MAX, ..options.clone() };
        let mut replay = case.replay(recording, options, None).map_err(|error| error.to_string())?;
        loop {
            let at = replay.position();
            if at == self.stands.len() {
                self.stands.push(Stand::of(replay.as_ref()));
            }
            let Some(report) = replay.step().map(EventReport::without_times) else { break };
            match self.reports.get(at) {
                None => self.reports.push(report),
                Some(old) if *old == report => {}
                Some(old) => return Err(format!("event {at} is reported as {old:#?}\nand as {report:#?}")),
            }
        }
        self.finding = replay.finding().cloned();
        Ok(())
    }

    /// Only the first few events are left.
    pub(crate) fn truncate(&mut self, events: usize) {
        self.reports.truncate(events);
        self.stands.truncate(events + 1);
        self.finding.take_if(|finding| finding.event.is_none_or(|event| event >= events));
    }
}

impl Stand {
    pub(crate) fn of(replay: &dyn Replay) -> Self {
        let (state, sizes) = (replay.state(), replay.sizes());
        Self { state, sizes, orbit: replay.orbit(), mode: replay.mode() }
    }
}
