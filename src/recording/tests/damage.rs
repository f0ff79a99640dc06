//! A damaged file is never taken for a recording: every cut, every changed byte, and what a forged checksum could bring in.

use super::{everything, pack};
use crate::engine::wound::WoundEvent;
use crate::recording::frame::{Frames, Kind, VERSION};
use crate::recording::{AnyRecording, Cause, ReadError, Recording, read};

fn events(any: &AnyRecording) -> &Recording<WoundEvent> {
    let AnyRecording::Wound(recording) = any;
    recording
}

/// What is said to be valid must be a part of what was written.
fn assert_prefix(error: &ReadError, whole: &AnyRecording) {
    let (Some(prefix), whole) = (&error.prefix, events(whole)) else { return assert!(error.frame <= 1) };
    let prefix = events(prefix);
    assert_eq!(prefix.events, whole.events[..prefix.events.len()]);
    assert_eq!(prefix, &whole.with_events(prefix.events.clone()));
    assert_eq!(error.frame, prefix.events.len() as u64 + 2, "the frame after the valid ones is named");
}

#[test]
fn cut_off_anywhere() {
    let bytes = everything();
    let whole = read(&bytes).unwrap();
    for length in 0..bytes.len() {
        let error = read(&bytes[..length]).unwrap_err();
        assert!(matches!(error.cause, Cause::CutOff { missing } if missing > 0), "{length}: {error}");
        assert_eq!(error.offset, length as u64);
        assert_prefix(&error, &whole);
    }
}

#[test]
fn any_byte_changed() {
    let bytes = everything();
    let whole = read(&bytes).unwrap();
    let mut damaged = bytes.clone();
    for at in 0..bytes.len() {
        for change in 1..=255 {
            damaged[at] = bytes[at] ^ change;
            let error = read(&damaged).unwrap_err();
            let cut_off = matches!(error.cause, Cause::CutOff { .. });
            assert!(cut_off || error.offset <= at as u64, "byte {at} ^ {change}: {error}");
            assert_prefix(&error, &whole);
        }
        damaged[at] = bytes[at];
    }
}

#[test]
fn something_appended() {
    let mut bytes = everything();
    let length = bytes.len() as u64;
    bytes.push(0);
    let error = read(&bytes).unwrap_err();
    assert_eq!((error.offset, error.cause), (length, Cause::Trailing { bytes: 1 }));
    assert_eq!(error.prefix, Some(read(&everything()).unwrap()));
}

/// Where each frame of a file lies.
fn frames(bytes: &[u8]) -> Vec<std::ops::Range<usize>> {
    let mut at = 8 + 4 + 1 + "wound".len() + 8;
    let mut frames = Vec::new();
    while at < bytes.len() {
        let length = u32::from_le_bytes(bytes[at + 1..at + 5].try_into().unwrap()) as usize;
        frames.push(at..at + 5 + length + 8);
        at += 5 + length + 8;
    }
    frames
}

#[test]
fn a_frame_left_out_doubled_or_moved() {
    let bytes = everything();
    let all = frames(&bytes);
    let [a, b] = [all[3].clone(), all[4].clone()];
    let (head, tail) = (&bytes[..a.start], &bytes[b.end..]);
    let (a, b) = (&bytes[a], &bytes[b]);
    for middle in [vec![b], vec![a, a, b], vec![b, a]] {
        let error = read(&[head, &middle.concat(), tail].concat()).unwrap_err();
        assert_eq!(error.cause, Cause::Checksum);
    }
}

#[test]
fn the_head_says_what_it_is_not() {
    assert_eq!(read(b"\x89PNG\r\n\x1a\n").unwrap_err().cause, Cause::NotARecording);
    let mut newer = everything();
    newer[8] = VERSION as u8 + 1;
    let error = read(&newer).unwrap_err();
    assert_eq!((error.offset, error.cause), (8, Cause::UnknownVersion(VERSION + 1)));
    let mut other = Vec::new();
    Frames::begin(&mut other, "cheese").unwrap();
    assert_eq!(read(&other).unwrap_err().cause, Cause::UnknownEngine("cheese".into()));
}

/// A file whose checksums are right, whatever is in it.
fn forged(payloads: &[(Kind, &[u8])]) -> ReadError {
    let mut bytes = Vec::new();
    let mut frames = Frames::begin(&mut bytes, "wound").unwrap();
    payloads.iter().for_each(|(kind, payload)| frames.frame(*kind, payload).unwrap());
    *read(&bytes).unwrap_err()
}

/// The payload of the scene frame of a whole file.
fn scene() -> Vec<u8> {
    let bytes = everything();
    let frame = frames(&bytes)[0].clone();
    bytes[frame.start + 5..frame.end - 8].to_vec()
}

#[test]
fn forged_lengths_allocate_nothing() {
    // A built-in scene whose name is said to be as long as a length can be.
    let name = [&[0; 4][..], &[0xff; 8]].concat();
    assert!(matches!(forged(&[(Kind::Scene, &name)]).cause, Cause::Malformed(_)));
    let inline = [&[3, 0, 0, 0][..], &[0xff, 0xff, 0xff, 0xff, 0, 0, 0, 0]].concat();
    assert!(matches!(forged(&[(Kind::Scene, &inline)]).cause, Cause::Malformed(_)));
}

#[test]
fn forged_frames_are_named() {
    let scene = scene();
    assert_eq!(forged(&[(Kind::Event, &scene)]).cause, Cause::WrongKind(2));
    assert_eq!(forged(&[(Kind::Scene, &scene), (Kind::Scene, &scene)]).cause, Cause::WrongKind(1));
    let longer = [&scene[..], &[0]].concat();
    assert!(matches!(forged(&[(Kind::Scene, &longer)]).cause, Cause::Malformed(_)));
    let count = forged(&[(Kind::Scene, &scene), (Kind::End, &3u64.to_le_bytes())]);
    assert_eq!(count.cause, Cause::Count { said: 3, found: 0 });
}

#[test]
fn forged_values_are_looked_at_as_a_scripts_are() {
    // Key 0, a click on a pixel that is no number.
    let click = [&[0; 4][..], &[2, 0, 0, 0], &f64::NAN.to_le_bytes(), &[0; 8]].concat();
    let error = forged(&[(Kind::Scene, &scene()), (Kind::Event, &click)]);
    assert!(matches!(&error.cause, Cause::Invalid(what) if what.starts_with("click: ")), "{error}");
    let narrow = pack(r#"{"version": 1, "scene": "builtin:bust", "viewport": [1, 16384], "events": []}"#);
    let mut payload = scene();
    let viewport = payload.len() - 16;
    payload[viewport..viewport + 4].fill(0);
    assert!(matches!(forged(&[(Kind::Scene, &payload)]).cause, Cause::Invalid(_)));
    assert_eq!(narrow.viewport(), [1, 16384]);
    // An inline mesh of no nodes, no faces, and one corner in the texture.
    let uv =
        |v: f32| [&[3, 0, 0, 0][..], &[0; 16], &[1, 0, 0, 0, 0, 0, 0, 0], &v.to_le_bytes(), &[0; 4]].concat();
    let inline = |v: f32| [&uv(v)[..], &[0; 64], &[1, 0, 0, 0, 1, 0, 0, 0], &[0; 8]].concat();
    assert!(matches!(forged(&[(Kind::Scene, &inline(0.5))]).cause, Cause::CutOff { .. }));
    let error = forged(&[(Kind::Scene, &inline(f32::NAN))]);
    assert!(error.to_string().contains("scene.inline.uv[0]: [NaN, 0.0] is not a place"), "{error}");
}

#[test]
fn errors_read_well() {
    let bytes = everything();
    let error = read(&bytes[..bytes.len() - 1]).unwrap_err().to_string();
    let length = bytes.len() - 1;
    let expected = format!(
        "byte {length}, frame 12 (after 10 events): the file ends here; bytes missing: at least 1, or a length is damaged"
    );
    assert_eq!(error, expected);
}
