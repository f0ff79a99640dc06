//! Keeps a change from making a setting both slower and less accurate than it was.
//!
//! Stored are, for each setting, its error and what it took in yardsticks (`turns`), so that seconds of different machines are not
//! compared. A setting that got slower **and** less accurate is a finding; one that pays for the one with the other is a choice, and passes. So is one
//! that is no longer there: a stored curve is held against what is measured, and of a subject that is measured every stored setting has to be.
//!
//! **Tolerances.** Errors are numbers of one arithmetic, the same on every run: [`ERROR`] allows for another rounding. Times are not: the medians of one
//! machine under load scatter by a half, and two machines differ in what they are good at: [`TIME`].

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{AccuracyReport, Row};

/// Version of the file.
const VERSION: u32 = 1;
/// A setting is slower when it takes more than so many times what it took.
pub const TIME: f64 = 1.6;
/// A setting is less accurate when its error is more than so many times what it was.
pub const ERROR: f64 = 1.02;
/// Errors below this share of the curve's largest are rounding.
const LEAST: f64 = 1e-9;

/// A setting as it was.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StoredRow {
    /// Its series.
    pub series: String,
    /// The setting.
    pub setting: String,
    /// Yardsticks that it took: the lower quartile, since what disturbs makes it longer.
    pub effort: f64,
    /// Its error; none where it failed.
    pub error: Option<f64>,
}

/// A curve as it was.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StoredCurve {
    /// Its name.
    pub name: String,
    /// Its settings.
    pub rows: Vec<StoredRow>,
}

/// Curves as they were.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Stored {
    /// Version of this layout.
    pub version: u32,
    /// Why they may be as they are.
    pub reason: String,
    /// Whether they are those of a quick run, which has settings of its own.
    pub quick: bool,
    /// The curves.
    pub curves: Vec<StoredCurve>,
}

impl Stored {
    /// What a run came to.
    pub fn of(report: &AccuracyReport, reason: &str) -> Self {
        let row = |row: &Row| StoredRow {
            series: row.series.clone(),
            setting: row.setting.clone(),
            effort: row.effort.low,
            error: row.error,
        };
        let curves = report.curves.iter();
        let curves = curves
            .map(|c| StoredCurve { name: c.name.clone(), rows: c.rows.iter().map(row).collect() })
            .collect();
        Self { version: VERSION, reason: reason.into(), quick: report.quick, curves }
    }

    /// Reads a file of curves.
    pub fn parse(text: &[u8]) -> Result<Self, String> {
        let stored: Self = serde_json::from_slice(text).map_err(|error| error.to_string())?;
        match stored.version {
            VERSION => Ok(stored),
            other => Err(format!("its version is {other}, not {VERSION}")),
        }
    }

    /// Its text.
    pub fn text(&self) -> Vec<u8> {
        // Names and numbers always have a form.
        let mut text = serde_json::to_vec_pretty(self).unwrap_or_default();
        text.push(b'\n');
        text
    }

    /// The settings that got worse in both, or are missing: a line each.
    pub fn compare(&self, report: &AccuracyReport) -> Vec<String> {
        if self.quick != report.quick {
            let kind = |quick: bool| if quick { "a quick run" } else { "a full run" };
            return vec![format!("stored is {}, and measured {}", kind(self.quick), kind(report.quick))];
        }
        let mut faults = Vec::new();
        for stored in &self.curves {
            let Some(curve) = report.curves.iter().find(|curve| curve.name == stored.name) else { continue };
            let largest = stored.rows.iter().filter_map(|row| row.error).fold(0.0, f64::max);
            for was in &stored.rows {
                let same = |row: &&Row| row.series == was.series && row.setting == was.setting;
                let fault = match curve.rows.iter().find(same) {
                    Some(now) => was.worse(now, LEAST * largest),
                    None => Some("is no longer measured".into()),
                };
                faults
                    .extend(fault.map(|f| format!("{}, {}, {}: {f}", stored.name, was.series, was.setting)));
            }
        }
        if faults.is_empty() && !self.meets(report) {
            faults.push("none of the stored settings was measured".into());
        }
        faults
    }

    /// Whether there was anything to compare.
    fn meets(&self, report: &AccuracyReport) -> bool {
        let measured = |stored: &StoredCurve, was: &StoredRow| {
            let curve = report.curves.iter().find(|curve| curve.name == stored.name);
            curve.is_some_and(|c| c.rows.iter().any(|r| r.series == was.series && r.setting == was.setting))
        };
        self.curves.iter().any(|stored| stored.rows.iter().any(|was| measured(stored, was)))
    }
}

impl StoredRow {
    /// What is wrong with a setting as it is now, where errors up to `least` are none.
    fn worse(&self, now: &Row, least: f64) -> Option<String> {
        let (was_error, error) = (or_never(self.error), or_never(now.error));
        let (slower, wider) = (now.effort.low / self.effort, error / was_error);
        let is_slower = slower > TIME;
        let is_wider = error > was_error * ERROR + least;
        (is_slower && is_wider).then(|| {
            format!(
                "slower ({slower:.2} times) and less accurate ({error:.4e}, {wider:.3} times) than it was"
            )
        })
    }
}

fn or_never(error: Option<f64>) -> f64 {
    error.unwrap_or(f64::INFINITY)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::Figure;
    use crate::measure::accuracy::turns::Timing;
    use crate::measure::accuracy::{Curve, Measure, Planted};

    fn report() -> AccuracyReport {
        let row = |setting: &str, effort: f64, error| {
            let figure = Figure::of([effort]);
            Row::new("s", setting, Timing { us: figure, effort: figure }, error, Vec::new())
        };
        let curve = Curve {
            name: "a".into(),
            title: String::new(),
            time_of: String::new(),
            error: Measure::new("d", "mm"),
            others: Vec::new(),
            rows: vec![row("coarse", 1.0, Some(8.0)), row("fine", 4.0, Some(1.0)), row("none", 1.0, None)],
            planted: Planted { what: String::new(), value: 1.0, measured: 1.0 },
        };
        AccuracyReport { quick: false, rounds: 1, curves: vec![curve] }
    }

    #[test]
    fn what_was_stored_comes_back_and_is_no_worse_than_itself() {
        let stored = Stored::of(&report(), "first");
        assert_eq!(Stored::parse(&stored.text()), Ok(stored.clone()));
        assert!(stored.compare(&report()).is_empty());
        assert!(Stored::parse(b"{}").is_err());
        let quick = Stored { quick: true, ..stored.clone() };
        assert_eq!(quick.compare(&report()).len(), 1, "other settings");
        let newer = Stored { version: 9, ..stored };
        assert!(Stored::parse(&newer.text()).is_err());
    }

    #[test]
    fn a_doctored_curve_fails_and_a_trade_passes() {
        let compare = |change: &dyn Fn(&mut StoredRow)| {
            let mut stored = Stored::of(&report(), "first");
            change(&mut stored.curves[0].rows[1]);
            stored.compare(&report())
        };
        let worse = compare(&|row| (row.effort, row.error) = (2.0, Some(0.5)));
        assert_eq!(worse.len(), 1);
        assert!(worse[0].starts_with("a, s, fine: slower (2.00 times)"), "{worse:?}");
        assert!(compare(&|row| row.effort = 2.0).is_empty(), "only slower");
        assert!(compare(&|row| row.error = Some(0.5)).is_empty(), "only less accurate");
        assert!(compare(&|row| (row.effort, row.error) = (3.9, Some(0.999))).is_empty(), "noise");
        assert_eq!(compare(&|row| row.setting = "gone".into()).len(), 1);
    }

    #[test]
    fn a_setting_that_fails_now_is_less_accurate_and_nothing_to_compare_is_a_finding() {
        let mut stored = Stored::of(&report(), "first");
        (stored.curves[0].rows[2].effort, stored.curves[0].rows[2].error) = (0.1, Some(9.0));
        assert_eq!(stored.compare(&report()).len(), 1);
        stored.curves[0].name = "b".into();
        assert_eq!(stored.compare(&report()), ["none of the stored settings was measured"]);
    }
}
