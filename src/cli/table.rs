//! Tables for people: columns as wide as they must be, figures to the right.

use std::io::{self, Write};

use anstyle::Style;

use super::console::Channel;
use crate::report::printable;

/// Which side a column's cells stand on.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Side {
    Left,
    Right,
}

/// A table that is being filled. The last cell of a row is not padded.
pub(super) struct TextTable {
    sides: Vec<Side>,
    rows: Vec<Vec<Cell>>,
}

/// A cell: its text, and its style where there is colour.
pub(super) struct Cell {
    text: String,
    style: Style,
}

impl<T: ToString> From<T> for Cell {
    fn from(text: T) -> Self {
        Self::styled(text, Style::new())
    }
}

impl Cell {
    /// A cell in a style.
    pub(super) fn styled(text: impl ToString, style: Style) -> Self {
        // A cell is one line.
        Self { text: printable(text).replace('\n', "\\n"), style }
    }

    fn width(&self) -> usize {
        self.text.chars().count()
    }
}

impl TextTable {
    /// Heads of the columns; one that begins with `>` is a column of figures.
    pub(super) fn new(heads: &[&str]) -> Self {
        let side = |head: &&str| if head.starts_with('>') { Side::Right } else { Side::Left };
        let bold = |head: &&str| Cell::styled(head.trim_start_matches('>'), Style::new().bold());
        Self { sides: heads.iter().map(side).collect(), rows: vec![heads.iter().map(bold).collect()] }
    }

    /// Names and values, without heads.
    pub(super) fn pairs() -> Self {
        Self { sides: vec![Side::Left, Side::Left], rows: Vec::new() }
    }

    /// Adds a row.
    pub(super) fn row(&mut self, cells: impl IntoIterator<Item = impl Into<Cell>>) {
        self.rows.push(cells.into_iter().map(Into::into).collect());
    }

    /// Adds a name and its value.
    pub(super) fn pair(&mut self, name: &str, value: impl ToString) {
        self.rows.push(vec![Cell::styled(name, Style::new().dimmed()), value.into()]);
    }

    /// Writes it.
    pub(super) fn write(&self, to: &mut Channel<'_>) -> io::Result<()> {
        let width = |column| self.rows.iter().filter_map(|row| row.get(column)).map(Cell::width).max();
        let widths: Vec<usize> = (0..self.sides.len()).map(|column| width(column).unwrap_or(0)).collect();
        self.rows.iter().try_for_each(|row| self.write_row(row, &widths, to))
    }

    fn write_row(&self, row: &[Cell], widths: &[usize], to: &mut Channel<'_>) -> io::Result<()> {
        let Some(last) = row.iter().rposition(|cell| !cell.text.is_empty()) else { return writeln!(to) };
        for (column, ((cell, side), width)) in
            row.iter().zip(&self.sides).zip(widths).enumerate().take(last + 1)
        {
            let pad = " ".repeat(width - cell.width());
            let text = to.paint(cell.style, &cell.text);
            match side {
                Side::Right => write!(to, "{pad}{text}")?,
                Side::Left if column == last => write!(to, "{text}")?,
                Side::Left => write!(to, "{text}{pad}")?,
            }
            to.write_all(if column == last { b"\n" } else { b"  " })?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::Console;

    #[test]
    fn columns_line_up() {
        let mut table = TextTable::new(&["name", ">cuts", "note"]);
        table.row(["a", "1", ""]);
        table.row(["größer", "12345", "x"]);
        let (mut out, mut err) = (Vec::new(), Vec::new());
        table.write(&mut Console::plain(&mut out, &mut err).out).unwrap();
        let expected = "name     cuts  note\na           1\ngrößer  12345  x\n";
        assert_eq!(String::from_utf8(out).unwrap(), expected);
    }
}
