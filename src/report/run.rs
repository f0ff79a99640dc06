//! The report of a whole run (schema 1 of `lancet replay --json`).
//!
//! Fields may be added, never renamed. Times (`us`) are the only fields that differ from run to run.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Check, EventReport, Outcome, SCHEMA};

/// A broken invariant, with where it broke.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Finding {
    /// The event; none at the end of the run.
    pub event: Option<usize>,
    /// The stage, or `state` for an invariant of the whole state.
    pub stage: String,
    /// The invariant, with what is wrong and the elements at fault.
    pub check: Check,
}

impl Finding {
    /// What tells one kind of failure from another: stage and invariant, such as `MC/manifold`.
    pub fn name(&self) -> String {
        format!("{}/{}", self.stage, self.check.name)
    }
}

/// The whole state at one moment.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct StateReport {
    /// Digest of all of it.
    pub digest: String,
    /// The same for each buffer.
    pub buffers: BTreeMap<String, String>,
    /// Counts, such as `faces` and `euler`.
    pub counts: BTreeMap<String, i64>,
    /// Its invariants.
    pub checks: Vec<Check>,
}

/// The sums of a run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Totals {
    /// Events that took a cut through the stages, applied or not.
    pub cuts: usize,
    /// Events that were applied.
    pub applied: usize,
    /// Events that were rejected.
    pub rejected: usize,
    /// Broken invariants.
    pub findings: usize,
    /// Digest of every event's outcome, reason and stages, and of the state at the end.
    pub digest: String,
}

/// What a run of a recording has to say.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct RunReport {
    /// Version of this layout.
    pub schema: u32,
    /// The recording's name.
    pub recording: String,
    /// The engine's name.
    pub engine: String,
    /// Counts of the state before the first event, such as `faces` and `nodes`.
    pub scene: BTreeMap<String, i64>,
    /// The events, in order, as far as the run has gone.
    pub events: Vec<EventReport>,
    /// The state after the last event; none when the run stopped before.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub end: Option<StateReport>,
    /// Sums.
    pub totals: Totals,
}

impl RunReport {
    /// Puts a report together and sums it up, all but the digest.
    pub fn new(
        recording: &str,
        engine: &str,
        scene: BTreeMap<String, i64>,
        events: Vec<EventReport>,
        end: Option<StateReport>,
    ) -> Self {
        let mut report = Self {
            schema: SCHEMA,
            recording: recording.into(),
            engine: engine.into(),
            scene,
            events,
            end,
            totals: Totals::default(),
        };
        report.totals = report.sums();
        report
    }

    fn sums(&self) -> Totals {
        let outcomes = |outcome| self.events.iter().filter(|e| e.outcome == outcome).count();
        Totals {
            cuts: self.events.iter().filter(|e| e.cut).count(),
            applied: outcomes(Outcome::Applied),
            rejected: outcomes(Outcome::Rejected),
            findings: self.findings().count(),
            digest: String::new(),
        }
    }

    /// Every broken invariant, in the order of the run.
    pub fn findings(&self) -> impl Iterator<Item = Finding> + '_ {
        let at_events = self.events.iter().flat_map(|event| {
            event.findings().map(|(stage, check)| Finding {
                event: Some(event.index),
                stage: stage.into(),
                check: check.clone(),
            })
        });
        let at_end = self.end.iter().flat_map(|end| &end.checks).filter(|c| !c.ok);
        at_events.chain(at_end.map(|check| Finding {
            event: None,
            stage: "state".into(),
            check: check.clone(),
        }))
    }

    /// How many invariants were looked at.
    pub fn checks(&self) -> usize {
        let stages = |event: &EventReport| event.stages.iter().map(|s| s.checks.len()).sum::<usize>();
        let events: usize = self.events.iter().map(|e| stages(e) + e.checks.len()).sum();
        events + self.end.as_ref().map_or(0, |end| end.checks.len())
    }

    /// The first of several runs of one recording, each stage with the median of its times.
    pub fn with_median_times(runs: &[Self]) -> Option<Self> {
        let mut report = runs.first()?.clone();
        for (e, event) in report.events.iter_mut().enumerate() {
            for (s, stage) in event.stages.iter_mut().enumerate() {
                let times = runs.iter().filter_map(|run| Some(run.events.get(e)?.stages.get(s)?.us));
                stage.us = median(times.collect());
            }
        }
        Some(report)
    }

    /// The same with every time at zero: two runs of one recording are compared so.
    #[must_use]
    pub fn without_times(&self) -> Self {
        Self { events: self.events.iter().map(EventReport::without_times).collect(), ..self.clone() }
    }
}

/// The middle value, the lower of two; 0 of none.
fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len().saturating_sub(1) / 2).copied().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::StageReport;

    fn sample() -> RunReport {
        let mut event = EventReport::new(0, "cut");
        event.outcome = Outcome::Applied;
        event.cut = true;
        let checks = vec![Check::pass("joined"), Check::fail("manifold", "a hole").culprits(["n12"])];
        event.stages.push(StageReport { us: 3.5, skipped: None, checks, ..StageReport::skipped("MC", "") });
        let end = StateReport { checks: vec![Check::pass("closed")], ..StateReport::default() };
        RunReport::new("a.lancet", "wound", [("faces".into(), 4)].into(), vec![event], Some(end))
    }

    #[test]
    fn sums_and_findings_come_from_the_events_and_the_end() {
        let run = sample();
        assert_eq!((run.totals.cuts, run.totals.applied, run.totals.findings), (1, 1, 1));
        assert_eq!(run.checks(), 3);
        let names: Vec<String> = run.findings().map(|f| f.name()).collect();
        assert_eq!(names, ["MC/manifold"]);
    }

    #[test]
    fn json_goes_both_ways_under_the_contracts_names() {
        let run = sample();
        let json = serde_json::to_value(&run).expect("a report is JSON");
        assert_eq!(json["schema"], 1);
        assert_eq!(json["scene"]["faces"], 4);
        assert_eq!(json["events"][0]["stages"][0]["us"], 3.5);
        assert_eq!(json["totals"]["findings"], 1);
        assert_eq!(serde_json::from_value::<RunReport>(json).expect("and back"), run);
    }

    #[test]
    fn several_runs_have_median_times() {
        let runs = [9.0, 1.0, 4.0].map(|us| {
            let mut run = sample();
            run.events[0].stages[0].us = us;
            run
        });
        let median = RunReport::with_median_times(&runs).expect("there are runs");
        assert_eq!(median.events[0].stages[0].us, 4.0);
        assert_eq!(median.without_times(), runs[0].without_times());
        assert_eq!(RunReport::with_median_times(&[]), None);
    }

    #[test]
    fn times_are_left_out_of_comparisons() {
        let (a, mut b) = (sample(), sample());
        b.events[0].stages[0].us = 99.0;
        assert_ne!(a, b);
        assert_eq!(a.without_times(), b.without_times());
    }
}
