//! Bytes to the decoder of recordings and to the reader of scripts.
//!
//! The bytes are read as they are, as a file and as a script. Since no mutation survives a checksum, they are read a third time with
//! their checksums put right (`sealed`, written here from the table in [`crate::recording`]'s module `frame`), which leads into the payloads.
//!
//! What must hold: what was read as a whole is written as the same bytes; the valid part before a fault is valid, and survives a round trip; the
//! fault lies within the file; a script says the same after it was packed and unpacked.

use super::{Finding, Hits, Outcome};
use crate::recording::{AnyRecording, Cause, ReadError, Script, read, to_bytes};

/// Magic number and version.
const FIXED_HEAD: usize = 12;
/// Kind and length of a frame.
const FRAME_HEAD: usize = 5;
const CHECKSUM: usize = 8;

pub(super) fn run(data: &[u8]) -> Outcome {
    let mut hits = Hits::default();
    file("file", data, &mut hits)?;
    file("sealed", &sealed(data), &mut hits)?;
    script(data, &mut hits)?;
    Ok(hits)
}

fn file(what: &str, bytes: &[u8], hits: &mut Hits) -> Result<(), Box<Finding>> {
    match read(bytes) {
        Ok(recording) => {
            hits.note(format!("{what} read"));
            let again = written(&recording)?;
            same("writes-what-it-read", again == bytes, bytes)
        }
        Err(error) => {
            hits.note(format!("{what} {}", word(&error.cause)));
            fault(&error, bytes)
        }
    }
}

/// A fault names a place in the file, and what was valid before it is a recording.
fn fault(error: &ReadError, bytes: &[u8]) -> Result<(), Box<Finding>> {
    if error.offset > bytes.len() as u64 {
        return Err(Finding::new("fault-within-file", format!("{error}, of {} bytes", bytes.len())));
    }
    let Some(prefix) = &error.prefix else { return Ok(()) };
    let again = read(&written(prefix)?).map_err(|e| Finding::new("prefix-is-valid", e.to_string()))?;
    same("prefix-is-valid", again == *prefix, bytes)
}

fn script(data: &[u8], hits: &mut Hits) -> Result<(), Box<Finding>> {
    let Ok(script) = Script::parse(data) else { return Ok(()) };
    hits.note("script read");
    let packed: Result<_, Box<Finding>> = script.clone().pack(|_| Ok(([1; 32], [2; 32])));
    let unpacked = read(&written(&packed?)?).map_err(|e| Finding::new("packs", e.to_string()))?;
    let unpacked = Script::of(&unpacked);
    same("unpacks-what-it-packed", unpacked == script, data)?;
    let mut text = Vec::new();
    unpacked.write(&mut text).map_err(|e| Finding::new("writes-script", e.to_string()))?;
    let again = Script::parse(&text).map_err(|e| Finding::new("reads-its-script", e.to_string()))?;
    same("reads-its-script", again == script, &text)
}

fn written(recording: &AnyRecording) -> Result<Vec<u8>, Box<Finding>> {
    to_bytes(recording).map_err(|e| Finding::new("writes-what-it-read", e.to_string()))
}

fn same(check: &str, holds: bool, recording: &[u8]) -> Result<(), Box<Finding>> {
    if holds { Ok(()) } else { Err(Finding::new(check, "it is not the same").with_recording(recording)) }
}

fn word(cause: &Cause) -> &'static str {
    match cause {
        Cause::NotARecording => "not a recording",
        Cause::UnknownVersion(_) => "of another version",
        Cause::UnknownEngine(_) => "for another engine",
        Cause::CutOff { .. } => "cut off",
        Cause::Checksum => "damaged",
        Cause::TooLong { .. } => "too long",
        Cause::WrongKind(_) => "of a wrong kind",
        Cause::Malformed(_) => "malformed",
        Cause::Invalid(_) => "invalid",
        Cause::Count { .. } => "of a wrong count",
        Cause::Trailing { .. } => "trailing",
    }
}

/// The same file with every checksum as it should be. A frame that says it is longer than the file is left as it is.
fn sealed(data: &[u8]) -> Vec<u8> {
    let mut bytes = data.to_vec();
    let mut checksum = [0; CHECKSUM];
    let name = bytes.get(FIXED_HEAD).map_or(0, |&length| usize::from(length));
    let (mut start, mut end) = (0, FIXED_HEAD + 1 + name);
    while bytes.get(end..end + CHECKSUM).is_some() {
        let mut hasher = blake3::Hasher::new();
        hasher.update(&checksum).update(&bytes[start..end]);
        checksum.copy_from_slice(&hasher.finalize().as_bytes()[..CHECKSUM]);
        bytes[end..end + CHECKSUM].copy_from_slice(&checksum);
        start = end + CHECKSUM;
        let Some(length) = bytes.get(start + 1..start + FRAME_HEAD).and_then(|b| b.try_into().ok()) else {
            break;
        };
        end = (start + FRAME_HEAD).saturating_add(u32::from_le_bytes(length) as usize);
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    const FIXTURE: &[u8] = include_bytes!("../../tests/fixtures/recordings/v1.lancet");

    #[test]
    fn a_whole_file_is_sealed_already_and_a_changed_one_leads_on() {
        assert_eq!(sealed(FIXTURE), FIXTURE);
        let mut changed = FIXTURE.to_vec();
        // Somewhere in the scene's hashes, which may be anything.
        let hash = read(FIXTURE).expect("a fixture").hashes()[0];
        let at = FIXTURE.windows(32).position(|w| w == hash).expect("it is in the file");
        changed[at] ^= 1;
        let hits = run(&changed).expect("no finding").0;
        assert!(hits.contains_key("file damaged") && hits.contains_key("sealed read"), "{hits:?}");
    }

    #[test]
    fn every_prefix_and_a_script_hold() {
        (0..FIXTURE.len()).for_each(|end| drop(run(&FIXTURE[..end]).expect("no finding")));
        let script = include_bytes!("../../tests/fixtures/recordings/v1.json");
        assert!(run(script).expect("no finding").0.contains_key("script read"));
    }
}
