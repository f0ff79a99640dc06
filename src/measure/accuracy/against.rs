//! Keeps a change from making a setting both slower and less accurate than it was.
//!
//! Stored are, for each setting, its error and what it took in yardsticks (`turns`), so that seconds of different machines are not
//! compared. A setting that got slower **and** less accurate is a finding; one that pays for the one with the other is a choice, and passes. One that has no
//! error any more where it had one fails, and nothing pays for that.
//!
//! **Nothing is left out.** What is stored of a subject has to be measured whenever the subject is: every curve, and every setting of it. A run of all
//! subjects has to measure all that is stored. What is measured has to be stored, so that a new curve does not go unguarded until somebody thinks of it.
//! Blessing puts the measured subjects in the place of their stored ones, and leaves the others as they are.
//!
//! **Tolerances.** Errors are numbers of one arithmetic, the same on every run. Each is held against itself: [`ERROR`] allows for another rounding, and
//! [`ROUNDED`] where rounding is all there is. Times are not: the medians of one machine under load scatter by a half, and two machines differ in what
//! they are good at: [`TIME`].

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{AccuracyReport, Curve, Row, SUBJECTS};

/// Version of the file.
const VERSION: u32 = 1;
/// A setting is slower when it takes more than so many times what it took.
pub const TIME: f64 = 1.6;
/// A setting is less accurate when its error is more than so many times what it was.
pub const ERROR: f64 = 1.02;
/// The same where the error is rounding alone: rounded in another order, it is another such number.
pub const ROUNDED: f64 = 1.5;
/// An error is rounding alone where it is less than this share of its series' largest: that of f64 is some 2e-9 of that of f32.
const ROUNDING: f64 = 1e-8;
/// Smaller than the last bit of one unit is no error: so much may stand where there was none.
const LEAST: f64 = f64::EPSILON;
/// What is said of what is measured and not stored.
const UNSTORED: &str = "is not stored yet: bless it";

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
            error: row.finite_error(),
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

    /// What is stored once a run is blessed: what it came to, in the place of all that it should have measured. Refused where curves of a quick run and
    /// of a full one would stand side by side.
    pub fn merged(self, report: &AccuracyReport, reason: &str) -> Result<Self, String> {
        let (quick, curves) = (self.quick, self.curves);
        let kept: Vec<StoredCurve> =
            curves.into_iter().filter(|curve| !is_due(report, &curve.name)).collect();
        if !kept.is_empty() {
            alike(quick, report)?;
        }
        let mut merged = Self::of(report, reason);
        merged.curves.extend(kept);
        merged.curves.sort_by_key(|curve| place(&curve.name));
        Ok(merged)
    }

    /// What got worse, is missing, or is not stored: a line each.
    pub fn compare(&self, report: &AccuracyReport) -> Vec<String> {
        if let Err(fault) = alike(self.quick, report) {
            return vec![fault];
        }
        let mut faults = Vec::new();
        for stored in self.curves.iter().filter(|stored| is_due(report, &stored.name)) {
            match report.curves.iter().find(|curve| curve.name == stored.name) {
                Some(curve) => faults.extend(stored.compare(curve)),
                None => faults.push(format!("{}: is no longer measured", stored.name)),
            }
        }
        let is_new = |curve: &&Curve| self.curves.iter().all(|stored| stored.name != curve.name);
        faults.extend(report.curves.iter().filter(is_new).map(|curve| format!("{}: {UNSTORED}", curve.name)));
        faults
    }
}

/// Whether a run and what is stored are of one kind.
fn alike(quick: bool, report: &AccuracyReport) -> Result<(), String> {
    let kind = |quick: bool| if quick { "a quick run" } else { "a full run" };
    match quick == report.quick {
        true => Ok(()),
        false => Err(format!("stored is {}, and measured {}", kind(quick), kind(report.quick))),
    }
}

/// Whether a curve is of a subject.
fn is_of(curve: &str, subject: &str) -> bool {
    curve.strip_prefix(subject).is_some_and(|rest| rest.is_empty() || rest.starts_with('-'))
}

/// Whether a run should have measured a curve: every one if it measured all subjects, else those of the subjects that it did.
fn is_due(report: &AccuracyReport, curve: &str) -> bool {
    let is_whole = SUBJECTS.iter().all(|subject| report.subjects.iter().any(|name| name == subject.name));
    is_whole
        || report.subjects.iter().any(|subject| is_of(curve, subject))
        || report.curves.iter().any(|measured| measured.name == curve)
}

/// Where a curve stands among others: by its subject, those of none last.
fn place(curve: &str) -> usize {
    SUBJECTS.iter().position(|subject| is_of(curve, subject.name)).unwrap_or(SUBJECTS.len())
}

impl StoredCurve {
    /// What is wrong with a curve as it is now: a line each.
    fn compare(&self, curve: &Curve) -> Vec<String> {
        let mut faults = Vec::new();
        let mut say = |series: &str, setting: &str, fault: &str| {
            faults.push(format!("{}, {series}, {setting}: {fault}", self.name));
        };
        for was in &self.rows {
            let fault = match curve.rows.iter().find(|now| was.is_of(now)) {
                Some(now) => was.worse(now, self.tolerance(was)),
                None => Some("is no longer measured".into()),
            };
            if let Some(fault) = fault {
                say(&was.series, &was.setting, &fault);
            }
        }
        let is_new = |now: &&Row| !self.rows.iter().any(|was| was.is_of(now));
        curve.rows.iter().filter(is_new).for_each(|now| say(&now.series, &now.setting, UNSTORED));
        faults
    }

    /// How many times what it was the error of a setting may be.
    fn tolerance(&self, was: &StoredRow) -> f64 {
        let errors = self.rows.iter().filter(|row| row.series == was.series).filter_map(|row| row.error);
        let largest = errors.fold(0.0, f64::max);
        if was.error.is_some_and(|error| error < ROUNDING * largest) { ROUNDED } else { ERROR }
    }
}

impl StoredRow {
    /// Whether it is the same setting.
    fn is_of(&self, row: &Row) -> bool {
        self.series == row.series && self.setting == row.setting
    }

    /// What is wrong with a setting as it is now, where its error may be so many times what it was.
    fn worse(&self, now: &Row, tolerance: f64) -> Option<String> {
        // What failed cannot get worse.
        let was = self.error?;
        let Some(error) = now.finite_error() else {
            return Some(format!("fails, and its error was {was:.4e}"));
        };
        let (slower, wider) = (now.effort.low / self.effort, error / was);
        let is_worse = slower > TIME && error > was * tolerance + LEAST;
        is_worse.then(|| {
            format!(
                "slower ({slower:.2} times) and less accurate ({error:.4e}, {wider:.3} times) than it was"
            )
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::Figure;
    use crate::measure::accuracy::turns::Timing;
    use crate::measure::accuracy::{Measure, Planted};

    /// One curve, whose name is its subject's.
    fn report() -> AccuracyReport {
        of_curves(&["a"], vec![curve("a")])
    }

    fn of_curves(subjects: &[&str], curves: Vec<Curve>) -> AccuracyReport {
        let subjects = subjects.iter().map(|name| (*name).to_owned()).collect();
        AccuracyReport { quick: false, rounds: 1, subjects, curves }
    }

    fn curve(name: &str) -> Curve {
        let row = |setting: &str, effort: f64, error| {
            let figure = Figure::of([effort]);
            Row::new("s", setting, Timing { us: figure, effort: figure }, error, Vec::new())
        };
        Curve {
            name: name.into(),
            title: String::new(),
            time_of: String::new(),
            error: Measure::new("d", "mm"),
            others: Vec::new(),
            rows: vec![row("coarse", 1.0, Some(8.0)), row("fine", 4.0, Some(1.0)), row("none", 1.0, None)],
            planted: Planted { what: String::new(), value: 1.0, measured: 1.0 },
        }
    }

    /// What is said of the second setting, whose error is now such and was another, if it got slower as well or if it did not.
    fn said(now: f64, was: Option<f64>, is_slower: bool) -> Vec<String> {
        let mut report = report();
        let mut stored = Stored::of(&report, "first");
        report.curves[0].rows[1].error = Some(now);
        let row = &mut stored.curves[0].rows[1];
        (row.effort, row.error) = (if is_slower { 2.0 } else { 4.0 }, was);
        stored.compare(&report)
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
        let gone = compare(&|row| row.setting = "gone".into());
        assert_eq!(gone, ["a, s, gone: is no longer measured", "a, s, fine: is not stored yet: bless it"]);
    }

    #[test]
    fn a_setting_that_fails_now_is_a_finding_however_fast_it_does() {
        let mut stored = Stored::of(&report(), "first");
        (stored.curves[0].rows[2].effort, stored.curves[0].rows[2].error) = (0.1, Some(9.0));
        assert_eq!(stored.compare(&report()), ["a, s, none: fails, and its error was 9.0000e0"]);
        stored.curves[0].rows[2].effort = 1.0;
        assert_eq!(stored.compare(&report()).len(), 1, "as fast as it was");
    }

    #[test]
    fn an_error_that_is_no_number_never_passes() {
        for now in [f64::NAN, f64::INFINITY] {
            assert_eq!(said(now, Some(1.0), false), ["a, s, fine: fails, and its error was 1.0000e0"]);
            let mut report = report();
            report.curves[0].rows[1].error = Some(now);
            let untrusted = report.untrusted();
            assert!(untrusted.len() == 1 && untrusted[0].starts_with("a, s, fine: "), "{untrusted:?}");
        }
        assert!(report().untrusted().is_empty());
    }

    #[test]
    fn an_error_is_held_against_itself_however_large_its_neighbours_are() {
        // Next to 8 of the coarse setting.
        let (now, other_rounding) = (4e-9, 1.2);
        assert_eq!(said(now, Some(now / 3.0), true).len(), 1, "three times");
        assert!(said(now, Some(now / other_rounding), true).is_empty(), "rounding alone");
        assert!(said(now, Some(now / 3.0), false).is_empty(), "only less accurate");
        assert_eq!(said(0.4, Some(0.4 / other_rounding), true).len(), 1, "no rounding");
        assert_eq!(said(now, Some(0.0), true).len(), 1, "there was none");
        assert!(said(1e-17, Some(0.0), true).is_empty(), "there is none");
    }

    #[test]
    fn a_curve_that_is_stored_is_measured_with_its_subject_and_a_new_one_is_told_of() {
        let all = of_curves(&["a", "b"], vec![curve("a"), curve("a-more"), curve("b")]);
        let stored = Stored::of(&all, "first");
        assert!(stored.compare(&all).is_empty());
        let less = of_curves(&["a"], vec![curve("a")]);
        assert_eq!(stored.compare(&less), ["a-more: is no longer measured"], "b is another subject");
        let names: Vec<&str> = SUBJECTS.iter().map(|subject| subject.name).collect();
        let whole = of_curves(&names, vec![curve("a"), curve("a-more")]);
        assert_eq!(stored.compare(&whole), ["b: is no longer measured"]);
        let more = of_curves(&["a"], vec![curve("a"), curve("a-more"), curve("a-new")]);
        assert_eq!(stored.compare(&more), ["a-new: is not stored yet: bless it"]);
        assert_eq!(stored.compare(&of_curves(&["c"], vec![curve("c")])), ["c: is not stored yet: bless it"]);
    }

    #[test]
    fn blessing_one_subject_leaves_the_others_as_they_are() {
        let both =
            of_curves(&["shadows", "patch"], vec![curve("shadows"), curve("patch"), curve("patch-old")]);
        let stored = Stored::of(&both, "first");
        let mut patch = of_curves(&["patch"], vec![curve("patch"), curve("patch-new")]);
        patch.curves[0].rows[0].error = Some(7.0);
        let merged = stored.clone().merged(&patch, "second").expect("of one kind");
        let names: Vec<&str> = merged.curves.iter().map(|curve| curve.name.as_str()).collect();
        assert_eq!(names, ["shadows", "patch", "patch-new"]);
        assert_eq!((&merged.curves[0], merged.reason.as_str()), (&stored.curves[0], "second"));
        assert_eq!(merged.curves[1].rows[0].error, Some(7.0));
        assert!(merged.compare(&patch).is_empty());
        patch.quick = true;
        assert!(stored.clone().merged(&patch, "third").is_err(), "the others are of a full run");
        patch.subjects = SUBJECTS.iter().map(|subject| subject.name.to_owned()).collect();
        let whole = stored.merged(&patch, "third").expect("nothing is left of the full run");
        assert!(whole.quick && whole.curves.len() == 2);
    }

    #[test]
    fn every_stored_curve_is_of_one_subject() {
        let text = include_bytes!("../../../benches/accuracy.json");
        let stored = Stored::parse(text).expect("curves");
        for StoredCurve { name, .. } in &stored.curves {
            assert_eq!(SUBJECTS.iter().filter(|subject| is_of(name, subject.name)).count(), 1, "{name}");
        }
    }
}
