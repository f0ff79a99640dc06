//! Medians and quartiles, and how figures and tables are put into words.

use schemars::JsonSchema;
use serde::Serialize;

use crate::report::{Row, Table};

/// What a measurement that was repeated came to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct Figure {
    /// The value in the middle.
    pub median: f64,
    /// A quarter of the values is at most this.
    pub low: f64,
    /// A quarter of the values is at least this.
    pub high: f64,
}

impl Figure {
    /// Of some values; zero of none.
    pub fn of(values: impl IntoIterator<Item = f64>) -> Self {
        let mut values: Vec<f64> = values.into_iter().collect();
        values.sort_unstable_by(f64::total_cmp);
        let Some(last) = values.len().checked_sub(1) else { return Self::default() };
        let at = |share: f64| values[(last as f64 * share).round() as usize];
        Self { median: at(0.5), low: at(0.25), high: at(0.75) }
    }

    /// The same in another unit.
    #[must_use]
    pub fn times(self, factor: f64) -> Self {
        Self { median: self.median * factor, low: self.low * factor, high: self.high * factor }
    }

    /// Median, and half of what lies between the quartiles, with so many decimals.
    pub fn text(&self, decimals: usize) -> String {
        format!("{:.decimals$} ±{:.decimals$}", self.median, (self.high - self.low) * 0.5)
    }
}

/// A table without ids to select.
pub(super) fn table(title: &str, columns: &[&str], rows: impl IntoIterator<Item = Vec<String>>) -> Table {
    Table {
        title: title.into(),
        columns: columns.iter().map(|&column| column.into()).collect(),
        rows: rows.into_iter().map(|cells| Row { ids: Vec::new(), cells }).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_median_is_the_middle_and_the_quartiles_lie_around_it() {
        let figure = Figure::of([9.0, 1.0, 3.0, 2.0, 100.0]);
        assert_eq!(figure, Figure { median: 3.0, low: 2.0, high: 9.0 });
        assert_eq!(figure.text(1), "3.0 ±3.5");
        assert_eq!(Figure::of([7.0]).median, 7.0);
        assert_eq!(Figure::of([]), Figure::default());
    }
}
