//! How long each stage took over the run: median and spread.

use std::collections::BTreeMap;

use crate::report::EventReport;

/// The times of each stage, by its short name.
#[derive(Clone, Debug, Default)]
pub(in crate::tui) struct Timing(BTreeMap<String, Vec<f64>>);

/// Microseconds of one stage over the run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::tui) struct Spread {
    /// A quarter of the times is below.
    pub(in crate::tui) low: f64,
    /// Half of them.
    pub(in crate::tui) median: f64,
    /// Three quarters.
    pub(in crate::tui) high: f64,
    /// The longest.
    pub(in crate::tui) most: f64,
    /// How many there are.
    pub(in crate::tui) count: usize,
}

impl Timing {
    /// Takes the times of another event.
    pub(in crate::tui) fn add(&mut self, report: &EventReport) {
        for stage in report.stages.iter().filter(|stage| stage.skipped.is_none()) {
            let times = self.0.entry(stage.id.clone()).or_default();
            times.insert(times.partition_point(|us| *us <= stage.us), stage.us);
        }
    }

    /// The spread of a stage that ran.
    pub(in crate::tui) fn spread(&self, stage: &str) -> Option<Spread> {
        let times = self.0.get(stage)?;
        let at = |share: f64| times[((times.len() - 1) as f64 * share).round() as usize];
        let most = *times.last()?;
        Some(Spread { low: at(0.25), median: at(0.5), high: at(0.75), most, count: times.len() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::StageReport;

    #[test]
    fn the_spread_is_of_the_times_that_were_taken() {
        let mut timing = Timing::default();
        for us in [5.0, 1.0, 4.0, 2.0, 3.0] {
            let ran = StageReport { us, skipped: None, ..StageReport::skipped("A", "") };
            let stages = vec![ran, StageReport::skipped("B", "mode")];
            timing.add(&EventReport { stages, ..EventReport::new(0, "cut") });
        }
        let spread = Spread { low: 2.0, median: 3.0, high: 4.0, most: 5.0, count: 5 };
        assert_eq!(timing.spread("A"), Some(spread));
        assert_eq!(timing.spread("B"), None);
    }
}
