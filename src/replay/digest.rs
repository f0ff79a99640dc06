//! Digests of what a run did. All are blake3, written as the first 128 bits in hexadecimal.
//!
//! A buffer's digest covers its name, type, ids and canonical values. A stage's covers its buffers' digests and nothing of other
//! stages, so that a stage or buffer added later changes none that exists. A run's covers every event's outcome and
//! reason, the digests of its stages, and the state at the end; never a time.

use std::collections::BTreeMap;

use crate::report::{Buffer, EventReport, Outcome, StateReport};

/// The seed of an event: the first 8 bytes, little-endian, of the hash of the recording's seed, the event's key and a purpose.
pub fn event_seed(recording_seed: u64, key: u32, purpose: &str) -> u64 {
    let mut hasher = blake3::Hasher::new();
    hasher.update(&recording_seed.to_le_bytes());
    hasher.update(&key.to_le_bytes());
    hasher.update(purpose.as_bytes());
    let mut first = [0; 8];
    hasher.finalize_xof().fill(&mut first);
    u64::from_le_bytes(first)
}

/// The digests of some buffers by name, and of all together.
pub(super) fn of_buffers(buffers: &[Buffer]) -> (String, BTreeMap<String, String>) {
    let mut hasher = blake3::Hasher::new();
    let mut by_name = BTreeMap::new();
    for buffer in buffers {
        let digest = buffer.digest();
        hasher.update(digest.as_bytes());
        by_name.insert(buffer.name.clone(), text(digest));
    }
    (text(hasher.finalize()), by_name)
}

/// The digest of a run.
pub(super) fn of_run(events: &[EventReport], end: Option<&StateReport>) -> String {
    let mut hasher = blake3::Hasher::new();
    for event in events {
        hasher.update(&[outcome_code(event.outcome)]);
        word(&mut hasher, event.reason.as_deref().unwrap_or(""));
        let stages = event.stages.iter().filter_map(|s| Some((s.id.as_str(), s.digest.as_deref()?)));
        stages.for_each(|(id, digest)| {
            word(&mut hasher, id);
            word(&mut hasher, digest);
        });
    }
    word(&mut hasher, end.map_or("", |end| &end.digest));
    text(hasher.finalize())
}

/// Hashes a text after its length, so that no two lists of words hash alike.
fn word(hasher: &mut blake3::Hasher, text: &str) {
    hasher.update(&(text.len() as u64).to_le_bytes());
    hasher.update(text.as_bytes());
}

fn outcome_code(outcome: Outcome) -> u8 {
    match outcome {
        Outcome::None => 0,
        Outcome::Applied => 1,
        Outcome::Rejected => 2,
        Outcome::Pending => 3,
        Outcome::Cancelled => 4,
    }
}

fn text(digest: blake3::Hash) -> String {
    digest.to_hex()[..32].into()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::{Rejection, Scalar, StageReport};

    #[test]
    fn an_events_seed_depends_on_seed_key_and_purpose_alone() {
        let seed = event_seed(7, 3, "cut");
        let mut hasher = blake3::Hasher::new();
        hasher.update(&[7, 0, 0, 0, 0, 0, 0, 0, 3, 0, 0, 0, b'c', b'u', b't']);
        assert_eq!(seed.to_le_bytes(), hasher.finalize().as_bytes()[..8]);
        assert_ne!(seed, event_seed(8, 3, "cut"));
        assert_ne!(seed, event_seed(7, 4, "cut"));
        assert_ne!(seed, event_seed(7, 3, "paint"));
    }

    #[test]
    fn a_further_buffer_leaves_the_others_digests() {
        let mut nodes = Buffer::new("nodes", "n", Scalar::F64, 1);
        nodes.push_f64(3, &[0.5]);
        let faces = Buffer::new("faces", "f", Scalar::U32, 3);
        let (_, one) = of_buffers(std::slice::from_ref(&nodes));
        let (_, two) = of_buffers(&[nodes, faces]);
        assert_eq!(one["nodes"], two["nodes"]);
        assert_eq!(one["nodes"].len(), 32);
    }

    #[test]
    fn a_runs_digest_sees_reasons_and_stages_but_no_times() {
        let mut event = EventReport::new(0, "cut");
        event.stages.push(StageReport { digest: Some("aa".into()), ..StageReport::skipped("FC", "") });
        let digest = |e: &EventReport| of_run(std::slice::from_ref(e), None);
        let plain = digest(&event);
        event.stages[0].us = 5.0;
        assert_eq!(digest(&event), plain);
        event.stages[0].digest = Some("ab".into());
        assert_ne!(digest(&event), plain);
        event.stages[0].digest = Some("aa".into());
        event.reject(Rejection::new("miss", ""));
        let miss = digest(&event);
        event.reason = Some("silhouette".into());
        assert!(miss != plain && miss != digest(&event));
    }
}
