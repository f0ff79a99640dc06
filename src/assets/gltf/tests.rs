//! Documents made by hand, placed, mirrored, damaged.

use proptest::prelude::*;
use serde_json::{Value, json};

use super::*;
use crate::assets::error::Place;

/// A square (strip order) with texture coordinates, and indices of a list.
fn buffer() -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut put = |values: &[f32]| values.iter().for_each(|v| bytes.extend(v.to_le_bytes()));
    put(&[0., 0., 0., 1., 0., 0., 0., 1., 0., 1., 1., 0.]);
    put(&[0., 1., 1., 1., 0., 0., 1., 0.]);
    [0u16, 1, 3, 0, 3, 2].into_iter().for_each(|i| bytes.extend(i.to_le_bytes()));
    bytes
}

fn document() -> Value {
    json!({
        "asset": {"version": "2.0"}, "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [
            {"children": [1, 2], "translation": [10, 0, 0]},
            {"mesh": 0},
            {"mesh": 0, "scale": [-1, 1, 1]},
            {"mesh": 0}
        ],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 2}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
            {"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC2"},
            {"bufferView": 2, "componentType": 5123, "count": 6, "type": "SCALAR"}
        ],
        "bufferViews": [
            {"buffer": 0, "byteOffset": 0, "byteLength": 48},
            {"buffer": 0, "byteOffset": 48, "byteLength": 32},
            {"buffer": 0, "byteOffset": 80, "byteLength": 12}
        ],
        "buffers": [{"uri": "square.bin", "byteLength": 92}]
    })
}

fn read_value(document: &Value) -> Result<Soup, Fault> {
    read(document.to_string().as_bytes(), &[buffer()])
}

fn changed(path: &str, value: Value) -> Value {
    let mut document = document();
    let (parent, key) = path.rsplit_once('/').expect("a path");
    let parent = document.pointer_mut(parent).expect("an existing parent");
    match key.parse::<usize>() {
        Ok(index) => parent[index] = value,
        Err(_) => parent[key] = value,
    }
    document
}

#[test]
fn meshes_stand_where_the_nodes_of_the_scene_put_them() {
    let soup = read_value(&document()).expect("valid");
    // The third node belongs to no scene.
    assert_eq!(soup.mesh.faces, [[0, 1, 3], [0, 3, 2], [4, 7, 5], [4, 6, 7]]);
    assert_eq!(
        (soup.mesh.positions[3], soup.mesh.positions[7]),
        (DVec3::new(11., 1., 0.), DVec3::new(9., 1., 0.))
    );
    assert_eq!(soup.mesh.uvs[0], Vec2::ZERO, "the origin is bottom left");
    assert_eq!(soup.mesh.face_uvs, soup.mesh.faces);
    let area = |f: &[u32; 3]| {
        let [a, b, c] = f.map(|n| soup.mesh.positions[n as usize]);
        (b - a).cross(c - a).z
    };
    assert!(soup.mesh.faces.iter().all(|f| area(f) > 0.0), "what is mirrored is turned over");
}

#[test]
fn strips_fans_and_lists_without_indices_are_read() {
    let faces = |mode: u32, indexed: bool| {
        let mut document = changed("/meshes/0/primitives/0/mode", json!(mode));
        if !indexed {
            document["meshes"][0]["primitives"][0].as_object_mut().expect("an object").remove("indices");
        }
        document["nodes"][0]["children"] = json!([1]);
        read_value(&document).expect("valid").mesh.faces
    };
    assert_eq!(faces(5, false), [[0, 1, 2], [2, 1, 3]]);
    assert_eq!(faces(6, false), [[0, 1, 2], [0, 2, 3]]);
    assert_eq!(faces(4, false), [[0, 1, 2]]);
    assert_eq!(faces(6, true), [[0, 1, 3], [0, 3, 0], [0, 0, 3], [0, 3, 2]]);
    let lines = read_value(&changed("/meshes/0/primitives/0/mode", json!(1))).expect("valid");
    assert_eq!((lines.mesh.faces.len(), lines.notes[0].what.as_str()), (0, "primitive-without-faces"));
}

fn glb() -> Vec<u8> {
    let mut bare = document();
    bare["buffers"][0].as_object_mut().expect("an object").remove("uri");
    let header = gltf::binary::Header { magic: *b"glTF", version: 2, length: 0 };
    let glb = gltf::Glb { header, json: bare.to_string().into_bytes().into(), bin: Some(buffer().into()) };
    glb.to_vec().expect("a GLB")
}

#[test]
fn a_glb_and_a_data_uri_carry_their_bytes() {
    let uri = format!("data:application/octet-stream;base64,{}", {
        use base64::Engine as _;
        base64::engine::general_purpose::STANDARD.encode(buffer())
    });
    let embedded = changed("/buffers/0/uri", json!(uri)).to_string();
    assert!(
        matches!(&buffer_uris(embedded.as_bytes()).expect("valid")[..], [Uri::Data(d)] if *d == buffer())
    );
    let bytes = glb();
    assert!(matches!(&buffer_uris(&bytes).expect("valid")[..], [Uri::Data(d)] if d.starts_with(&buffer())));
    assert_eq!(read(&bytes, &[buffer()]).expect("valid").mesh.faces.len(), 4);
    let named = changed("/buffers/0/uri", json!("a%20b.bin")).to_string();
    let uris = buffer_uris(named.as_bytes()).expect("valid");
    assert!(matches!(&uris[..], [Uri::File(p)] if p.to_str() == Some("a b.bin")));
}

#[test]
fn accessors_that_point_astray_are_faults() {
    use FaultKind::{Index, Syntax, Truncated, Unsupported};
    for (path, value, kind) in [
        ("/accessors/0/count", json!(5), Truncated),
        ("/accessors/0/count", json!(u32::MAX), Truncated),
        ("/accessors/0/byteOffset", json!(u64::MAX / 2), Truncated),
        ("/accessors/2/byteOffset", json!(4), Truncated),
        ("/bufferViews/0/byteOffset", json!(u64::MAX / 2), Truncated),
        ("/bufferViews/0/byteStride", json!(4), Syntax),
        ("/accessors/1/componentType", json!(5121), Unsupported),
        ("/accessors/1/count", json!(3), Syntax),
        ("/accessors/0/type", json!("VEC2"), Syntax),
        ("/accessors/2/type", json!("VEC2"), Syntax),
        ("/accessors/2/componentType", json!(5121), Index),
        ("/accessors/0/bufferView", json!(9), Syntax),
        ("/meshes/0/primitives/0/attributes", json!({"POSITION": 3}), Index),
        ("/meshes/0/primitives/0/indices", json!(3), Syntax),
        ("/nodes/1/children", json!([0]), Syntax),
        ("/buffers/0/byteLength", json!(0), Syntax),
    ] {
        let mut document = changed(path, value.clone());
        if path.ends_with("2/componentType") {
            // Halves of indices: one of them must be too large.
            document["accessors"][2]["byteOffset"] = json!(0);
            document["bufferViews"][2]["byteOffset"] = json!(42);
        }
        match read_value(&document) {
            Err(fault) => assert_eq!(fault.kind, kind, "{path} {value}: {fault}"),
            Ok(_) => assert_eq!(path, "/buffers/0/byteLength", "{path} {value}"),
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(300) })]

    /// Whatever is changed in a good file, document or buffer: a soup or a fault.
    #[test]
    fn damage_is_no_panic(at in any::<prop::sample::Index>(), byte in any::<u8>(), cut in any::<prop::sample::Index>()) {
        let mut text = document().to_string().into_bytes();
        let at = at.index(text.len());
        text[at] = byte;
        let data = buffer();
        let _ = buffer_uris(&text);
        if let Ok(soup) = read(&text, &[data[..cut.index(data.len() + 1)].to_vec()]) {
            let _ = super::super::repair::build(soup, super::super::weld::Rule::Position);
        }
    }

    /// The same for the frame of a GLB.
    #[test]
    fn a_damaged_glb_is_no_panic(at in 0usize..40, byte in any::<u8>(), cut in any::<prop::sample::Index>()) {
        let mut bytes = glb();
        bytes[at] = byte;
        let _ = buffer_uris(&bytes);
        bytes.truncate(cut.index(bytes.len()));
        let _ = buffer_uris(&bytes);
    }
}

#[test]
fn a_mesh_that_is_shown_more_often_than_the_file_justifies_is_refused() {
    let parsed = parse(document().to_string().as_bytes()).expect("valid").document;
    let buffers = [buffer()];
    let show = |most: usize| Collector { buffers: &buffers, most, ..Collector::new() }.scene(&parsed);
    // Two squares of four nodes.
    assert_eq!(show(8), Ok(()));
    assert_eq!(show(7).map_err(|fault| fault.kind), Err(FaultKind::TooLarge));
}

#[test]
fn a_binary_file_that_says_it_is_shorter_than_its_head_is_refused() {
    for length in [0u32, 2, 11] {
        let bytes = [&b"glTF\x02\0\0\0"[..], &length.to_le_bytes(), b"\0\0\0\0JSON"].concat();
        assert_eq!(read(&bytes, &[]).map_err(|fault| fault.place).err(), Some(Place::Byte(8)), "{length}");
    }
}
