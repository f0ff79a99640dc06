//! Columns: as wide as what is in them, numbers to the right, and narrower where there is no room.
//!
//! Heads that are wider than what stands below them give way first, then the widest columns, down to a few cells; when every one is down there, the last
//! ones go.

use crate::report::printable;
use crate::tui::text;

/// Blanks between columns.
const GAP: usize = 2;
/// A column that is cut keeps this much.
const LEAST: usize = 5;

/// See the module.
pub(super) struct Grid {
    heads: Vec<String>,
    rows: Vec<Vec<String>>,
    /// Of each column, cells that it needs, and of these what it needs below its head.
    widths: Vec<[usize; 2]>,
    numeric: Vec<bool>,
}

impl Grid {
    /// The columns of these rows, under these heads.
    pub(super) fn new(heads: &[String], rows: impl IntoIterator<Item = Vec<String>>) -> Self {
        let heads: Vec<String> = heads.iter().map(printable).collect();
        let rows: Vec<Vec<String>> = rows.into_iter().collect();
        let column = |i: usize| rows.iter().filter_map(move |row| row.get(i)).map(String::as_str);
        let count = rows.iter().map(Vec::len).max().unwrap_or(0).max(heads.len());
        let wide = |i: usize| {
            let head = heads.get(i).map_or(0, |head| text::width(head));
            let below = column(i).map(text::width).max().unwrap_or(0);
            [below.max(head), below]
        };
        let widths = (0..count).map(wide).collect();
        let numeric =
            (0..count).map(|i| column(i).any(|cell| !cell.is_empty()) && column(i).all(is_number)).collect();
        Self { heads, rows, widths, numeric }
    }

    /// The heads in so many cells.
    pub(super) fn head(&self, room: usize) -> String {
        self.lay(&self.heads, room)
    }

    /// A row in so many cells.
    pub(super) fn line(&self, row: usize, room: usize) -> String {
        self.rows.get(row).map_or(String::new(), |row| self.lay(row, room))
    }

    fn lay(&self, cells: &[String], room: usize) -> String {
        let widths = fit(&self.widths, room);
        let mut line = String::new();
        for (i, width) in widths.into_iter().enumerate() {
            let cell = cells.get(i).map_or("", String::as_str);
            let gap = if i == 0 { "" } else { &" ".repeat(GAP) };
            line += gap;
            line += &if self.numeric[i] { text::pad_start(cell, width) } else { text::pad(cell, width) };
        }
        line
    }
}

fn sum(widths: &[usize]) -> usize {
    widths.iter().sum::<usize>() + GAP * widths.len().saturating_sub(1)
}

/// The widths that columns get of some cells. Those that get none are not among them.
fn fit(needs: &[[usize; 2]], room: usize) -> Vec<usize> {
    let mut widths: Vec<usize> = needs.iter().map(|[width, _]| *width).collect();
    while sum(&widths) > room {
        let spare = |i: &usize| widths[*i].saturating_sub(needs[*i][1].max(LEAST));
        let Some(most) = (0..widths.len()).max_by_key(spare).filter(|i| spare(i) > 0) else { break };
        widths[most] -= 1;
    }
    while sum(&widths) > room {
        let over = sum(&widths) - room;
        let widest = widths.iter().copied().max().unwrap_or(0);
        if widest > LEAST {
            let next = widths.iter().copied().filter(|width| *width < widest).max().unwrap_or(0).max(LEAST);
            let alike = widths.iter_mut().filter(|width| **width == widest).collect::<Vec<_>>();
            // All the widest give way alike, down to the next, or as far as is needed.
            let by = (widest - next).min(over.div_ceil(alike.len()));
            alike.into_iter().for_each(|width| *width -= by);
        } else if widths.len() > 1 {
            widths.pop();
        } else {
            return vec![room];
        }
    }
    widths
}

/// Whether a cell reads as a number, a change, or nothing.
fn is_number(cell: &str) -> bool {
    let digits = cell.trim_start_matches(['+', '−', '-']);
    matches!(cell, "" | "·" | "…") || digits.replace(',', "").parse::<f64>().is_ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid() -> Grid {
        let row = |cells: [&str; 3]| cells.map(String::from).to_vec();
        Grid::new(
            &row(["kind", "faces", "length"]),
            [row(["FE", "f1", "0.5"]), row(["EE", "f23456789", "12"])],
        )
    }

    #[test]
    fn columns_stand_under_their_heads_and_numbers_to_the_right() {
        let grid = grid();
        assert_eq!(grid.head(40), "kind  faces      length");
        assert_eq!(grid.line(0, 40), "FE    f1            0.5");
        assert_eq!(grid.line(1, 40), "EE    f23456789      12");
        assert_eq!(grid.line(7, 40), "");
    }

    #[test]
    fn the_widest_gives_way_first_and_then_the_last() {
        assert_eq!(grid().line(1, 20), "EE    f23456…     12");
        let fit =
            |widths: &[usize], room| fit(&widths.iter().map(|width| [*width; 2]).collect::<Vec<_>>(), room);
        assert_eq!(fit(&[4, 9, 6], 19), [4, 5, 5]);
        assert_eq!(fit(&[9, 9, 6], 18), [5, 5]);
        assert_eq!(fit(&[9, 9], 7), [5]);
        assert_eq!(fit(&[9], 2), [2]);
        assert_eq!(fit(&[], 2), [0usize; 0]);
    }

    #[test]
    fn heads_give_way_before_what_stands_below_them() {
        assert_eq!(fit(&[[13, 2], [9, 9], [8, 8]], 34), [13, 9, 8]);
        assert_eq!(fit(&[[13, 2], [9, 9], [8, 8]], 26), [5, 9, 8]);
        assert_eq!(fit(&[[13, 2], [9, 9], [8, 8]], 25), [5, 8, 8]);
    }

    #[test]
    fn a_line_is_never_wider_than_there_is_room() {
        for room in 0..40 {
            for line in [grid().head(room), grid().line(0, room), grid().line(1, room)] {
                assert!(text::width(&line) <= room, "{line:?} in {room}");
            }
        }
    }
}
