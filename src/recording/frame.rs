//! The bytes of a recording: a head, then frames, each with a checksum.
//!
//! | bytes | head |
//! | --- | --- |
//! | 8 | magic number: a byte that is not ASCII, `LNCT`, CR LF, ctrl-Z, so that a transfer as text shows (after PNG) |
//! | 4 | format version |
//! | 1, n | length of the engine's name, the name |
//! | 8 | checksum |
//!
//! | bytes | frame |
//! | --- | --- |
//! | 1 | kind: 1 scene, 2 event, 3 end |
//! | 4, n | length, payload (bincode) |
//! | 8 | checksum |
//!
//! Integers are little-endian. A checksum is the first eight bytes of blake3 over the checksum before it and all bytes since: so a frame
//! that was left out, doubled, moved or taken from another recording is noticed as well as one that was changed.

use std::io::{self, Write};

use super::error::Cause;

/// The version of the format that is written.
pub const VERSION: u32 = 1;

pub(super) const MAGIC: [u8; 8] = *b"\x89LNCT\r\n\x1a";
/// The longest payload; a scene with its mesh in it is the only one that comes near.
pub(super) const MAX_PAYLOAD: usize = 1 << 28;
const CHECKSUM: usize = 8;

type Checksum = [u8; CHECKSUM];

/// What a frame holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Scene = 1,
    Event = 2,
    End = 3,
}

/// What is wrong, and where.
#[derive(Debug)]
pub(super) struct Fault {
    pub(super) offset: usize,
    pub(super) frame: u64,
    pub(super) cause: Cause,
}

fn chain(before: Checksum, parts: &[&[u8]]) -> Checksum {
    let mut hasher = blake3::Hasher::new();
    hasher.update(&before);
    parts.iter().for_each(|part| {
        hasher.update(part);
    });
    let mut checksum = Checksum::default();
    checksum.copy_from_slice(&hasher.finalize().as_bytes()[..CHECKSUM]);
    checksum
}

/// Writes a head, then frames.
pub(super) struct Frames<'w> {
    to: &'w mut dyn Write,
    checksum: Checksum,
}

impl<'w> Frames<'w> {
    /// Writes the head. The name is one of ours, so its length fits.
    pub(super) fn begin(to: &'w mut dyn Write, engine: &str) -> io::Result<Self> {
        let length = u8::try_from(engine.len()).map_err(io::Error::other)?;
        let mut head = MAGIC.to_vec();
        head.extend_from_slice(&VERSION.to_le_bytes());
        head.push(length);
        head.extend_from_slice(engine.as_bytes());
        let mut frames = Self { to, checksum: Checksum::default() };
        frames.seal(&[&head])?;
        Ok(frames)
    }

    /// Writes a frame, of at most [`MAX_PAYLOAD`] bytes.
    pub(super) fn frame(&mut self, kind: Kind, payload: &[u8]) -> io::Result<()> {
        let length = u32::try_from(payload.len()).map_err(io::Error::other)?;
        self.seal(&[&[kind as u8], &length.to_le_bytes(), payload])
    }

    fn seal(&mut self, parts: &[&[u8]]) -> io::Result<()> {
        self.checksum = chain(self.checksum, parts);
        parts.iter().try_for_each(|part| self.to.write_all(part))?;
        self.to.write_all(&self.checksum)
    }
}

/// A frame that is as it was written.
pub(super) struct Frame<'a> {
    pub(super) kind: u8,
    pub(super) payload: &'a [u8],
}

/// Reads a head, then frames.
pub(super) struct Reader<'a> {
    bytes: &'a [u8],
    at: usize,
    /// Where the frame that was read last begins, and which it is.
    start: usize,
    frame: u64,
    checksum: Checksum,
}

impl<'a> Reader<'a> {
    /// Reads the head: the engine's name.
    pub(super) fn open(bytes: &'a [u8]) -> Result<(Self, &'a str), Fault> {
        let mut reader = Self { bytes, at: 0, start: 0, frame: 0, checksum: Checksum::default() };
        reader.magic()?;
        let version = reader.u32()?;
        if version != VERSION {
            return Err(Fault { offset: MAGIC.len(), ..reader.fault(Cause::UnknownVersion(version)) });
        }
        let length = reader.u8()?;
        let name = reader.take(length.into())?;
        reader.verify()?;
        let name = std::str::from_utf8(name).map_err(|e| reader.fault(Cause::Malformed(e.to_string())))?;
        Ok((reader, name))
    }

    /// Reads the next frame.
    pub(super) fn next(&mut self) -> Result<Frame<'a>, Fault> {
        (self.start, self.frame) = (self.at, self.frame + 1);
        let kind = self.u8()?;
        let length = self.u32()? as usize;
        let payload = self.take(length)?;
        self.verify()?;
        if length > MAX_PAYLOAD {
            return Err(self.fault(Cause::TooLong { bytes: length as u64 }));
        }
        Ok(Frame { kind, payload })
    }

    /// Nothing may follow the last frame.
    pub(super) fn finish(&self) -> Result<(), Fault> {
        match self.bytes.len() - self.at {
            0 => Ok(()),
            left => {
                let cause = Cause::Trailing { bytes: left as u64 };
                Err(Fault { offset: self.at, frame: self.frame + 1, cause })
            }
        }
    }

    /// A fault in the frame that was read last.
    pub(super) fn fault(&self, cause: Cause) -> Fault {
        Fault { offset: self.start, frame: self.frame, cause }
    }

    /// A file that ends within the magic number is cut off; one that differs from it is none of ours.
    fn magic(&mut self) -> Result<(), Fault> {
        if !MAGIC.starts_with(&self.bytes[..self.bytes.len().min(MAGIC.len())]) {
            return Err(self.fault(Cause::NotARecording));
        }
        self.take(MAGIC.len()).map(|_| ())
    }

    fn take(&mut self, count: usize) -> Result<&'a [u8], Fault> {
        let left = &self.bytes[self.at..];
        match left.get(..count) {
            Some(taken) => {
                self.at += count;
                Ok(taken)
            }
            None => {
                let cause = Cause::CutOff { missing: (count - left.len()) as u64 };
                Err(Fault { offset: self.bytes.len(), ..self.fault(cause) })
            }
        }
    }

    fn array<const N: usize>(&mut self) -> Result<[u8; N], Fault> {
        let mut array = [0; N];
        array.copy_from_slice(self.take(N)?);
        Ok(array)
    }

    fn u8(&mut self) -> Result<u8, Fault> {
        self.array().map(u8::from_le_bytes)
    }

    fn u32(&mut self) -> Result<u32, Fault> {
        self.array().map(u32::from_le_bytes)
    }

    /// Compares the checksum of what was read since `start`.
    fn verify(&mut self) -> Result<(), Fault> {
        let expected = chain(self.checksum, &[&self.bytes[self.start..self.at]]);
        self.checksum = self.array()?;
        if self.checksum == expected { Ok(()) } else { Err(self.fault(Cause::Checksum)) }
    }
}
