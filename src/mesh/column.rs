//! An array with a memory: what an open transaction wrote to it can be rolled back, or kept as a [`ColumnPatch`].

/// One array of mesh elements and the log of the open transaction.
#[derive(Clone, Debug)]
pub(super) struct Column<T> {
    data: Vec<T>,
    /// Old values of the elements written since `begin`, in the order of the writes.
    log: Vec<(u32, T)>,
    /// Length when the transaction began; `None` outside of one.
    start: Option<usize>,
}

/// What one transaction did to one column: enough to take it back and to do it again.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ColumnPatch<T> {
    /// Element, value before, value after; sorted by element, one entry each.
    writes: Vec<(u32, T, T)>,
    start: usize,
    tail: Vec<T>,
}

impl<T> ColumnPatch<T> {
    pub(super) fn bytes(&self) -> usize {
        self.writes.len() * size_of::<(u32, T, T)>() + self.tail.len() * size_of::<T>()
    }

    pub(super) fn is_empty(&self) -> bool {
        self.writes.is_empty() && self.tail.is_empty()
    }

    /// The elements that the patch writes or appends, ascending.
    pub(super) fn touched(&self) -> impl Iterator<Item = u32> + '_ {
        let tail = self.start as u32..(self.start + self.tail.len()) as u32;
        self.writes.iter().map(|w| w.0).chain(tail)
    }
}

/// A place in a column's log and array.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct ColumnMark {
    log: usize,
    len: usize,
}

impl<T: Copy + PartialEq> Column<T> {
    /// Takes the array over and leaves room for the edits to come, so that a cut does not move a large mesh.
    pub(super) fn new(mut data: Vec<T>) -> Self {
        let room = Self::roomy(data.len());
        if data.capacity() < room || data.capacity() > 2 * room {
            let mut exact = Vec::with_capacity(room);
            exact.append(&mut data);
            data = exact;
        }
        Self { data, log: Vec::new(), start: None }
    }

    /// The capacity that [`Self::new`] asks for: what is read into so much is not moved again.
    pub(super) fn roomy(len: usize) -> usize {
        len + len / 32 + 64
    }

    #[inline]
    pub(super) fn all(&self) -> &[T] {
        &self.data
    }

    #[inline]
    pub(super) fn set(&mut self, index: usize, value: T) {
        let old = std::mem::replace(&mut self.data[index], value);
        if self.start.is_some() {
            self.log.push((index as u32, old));
        }
    }

    #[inline]
    pub(super) fn push(&mut self, value: T) -> usize {
        if self.data.len() == self.data.capacity() {
            self.data.reserve_exact(self.data.len() / 8 + 64);
        }
        self.data.push(value);
        self.data.len() - 1
    }

    pub(super) fn begin(&mut self) {
        debug_assert!(self.start.is_none(), "transactions do not nest");
        self.log.clear();
        self.start = Some(self.data.len());
    }

    pub(super) fn mark(&self) -> ColumnMark {
        ColumnMark { log: self.log.len(), len: self.data.len() }
    }

    /// Where the open transaction began.
    pub(super) fn beginning(&self) -> ColumnMark {
        ColumnMark { log: 0, len: self.start.unwrap_or(self.data.len()) }
    }

    /// The elements written or appended since a mark of the open transaction, ascending, each once.
    pub(super) fn touched_since(&self, mark: ColumnMark) -> Vec<u32> {
        let mut touched: Vec<u32> = self.log[mark.log..].iter().map(|w| w.0).collect();
        touched.sort_unstable();
        touched.dedup();
        touched.retain(|&i| (i as usize) < mark.len);
        touched.extend(mark.len as u32..self.data.len() as u32);
        touched
    }

    pub(super) fn rollback(&mut self) {
        let Some(start) = self.start.take() else { return };
        for (index, old) in self.log.drain(..).rev() {
            self.data[index as usize] = old;
        }
        self.data.truncate(start);
    }

    /// Takes back what was written since a mark of the open transaction.
    pub(super) fn rollback_to(&mut self, mark: ColumnMark) {
        for (index, old) in self.log.drain(mark.log..).rev() {
            self.data[index as usize] = old;
        }
        self.data.truncate(mark.len);
    }

    pub(super) fn commit(&mut self) -> ColumnPatch<T> {
        let start = self.start.take().unwrap_or(self.data.len());
        // The first entry of an element holds its value before the transaction: a stable sort keeps it in front.
        self.log.retain(|w| (w.0 as usize) < start);
        self.log.sort_by_key(|w| w.0);
        self.log.dedup_by_key(|w| w.0);
        let writes = self.log.drain(..).map(|(i, old)| (i, old, self.data[i as usize])).collect();
        ColumnPatch { writes, start, tail: self.data[start..].to_vec() }
    }

    pub(super) fn revert(&mut self, patch: &ColumnPatch<T>) {
        debug_assert_eq!(
            self.data.len(),
            patch.start + patch.tail.len(),
            "patches are taken back newest first"
        );
        self.data.truncate(patch.start);
        for &(index, old, _) in &patch.writes {
            self.data[index as usize] = old;
        }
    }

    pub(super) fn apply(&mut self, patch: &ColumnPatch<T>) {
        debug_assert_eq!(self.data.len(), patch.start, "patches are done again in their order");
        for &(index, _, new) in &patch.writes {
            self.data[index as usize] = new;
        }
        self.data.reserve(patch.tail.len());
        self.data.extend_from_slice(&patch.tail);
    }

    pub(super) fn bytes(&self) -> usize {
        self.data.capacity() * size_of::<T>() + self.log.capacity() * size_of::<(u32, T)>()
    }
}
