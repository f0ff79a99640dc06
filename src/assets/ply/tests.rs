//! The three encodings, what is stepped over, and what is refused.

use proptest::prelude::*;

use super::*;

const ASCII: &str = "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 4\nproperty float x\nproperty float y\n\
    property float z\nproperty uchar red\nproperty float s\nproperty float t\nelement thing 2\nproperty list uchar int of\n\
    element empty 4000000000\nelement face 2\nproperty list uchar int vertex_indices\nproperty int part\nend_header\n\
    0 0 0 255 0 0\n1 0 0 255 1 0\n1 1 0 255 1 1\n0 1 0.1 255 0 1\n2 7 7\n0\n3 0 1 2 5\n4 0 1 2 3 5\n";

fn header(format: &str, vertices: u64, faces: u64) -> Vec<u8> {
    format!(
        "ply\r\nformat {format} 1.0\r\nelement vertex {vertices}\r\nproperty double x\r\nproperty float32 y\r\n\
         property int16 z\r\nelement face {faces}\r\nproperty list uint16 int8 vertex_index\r\n\
         property list uchar float texcoord\r\nend_header\r\n"
    )
    .into_bytes()
}

/// Three nodes and a face, in one byte order.
fn binary(big: bool) -> Vec<u8> {
    let mut bytes = header(if big { "binary_big_endian" } else { "binary_little_endian" }, 3, 1);
    let mut put = |mut little: Vec<u8>| {
        if big {
            little.reverse();
        }
        bytes.extend(little);
    };
    for (x, y, z) in [(0.1f64, 0.5f32, -1i16), (1.0, 0.0, 2), (0.0, 1.0, 300)] {
        put(x.to_le_bytes().into());
        put(y.to_le_bytes().into());
        put(z.to_le_bytes().into());
    }
    put(3u16.to_le_bytes().into());
    [0u8, 1, 2].into_iter().for_each(|n| put(vec![n]));
    put(vec![6]);
    [0.0f32, 0.25, 1.0, 0.5, 0.5, 1.0].into_iter().for_each(|v| put(v.to_le_bytes().into()));
    bytes
}

#[test]
fn ascii_is_read_and_strangers_are_stepped_over() {
    let soup = read(ASCII.as_bytes()).expect("valid");
    assert_eq!(soup.mesh.positions[3], DVec3::new(0.0, 1.0, 0.1));
    assert_eq!(soup.mesh.faces, [[0, 1, 2], [0, 1, 2], [0, 2, 3]]);
    assert_eq!((soup.mesh.face_uvs.clone(), soup.mesh.uvs[3]), (soup.mesh.faces.clone(), Vec2::Y));
    assert_eq!(soup.origin, [0, 1, 1]);
}

#[test]
fn both_byte_orders_are_read() {
    for big in [false, true] {
        let soup = read(&binary(big)).expect("valid");
        assert_eq!(soup.mesh.positions[0], DVec3::new(0.1, 0.5, -1.0));
        assert_eq!((soup.mesh.positions[2].z, soup.mesh.faces), (300.0, vec![[0, 1, 2]]));
        assert_eq!(soup.mesh.uvs, [Vec2::new(0.0, 0.25), Vec2::new(1.0, 0.5), Vec2::new(0.5, 1.0)]);
    }
}

#[test]
fn every_cut_is_a_fault() {
    for whole in [binary(false), binary(true), ASCII.as_bytes().to_vec()] {
        // Without its last blank an ASCII file is whole.
        for end in 0..whole.len() - 1 {
            assert!(read(&whole[..end]).is_err(), "cut at {end}");
        }
    }
}

#[test]
fn huge_counts_allocate_nothing() {
    for format in ["ascii", "binary_little_endian"] {
        for (vertices, faces) in [(u64::MAX, 1), (3, u64::MAX), (0, u64::MAX)] {
            let fault = read(&header(format, vertices, faces)).expect_err("nothing there");
            assert_eq!(fault.kind, FaultKind::Truncated, "{fault}");
        }
    }
    let list = ASCII.replace("3 0 1 2 5", "4000000000 0 1 2 5");
    assert_eq!(read(list.as_bytes()).expect_err("too long").kind, FaultKind::Truncated);
}

#[test]
fn faults_name_their_place() {
    let fault = |from: &str, to: &str| {
        let fault = read(ASCII.replacen(from, to, 1).as_bytes()).expect_err(to);
        (fault.place, fault.kind)
    };
    use FaultKind::{Index, Number, Syntax, Unsupported};
    assert_eq!(fault("ply", "plx"), (Place::Line(1), Syntax));
    assert_eq!(fault("ascii", "utf16"), (Place::Line(2), Syntax));
    assert_eq!(fault("element vertex 4", "element vertex x"), (Place::Line(4), Syntax));
    assert_eq!(fault("property float x", "property quad x"), (Place::Line(5), Syntax));
    assert_eq!(fault("property float x", "property float w"), (Place::Whole, Syntax));
    assert_eq!(fault("1 0 0 255 1 0", "1 0 x 255 1 0"), (Place::Line(19), Number));
    assert_eq!(fault("3 0 1 2 5", "3 0 1 9 5"), (Place::Face(0), Index));
    assert_eq!(fault("4 0 1 2 3 5", "4 0 1 -2 3 5"), (Place::Face(1), Index));
    assert_eq!(fault("3 0 1 2 5", "2 0 1 5"), (Place::Face(0), Syntax));
    assert_eq!(fault("element thing", "element tristrips"), (Place::Whole, Unsupported));
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(300) })]

    /// Whatever is flipped in a good file: a soup or a fault.
    #[test]
    fn damage_is_no_panic(at in 0usize..400, byte in any::<u8>(), which in 0usize..3) {
        let mut bytes = vec![binary(false), binary(true), ASCII.as_bytes().to_vec()].swap_remove(which);
        let at = at % bytes.len();
        bytes[at] = byte;
        let _ = read(&bytes);
    }

    #[test]
    fn garbage_behind_a_header_is_no_panic(bytes in proptest::collection::vec(any::<u8>(), 0..300), big in any::<bool>()) {
        let mut file = header(if big { "binary_big_endian" } else { "binary_little_endian" }, 3, 2);
        file.extend(bytes);
        if let Ok(soup) = read(&file) {
            let _ = super::super::repair::build(soup, super::super::weld::Rule::Position);
        }
    }
}
