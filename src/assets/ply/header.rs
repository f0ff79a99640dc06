//! The header of a PLY file: which elements there are, and what a row of each is made of.

use crate::assets::error::{Fault, FaultKind};
use crate::report::quoted;

/// A header longer than this is none.
const MOST_HEADER_BYTES: usize = 1 << 16;

/// How the body is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    Ascii,
    Little,
    Big,
}

/// The type of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Type {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Type {
    fn of(name: &str) -> Option<Self> {
        Some(match name {
            "char" | "int8" => Self::I8,
            "uchar" | "uint8" => Self::U8,
            "short" | "int16" => Self::I16,
            "ushort" | "uint16" => Self::U16,
            "int" | "int32" => Self::I32,
            "uint" | "uint32" => Self::U32,
            "float" | "float32" => Self::F32,
            "double" | "float64" => Self::F64,
            _ => return None,
        })
    }

    pub(super) fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }
}

/// One property of an element.
#[derive(Clone, Debug)]
pub(super) struct Property {
    pub(super) name: String,
    /// The type of a list's length; `None` for a single number.
    pub(super) length: Option<Type>,
    pub(super) of: Type,
}

/// One element: so many rows of these properties.
#[derive(Clone, Debug)]
pub(super) struct Element {
    pub(super) name: String,
    pub(super) count: u64,
    pub(super) properties: Vec<Property>,
}

impl Element {
    /// Where a single number of that name stands in a row.
    pub(super) fn scalar(&self, name: &str) -> Option<usize> {
        self.properties.iter().position(|p| p.name == name && p.length.is_none())
    }

    /// The same for a list.
    pub(super) fn list(&self, name: &str) -> Option<usize> {
        self.properties.iter().position(|p| p.name == name && p.length.is_some())
    }

    /// Bytes that a row takes at least.
    pub(super) fn least_row(&self, encoding: Encoding) -> usize {
        let binary = |p: &Property| p.length.unwrap_or(p.of).size();
        // In ASCII a digit and a blank.
        self.properties.iter().map(|p| if encoding == Encoding::Ascii { 2 } else { binary(p) }).sum()
    }
}

#[derive(Debug)]
pub(super) struct Header {
    pub(super) encoding: Encoding,
    pub(super) elements: Vec<Element>,
}

/// Reads the header; says where the body starts, byte and line.
pub(super) fn parse(bytes: &[u8]) -> Result<(Header, usize, u64), Fault> {
    let mut lines = Lines { bytes: &bytes[..bytes.len().min(MOST_HEADER_BYTES)], at: 0, line: 0 };
    if lines.next()? != "ply" {
        return Err(lines.fault("a PLY file starts with `ply`"));
    }
    let (mut encoding, mut elements) = (None, Vec::new());
    loop {
        let line = lines.next()?;
        let words: Vec<&str> = line.split_ascii_whitespace().collect();
        match words[..] {
            [] | ["comment" | "obj_info", ..] => {}
            ["end_header"] => break,
            ["format", name, _] => encoding = Some(lines.encoding(name)?),
            ["element", name, count] => elements.push(lines.element(name, count)?),
            ["property", ref words @ ..] => lines.property(&mut elements, words)?,
            _ => return Err(lines.fault(&format!("{} is not part of a header", quoted(line)))),
        }
    }
    let encoding = encoding.ok_or_else(|| lines.fault("the header names no format"))?;
    Ok((Header { encoding, elements }, lines.at, lines.line + 1))
}

struct Lines<'a> {
    bytes: &'a [u8],
    at: usize,
    line: u64,
}

impl<'a> Lines<'a> {
    fn next(&mut self) -> Result<&'a str, Fault> {
        self.line += 1;
        let rest = &self.bytes[self.at..];
        let Some(length) = rest.iter().position(|&b| b == b'\n') else {
            return Err(Fault::line(self.line, FaultKind::Truncated, "the header has no end"));
        };
        self.at += length + 1;
        let text = std::str::from_utf8(&rest[..length]).map_err(|_| self.fault("the header is not text"))?;
        Ok(text.trim())
    }

    fn fault(&self, detail: &str) -> Fault {
        Fault::line(self.line, FaultKind::Syntax, detail)
    }

    fn encoding(&self, name: &str) -> Result<Encoding, Fault> {
        match name {
            "ascii" => Ok(Encoding::Ascii),
            "binary_little_endian" => Ok(Encoding::Little),
            "binary_big_endian" => Ok(Encoding::Big),
            _ => Err(self.fault(&format!("there is no format {}", quoted(name)))),
        }
    }

    fn element(&self, name: &str, count: &str) -> Result<Element, Fault> {
        let count = count.parse().map_err(|_| self.fault(&format!("{} is not a count", quoted(count))))?;
        Ok(Element { name: name.into(), count, properties: Vec::new() })
    }

    fn property(&self, elements: &mut [Element], words: &[&str]) -> Result<(), Fault> {
        let none = |name: &str| self.fault(&format!("there is no type {}", quoted(name)));
        let of = |name: &str| Type::of(name).ok_or_else(|| none(name));
        let property = match *words {
            ["list", length, item, name] => {
                Property { name: name.into(), length: Some(self.length(of(length)?)?), of: of(item)? }
            }
            [item, name] => Property { name: name.into(), length: None, of: of(item)? },
            _ => return Err(self.fault("a property has a type and a name")),
        };
        let element = elements.last_mut().ok_or_else(|| self.fault("a property before the first element"))?;
        element.properties.push(property);
        Ok(())
    }

    fn length(&self, of: Type) -> Result<Type, Fault> {
        match of {
            Type::F32 | Type::F64 => Err(self.fault("the length of a list is a whole number")),
            whole => Ok(whole),
        }
    }
}
