//! The body of a PLY file, row by row.

use super::header::{Element, Encoding, Type};
use crate::assets::error::{Fault, FaultKind};
use crate::report::quoted;

/// The values of one row.
#[derive(Debug, Default)]
pub(super) struct Row {
    /// All numbers of the row, lists in place.
    values: Vec<f64>,
    /// Where each property's numbers start.
    starts: Vec<usize>,
}

impl Row {
    /// A property that is a single number.
    pub(super) fn scalar(&self, property: usize) -> f64 {
        self.list(property).first().copied().unwrap_or(f64::NAN)
    }

    /// A property that is a list.
    pub(super) fn list(&self, property: usize) -> &[f64] {
        let start = self.starts.get(property).copied().unwrap_or_default();
        let end = self.starts.get(property + 1).copied().unwrap_or(self.values.len());
        self.values.get(start..end).unwrap_or_default()
    }
}

/// A place in the body.
#[derive(Debug)]
pub(super) struct Body<'a> {
    bytes: &'a [u8],
    at: usize,
    line: u64,
    encoding: Encoding,
}

impl<'a> Body<'a> {
    pub(super) fn new(bytes: &'a [u8], at: usize, line: u64, encoding: Encoding) -> Self {
        Self { bytes, at, line, encoding }
    }

    /// How many rows of an element the rest of the file can hold, at most as many as it says.
    pub(super) fn plausible(&self, element: &Element) -> usize {
        let most = (self.bytes.len() - self.at) / element.least_row(self.encoding).max(1) + 1;
        usize::try_from(element.count).unwrap_or(usize::MAX).min(most)
    }

    /// Reads all rows of an element.
    pub(super) fn rows(
        &mut self,
        element: &Element,
        mut each: impl FnMut(&Row, &Self) -> Result<(), Fault>,
    ) -> Result<(), Fault> {
        if element.properties.is_empty() {
            return Ok(());
        }
        let mut row = Row::default();
        for number in 0..element.count {
            self.row(element, &mut row).map_err(|mut fault| {
                fault.detail = format!("{} (element {} {number})", fault.detail, element.name);
                fault
            })?;
            each(&row, self)?;
        }
        Ok(())
    }

    fn row(&mut self, element: &Element, row: &mut Row) -> Result<(), Fault> {
        row.values.clear();
        row.starts.clear();
        for property in &element.properties {
            row.starts.push(row.values.len());
            let length = match property.length {
                None => 1,
                Some(of) => self.length(of, property.of)?,
            };
            for _ in 0..length {
                let value = self.value(property.of)?;
                row.values.push(value);
            }
        }
        Ok(())
    }

    /// The length of a list, which the rest of the file must be able to hold.
    fn length(&mut self, of: Type, item: Type) -> Result<usize, Fault> {
        let start = self.at;
        let length = self.value(of)?;
        let least = if self.encoding == Encoding::Ascii { 2 } else { item.size() };
        let most = (self.bytes.len() - self.at).div_ceil(least);
        if length >= 0.0 && length.trunc() == length && length <= most as f64 {
            return Ok(length as usize);
        }
        let detail = format!("a list of {length} does not fit into the file");
        Err(Fault::byte(start, FaultKind::Truncated, detail))
    }

    fn value(&mut self, of: Type) -> Result<f64, Fault> {
        if self.encoding == Encoding::Ascii { self.word() } else { self.binary(of) }
    }

    fn binary(&mut self, of: Type) -> Result<f64, Fault> {
        let Some(bytes) = self.bytes.get(self.at..self.at + of.size()) else {
            return Err(Fault::byte(self.at, FaultKind::Truncated, "the file ends within a number"));
        };
        self.at += of.size();
        let mut little = [0; 8];
        little[..bytes.len()].copy_from_slice(bytes);
        if self.encoding == Encoding::Big {
            little[..bytes.len()].reverse();
        }
        let bits = u64::from_le_bytes(little);
        Ok(match of {
            Type::I8 => f64::from(bits as i8),
            Type::U8 | Type::U16 | Type::U32 => bits as f64,
            Type::I16 => f64::from(bits as i16),
            Type::I32 => f64::from(bits as i32),
            Type::F32 => f64::from(f32::from_bits(bits as u32)),
            Type::F64 => f64::from_bits(bits),
        })
    }

    fn word(&mut self) -> Result<f64, Fault> {
        while let Some(blank) = self.bytes.get(self.at).filter(|b| b.is_ascii_whitespace()) {
            self.line += u64::from(*blank == b'\n');
            self.at += 1;
        }
        let rest = &self.bytes[self.at..];
        if rest.is_empty() {
            return Err(Fault::line(self.line, FaultKind::Truncated, "the file ends before its last number"));
        }
        let parsed = fast_float2::parse_partial(rest);
        let sticks = |n: usize| rest.get(n).is_some_and(|b| !b.is_ascii_whitespace());
        match parsed {
            Ok((value, length)) if !sticks(length) => {
                self.at += length;
                Ok(value)
            }
            _ => {
                let length = rest.iter().take(40).take_while(|b| !b.is_ascii_whitespace()).count();
                let word = String::from_utf8_lossy(&rest[..length]);
                Err(Fault::line(self.line, FaultKind::Number, format!("{} is not a number", quoted(word))))
            }
        }
    }
}
