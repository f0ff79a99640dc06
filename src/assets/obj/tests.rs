//! What an OBJ file may look like, and what is said where it may not.

use proptest::prelude::*;

use super::super::error::Place;
use super::*;

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

fn soup(text: &str) -> Soup {
    read(text.as_bytes()).unwrap_or_else(|fault| panic!("{fault} in {text:?}"))
}

fn faces(text: &str) -> Vec<[u32; 3]> {
    soup(text).mesh.faces
}

fn fault(text: &str) -> (Place, FaultKind) {
    let fault = read(text.as_bytes()).expect_err(text);
    (fault.place, fault.kind)
}

#[test]
fn corners_come_in_all_forms() {
    let head = format!("{SQUARE}vt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 1\n");
    for corners in ["1/1 2/2 3/3", "1/1/1 2/2/1 3/3/1", "-4/-3 -3/-2 -2/-1", "+1/1/ 2/2/ 3/3/"] {
        let soup = soup(&format!("{head}f {corners}\n"));
        assert_eq!((soup.mesh.faces, soup.mesh.face_uvs), (vec![[0, 1, 2]], vec![[0, 1, 2]]), "{corners}");
    }
    for corners in ["1 2 3", "1//1 2//1 3//1", "1// 2// 3//", "1/ 2/ 3/", "-4 -3 -2"] {
        let soup = soup(&format!("{head}f {corners}\n"));
        assert_eq!((soup.mesh.faces, soup.mesh.uvs), (vec![[0, 1, 2]], vec![]), "{corners}");
    }
}

#[test]
fn layout_does_not_matter() {
    let expected = vec![[0, 1, 2], [0, 2, 3]];
    for text in [
        format!("{SQUARE}f 1 2 3 4"),
        format!("# a comment\n\n{SQUARE}f 1 2 3 4 # behind it\n").replace('\n', "\r\n"),
        format!("\u{feff}{SQUARE}f\t1  2\t3 4   \n"),
        format!("{SQUARE}f 1 2 \\\n 3 \\\r\n4\n"),
        format!("g a b\no x\ns off\nusemtl m\nmtllib \\\n v 1 1 1\nl 1 2\n{SQUARE}f 1 2 3 4\n"),
        format!("f 1 2 3 4\n{SQUARE}"),
    ] {
        assert_eq!(faces(&text), expected, "{text:?}");
    }
}

#[test]
fn numbers_are_read_to_the_nearest_float() {
    let text = "v .8e-1 -.7e+2 +1\nv 2.e1 2. -0\nv 0.1 1e-320 123456789012345678901234567890\nf 1 2 3\n";
    let positions = soup(text).mesh.positions;
    assert_eq!(positions[0], DVec3::new(0.08, -70.0, 1.0));
    assert_eq!(positions[1].to_array().map(f64::to_bits), [20.0f64, 2.0, 0.0].map(f64::to_bits), "−0 is 0");
    assert_eq!(positions[2], DVec3::new(0.1, 1e-320, 123456789012345678901234567890.0));
}

#[test]
fn weights_and_colours_are_passed_over() {
    let text = "v 0 0 0 1\nv 1 0 0 0.5 0.5 0.5\nv 0 1 0 1 .1 .2 .3\nvt 1\nvt 1 2 3\nf 1 2 3\n";
    assert_eq!(soup(text).mesh.positions[1], DVec3::X);
}

#[test]
fn corners_without_texture_coordinate_are_completed_and_noted() {
    let soup = soup(&format!("{SQUARE}vt .5 .5\nf 1/1 2/1 3/1\nf 1 3/1 4\n"));
    assert_eq!(soup.mesh.face_uvs, [[0, 0, 0], [1, 0, 1]]);
    assert_eq!(soup.mesh.uvs[1], Vec2::ZERO);
    assert_eq!((soup.notes[0].what.as_str(), soup.notes[0].count), ("texture-coordinate-missing", 2));
}

#[test]
fn unknown_statements_are_noted_with_their_line() {
    let soup = soup(&format!("{SQUARE}frob 1 2\nfrob 3\nf 1 2 3\n"));
    assert_eq!((soup.notes[0].what.as_str(), soup.notes[0].count), ("statement-unknown", 2));
    assert!(soup.notes[0].detail.contains("line 5"), "{}", soup.notes[0].detail);
}

#[test]
fn errors_name_the_line_and_the_kind() {
    use FaultKind::{Index, Number, Syntax};
    for (statement, kind) in [
        ("v 1 2", Syntax),
        ("v 1 2 x", Number),
        ("v 1 2 3.1+e2", Number),
        ("v 1 2 3 4 5 6 7 8 9", Syntax),
        ("v 1.#IND 0 0", Number),
        ("vt", Syntax),
        ("f", Syntax),
        ("f 1 2", Syntax),
        ("f 1 2 0", Index),
        ("f 1 2 9", Index),
        ("f 1 2 -5", Index),
        ("f 1/9 2/9 3/9", Index),
        ("f 1 2 3x", Syntax),
        ("f 1 2 x", Number),
        ("f 1 2 3/x", Number),
        ("f 1 2 3////", Syntax),
        ("f 1 2 99999999999999999999", Number),
        ("f 1 2 4294967296", Index),
    ] {
        assert_eq!(fault(&format!("{SQUARE}{statement}\nf 1 2 3\n")), (Place::Line(5), kind), "{statement}");
    }
}

#[test]
fn a_continued_line_is_counted() {
    assert_eq!(fault(&format!("{SQUARE}f 1 \\\n2 \\\n3\nv x")), (Place::Line(8), FaultKind::Number));
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(300) })]

    /// Whatever the bytes: a soup or a fault.
    #[test]
    fn garbage_is_no_panic(bytes in proptest::collection::vec(any::<u8>(), 0..200)) {
        let _ = read(&bytes);
    }

    /// The same close to the grammar, and the result can be repaired or refused.
    #[test]
    fn almost_obj_is_no_panic(words in proptest::collection::vec(
        prop_oneof![
            Just("v"), Just("f"), Just("vt"), Just("\n"), Just("\nv 0 0 0"), Just("\nv 1 0 0"), Just("\nv 1 1 0"),
            Just("\nv 0 1 1"), Just("\nf 1 2 3"), Just("\nf 1 3 4"), Just("\nf -1 -2 -3 -4"), Just("\nf 4 2 1"),
            Just("\\\n"), Just("#"), Just("1"), Just("-1"), Just("/"), Just("nan"), Just("1e999"), Just("\r"),
        ], 0..60)) {
        if let Ok(soup) = read(words.join(" ").as_bytes()) {
            let _ = super::super::repair::build(soup, super::super::weld::Rule::Own);
        }
    }
}
