//! The file: a scene frame, a frame for each event, an end frame with their count.
//!
//! Payloads are bincode 2 with fixed-width little-endian integers. A payload that decodes must also be what would be written for it, so that
//! a recording has one file and packing what was unpacked gives it back.
//!
//! Promised: cut off anywhere, or with any byte changed, reading gives an error that says what and where, with the valid part before it;
//! it never panics, and sets aside at most 64 KiB or 64 times the payload before it has read it. Not promised: safety from someone who forges checksums on purpose;
//! what such a file says is validated as any other.

use std::io::Write;
use std::path::Path;

use bincode::config::{Configuration, Fixint, Limit, LittleEndian, standard};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use super::any::{ForEngine, for_engine};
use super::error::Cause;
use super::frame::{Fault, Frame, Frames, Kind, MAGIC, MAX_PAYLOAD, Reader};
use super::rules::{self, Names};
use super::{AnyRecording, Keyed, ReadError, Recorded, Recording, SceneRef, Visit, WriteError};

/// The payload of the scene frame.
#[derive(Serialize, Deserialize)]
struct Head {
    scene: SceneRef,
    scene_hash: [u8; 32],
    mesh_hash: [u8; 32],
    viewport: [u32; 2],
    seed: u64,
}

/// The payload of the end frame.
#[derive(Serialize, Deserialize)]
struct End {
    events: u64,
}

/// Whether a file is a script rather than a recording: it has a script's name, or at least not a recording's name or beginning.
pub fn is_script(path: &Path, bytes: &[u8]) -> bool {
    let named = |extension| path.extension().is_some_and(|e| e == extension);
    !bytes.starts_with(&MAGIC) && (named("json") || !named("lancet"))
}

/// Reads a file.
pub fn read(bytes: &[u8]) -> Result<AnyRecording, Box<ReadError>> {
    let (reader, engine) = Reader::open(bytes).map_err(|fault| failed(fault, None))?;
    let unknown = reader.fault(Cause::UnknownEngine(engine.to_owned()));
    for_engine(engine, ReadFrames(reader)).unwrap_or_else(|| Err(failed(unknown, None)))
}

/// The bytes of a recording's file.
pub fn to_bytes(recording: &AnyRecording) -> Result<Vec<u8>, WriteError> {
    let mut bytes = Vec::new();
    write(recording, &mut bytes)?;
    Ok(bytes)
}

/// Writes a recording's file.
pub fn write(recording: &AnyRecording, to: &mut dyn Write) -> Result<(), WriteError> {
    recording.visit(WriteFrames(to))
}

fn failed(fault: Fault, prefix: Option<AnyRecording>) -> Box<ReadError> {
    Box::new(ReadError { offset: fault.offset as u64, frame: fault.frame, cause: fault.cause, prefix })
}

struct ReadFrames<'a>(Reader<'a>);

impl ForEngine for ReadFrames<'_> {
    type Output = Result<AnyRecording, Box<ReadError>>;

    fn run<E: Recorded>(mut self) -> Self::Output {
        let head = read_head(&mut self.0).map_err(|fault| failed(fault, None))?;
        let Head { scene, scene_hash, mesh_hash, viewport, seed } = head;
        let mut recording: Recording<E> =
            Recording { scene, scene_hash, mesh_hash, viewport, seed, events: Vec::new() };
        match read_events(&mut self.0, &mut recording.events) {
            Ok(()) => Ok(E::wrap(recording)),
            Err(fault) => Err(failed(fault, Some(E::wrap(recording)))),
        }
    }
}

fn read_head(reader: &mut Reader<'_>) -> Result<Head, Fault> {
    let frame = reader.next()?;
    if frame.kind != Kind::Scene as u8 {
        return Err(reader.fault(Cause::WrongKind(frame.kind)));
    }
    let head: Head = decode(reader, &frame)?;
    match rules::head(&head.scene, head.viewport) {
        Ok(()) => Ok(head),
        Err(what) => Err(reader.fault(Cause::Invalid(what))),
    }
}

fn read_events<E: Recorded>(reader: &mut Reader<'_>, events: &mut Vec<Keyed<E>>) -> Result<(), Fault> {
    let mut names = Names::default();
    loop {
        let frame = reader.next()?;
        if frame.kind == Kind::End as u8 {
            return read_end(reader, &frame, events.len() as u64);
        }
        if frame.kind != Kind::Event as u8 {
            return Err(reader.fault(Cause::WrongKind(frame.kind)));
        }
        let keyed: Keyed<E> = decode(reader, &frame)?;
        names.admit(&keyed.event).map_err(|what| reader.fault(Cause::Invalid(what)))?;
        events.push(keyed);
    }
}

fn read_end(reader: &Reader<'_>, frame: &Frame<'_>, found: u64) -> Result<(), Fault> {
    let End { events: said } = decode(reader, frame)?;
    if said != found {
        return Err(reader.fault(Cause::Count { said, found }));
    }
    reader.finish()
}

struct WriteFrames<'w>(&'w mut dyn Write);

impl Visit for WriteFrames<'_> {
    type Output = Result<(), WriteError>;

    fn visit<E: Recorded>(self, recording: &Recording<E>) -> Self::Output {
        recording.validate().map_err(WriteError::Invalid)?;
        let &Recording { scene_hash, mesh_hash, viewport, seed, .. } = recording;
        let head = Head { scene: recording.scene.clone(), scene_hash, mesh_hash, viewport, seed };
        let mut frames = Frames::begin(self.0, E::ENGINE)?;
        put(&mut frames, Kind::Scene, &head)?;
        recording.events.iter().try_for_each(|keyed| put(&mut frames, Kind::Event, keyed))?;
        put(&mut frames, Kind::End, &End { events: recording.events.len() as u64 })
    }
}

fn put(frames: &mut Frames<'_>, kind: Kind, payload: &impl Serialize) -> Result<(), WriteError> {
    let bytes = encode(payload).map_err(WriteError::Invalid)?;
    if bytes.len() > MAX_PAYLOAD {
        return Err(WriteError::Invalid(format!("{} bytes are too long for a frame", bytes.len())));
    }
    Ok(frames.frame(kind, &bytes)?)
}

const fn fixed<const LIMIT: usize>() -> Configuration<LittleEndian, Fixint, Limit<LIMIT>> {
    standard().with_little_endian().with_fixed_int_encoding().with_limit::<LIMIT>()
}

fn encode(value: &impl Serialize) -> Result<Vec<u8>, String> {
    bincode::serde::encode_to_vec(value, fixed::<MAX_PAYLOAD>()).map_err(|e| e.to_string())
}

/// A payload's value; it must be written in the one way that we write it.
fn decode<T: DeserializeOwned + Serialize>(reader: &Reader<'_>, frame: &Frame<'_>) -> Result<T, Fault> {
    let malformed = |what: String| reader.fault(Cause::Malformed(what));
    let value = decode_limited(frame.payload).map_err(malformed)?;
    if encode(&value).map_err(malformed)? != frame.payload {
        return Err(malformed("not in the form in which it would be written".into()));
    }
    Ok(value)
}

/// bincode sets a string's length aside before it reads it; its limit is a constant, so a small payload gets a small one.
fn decode_limited<T: DeserializeOwned>(payload: &[u8]) -> Result<T, String> {
    const SMALL: usize = 1 << 16;
    const MIDDLE: usize = 1 << 22;
    let decoded = if payload.len() <= SMALL {
        bincode::serde::decode_from_slice(payload, fixed::<SMALL>())
    } else if payload.len() <= MIDDLE {
        bincode::serde::decode_from_slice(payload, fixed::<MIDDLE>())
    } else {
        bincode::serde::decode_from_slice(payload, fixed::<MAX_PAYLOAD>())
    };
    decoded.map(|(value, _)| value).map_err(|e| e.to_string())
}
