//! Where one is in a list: the selected row, and the part of the list that is in view.
//!
//! A list does not hold its rows: their count comes with each question, and may change between two of them. Nothing fails with no row or no
//! height. The view remembers where it was scrolled to, so that the selection moves within it before the list does, as people are used to
//! from editors; it keeps a few rows in view beyond the selection. Scrolled by hand, it leaves the selection behind until that moves.

use std::cell::Cell;
use std::ops::Range;

/// Rows that stay in view above and below the selection, where there is room.
const MARGIN: usize = 2;

/// A selection, and what is in view.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct List {
    selected: usize,
    /// The first row in view, as it was when last drawn.
    offset: Cell<usize>,
    /// Whether the view was scrolled by hand, and need not have the selection in it.
    free: bool,
}

impl List {
    /// A list with this row selected.
    pub fn at(selected: usize) -> Self {
        Self { selected, ..Self::default() }
    }

    /// The selected row; `None` where there are no rows.
    pub fn selected(&self, len: usize) -> Option<usize> {
        len.checked_sub(1).map(|last| self.selected.min(last))
    }

    /// Selects a row, or the last one.
    pub fn select(&mut self, row: usize, len: usize) {
        (self.selected, self.free) = (row.min(len.saturating_sub(1)), false);
    }

    /// Up by some rows, to the first at most.
    pub fn up(&mut self, by: usize, len: usize) {
        self.select(self.selected.min(len.saturating_sub(1)).saturating_sub(by), len);
    }

    /// Down by some rows, to the last at most.
    pub fn down(&mut self, by: usize, len: usize) {
        self.select(self.selected.saturating_add(by), len);
    }

    /// To the first row.
    pub fn top(&mut self) {
        (self.selected, self.free) = (0, false);
    }

    /// To the last row.
    pub fn bottom(&mut self, len: usize) {
        self.select(usize::MAX, len);
    }

    /// Keeps the selection within rows that have become fewer.
    pub fn clamp(&mut self, len: usize) {
        self.select(self.selected, len);
    }

    /// Scrolls the view by some rows and leaves the selection where it is.
    pub fn scroll(&mut self, by: isize, height: usize, len: usize) {
        let from = self.window(height, len).start;
        self.offset.set(from.saturating_add_signed(by));
        self.free = true;
    }

    /// Scrolls no further than needed to have a row in view, and leaves the selection where it is.
    pub fn reveal(&mut self, row: usize, height: usize, len: usize) {
        let window = self.window(height, len);
        if row < len && height > 0 && !window.contains(&row) {
            self.offset.set(if row < window.start { row } else { row + 1 - height });
            self.free = true;
        }
    }

    /// By how much a page moves: a row stays in view.
    pub fn page(height: usize) -> usize {
        height.saturating_sub(1).max(1)
    }

    /// The rows in view in this height, with the selection among them unless it was scrolled away; scrolls no further than needed.
    pub fn window(&self, height: usize, len: usize) -> Range<usize> {
        let Some(selected) = self.selected(len).filter(|_| height > 0) else { return 0..0 };
        let margin = MARGIN.min((height - 1) / 2);
        let least = (selected + margin + 1).saturating_sub(height);
        let most = selected.saturating_sub(margin);
        let offset = self.offset.get();
        let offset = if self.free { offset } else { offset.clamp(least, most) };
        let offset = offset.min(len.saturating_sub(height));
        self.offset.set(offset);
        offset..len.min(offset + height)
    }

    /// The row that is drawn this far below the first one in view, as when clicked.
    pub fn row_at(&self, below: usize, height: usize, len: usize) -> Option<usize> {
        self.window(height, len).nth(below)
    }

    /// A row of the scroll bar beside the list, from the top; blank where everything is in view.
    pub fn bar(&self, row: usize, height: usize, len: usize) -> &'static str {
        let window = self.window(height, len);
        match window.len() >= len {
            true => " ",
            false if thumb(&window, height, len).contains(&row) => "┃",
            false => "│",
        }
    }
}

/// The rows of a scroll bar that stand for what is in view: at least one, and at an end only if the list is.
fn thumb(window: &Range<usize>, height: usize, len: usize) -> Range<usize> {
    let size = (height * height / len).clamp(1, height);
    let (room, hidden) = (height - size, len - window.len());
    let second = room.min(1);
    let start = match window.start {
        0 => 0,
        start if start == hidden => room,
        start => (room * start / hidden).clamp(second, room.saturating_sub(1).max(second)),
    };
    start..start + size
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_selection_is_in_view_with_its_margin_whatever_is_asked() {
        for (len, height) in (0..12).flat_map(|len| (0..9).map(move |height| (len, height))) {
            let mut list = List::default();
            for row in (0..len + 3).chain((0..len).rev()).chain([usize::MAX, 5, 0]) {
                list.select(row, len);
                let window = list.window(height, len);
                assert_eq!(window.len(), height.min(len), "{len} rows in {height}");
                let Some(selected) = list.selected(len).filter(|_| height > 0) else { continue };
                let margin = MARGIN.min((height - 1) / 2);
                let wanted = selected.saturating_sub(margin)..(selected + margin + 1).min(len);
                assert!(window.start <= wanted.start && wanted.end <= window.end, "{window:?} {wanted:?}");
            }
        }
    }

    #[test]
    fn the_selection_moves_before_the_list_does() {
        let mut list = List::at(50);
        assert_eq!(list.window(10, 100), 43..53);
        list.up(5, 100);
        assert_eq!(list.window(10, 100), 43..53);
        list.up(1, 100);
        assert_eq!(list.window(10, 100), 42..52);
        list.down(6, 100);
        assert_eq!(list.window(10, 100), 43..53);
    }

    #[test]
    fn the_view_scrolls_away_from_the_selection_and_comes_back_with_it() {
        let mut list = List::at(50);
        list.window(10, 100);
        list.scroll(-20, 10, 100);
        assert_eq!((list.window(10, 100), list.selected(100)), (23..33, Some(50)));
        list.scroll(-99, 10, 100);
        assert_eq!(list.window(10, 100), 0..10);
        list.scroll(isize::MAX, 10, 100);
        assert_eq!(list.window(10, 100), 90..100);
        list.down(1, 100);
        assert_eq!((list.window(10, 100), list.selected(100)), (49..59, Some(51)));
        list.reveal(3, 10, 100);
        assert_eq!(list.window(10, 100), 3..13);
        list.reveal(60, 10, 100);
        assert_eq!((list.window(10, 100), list.selected(100)), (51..61, Some(51)));
        list.reveal(5, 0, 0);
        assert_eq!(list.window(10, 0), 0..0);
    }

    #[test]
    fn moves_end_at_the_ends() {
        let mut list = List::default();
        list.up(1, 5);
        assert_eq!(list.selected(5), Some(0));
        list.down(List::page(4), 5);
        assert_eq!(list.selected(5), Some(3));
        list.down(usize::MAX, 5);
        assert_eq!(list.selected(5), Some(4));
        list.up(1, 3);
        assert_eq!(list.selected(3), Some(1), "rows went away");
        list.bottom(5);
        list.clamp(0);
        assert_eq!(list.selected(0), None);
        assert_eq!(list.selected(1), Some(0));
        list.bottom(7);
        list.top();
        assert_eq!(list.selected(7), Some(0));
    }

    #[test]
    fn a_click_is_on_the_row_that_was_drawn() {
        let list = List::at(50);
        let window = list.window(10, 100);
        assert_eq!(list.row_at(3, 10, 100), Some(window.start + 3));
        assert_eq!(list.row_at(10, 10, 100), None);
        assert_eq!(List::default().row_at(2, 10, 2), None);
    }

    #[test]
    fn the_scroll_bar_is_at_an_end_only_if_the_list_is() {
        let bar = |selected: usize, height: usize, len: usize| {
            let list = List::at(selected);
            (0..height).map(|row| list.bar(row, height, len)).collect::<String>()
        };
        assert_eq!(bar(0, 5, 5), "     ");
        assert_eq!(bar(0, 5, 10), "┃┃│││");
        assert_eq!(bar(9, 5, 10), "│││┃┃");
        assert_eq!(bar(5, 5, 1000), "│┃│││");
        assert_eq!(bar(994, 5, 1000), "│││┃│");
        assert_eq!(bar(0, 1, 1000), "┃");
        for (len, height, row) in
            (1..40).flat_map(|len| (1..6).flat_map(move |h| (0..len).map(move |r| (len, h, r))))
        {
            let bar = bar(row, height, len);
            assert_eq!(bar.contains('┃'), len > height, "{row} of {len} in {height}");
        }
    }
}
