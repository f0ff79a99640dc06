//! A buffer that grows: what it holds is written anew, or only where it differs from what was there.

use std::ops::Range;

use bytemuck::NoUninit;
use wgpu::BufferUsages;

use super::device::Device;
use crate::canvas::RenderError;

/// A buffer that grows by doubling.
#[derive(Debug)]
pub(crate) struct Store {
    label: &'static str,
    usage: BufferUsages,
    buffer: Option<wgpu::Buffer>,
}

impl Store {
    /// One that holds nothing yet.
    pub(crate) fn new(label: &'static str, usage: BufferUsages) -> Self {
        Self { label, usage: usage | BufferUsages::COPY_DST, buffer: None }
    }

    /// The buffer, once something was put into it.
    pub(crate) fn buffer(&self) -> Option<&wgpu::Buffer> {
        self.buffer.as_ref()
    }

    /// Writes all that it holds.
    pub(crate) fn put(&mut self, device: &Device, bytes: &[u8]) -> Result<wgpu::Buffer, RenderError> {
        let (buffer, _) = self.room(device, bytes.len() as u64)?;
        if !bytes.is_empty() {
            device.write(&buffer, 0, bytes)?;
        }
        Ok(buffer)
    }

    /// Turns what it holds from one list into another, and says which ranges were written. Rows that are the same are written along where
    /// no more than `gap` lie between two that are not.
    pub(crate) fn follow<T: NoUninit + PartialEq>(
        &mut self,
        device: &Device,
        from: &[T],
        to: &[T],
        gap: usize,
    ) -> Result<Vec<Range<usize>>, RenderError> {
        let (buffer, new) = self.room(device, size_of_val(to) as u64)?;
        let ranges = changed(if new { &[] } else { from }, to, gap);
        for range in &ranges {
            let at = (range.start * size_of::<T>()) as u64;
            device.write(&buffer, at, bytemuck::cast_slice(&to[range.clone()]))?;
        }
        Ok(ranges)
    }

    /// The buffer with room for so many bytes, and whether it is a new one.
    fn room(&mut self, device: &Device, bytes: u64) -> Result<(wgpu::Buffer, bool), RenderError> {
        let before = self.buffer.as_ref().map_or(0, wgpu::Buffer::size);
        if let Some(buffer) = self.buffer.clone().filter(|_| bytes <= before) {
            return Ok((buffer, false));
        }
        // The old one goes first: both together might be too much.
        self.buffer = None;
        let doubled = bytes.max(2 * before);
        let most = [doubled, bytes];
        let made = most.iter().find_map(|&size| device.buffer(self.label, size, self.usage).ok());
        let buffer = made.map_or_else(|| device.buffer(self.label, bytes, self.usage), Ok)?;
        self.buffer = Some(buffer.clone());
        Ok((buffer, true))
    }
}

/// The ranges in which a list differs from the one before it.
fn changed<T: PartialEq>(from: &[T], to: &[T], gap: usize) -> Vec<Range<usize>> {
    let mut ranges: Vec<Range<usize>> = Vec::new();
    for i in (0..to.len()).filter(|&i| from.get(i) != Some(&to[i])) {
        match ranges.last_mut() {
            Some(last) if i <= last.end + gap => last.end = i + 1,
            _ => ranges.push(i..i + 1),
        }
    }
    ranges
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_are_joined_over_small_gaps_alone() {
        let mut to = [0; 100];
        (to[3], to[5], to[9], to[99]) = (1, 1, 1, 1);
        assert_eq!(changed(&[0; 100], &to, 0), [3..4, 5..6, 9..10, 99..100]);
        assert_eq!(changed(&[0; 100], &to, 3), [3..10, 99..100]);
        assert_eq!(changed(&[0; 98], &[0; 100], 3).first(), Some(&(98..100)));
        assert_eq!(changed(&to, &to, 3), []);
        assert_eq!(changed(&to, &to[..50], 3), []);
    }
}
