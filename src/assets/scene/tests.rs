//! What a scene may say, what is refused, and what its hash tells apart.

use super::*;
use crate::assets::error::Place;

fn parsed(text: &str) -> (String, SceneSettings, MapFiles) {
    parse(text.as_bytes()).unwrap_or_else(|fault| panic!("{text}: {fault}"))
}

/// A scene that says this beside its mesh.
fn saying(what: &str) -> String {
    format!(r#"{{"mesh": "a.obj", {what}}}"#)
}

#[test]
fn everything_but_the_mesh_may_be_left_out() {
    let (mesh, settings, maps) = parsed(r#"{"mesh": "head.obj"}"#);
    assert_eq!((mesh.as_str(), settings, maps), ("head.obj", SceneSettings::default(), MapFiles::default()));
    let (_, settings, _) =
        parsed(r#"{"mesh": "builtin:bust", "unit_cm": 2.5, "target": [1, 2, 3], "distance": 9}"#);
    assert_eq!(
        (settings.unit_cm, settings.target, settings.distance),
        (2.5, Some([1.0, 2.0, 3.0]), Some(9.0))
    );
}

#[test]
fn every_part_of_the_look_arrives() {
    let (_, settings, maps) = parsed(&saying(
        r#""lights": [{"azimuth": 1.5, "color": [3, 2, 1]}], "ambient": {"intensity": 0.5},
           "shadows": {"size": 64}, "skin": {"bumpiness": 2}, "scattering": {"samples": 41, "law": "derived"},
           "wound": {"distance": "texture"}, "background": [1, 0, 1], "switches": {"color-map": false},
           "maps": {"color": "c.png", "irradiance": "sky.jpg"}"#,
    ));
    let look = &settings.look;
    let light = &look.lights.as_ref().expect("lights")[0];
    assert_eq!((light.azimuth, light.color, light.distance), (1.5, [3.0, 2.0, 1.0], 4.0));
    assert_eq!((look.ambient.intensity, look.shadows.size, look.shadows.filter), (0.5, 64, 3));
    assert_eq!((look.skin.bumpiness, look.scattering.samples), (2.0, 41));
    assert_eq!(look.scattering.law, crate::canvas::look::Law::Derived);
    assert_eq!(look.wound.distance, crate::canvas::look::Distance::Texture);
    assert_eq!(look.background.0, [1.0, 0.0, 1.0]);
    assert!(!look.switches.color_map && look.switches.normal_map);
    let expected =
        MapFiles { color: Some("c.png".into()), irradiance: Some("sky.jpg".into()), ..MapFiles::default() };
    assert_eq!(maps, expected);
}

#[test]
fn errors_name_the_line() {
    let place = |text: &str| parse(text.as_bytes()).expect_err("invalid").place;
    assert_eq!(place("{\n\"mesh\": \"a.obj\",\n\"colour\": 1}"), Place::Line(3));
    assert_eq!(place("{\"mesh\":"), Place::Line(1));
    for nested in [
        r#""maps": {"colour": "a.png"}"#,
        r#""skin": {"albedo": [1, 1, 1], "shine": 1}"#,
        r#""lights": [{"power": 1}]"#,
        r#""switches": {"shadow": true}"#,
        r#""wound": {"noise": {"octave": 1}}"#,
        r#""shadows": {"size": -1}"#,
        r#""shadows": {"size": 64.5}"#,
    ] {
        assert_eq!(place(&saying(nested)), Place::Line(1), "{nested}");
    }
}

/// Every field, with values on either side of its range: refused with its name.
#[test]
fn every_number_has_a_range() {
    for (field, values) in [
        ("unit_cm", ["0", "1e10"]),
        ("snap_px", ["-1", "1001"]),
        ("fov_y", ["0", "3.5"]),
        ("zenith", ["-0.1", "3.2"]),
        ("distance", ["0", "-1"]),
        ("ambient.intensity", ["-1", "1e38"]),
        (
            "ambient.irradiance",
            ["[[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,1e38]]"; 2],
        ),
        ("shadows.size", ["15", "8193"]),
        ("shadows.filter", ["0", "10"]),
        ("skin.albedo", ["[0, 1.1, 0]", "[-0.1, 0, 0]"]),
        ("skin.intensity", ["-1", "1.1"]),
        ("skin.roughness", ["-1", "1.1"]),
        ("skin.specular", ["-1", "1e38"]),
        ("skin.bumpiness", ["-1", "1e38"]),
        ("skin.reflectance", ["-1", "1.1"]),
        ("scattering.width_cm", ["0", "101"]),
        ("scattering.strength", ["[1.1, 0, 0]", "[0, 0, -1]"]),
        ("scattering.falloff", ["[1.1, 0, 0]", "[0, 0, -1]"]),
        ("scattering.samples", ["8", "43"]),
        ("scattering.translucency", ["-1", "1.1"]),
        ("wound.inner", ["[2, 0, 0]", "[-1, 0, 0]"]),
        ("wound.dark", ["[2, 0, 0]", "[-1, 0, 0]"]),
        ("wound.light", ["[2, 0, 0]", "[-1, 0, 0]"]),
        ("wound.edge", ["[-1, 0]", "[0, -1]"]),
        ("wound.noise.octaves", ["0", "17"]),
        ("wound.noise.frequency", ["-1", "1e5"]),
        ("wound.noise.amplitude", ["-1", "1e5"]),
        ("wound.noise.lacunarity", ["-1", "9"]),
        ("wound.noise.persistence", ["-1", "9"]),
        ("wound.blotches.octaves", ["0", "17"]),
        ("wound.discolor", ["[[0, 2], [0, 1], [0, 1]]", "[[0.5, 0.4], [0, 1], [0, 1]]"]),
        ("wound.tissue", ["[[2, 0, 0], [0, 0, 0], [0, 0, 0]]", "[[0, 0, 0], [0, 0, 0], [0, 0, -1]]"]),
        ("background", ["[2, 0, 0]", "[0, 0, -1]"]),
    ] {
        for value in values {
            assert_eq!(place_of(field, value), Place::Field(field.into()), "{value}");
        }
    }
}

#[test]
fn every_number_of_a_light_has_a_range() {
    for (field, value) in [
        ("zenith", "-0.1"),
        ("distance", "1"),
        ("color", "[1, -0.1, 1]"),
        ("cone", "1.6"),
        ("softness", "1.1"),
    ] {
        let text = saying(&format!(r#""lights": [{{}}, {{"{field}": {value}}}]"#));
        let place = parse(text.as_bytes()).expect_err(field).place;
        assert_eq!(place, Place::Field(format!("lights[1].{field}")));
    }
    let many = saying(&format!(r#""lights": [{}]"#, vec!["{}"; 65].join(",")));
    assert_eq!(parse(many.as_bytes()).expect_err("too many").place, Place::Field("lights".into()));
}

/// Where a scene is refused in which the field at this path has this value.
fn place_of(path: &str, value: &str) -> Place {
    let nested = path.rsplit('.').fold(value.to_owned(), |inner, name| format!(r#"{{"{name}": {inner}}}"#));
    let text = saying(&nested[1..nested.len() - 1]);
    parse(text.as_bytes()).expect_err(&text).place
}

/// The hash that recordings of plain scenes have held since before there were looks.
const PLAIN: &str = "e8791da6ab7d543c99723748c0a1a42d38c6a94f7d7d20f779484f9bd1f7a3f9";

fn hash_of(text: &str) -> [u8; 32] {
    parsed(text).1.hash(&[])
}

#[test]
fn a_scene_that_says_nothing_new_has_the_hash_that_it_had() {
    let plain = SceneSettings::default().hash(&[]);
    assert_eq!(blake3::Hash::from_bytes(plain).to_hex().as_str(), PLAIN);
    for default in [
        r#""unit_cm": 1"#,
        r#""azimuth": -0.0"#,
        r#""lights": null"#,
        r#""skin": {"roughness": 0.35}"#,
        r#""switches": {"shadows": true}"#,
        r#""ambient": {}, "shadows": {}, "scattering": {}, "wound": {}, "maps": {}"#,
        r#""background": [0.13, 0.14, 0.16]"#,
    ] {
        assert_eq!(hash_of(&saying(default)), plain, "{default}");
    }
}

#[test]
fn whatever_a_scene_says_has_a_hash_of_its_own() {
    let mut seen = vec![SceneSettings::default().hash(&[])];
    for said in [
        r#""unit_cm": 2"#,
        r#""distance": 1"#,
        r#""target": [0, 0, 0]"#,
        r#""lights": []"#,
        r#""lights": [{}]"#,
        r#""lights": [{}, {}]"#,
        r#""lights": [{"color": [1, 1, 0.5]}]"#,
        r#""lights": [{"color": [1, 0.5, 1]}]"#,
        r#""lights": [{"azimuth": 0.5}]"#,
        r#""ambient": {"intensity": 0.5}"#,
        r#""ambient": {"irradiance": [[1,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0]]}"#,
        r#""shadows": {"size": 512}"#,
        r#""shadows": {"filter": 5}"#,
        r#""skin": {"bumpiness": 0}"#,
        r#""skin": {"albedo": [0.5, 0.62, 0.53]}"#,
        r#""scattering": {"law": "derived"}"#,
        r#""wound": {"noise": {"octaves": 5}}"#,
        r#""wound": {"blotches": {"octaves": 5}}"#,
        r#""background": [0, 0, 0]"#,
        r#""switches": {"specular": false}"#,
    ] {
        seen.push(hash_of(&saying(said)));
    }
    let plain = SceneSettings::default();
    seen.push(plain.hash(&[("color", [1; 32])]));
    seen.push(plain.hash(&[("color", [2; 32])]));
    seen.push(plain.hash(&[("normal", [1; 32])]));
    let count = seen.len();
    seen.sort_unstable();
    seen.dedup();
    assert_eq!(seen.len(), count);
}
