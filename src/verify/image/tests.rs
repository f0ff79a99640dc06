//! Noise passes, defects do not.

use super::gates::GatesFile;
use super::plant::planted;
use super::*;

pub(in crate::verify) const BACKGROUND: [u8; 4] = [33, 36, 41, 255];

/// A fixed hash of a place.
fn hash(x: u32, y: u32, salt: u32) -> u32 {
    let mut h = x.wrapping_mul(0x9e37_79b9) ^ y.wrapping_mul(0x85eb_ca6b) ^ salt.wrapping_mul(0xc2b2_ae35);
    h = (h ^ (h >> 15)).wrapping_mul(0x2c1b_3c6d);
    h = (h ^ (h >> 12)).wrapping_mul(0x297a_2d39);
    h ^ (h >> 15)
}

/// Something like a face: an ellipse of shaded skin with pores, before a background.
pub(in crate::verify) fn face(size: [u32; 2]) -> Image {
    let mut image = Image::filled(size, BACKGROUND);
    let [w, h] = size.map(f64::from);
    for (at, texel) in image.texels.iter_mut().enumerate() {
        let [x, y] = [at as u32 % size[0], at as u32 / size[0]];
        let [u, v] = [(f64::from(x) + 0.5) / w * 2.0 - 1.0, (f64::from(y) + 0.5) / h * 2.0 - 1.0];
        let r2 = (u * u + v * v) / 0.64;
        if r2 < 1.0 {
            let light = (1.0 - r2).sqrt() * 0.6 + 0.3 - 0.15 * u;
            let pore = f64::from(hash(x, y, 7) % 9) - 4.0;
            *texel = [220.0, 170.0, 145.0].map(|c: f64| (c * light + pore).clamp(0.0, 255.0) as u8).alpha();
        }
    }
    image
}

trait Opaque {
    fn alpha(self) -> [u8; 4];
}

impl Opaque for [u8; 3] {
    fn alpha(self) -> [u8; 4] {
        [self[0], self[1], self[2], 255]
    }
}

/// The skin's channels off by so much, up or down; every pixel, or one in so many on average.
pub(in crate::verify) fn noise(image: &Image, off: i16, one_in: u32) -> Image {
    let mut noisy = image.clone();
    for (at, texel) in noisy.texels.iter_mut().enumerate() {
        let h = hash(at as u32, 1, 3);
        if *texel != BACKGROUND && (h >> 16).is_multiple_of(one_in) {
            (0..3).for_each(|c| {
                let sign = if h >> c & 1 == 0 { off } else { -off };
                texel[c] = (i16::from(texel[c]) + sign).clamp(0, 255) as u8;
            });
        }
    }
    noisy
}

const DEFECTS: [Defect; 4] = [Defect::Hole, Defect::Crack, Defect::Tone, Defect::Shift];

fn skin(golden: &Image) -> Skin {
    Skin::of(golden, BACKGROUND)
}

fn distance(golden: &Image, found: &Image) -> Distance {
    measure(golden, found, &skin(golden)).distance
}

fn with(golden: &Image, defect: Defect) -> Image {
    planted(golden, &skin(golden), defect).expect("there is room for it")
}

fn entry(measured: Distance) -> Known {
    Known { adapter: "llvmpipe*".into(), reason: "a test".into(), measured }
}

/// The gate of an adapter that differs from the reference by noise.
fn gate_of(golden: &Image, noisy: &Image) -> Distance {
    entry(distance(golden, noisy)).gate().expect("it lies below every defect")
}

fn adapter(name: &str, kind: Kind) -> Adapter {
    let empty = String::new;
    Adapter { kind, name: name.into(), driver: empty(), backend: empty(), shaders: empty() }
}

fn gpu(name: &str) -> Adapter {
    adapter(name, Kind::Gpu)
}

#[test]
fn noise_passes_and_every_defect_is_caught() {
    for size in [[64, 64], [320, 180], [640, 360]] {
        let golden = face(size);
        for (off, one_in) in [(1, 2), (2, 8), (0, 1)] {
            let noisy = noise(&golden, off, one_in);
            let gate = gate_of(&golden, &noisy);
            assert_eq!(distance(&golden, &noisy).beyond(&gate), None, "{size:?}, noise of {off}");
            for defect in DEFECTS {
                // On top of the noise, as it would come.
                let spoilt = distance(&golden, &with(&noisy, defect));
                assert!(spoilt.beyond(&gate).is_some(), "{size:?}, noise of {off}, {defect}: {spoilt}");
            }
            let proof = prove(&golden, &skin(&golden), &gate);
            assert_eq!((proof.planted.len(), proof.missed().count(), proof.unproven), (4, 0, vec![]));
        }
    }
}

#[test]
fn every_measure_sees_what_it_is_there_for() {
    let golden = face([320, 180]);
    let at = |defect| distance(&golden, &with(&golden, defect));
    let (hole, crack, tone, shift) =
        (at(Defect::Hole), at(Defect::Crack), at(Defect::Tone), at(Defect::Shift));
    assert_eq!((hole.outliers, crack.outliers, tone.outliers), (144, 40, 0));
    assert!(hole.tile > 30.0 && crack.tile > 7.5, "{hole}; {crack}");
    assert_eq!((tone.tone, tone.tile), (3.0, 3.0), "the same everywhere");
    assert!(shift.structure > 0.1 && (0.9..1.1).contains(&shift.displacement), "{shift}");
    let harmless = distance(&golden, &noise(&golden, 2, 1));
    assert!(
        harmless.outliers == 0 && harmless.tone < 0.1 && harmless.tile <= 2.0 && harmless.displacement < 0.02,
        "{harmless}"
    );
    let worst = measure(&golden, &with(&golden, Defect::Hole), &skin(&golden)).worst_tile;
    assert!(worst[0].abs_diff(160) <= 32 && worst[1].abs_diff(90) <= 32, "{worst:?}");
}

#[test]
fn each_gate_catches_its_defect_alone() {
    let golden = face([320, 180]);
    let open = Distance { tile: 1e9, outliers: u32::MAX, tone: 1e9, displacement: 1e9, structure: 1e9 };
    let floor = GatesFile::default().general().most;
    let alone = |gate: Distance, defect| {
        let found = with(&golden, defect);
        super::distance::first_beyond(&golden, &found, &skin(&golden), &gate)
    };
    let caught = |metric| Some(metric);
    assert_eq!(alone(Distance { tile: floor.tile, ..open }, Defect::Crack), caught(Metric::Tile));
    assert_eq!(alone(Distance { outliers: floor.outliers, ..open }, Defect::Hole), caught(Metric::Outliers));
    assert_eq!(alone(Distance { tone: floor.tone, ..open }, Defect::Tone), caught(Metric::Tone));
    assert_eq!(
        alone(Distance { structure: floor.structure, ..open }, Defect::Shift),
        caught(Metric::Structure)
    );
    let displacement = Distance { displacement: floor.displacement, ..open };
    assert_eq!(alone(displacement, Defect::Shift), caught(Metric::Displacement));
    DEFECTS.into_iter().for_each(|defect| assert_eq!(alone(open, defect), None, "{defect}"));
    let proof = prove(&golden, &skin(&golden), &open);
    assert_eq!(proof.missed().collect::<Vec<_>>(), DEFECTS, "an open gate proves nothing");
}

#[test]
fn a_smooth_picture_tells_where_it_is() {
    let mut golden = Image::filled([320, 180], [0; 4]);
    for (at, texel) in golden.texels.iter_mut().enumerate() {
        let grey = (90 + (at % 320) / 8 + (at / 320) / 6) as u8;
        *texel = [grey, grey, grey, 255];
    }
    let noisy = noise(&golden, 1, 2);
    let shift = distance(&golden, &with(&noisy, Defect::Shift));
    assert!((0.8..1.2).contains(&shift.displacement) && shift.outliers == 0, "{shift}");
    assert!(distance(&golden, &noisy).displacement < 0.1, "{}", distance(&golden, &noisy));
    assert_eq!(prove(&golden, &skin(&golden), &gate_of(&golden, &noise(&golden, 1, 40))).missed().count(), 0);
}

#[test]
fn nothing_is_proven_where_nothing_can_be_planted() {
    let proof = |golden: &Image| prove(golden, &skin(golden), &Distance::default());
    assert_eq!(proof(&face([63, 200])).unproven, ["the picture is smaller than 64 x 64"]);
    let empty = proof(&Image::filled([100, 100], BACKGROUND));
    assert_eq!((empty.planted.len(), empty.unproven.len()), (0, 4));
    let dark = proof(&Image::filled([100, 100], [9, 9, 9, 255]));
    assert_eq!((dark.planted.len(), dark.unproven.len()), (0, 4), "a hole in the dark is none");
    let mut narrow = Image::filled([100, 100], BACKGROUND);
    (0..100).for_each(|y| (40..60).for_each(|x| narrow.texels[y * 100 + x] = [200, 150, 120, 255]));
    assert_eq!(proof(&narrow).planted.len(), 4, "a crack may go down");
}

#[test]
fn the_smallest_pictures_are_measured_too() {
    for size in [[1, 1], [3, 1], [17, 33]] {
        let (black, white) = (Image::filled(size, [0, 0, 0, 255]), Image::filled(size, [255; 4]));
        let apart = distance(&black, &white);
        assert_eq!((apart.tile, apart.outliers), (255.0, size[0] * size[1]), "{size:?}");
        let part = (f64::from(size[0] * size[1]) / 144.0).min(1.0);
        assert!((apart.tone - 255.0 * part).abs() < 1e-9, "few pixels have no tone: {}", apart.tone);
        assert_eq!(distance(&black, &black), Distance::default());
    }
    assert_eq!(distance(&Image::default(), &Image::default()).tile, 0.0);
}

#[test]
fn gates_are_twice_what_was_measured_above_a_floor_and_below_every_defect() {
    let measured =
        Distance { tile: 1.5, tone: 0.5, displacement: 0.1, structure: 0.01, ..Distance::default() };
    let gate = entry(measured).gate().expect("a gate");
    assert_eq!((gate.tile, gate.outliers, gate.tone, gate.structure), (3.0, 4, 1.0, 0.02));
    for (wide, metric) in [
        (Distance { tile: 4.0, ..measured }, Metric::Tile),
        (Distance { outliers: 20, ..measured }, Metric::Outliers),
        (Distance { tone: 1.5, ..measured }, Metric::Tone),
        (Distance { displacement: 0.4, ..measured }, Metric::Displacement),
        (Distance { structure: 0.06, ..measured }, Metric::Structure),
    ] {
        let error = entry(wide).gate().expect_err("too wide");
        assert!(matches!(error, GatesError::TooWide { metric: m, .. } if m == metric), "{error}");
    }
    for tile in [-1.0, f64::NAN, f64::INFINITY] {
        let error = entry(Distance { tile, ..measured }).gate();
        assert!(matches!(error, Err(GatesError::NoDistance { metric: Metric::Tile, .. })));
    }
}

#[test]
fn an_adapter_has_its_own_gate_or_the_largest_of_all() {
    let file = |text: &str| GatesFile::parse(text.as_bytes());
    let text = r#"{ "version": 1, "adapters": [
        { "adapter": "llvmpipe*", "reason": "CI", "measured": { "tile": 1.0, "outliers": 3, "tone": 0.1, "displacement": 0.01, "structure": 0.004 } },
        { "adapter": "NVIDIA * Ti", "reason": "a desk", "measured": { "tile": 0.5, "outliers": 9, "tone": 0.1, "displacement": 0.01, "structure": 0.001 } } ] }"#;
    let gates = file(text).expect("gates");
    let own = gates.gate(&gpu("llvmpipe (LLVM 15.0.6, 256 bits)"));
    assert_eq!((own.of.as_str(), own.most.outliers, own.most.tile), ("llvmpipe*", 6, 2.0));
    assert_eq!(gates.gate(&gpu("NVIDIA RTX 4080 Ti")).of, "NVIDIA * Ti");
    for unknown in ["NVIDIA RTX 4080", "my llvmpipe", "AMD"] {
        let general = gates.gate(&gpu(unknown));
        assert_eq!((general.most.outliers, general.most.tile, general.most.structure), (18, 2.0, 0.008));
    }
    assert_eq!(gates.gate(&adapter("CPU", Kind::Reference)).most, Distance::default());
    assert_eq!(GatesFile::parse(&gates.text()), Ok(gates), "and back");
}

#[test]
fn damaged_gates_are_named() {
    let error = |text: &str| GatesFile::parse(text.as_bytes()).expect_err("damaged").to_string();
    assert!(error("{\n\"version\": 1,\n\"adapter\": []}").contains("unknown field `adapter`, expected"));
    assert!(error("{").contains("line 1"));
    assert_eq!(error(r#"{"version": 2, "adapters": []}"#), "its version is 2, not 1");
    let entry = |adapter: &str, reason: &str, tone: &str| {
        error(&format!(
            r#"{{"version": 1, "adapters": [{{"adapter": "{adapter}", "reason": "{reason}",
                "measured": {{"tile": 0, "outliers": 0, "tone": {tone}, "displacement": 0, "structure": 0}}}}]}}"#
        ))
    };
    assert_eq!(entry("", "x", "0"), "adapters[0] has no adapter");
    assert_eq!(entry("x", " ", "0"), "adapters[0] has no reason");
    assert_eq!(entry("x", "y", "-1"), "x: tone is no distance");
    assert!(entry("x", "y", "2").starts_with("x: the gate of tone, twice what was measured, is 4"));
}

#[test]
fn the_reference_is_exact_and_proves_with_the_general_gate() {
    let golden = face([128, 96]);
    let frame = |image: Image| CheckpointFrame {
        event: 3,
        name: "cut".into(),
        frame: crate::canvas::frame::Frame { image, passes: Vec::new() },
        background: BACKGROUND,
    };
    let exact = Rules::new(&GatesFile::default(), &adapter("CPU", Kind::Reference));
    let report = exact.judge(&frame(golden.clone()), Some(&golden));
    assert_eq!(
        (report.verdict, report.problems().len(), report.proof.planted.len()),
        (ImageVerdict::Equal, 0, 4)
    );
    let mut other = golden.clone();
    other.texels[96 * 64][0] ^= 1;
    let report = exact.judge(&frame(other.clone()), Some(&golden));
    assert_eq!(report.verdict, ImageVerdict::Beyond);
    assert!(report.problems()[0].starts_with("picture cut: tile: tile 0.00"), "{:?}", report.problems());
    let device = Rules::new(&GatesFile::default(), &gpu("any"));
    let report = device.judge(&frame(other), Some(&golden));
    assert_eq!((report.verdict, report.is_fine()), (ImageVerdict::Within, true));
    assert_eq!(device.judge(&frame(golden), None).verdict, ImageVerdict::Unseen);
}

#[test]
fn an_insensitive_golden_is_a_problem() {
    let mut report = Rules::new(&GatesFile::default(), &gpu("any")).unseen(&CheckpointFrame {
        event: 0,
        name: "cut".into(),
        frame: crate::canvas::frame::Frame { image: face([64, 64]), passes: Vec::new() },
        background: BACKGROUND,
    });
    assert!(report.is_fine());
    report.proof.planted.push(Planted { defect: Defect::Crack, caught_by: None });
    let problem = "picture cut: insensitive: a planted crack passes (no adapter is known)";
    assert_eq!(report.problems(), [problem]);
}
