//! What a fresh replay of a list of events reports and is, event by event, from the first to the last.

use lancet::canvas::frame::Orbit;
use lancet::recording::AnyRecording;
use lancet::replay::{Case, Options, Replay};
use lancet::report::{EventReport, StateReport};

/// See the module.
pub(crate) struct Linear {
    /// Of every event, without its times.
    pub(crate) reports: Vec<EventReport>,
    /// Before every event, and after the last.
    pub(crate) stands: Vec<Stand>,
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
    /// An error says which invariant breaks.
    pub(crate) fn of(case: &Case, recording: &AnyRecording, options: Options) -> Result<Self, String> {
        let mut replay = case.replay(recording, options, None).map_err(|error| error.to_string())?;
        let mut stands = vec![Stand::of(replay.as_ref())];
        let mut reports = Vec::new();
        while let Some(report) = replay.step() {
            reports.push(report.without_times());
            stands.push(Stand::of(replay.as_ref()));
        }
        match replay.finding() {
            Some(finding) => Err(format!("linear replay breaks {}: {finding:?}", finding.name())),
            None => Ok(Self { reports, stands }),
        }
    }
}

impl Stand {
    pub(crate) fn of(replay: &dyn Replay) -> Self {
        let (state, sizes) = (replay.state(), replay.sizes());
        Self { state, sizes, orbit: replay.orbit(), mode: replay.mode() }
    }
}
