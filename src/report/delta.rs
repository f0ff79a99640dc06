//! What a stage changed, element by element, in a form that can be hashed, stored and compared.
//!
//! A [`Buffer`] is a named array of which only the changed elements are kept, each with `width` scalars. Its digest is blake3 over
//! name, scalar type, width, ids and canonical little-endian values: NaN has one bit pattern and −0 is 0.

use serde::{Deserialize, Serialize};

/// What the scalars of a buffer are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Scalar {
    /// 64-bit floats.
    F64,
    /// 32-bit floats.
    F32,
    /// Unsigned integers, ids among them.
    U32,
}

impl Scalar {
    /// Bytes of one scalar.
    pub fn size(self) -> usize {
        if self == Self::F64 { 8 } else { 4 }
    }
}

/// The changed elements of one array.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Buffer {
    /// Its name, such as `nodes`.
    pub name: String,
    /// Letter before an id of its elements, such as `n`.
    pub prefix: String,
    /// What its scalars are.
    pub scalar: Scalar,
    /// Scalars of one element.
    pub width: u32,
    /// The elements, ascending.
    pub ids: Vec<u32>,
    /// Their scalars, little-endian and canonical, `width` for each id.
    pub data: Vec<u8>,
}

/// What one stage changed at one event.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct StageDelta {
    /// The stage, such as `MC`.
    pub stage: String,
    /// What it changed, in the stage's order.
    pub buffers: Vec<Buffer>,
}

/// What the stages changed at one event.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct EventDelta {
    /// The event's place in the recording.
    pub event: usize,
    /// The stages that ran through, in order.
    pub stages: Vec<StageDelta>,
}

/// The first place at which two buffers differ.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Difference {
    /// The element, such as `n12`.
    pub element: String,
    /// What was expected, and what was found, as text; floats with their distance in ulps.
    pub expected: String,
    /// What was found.
    pub found: String,
}

impl Buffer {
    /// An empty buffer.
    pub fn new(name: &str, prefix: &str, scalar: Scalar, width: u32) -> Self {
        Self { name: name.into(), prefix: prefix.into(), scalar, width, ids: Vec::new(), data: Vec::new() }
    }

    /// Appends an element's 64-bit floats.
    pub fn push_f64(&mut self, id: u32, values: &[f64]) {
        debug_assert!(self.scalar == Scalar::F64 && values.len() == self.width as usize);
        self.ids.push(id);
        values.iter().for_each(|v| self.data.extend_from_slice(&canonical_f64(*v).to_le_bytes()));
    }

    /// Appends an element's 32-bit floats.
    pub fn push_f32(&mut self, id: u32, values: &[f32]) {
        debug_assert!(self.scalar == Scalar::F32 && values.len() == self.width as usize);
        self.ids.push(id);
        values.iter().for_each(|v| self.data.extend_from_slice(&canonical_f32(*v).to_le_bytes()));
    }

    /// Appends an element's integers.
    pub fn push_u32(&mut self, id: u32, values: &[u32]) {
        debug_assert!(self.scalar == Scalar::U32 && values.len() == self.width as usize);
        self.ids.push(id);
        values.iter().for_each(|v| self.data.extend_from_slice(&v.to_le_bytes()));
    }

    /// Bytes of one element.
    pub fn stride(&self) -> usize {
        self.width as usize * self.scalar.size()
    }

    /// The bytes of the element at a place in `ids`.
    pub fn element(&self, at: usize) -> &[u8] {
        &self.data[at * self.stride()..(at + 1) * self.stride()]
    }

    /// blake3 over all of it.
    pub fn digest(&self) -> blake3::Hash {
        let mut hasher = blake3::Hasher::new();
        hasher.update(self.name.as_bytes());
        hasher.update(&[0, self.scalar as u8]);
        hasher.update(&self.width.to_le_bytes());
        hasher.update(&(self.ids.len() as u64).to_le_bytes());
        self.ids.iter().for_each(|i| {
            hasher.update(&i.to_le_bytes());
        });
        hasher.update(&self.data);
        hasher.finalize()
    }

    /// The first element, in the order of ids, at which `self` (expected) and `other` (found) differ.
    pub fn first_difference(&self, other: &Self) -> Option<Difference> {
        let (mut i, mut j) = (0, 0);
        loop {
            match (self.ids.get(i), other.ids.get(j)) {
                (None, None) => return None,
                (Some(a), Some(b)) if a == b => {
                    if self.element(i) != other.element(j) {
                        return Some(self.difference(*a, Some(self.element(i)), Some(other.element(j))));
                    }
                    (i, j) = (i + 1, j + 1);
                }
                (Some(a), b) if b.is_none_or(|b| a < b) => {
                    return Some(self.difference(*a, Some(self.element(i)), None));
                }
                (_, Some(b)) => return Some(self.difference(*b, None, Some(other.element(j)))),
                (Some(_), None) => unreachable!("covered by the guard"),
            }
        }
    }

    fn difference(&self, id: u32, expected: Option<&[u8]>, found: Option<&[u8]>) -> Difference {
        let element = format!("{}{id}", self.prefix);
        let text = |bytes: Option<&[u8]>| bytes.map_or("unchanged".into(), |b| self.text(b));
        let mut difference = Difference { element, expected: text(expected), found: text(found) };
        if let (Some(a), Some(b)) = (expected, found)
            && let Some(ulps) = self.ulps(a, b)
        {
            difference.found += &format!(" ({ulps} ulp)");
        }
        difference
    }

    fn text(&self, element: &[u8]) -> String {
        let scalars: Vec<String> = match self.scalar {
            Scalar::F64 => {
                element.chunks_exact(8).map(|b| format!("{:?}", f64::from_bits(u64_of(b)))).collect()
            }
            Scalar::F32 => {
                element.chunks_exact(4).map(|b| format!("{:?}", f32::from_bits(u32_of(b)))).collect()
            }
            Scalar::U32 => element.chunks_exact(4).map(|b| u32_of(b).to_string()).collect(),
        };
        format!("({})", scalars.join(", "))
    }

    /// The largest distance in ulps between two elements' floats.
    fn ulps(&self, a: &[u8], b: &[u8]) -> Option<u64> {
        let pairs = |n| a.chunks_exact(n).zip(b.chunks_exact(n));
        match self.scalar {
            Scalar::F64 => pairs(8).map(|(a, b)| ordered64(u64_of(a)).abs_diff(ordered64(u64_of(b)))).max(),
            Scalar::F32 => {
                pairs(4).map(|(a, b)| ordered32(u32_of(a)).abs_diff(ordered32(u32_of(b))) as u64).max()
            }
            Scalar::U32 => None,
        }
    }
}

fn u64_of(bytes: &[u8]) -> u64 {
    bytes.iter().rev().fold(0, |n, &b| n << 8 | b as u64)
}

fn u32_of(bytes: &[u8]) -> u32 {
    u64_of(bytes) as u32
}

/// Bits such that neighbouring floats are neighbouring integers.
fn ordered64(bits: u64) -> i64 {
    let bits = bits as i64;
    if bits < 0 { i64::MIN.wrapping_sub(bits) } else { bits }
}

fn ordered32(bits: u32) -> i32 {
    let bits = bits as i32;
    if bits < 0 { i32::MIN.wrapping_sub(bits) } else { bits }
}

fn canonical_f64(v: f64) -> u64 {
    if v.is_nan() { f64::NAN.to_bits() & !(1 << 63) } else { (v + 0.0).to_bits() }
}

fn canonical_f32(v: f32) -> u32 {
    if v.is_nan() { f32::NAN.to_bits() & !(1 << 31) } else { (v + 0.0).to_bits() }
}
