//! Choices drawn from a fuzzer's bytes.
//!
//! Every string of bytes is a string of choices, and where it ends the first choice is made from there on. So each has a meaning, and a byte that a
//! fuzzer changes changes one choice.

use arbitrary::Unstructured;

/// Draws choices from bytes.
pub(crate) struct Dice<'a>(Unstructured<'a>);

impl<'a> Dice<'a> {
    pub(crate) fn new(bytes: &'a [u8]) -> Self {
        Self(Unstructured::new(bytes))
    }

    /// Whether all bytes are drawn.
    pub(crate) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub(crate) fn byte(&mut self) -> u8 {
        self.0.arbitrary().unwrap_or(0)
    }

    /// In 0..n; 0 where n is 0.
    pub(crate) fn below(&mut self, n: usize) -> usize {
        let last = n.saturating_sub(1);
        self.0.int_in_range(0..=last).unwrap_or(0)
    }

    /// True once in `n` times.
    pub(crate) fn once_in(&mut self, n: usize) -> bool {
        self.below(n) + 1 == n
    }

    /// One of some values, of which there is at least one.
    pub(crate) fn one_of<T: Copy, const N: usize>(&mut self, values: [T; N]) -> T {
        const { assert!(N > 0) };
        values[self.below(N)]
    }

    /// One of a list.
    pub(crate) fn any_of<T: Copy>(&mut self, values: &[T]) -> Option<T> {
        values.get(self.below(values.len())).copied()
    }

    /// A multiple of 1/256 in (0, 1).
    pub(crate) fn inside(&mut self) -> f64 {
        f64::from(self.byte().max(1)) / 256.0
    }

    /// Any number in [0, 1), all its digits drawn.
    pub(crate) fn unit(&mut self) -> f64 {
        let bits: u64 = self.0.arbitrary().unwrap_or(0);
        (bits >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Puts a list into another order.
    pub(crate) fn shuffle<T>(&mut self, values: &mut [T]) {
        for i in (1..values.len()).rev() {
            values.swap(i, self.below(i + 1));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn where_bytes_end_the_first_choice_is_made() {
        let mut dice = Dice::new(&[7]);
        assert_eq!(dice.below(4), 3);
        assert!(dice.is_empty());
        assert_eq!((dice.below(4), dice.one_of(['a', 'b']), dice.unit()), (0, 'a', 0.0));
        assert_eq!((dice.below(0), dice.any_of::<u8>(&[]), dice.once_in(2)), (0, None, false));
    }

    #[test]
    fn a_shuffled_list_has_the_same_members() {
        let mut list: Vec<u8> = (0..9).collect();
        Dice::new(&[5, 1, 4, 200, 3, 9]).shuffle(&mut list);
        assert!(!list.is_sorted());
        list.sort_unstable();
        assert_eq!(list, (0..9).collect::<Vec<u8>>());
    }
}
