//! The two forms of a recording say the same.

use std::collections::BTreeMap;
use std::path::Path;

use proptest::prelude::*;

use super::{EVERYTHING, everything, pack, parse, text};
use crate::engine::Event;
use crate::engine::wound::{CameraChange, Mode, Pick, Value, WoundEvent};
use crate::mesh::{EdgeId, FaceId, NodeId};
use crate::recording::{
    AnyRecording, InlineMesh, Keyed, Recording, SceneRef, Script, WriteError, first_difference, read,
    to_bytes,
};

#[test]
fn the_script_comes_back_letter_by_letter() {
    assert_eq!(text(&parse(EVERYTHING)), EVERYTHING);
    assert_eq!(text(&Script::of(&read(&everything()).unwrap())), EVERYTHING);
}

#[test]
fn what_could_not_be_read_is_not_written() {
    let AnyRecording::Wound(mut recording) = pack(EVERYTHING);
    recording.events[2].event = WoundEvent::Click([f64::INFINITY, 0.0]);
    let any = AnyRecording::Wound(recording);
    let expected = "events[2].click: inf is not a finite number";
    assert!(matches!(to_bytes(&any), Err(WriteError::Invalid(what)) if what == expected));
    let script = Script::of(&any).write(&mut Vec::new());
    assert!(matches!(script, Err(WriteError::Invalid(what)) if what == expected));
}

#[test]
fn a_scene_is_found_from_another_folder() {
    let mesh = |path: &str| SceneRef::Mesh(path.into());
    let moved = |path: &str, to: &str| mesh(path).moved(Path::new("/a/b"), Path::new(to));
    assert_eq!(moved("head.obj", "/a/b"), mesh("head.obj"));
    assert_eq!(moved("head.obj", "/a"), mesh("b/head.obj"));
    assert_eq!(moved("../head.obj", "/a/b/c/d"), mesh("../../../head.obj"));
    assert_eq!(moved("./x/../head.obj", "/z"), mesh("../a/b/head.obj"));
    assert_eq!(moved("/head.obj", "/z"), mesh("/head.obj"));
}

fn number() -> impl Strategy<Value = f64> {
    prop_oneof![any::<f64>().prop_filter("finite", |v| v.is_finite()), -10.0..10.0f64, Just(-0.0)]
}

fn unit() -> impl Strategy<Value = f64> {
    prop_oneof![0.0..=1.0f64, Just(-0.0)]
}

fn pick() -> impl Strategy<Value = Pick> {
    prop_oneof![
        [number(), number()].prop_map(Pick::Pixel),
        any::<u32>().prop_map(|n| Pick::Node(NodeId(n))),
        (any::<u32>(), unit()).prop_map(|(e, t)| Pick::Edge(EdgeId(e), t)),
        (any::<u32>(), 0.0..0.5f64, 0.0..0.5f64).prop_map(|(f, u, v)| Pick::Face(FaceId(f), u, v)),
    ]
}

fn camera() -> impl Strategy<Value = CameraChange> {
    let distance = prop::option::of(1e-9..1e9f64);
    (prop::option::of(number()), prop::option::of(0.0..=std::f64::consts::PI), distance)
        .prop_map(|(azimuth, zenith, distance)| CameraChange { azimuth, zenith, distance })
}

fn settings() -> impl Strategy<Value = BTreeMap<String, Value>> {
    let snap = prop::option::of(number().prop_map(f64::abs));
    let shadows = prop::option::of(any::<bool>());
    (snap, shadows).prop_map(|(snap, shadows)| {
        let snap = snap.map(|v| ("snap_px".into(), Value::Number(v)));
        snap.into_iter().chain(shadows.map(|v| ("shadows".into(), Value::Switch(v)))).collect()
    })
}

fn event() -> impl Strategy<Value = WoundEvent> {
    prop_oneof![
        camera().prop_map(WoundEvent::Camera),
        prop::sample::select(vec![Mode::Patch, Mode::Merge, Mode::Carve]).prop_map(WoundEvent::Mode),
        [number(), number()].prop_map(WoundEvent::Click),
        (pick(), pick()).prop_map(|(from, to)| WoundEvent::Cut { from, to }),
        ([number(), number()], prop::sample::select(vec![3, 4, 6]))
            .prop_map(|(at, into)| WoundEvent::Subdivide { at, into }),
        Just(WoundEvent::Undo {}),
        Just(WoundEvent::Redo {}),
        settings().prop_map(WoundEvent::Set),
        "[a-z0-9-]{1,64}".prop_map(WoundEvent::Checkpoint),
    ]
}

fn inline() -> impl Strategy<Value = InlineMesh> {
    let uv = any::<[f32; 2]>().prop_filter("finite", |uv| uv.iter().all(|v| v.is_finite()));
    let nodes = prop::collection::vec([number(), number(), number()], 0..4);
    let faces = prop::collection::vec(any::<[u32; 3]>(), 0..4);
    (nodes, faces, prop::collection::vec(uv, 0..4)).prop_map(|(nodes, faces, uv)| InlineMesh {
        nodes,
        faces,
        uv,
    })
}

fn scene() -> impl Strategy<Value = SceneRef> {
    prop_oneof![
        "[a-z:0-9\\PC]{1,20}".prop_map(SceneRef::Builtin),
        "\\PC{0,20}".prop_map(|path| SceneRef::File(path.into())),
        "\\PC{0,20}".prop_map(|path| SceneRef::Mesh(path.into())),
        inline().prop_map(SceneRef::Inline),
    ]
}

prop_compose! {
    fn recording()(
        scene in scene(), scene_hash: [u8; 32], mesh_hash: [u8; 32], viewport in [1..=16384u32, 1..=16384u32],
        seed: u64, shifted: bool, events in prop::collection::vec((any::<u32>(), event()), 0..8),
    ) -> Recording<WoundEvent> {
        let keyed = (0..).zip(events).map(|(i, (key, event))| Keyed { key: if shifted { key } else { i }, event });
        Recording { scene, scene_hash, mesh_hash, viewport, seed, events: keyed.collect() }
    }
}

proptest! {
    #[test]
    fn file_and_script_and_back(recording in recording()) {
        prop_assume!(recording.validate().is_ok());
        prop_assert!(recording.events.iter().all(|k| k.event.validate().is_ok()));
        let any = AnyRecording::Wound(recording);
        let bytes = to_bytes(&any).unwrap();
        prop_assert_eq!(&read(&bytes).unwrap(), &any);
        let [scene, mesh] = any.hashes();
        let again = parse(&text(&Script::of(&any))).pack(|_| Ok::<_, ()>((scene, mesh))).unwrap();
        prop_assert_eq!(to_bytes(&again).unwrap(), bytes);
    }

    #[test]
    fn any_bytes_give_an_error(bytes: Vec<u8>) {
        prop_assert!(read(&bytes).is_err());
        prop_assert!(Script::parse(&bytes).is_err());
    }
}

#[test]
fn the_first_difference_is_named() {
    let difference = |text: &str| first_difference(&pack(EVERYTHING), &pack(text)).map(|d| d.to_string());
    assert_eq!(difference(EVERYTHING), None);
    assert_eq!(difference(&EVERYTHING.replace("7,", "8,")).unwrap(), "seed: 7 against 8");
    let moved = difference(&EVERYTHING.replace("300.25", "300.5")).unwrap();
    assert_eq!(
        moved,
        r#"events[2]: {"click":[640.5,300.25]} (key 2) against {"click":[640.5,300.5]} (key 2)"#
    );
    let shorter = EVERYTHING.replace(",\n    {\"checkpoint\": \"after-first-cut\"}", "");
    let shorter = difference(&shorter).unwrap();
    assert!(shorter.starts_with("events[9]: ") && shorter.ends_with(" against nothing"), "{shorter}");
}
