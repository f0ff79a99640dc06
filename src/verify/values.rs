//! The changed values behind a run's digests, so that a divergence can be named down to the element.
//!
//! Layout: magic number, version (u32), digest of the run, checksum (blake3, 16 bytes) of all that follows it; then bincode, deflated.
//! A buffer of at most [`ELEMENTS_CAP`] elements is kept whole; of a larger one, a hash for each block of [`BLOCK`] elements. The file has
//! a cap too: from the first event at which it would be passed, blocks are all that is kept.

use serde::{Deserialize, Serialize};

use crate::report::{Buffer, Difference, EventDelta};

const MAGIC: &[u8; 8] = b"LANCVALS";
const VERSION: u32 = 1;
/// Bytes before the payload: magic number, version, digest of the run, checksum.
const HEAD: usize = 8 + 4 + 32 + 16;
/// Elements of a buffer that is kept whole.
const ELEMENTS_CAP: usize = 4096;
/// Bytes of a file, when compressed.
const BYTES_CAP: usize = 64 << 10;
/// Elements behind one hash.
const BLOCK: usize = 64;
/// Bytes that a payload may inflate to: a hostile one must not fill the memory.
const INFLATED_CAP: usize = 256 << 20;

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
enum Kept {
    Whole(Buffer),
    Blocks { of: Buffer, count: u32, blocks: Vec<Block> },
}

/// The hash of some neighbouring elements of a buffer.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Block {
    first: u32,
    last: u32,
    hash: u64,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct KeptStage {
    stage: String,
    buffers: Vec<Kept>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct KeptEvent {
    event: u64,
    stages: Vec<KeptStage>,
}

/// The values of a run.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Values(Vec<KeptEvent>);

impl Kept {
    fn of(buffer: &Buffer, elements_cap: usize) -> Self {
        if buffer.ids.len() <= elements_cap {
            return Self::Whole(buffer.clone());
        }
        let of = Buffer::new(&buffer.name, &buffer.prefix, buffer.scalar, buffer.width);
        Self::Blocks { of, count: buffer.ids.len() as u32, blocks: blocks(buffer) }
    }

    fn form(&self) -> &Buffer {
        match self {
            Self::Whole(buffer) | Self::Blocks { of: buffer, .. } => buffer,
        }
    }

    fn first_difference(&self, found: &Buffer) -> Option<Difference> {
        let form = |b: &Buffer| format!("{:?} x {}", b.scalar, b.width);
        let (expected, found_form) = (form(self.form()), form(found));
        if expected != found_form {
            return Some(Difference { element: "all".into(), expected, found: found_form });
        }
        match self {
            Self::Whole(buffer) => buffer.first_difference(found),
            Self::Blocks { count, blocks, .. } => first_block(blocks, *count, found),
        }
    }

    /// Whether its bytes are those that its ids and form ask for.
    fn is_sound(&self) -> bool {
        let Self::Whole(buffer) = self else { return true };
        let stride = (buffer.width as usize).checked_mul(buffer.scalar.size());
        let bytes = stride.and_then(|stride| stride.checked_mul(buffer.ids.len()));
        bytes == Some(buffer.data.len()) && buffer.ids.is_sorted_by(|a, b| a < b)
    }
}

fn blocks(buffer: &Buffer) -> Vec<Block> {
    let elements = buffer.ids.chunks(BLOCK).zip(buffer.data.chunks((BLOCK * buffer.stride()).max(1)));
    elements
        .map(|(ids, data)| Block { first: ids[0], last: ids[ids.len() - 1], hash: hash(ids, data) })
        .collect()
}

fn hash(ids: &[u32], data: &[u8]) -> u64 {
    let mut hasher = blake3::Hasher::new();
    ids.iter().for_each(|id| {
        hasher.update(&id.to_le_bytes());
    });
    hasher.update(data);
    let mut first = [0; 8];
    hasher.finalize_xof().fill(&mut first);
    u64::from_le_bytes(first)
}

fn first_block(expected: &[Block], count: u32, found: &Buffer) -> Option<Difference> {
    let found_blocks = blocks(found);
    let longest = expected.len().max(found_blocks.len());
    let at = (0..longest).find(|&at| expected.get(at) != found_blocks.get(at))?;
    let text = |block: Option<&Block>, count: usize| match block {
        Some(block) => format!("{:016x} (block {at} of {count} elements)", block.hash),
        None => format!("no block {at} ({count} elements)"),
    };
    let named = expected.get(at).or(found_blocks.get(at))?;
    let prefix = &found.prefix;
    Some(Difference {
        element: format!("{prefix}{}..{prefix}{}", named.first, named.last),
        expected: text(expected.get(at), count as usize),
        found: text(found_blocks.get(at), found.ids.len()),
    })
}

impl Values {
    /// The values of a run, of which the first `whole` events are kept whole.
    fn of(deltas: &[EventDelta], whole: usize) -> Self {
        let event = |(at, delta): (usize, &EventDelta)| {
            let cap = if at < whole { ELEMENTS_CAP } else { BLOCK };
            let stages = delta.stages.iter().map(|s| KeptStage {
                stage: s.stage.clone(),
                buffers: s.buffers.iter().map(|b| Kept::of(b, cap)).collect(),
            });
            KeptEvent { event: delta.event as u64, stages: stages.collect() }
        };
        Self(deltas.iter().enumerate().map(event).collect())
    }

    /// The file of a run's values: as many events whole as the cap allows.
    pub(super) fn file(deltas: &[EventDelta], run_digest: &str) -> Vec<u8> {
        let payload = |whole| Self::of(deltas, whole).deflate();
        let all = payload(deltas.len());
        if all.len() <= BYTES_CAP {
            return seal(&all, run_digest);
        }
        // `low` events fit whole, or none does; `high` do not.
        let (mut low, mut high) = (0, deltas.len());
        while high - low > 1 {
            let middle = low.midpoint(high);
            if payload(middle).len() <= BYTES_CAP { low = middle } else { high = middle }
        }
        seal(&payload(low), run_digest)
    }

    fn deflate(&self) -> Vec<u8> {
        let plain = bincode::serde::encode_to_vec(&self.0, bincode::config::standard());
        let plain = plain.expect("lists, numbers and texts always have a form");
        miniz_oxide::deflate::compress_to_vec_zlib(&plain, 6)
    }

    /// Reads a file. An error says what is wrong with it.
    pub(super) fn read(file: &[u8], run_digest: &str) -> Result<Self, String> {
        let payload = unseal(file, run_digest)?;
        let plain = miniz_oxide::inflate::decompress_to_vec_zlib_with_limit(payload, INFLATED_CAP);
        let plain = plain.map_err(|e| format!("byte {HEAD}: it does not inflate: {e}"))?;
        let config = bincode::config::standard().with_limit::<INFLATED_CAP>();
        let (events, read): (Vec<KeptEvent>, usize) =
            bincode::serde::decode_from_slice(&plain, config).map_err(|e| format!("payload: {e}"))?;
        let sound = events.iter().flat_map(|e| &e.stages).flat_map(|s| &s.buffers).all(Kept::is_sound);
        if sound && read == plain.len() {
            Ok(Self(events))
        } else {
            Err("payload: a buffer is not what its ids ask for".into())
        }
    }

    /// Where a buffer differs from the one that is kept. An error says why that cannot be told.
    pub(super) fn first_difference(
        &self,
        event: usize,
        stage: &str,
        found: &Buffer,
    ) -> Result<Difference, &'static str> {
        let event =
            self.0.iter().find(|e| e.event == event as u64).ok_or("no values are kept of this event")?;
        let stage =
            event.stages.iter().find(|s| s.stage == stage).ok_or("no values are kept of this stage")?;
        let kept = stage.buffers.iter().find(|b| b.form().name == found.name);
        let kept = kept.ok_or("no values are kept of this buffer")?;
        kept.first_difference(found).ok_or("the values that are kept are the same")
    }
}

fn checksum(payload: &[u8]) -> [u8; 16] {
    let mut sum = [0; 16];
    blake3::Hasher::new().update(payload).finalize_xof().fill(&mut sum);
    sum
}

fn seal(payload: &[u8], run_digest: &str) -> Vec<u8> {
    let mut digest = [b' '; 32];
    digest.iter_mut().zip(run_digest.bytes()).for_each(|(to, from)| *to = from);
    [MAGIC, &VERSION.to_le_bytes()[..], &digest, &checksum(payload), payload].concat()
}

/// The payload of a file. An error says what is wrong around it.
fn unseal<'a>(file: &'a [u8], run_digest: &str) -> Result<&'a [u8], String> {
    let Some((head, payload)) = file.split_at_checked(HEAD) else {
        return Err(format!("byte {}: it ends within its head", file.len()));
    };
    let expected = seal(payload, run_digest);
    let wrong = |at: std::ops::Range<usize>| head[at.clone()] != expected[at];
    if wrong(0..8) {
        return Err("byte 0: it is no file of values".into());
    }
    if wrong(8..12) {
        return Err(format!("byte 8: its version is not {VERSION}"));
    }
    if wrong(44..60) {
        return Err("byte 44: its checksum does not match".into());
    }
    if wrong(12..44) {
        return Err("byte 12: it was written for another run than the text beside it".into());
    }
    Ok(payload)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::{Scalar, StageDelta};

    /// A coordinate whose bits do not compress.
    fn coordinate(salt: u32, id: u32) -> f64 {
        (hash(&[salt, id], &[]) >> 12) as f64
    }

    fn nodes(salt: u32, count: u32) -> Buffer {
        let mut buffer = Buffer::new("nodes", "n", Scalar::F64, 2);
        (0..count).for_each(|id| buffer.push_f64(id, &[coordinate(salt, id), id as f64]));
        buffer
    }

    fn run(events: u32, count: u32) -> Vec<EventDelta> {
        let stage = |event| StageDelta { stage: "MC".into(), buffers: vec![nodes(event, count)] };
        (0..events).map(|event| EventDelta { event: event as usize, stages: vec![stage(event)] }).collect()
    }

    fn read_back(events: u32, count: u32) -> Values {
        Values::read(&Values::file(&run(events, count), "d1"), "d1").expect("what was just written")
    }

    #[test]
    fn an_element_is_named_with_both_values() {
        let mut found = nodes(1, 10);
        let moved = coordinate(1, 7);
        found.data[7 * 16..7 * 16 + 8].copy_from_slice(&f64::from_bits(moved.to_bits() + 3).to_le_bytes());
        let difference = read_back(2, 10).first_difference(1, "MC", &found).expect("one differs");
        assert_eq!(difference.element, "n7");
        assert_eq!(difference.expected, format!("({moved:?}, 7.0)"));
        assert!(difference.found.ends_with("(3 ulp)"), "{}", difference.found);
    }

    #[test]
    fn a_large_buffer_names_its_block() {
        let mut found = nodes(0, 5000);
        found.data[130 * 16] ^= 1;
        let difference = read_back(1, 5000).first_difference(0, "MC", &found).expect("one differs");
        assert_eq!(difference.element, "n128..n191");
        assert_ne!(difference.expected, difference.found);
        found.ids.truncate(64);
        found.data.truncate(64 * 16);
        let shorter = read_back(1, 5000).first_difference(0, "MC", &found).expect("most is missing");
        assert_eq!(shorter.found, "no block 1 (64 elements)");
    }

    #[test]
    fn a_file_stays_under_its_cap_and_keeps_the_first_events_whole() {
        let file = Values::file(&run(40, 1000), "d1");
        assert!(file.len() <= BYTES_CAP + HEAD, "{} bytes", file.len());
        let values = Values::read(&file, "d1").expect("what was just written");
        let whole = |at: usize| matches!(values.0[at].stages[0].buffers[0], Kept::Whole(_));
        assert!(whole(0) && whole(1) && !whole(39));
    }

    #[test]
    fn damage_is_named() {
        let file = Values::file(&run(2, 10), "d1");
        for end in 0..file.len() {
            assert!(Values::read(&file[..end], "d1").is_err(), "cut off at byte {end}");
        }
        for at in 0..file.len() {
            let mut flipped = file.clone();
            flipped[at] ^= 4;
            assert!(Values::read(&flipped, "d1").is_err(), "byte {at}");
        }
        assert!(Values::read(&file, "d2").is_err_and(|e| e.contains("another run")));
    }

    #[test]
    fn an_unsound_payload_is_refused() {
        let spoil = |how: fn(&mut Buffer)| {
            let mut deltas = run(1, 10);
            how(&mut deltas[0].stages[0].buffers[0]);
            Values::read(&Values::file(&deltas, "d1"), "d1")
        };
        let spoilers: [fn(&mut Buffer); 3] =
            [|b| b.data.truncate(3), |b| b.ids.swap(2, 3), |b| b.width = u32::MAX];
        for how in spoilers {
            assert!(spoil(how).is_err_and(|e| e.starts_with("payload")));
        }
    }
}
