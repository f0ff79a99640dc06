//! A curve: settings with their times and errors, which of them are worth having, and what was planted to trust the errors.

use schemars::JsonSchema;
use serde::Serialize;

use super::turns::Timing;
use crate::measure::Figure;
use crate::measure::figure::table;
use crate::measure::plot::{Mark, Plot, Series};
use crate::report::Table;

/// A distance, or whatever else stands against time, and its unit.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Measure {
    /// What it is.
    pub what: String,
    /// Its unit; empty for a pure number.
    pub unit: String,
}

impl Measure {
    /// By its name and unit.
    pub fn new(what: &str, unit: &str) -> Self {
        Self { what: what.into(), unit: unit.into() }
    }

    fn head(&self) -> String {
        if self.unit.is_empty() { self.what.clone() } else { format!("{}, {}", self.what, self.unit) }
    }
}

/// A setting, and what it comes to.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Row {
    /// Rows of one series do the same task, so that one can be better than another.
    pub series: String,
    /// The setting.
    pub setting: String,
    /// Microseconds.
    pub us: Figure,
    /// The same in yardsticks.
    pub effort: Figure,
    /// The error; none where the setting fails altogether.
    pub error: Option<f64>,
    /// The curve's other distances.
    pub others: Vec<f64>,
    /// Whether no row of the series is as fast and nearer, or as near and faster.
    pub front: bool,
}

/// A known error, put into what is otherwise exact.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Planted {
    /// What was planted.
    pub what: String,
    /// How large it is, in the curve's own distance and unit.
    pub value: f64,
    /// What was measured of it.
    pub measured: f64,
}

/// How far what is measured may be from what was planted, as a share: planted results are sampled as finely as real ones.
const PLANTED_WITHIN: f64 = 0.02;

impl Planted {
    /// Whether it was measured as what it is.
    pub fn is_measured(&self) -> bool {
        // A NaN is not within anything.
        (self.measured - self.value).abs() <= PLANTED_WITHIN * self.value.abs()
    }
}

/// Time against error.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Curve {
    /// Its name: the subject's, and what is measured of it.
    pub name: String,
    /// What it shows.
    pub title: String,
    /// What the time is of.
    pub time_of: String,
    /// What the error is.
    pub error: Measure,
    /// Other distances of the same results.
    pub others: Vec<Measure>,
    /// The settings.
    pub rows: Vec<Row>,
    /// What was planted.
    pub planted: Planted,
}

impl Row {
    /// A row; the curve says whether it is on the front.
    pub(super) fn new(
        series: &str,
        setting: impl Into<String>,
        timing: Timing,
        error: Option<f64>,
        others: Vec<f64>,
    ) -> Self {
        let (us, effort) = (timing.us, timing.effort);
        Self { series: series.into(), setting: setting.into(), us, effort, error, others, front: false }
    }

    /// Whether this is at least as good in both, and better in one.
    fn beats(&self, other: &Self) -> bool {
        let (ours, theirs) = (self.price(), other.price());
        ours.iter().zip(theirs).all(|(a, b)| *a <= b) && ours.iter().zip(theirs).any(|(a, b)| *a < b)
    }

    fn price(&self) -> [f64; 2] {
        [self.us.median, self.finite_error().unwrap_or(f64::INFINITY)]
    }

    /// The error where it is a number: one that is none stands on no front and in no picture, and cannot be compared.
    pub(super) fn finite_error(&self) -> Option<f64> {
        self.error.filter(|error| error.is_finite())
    }
}

impl Curve {
    /// The same, with its front marked.
    #[must_use]
    pub(super) fn with_front(mut self) -> Self {
        let rows = &self.rows;
        let beaten = |row: &Row| rows.iter().any(|other| other.series == row.series && other.beats(row));
        let front: Vec<bool> = rows.iter().map(|row| row.finite_error().is_some() && !beaten(row)).collect();
        self.rows.iter_mut().zip(front).for_each(|(row, front)| row.front = front);
        self
    }

    /// Whether what was planted was measured.
    pub fn is_trusted(&self) -> bool {
        self.planted.is_measured()
    }

    /// Why it is not to be trusted: a line for what was planted and not measured, and for each error that is no number.
    pub(super) fn doubts(&self) -> Vec<String> {
        let Planted { what, value, measured } = &self.planted;
        let planted = (!self.is_trusted())
            .then(|| format!("{}: planted was {value} ({what}), and measured {measured}", self.name));
        let odd = self.rows.iter().filter(|row| row.error.is_some() && row.finite_error().is_none());
        let odd =
            odd.map(|row| format!("{}, {}, {}: its error is no number", self.name, row.series, row.setting));
        planted.into_iter().chain(odd).collect()
    }

    /// The series, in their order.
    pub fn series(&self) -> Vec<&str> {
        let mut names: Vec<&str> = Vec::new();
        for row in &self.rows {
            if !names.contains(&row.series.as_str()) {
                names.push(&row.series);
            }
        }
        names
    }

    /// The curve for people.
    pub(super) fn table(&self, rounds: usize) -> Table {
        let heads =
            ["setting".into(), format!("{}, µs", self.time_of), "quartiles".into(), self.error.head()];
        let heads = heads.into_iter().chain(self.others.iter().map(Measure::head)).chain(["front".into()]);
        let heads: Vec<String> = heads.collect();
        let planted = &self.planted;
        let mut last = vec![format!("planted: {}", planted.what), String::new(), String::new()];
        last.push(format!("{} → {}", text(planted.value), text(planted.measured)));
        last.resize(heads.len(), String::new());
        let rows = self.rows.iter().map(|row| self.cells(row)).chain([last]);
        let title =
            format!("{}: {}; median and quartiles of {rounds} rounds taken in turns", self.name, self.title);
        table(&title, &heads.iter().map(String::as_str).collect::<Vec<_>>(), rows)
    }

    fn cells(&self, row: &Row) -> Vec<String> {
        let Figure { median, low, high } = row.us;
        let mut cells = vec![format!("{}: {}", row.series, row.setting)];
        cells.push(text(median));
        cells.push(format!("{} … {}", text(low), text(high)));
        cells.push(row.error.map_or("never".into(), text));
        cells.extend(row.others.iter().map(|v| text(*v)));
        cells.resize(4 + self.others.len(), String::new());
        cells.push(if row.front { "front".into() } else { String::new() });
        cells
    }

    /// The curve as a picture.
    pub fn plot(&self) -> Plot {
        let mark = |row: &Row| {
            let y = row.finite_error()?;
            Some(Mark { x: row.us.median, y, label: row.setting.clone(), front: row.front })
        };
        let series = |name: &str| Series {
            name: name.into(),
            marks: self.rows.iter().filter(|row| row.series == name).filter_map(mark).collect(),
        };
        Plot {
            title: self.title.clone(),
            across: format!("time of {}", self.time_of),
            up: self.error.head(),
            series: self.series().into_iter().map(series).collect(),
        }
    }
}

/// Four digits, whatever the size.
pub(super) fn text(value: f64) -> String {
    match value.abs() {
        0.0 => "0".into(),
        size if !(1e-3..1e6).contains(&size) => format!("{value:.3e}"),
        size => {
            let decimals = (3 - libm::floor(libm::log10(size)) as i32).clamp(0, 6) as usize;
            format!("{value:.decimals$}")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(series: &str, us: f64, error: Option<f64>) -> Row {
        Row::new(series, "x", Timing { us: Figure::of([us]), effort: Figure::of([us]) }, error, Vec::new())
    }

    fn curve(rows: Vec<Row>) -> Curve {
        let planted = Planted { what: "a step".into(), value: 2.0, measured: 2.01 };
        Curve {
            name: "a".into(),
            title: "b".into(),
            time_of: "c".into(),
            error: Measure::new("largest distance", "mm"),
            others: Vec::new(),
            rows,
            planted,
        }
        .with_front()
    }

    #[test]
    fn the_front_is_what_nothing_of_its_series_beats() {
        let rows = [("a", 1.0, Some(9.0)), ("a", 2.0, Some(9.0)), ("a", 3.0, Some(1.0)), ("a", 0.5, None)];
        let rows = rows.into_iter().chain([("b", 5.0, Some(50.0)), ("b", 5.0, Some(50.0))]);
        let curve = curve(rows.map(|(series, us, error)| row(series, us, error)).collect());
        let front: Vec<bool> = curve.rows.iter().map(|row| row.front).collect();
        assert_eq!(front, [true, false, true, false, true, true]);
        assert_eq!(curve.series(), ["a", "b"]);
        let table = curve.table(3);
        assert_eq!(table.rows[3].cells, ["a: x", "0.5000", "0.5000 … 0.5000", "never", ""]);
        assert!(table.rows.iter().all(|row| row.cells.len() == table.columns.len()));
        assert_eq!(curve.plot().series[0].marks.len(), 3);
    }

    #[test]
    fn an_error_that_is_no_number_is_drawn_nowhere_and_not_trusted() {
        let curve = curve([f64::NAN, f64::INFINITY, 5.0].map(|error| row("a", 1.0, Some(error))).into());
        assert_eq!(curve.rows.iter().map(|row| row.front).collect::<Vec<_>>(), [false, false, true]);
        assert_eq!(curve.plot().series[0].marks.len(), 1);
        assert_eq!(curve.doubts(), ["a, a, x: its error is no number"; 2]);
    }

    #[test]
    fn what_is_planted_has_to_be_measured() {
        let planted = |measured| Planted { what: String::new(), value: 2.0, measured }.is_measured();
        assert!(planted(2.0) && planted(1.97));
        assert!(!planted(2.1) && !planted(0.0) && !planted(f64::NAN));
    }

    #[test]
    fn numbers_have_four_digits() {
        let texts = [0.0, 12345.6, 1.5, 0.012_345, 1e-9, 3e7].map(text);
        assert_eq!(texts, ["0", "12346", "1.500", "0.01235", "1.000e-9", "3.000e7"]);
    }
}
