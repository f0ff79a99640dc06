//! Pictures beside goldens, from a renderer that plays a part.

use super::*;
use crate::canvas::frame::{Frame, FrameJob};
use crate::canvas::image::{Image, MapId, Maps};
use crate::canvas::job::{Painting, PatchJob};
use crate::canvas::{Adapter, Kind, RenderError, Renderer};
use crate::mesh::Mesh;
use crate::report::{Check, Pass};
use crate::verify::image::tests::{BACKGROUND, face, noise};
use std::sync::Arc;

/// What a painter does to each of its pictures.
pub(super) type Spoil = fn(Image) -> Image;

/// A studio whose every frame is the same face.
struct Painter {
    adapter: Adapter,
    spoil: Spoil,
    /// Its device is lost at the first frame.
    lost: bool,
}

fn painter(kind: Kind, name: &str, spoil: Spoil) -> Arc<dyn Studio> {
    let text = |text: &str| String::from(text);
    let shaders = if kind == Kind::Gpu { "5ade" } else { "" };
    let adapter =
        Adapter { kind, name: name.into(), driver: text(""), backend: text(""), shaders: text(shaders) };
    Arc::new(Painter { adapter, spoil, lost: false })
}

pub(super) fn reference() -> Arc<dyn Studio> {
    painter(Kind::Reference, "CPU reference", |image| image)
}

pub(super) fn gpu(spoil: Spoil) -> Arc<dyn Studio> {
    painter(Kind::Gpu, "llvmpipe (LLVM 15.0.6, 256 bits)", spoil)
}

impl Studio for Painter {
    fn adapter(&self) -> &Adapter {
        &self.adapter
    }

    fn open(&self, _: Arc<Maps>, _: &Mesh) -> Result<Box<dyn Renderer>, RenderError> {
        Ok(Box::new(Self { adapter: self.adapter.clone(), ..*self }))
    }
}

impl Renderer for Painter {
    fn adapter(&self) -> &Adapter {
        &self.adapter
    }

    fn patch(&mut self, _: &PatchJob) -> Result<(), RenderError> {
        Ok(())
    }

    fn paint(&mut self, _: &Arc<Painting>) -> Result<(), RenderError> {
        Ok(())
    }

    fn follow(&mut self, _: &[Arc<Painting>]) -> Result<(), RenderError> {
        Ok(())
    }

    fn check_patch(&mut self, _: &PatchJob) -> Result<Vec<Check>, RenderError> {
        Ok(Vec::new())
    }

    fn check_paint(&mut self) -> Result<Vec<Check>, RenderError> {
        Ok(Vec::new())
    }

    fn frame(&mut self, job: &FrameJob<'_>) -> Result<Frame, RenderError> {
        if self.lost {
            return Err(RenderError::Lost("unplugged".into()));
        }
        let pass = |id: &str, skipped: Option<&str>, of| Pass {
            id: id.into(),
            us: 7.0,
            skipped: skipped.map(Into::into),
            tiles: of / 2,
            of,
        };
        let passes = vec![pass("shadow 0", Some("unmoved"), 0), pass("skin", None, 24)];
        Ok(Frame { image: (self.spoil)(face(job.view.size)), passes })
    }

    fn map(&mut self, _: MapId) -> Result<Image, RenderError> {
        Ok(Image::default())
    }
}

/// So many recordings of a square with one checkpoint, blessed from the reference.
pub(super) fn drawn(count: usize) -> Suite {
    let suite = Suite::new(&[]);
    let bytes = packed(&SQUARE.replace("[100, 100]", "[128, 96]"));
    (0..count).for_each(|at| suite.put(&format!("recordings/wound/square-{at}.lancet"), &bytes));
    let report = suite.bless_by(&reference());
    assert_eq!(report.exit_code(), 0, "{report:?}");
    suite
}

impl Suite {
    fn paths(&self) -> [PathBuf; 1] {
        [self.at("recordings")]
    }

    fn bless_by(&self, studio: &Arc<dyn Studio>) -> BlessReport {
        bless(&self.paths(), &BlessOptions { studio: Some(studio.clone()), ..because("a test") }, &())
    }

    pub(super) fn gauge_by(&self, studio: &Arc<dyn Studio>, dry_run: bool) -> GaugeReport {
        let options = BlessOptions { studio: Some(studio.clone()), dry_run, ..because("a test") };
        gauge(&self.paths(), &options, &())
    }

    fn verify_by(&self, studio: &Arc<dyn Studio>) -> VerifyReport {
        self.blob(studio, None).report
    }

    pub(super) fn blob(&self, studio: &Arc<dyn Studio>, shard: Option<&str>) -> Blob {
        let shard = shard.map(|shard| shard.parse().expect("a shard"));
        let studio = Some(studio.clone());
        let options = VerifyOptions { studio, shard, details: true, ..VerifyOptions::default() };
        verify_to_blob(&self.paths(), &options, &())
    }

    fn bytes(&self, path: &str) -> Vec<u8> {
        read_file(&self.at(path)).expect("it is there")
    }
}

const PICTURE: &str = "golden/wound/square-0/cut.png";
const TEXT: &str = "golden/wound/square-0/cut.txt";

#[test]
fn a_checkpoint_has_a_picture_beside_its_text() {
    let suite = drawn(1);
    let picture = assets::read_png(&suite.bytes(PICTURE)).expect("a picture");
    assert_eq!(picture, face([128, 96]));
    let text = suite.get(TEXT);
    for line in ["reason = a test", "renderer = reference", "adapter = CPU reference", "shaders = none"] {
        assert!(text.lines().any(|l| l == line), "{line} is not in {text}");
    }
    for fact in
        ["frame width = 128", "frame height = 96", &format!("frame digest image = {}", picture.digest())]
    {
        assert!(text.lines().any(|l| l == fact), "{fact} is not in {text}");
    }
    assert!(!suite.get("golden/wound/square-0/_run.txt").contains("renderer"));
    let report = suite.verify_by(&reference());
    assert_eq!(report.exit_code(), 0, "{report:?}");
    let image = &only(&report).images[0];
    assert_eq!(
        (image.verdict, image.size, image.checkpoint.as_str()),
        (ImageVerdict::Equal, [128, 96], "cut")
    );
    assert_eq!(image.proof.planted.len(), 4, "{image:?}");
    assert_eq!(
        report.skips.iter().map(|s| (s.pass.as_str(), s.times_skipped())).collect::<Vec<_>>(),
        [("shadow", 1), ("skin", 0)]
    );
}

#[test]
fn a_picture_that_changed_fails_the_reference_by_name() {
    let suite = drawn(1);
    let darker = painter(Kind::Reference, "CPU reference", |mut image| {
        image.texels[96 * 64][0] -= 1;
        image
    });
    let report = suite.verify_by(&darker);
    assert_eq!((report.exit_code(), only(&report).images[0].verdict), (1, ImageVerdict::Beyond));
    let divergence = only(&report).divergence.as_ref().expect("the digest is another");
    assert_eq!(divergence.what, "checkpoint cut frame digest image");
    let blessed = suite.bless_by(&darker);
    assert_eq!((blessed.recordings[0].change, blessed.recordings[0].differing), (Change::Changed, 1));
    assert_eq!(suite.verify_by(&darker).exit_code(), 0);
}

#[test]
fn a_device_passes_within_its_gate_and_fails_beyond_it() {
    let suite = drawn(1);
    let near = gpu(|image| noise(&image, 1, 2));
    assert_eq!(suite.verify_by(&gpu(|image| image)).exit_code(), 0);
    let before = suite.verify_by(&near);
    assert_eq!((before.exit_code(), only(&before).images[0].gate.of.as_str()), (1, "no adapter is known"));
    let gauged = suite.gauge_by(&near, true);
    assert_eq!((gauged.exit_code(), gauged.images, gauged.before), (0, 1, None), "{gauged:?}");
    assert_eq!(gauged.worst[0], (Metric::Tile, "wound/square-0 cut".into()), "{gauged:?}");
    assert!(!suite.at("golden/gates.json").exists(), "a dry run writes nothing");
    assert_eq!(suite.gauge_by(&near, false).adapter, "llvmpipe*");
    let report = suite.verify_by(&near);
    assert_eq!(
        (report.exit_code(), only(&report).images[0].verdict),
        (0, ImageVerdict::Within),
        "{report:?}"
    );
    assert_eq!(report.orphans.len(), 0, "gates are no orphan");
    let holed = gpu(|mut image| {
        (40..52).for_each(|y| image.texels[y * 128 + 60..y * 128 + 72].fill([0, 0, 0, 255]));
        image
    });
    let report = suite.verify_by(&holed);
    assert_eq!(report.exit_code(), 1);
    assert!(only(&report).problems()[0].contains("outliers 144"), "{:?}", only(&report).problems());
    assert_eq!(only(&report).divergence, None, "a device's digest is its own");
    assert_eq!(suite.gauge_by(&near, false).before, Some(gauged.measured));
}

#[test]
fn gates_that_would_let_a_defect_pass_are_not_written() {
    let suite = drawn(1);
    let reddish = gpu(|mut image| {
        image.texels.iter_mut().filter(|t| **t != BACKGROUND).for_each(|t| t[0] = t[0].saturating_add(2));
        image
    });
    let report = suite.gauge_by(&reddish, false);
    assert_eq!(report.exit_code(), 2);
    assert!(report.errors[0].contains("the gate of tone"), "{report:?}");
    assert!(!suite.at("golden/gates.json").exists());
    let exact = suite.gauge_by(&reference(), false);
    assert!(exact.errors[0].contains("exact"), "{exact:?}");
    let missing = Suite::new(&[]);
    missing.put("recordings/a.lancet", &packed(SQUARE));
    let missing = missing.gauge_by(&gpu(|image| image), false);
    assert!(
        missing.exit_code() == 2 && missing.errors.iter().any(|e| e.ends_with("cut.png: missing")),
        "{missing:?}"
    );
}

#[test]
fn damaged_gates_are_an_error_and_hide_nothing() {
    let suite = drawn(1);
    suite.put("golden/gates.json", b"{\n\"version\": 1}");
    let report = suite.verify_by(&reference());
    assert_eq!((report.exit_code(), only(&report).verdict), (2, Verdict::Verified));
    assert!(
        report.errors[0].contains("gates.json: missing field `adapters` at line 2"),
        "{:?}",
        report.errors
    );
}

#[test]
fn every_fault_of_a_picture_is_named() {
    let suite = drawn(1);
    let good = suite.bytes(PICTURE);
    let fault = |bytes: &[u8]| {
        suite.put(PICTURE, bytes);
        let report = suite.verify_by(&reference());
        assert_eq!((report.exit_code(), only(&report).images[0].verdict), (1, ImageVerdict::Unseen));
        only(&report).goldens[0].clone()
    };
    assert!(fault(&good[..good.len() / 2]).contains("cut.png: damaged: "));
    assert!(fault(b"").contains("cut.png: damaged: "));
    let png = |image: &Image| assets::write_png(image).expect("a file");
    let other = fault(&png(&noise(&face([128, 96]), 1, 2)));
    assert!(
        other.ends_with("cut.png: damaged: it is not the picture that the text beside it tells of"),
        "{other}"
    );
    let small = face([64, 48]);
    suite.put(TEXT, suite.get(TEXT).replace(&face([128, 96]).digest(), &small.digest()).as_bytes());
    assert!(fault(&png(&small)).ends_with("cut.png: mis-sized: it is 64 x 48, and the frame 128 x 96"));
    std::fs::remove_file(suite.at(PICTURE)).expect("removed");
    let report = suite.verify_by(&reference());
    assert!(only(&report).goldens[0].ends_with("cut.png: missing"));
    assert!(!suite.at(PICTURE).exists(), "verifying writes nothing");
}

#[test]
fn a_picture_that_nobody_asks_for_is_orphaned() {
    let suite = drawn(1);
    suite.put("golden/wound/square-0/before.png", &suite.bytes(PICTURE));
    let report = suite.verify_by(&reference());
    assert_eq!(report.exit_code(), 1);
    assert!(only(&report).goldens[0].contains("before.png: orphaned"));
}

#[test]
fn without_a_renderer_pictures_are_left_alone() {
    let suite = drawn(1);
    let report = verify(&suite.paths(), &VerifyOptions::default(), &());
    assert_eq!((report.exit_code(), only(&report).images.len()), (0, 0), "{report:?}");
    let blessed = bless(&suite.paths(), &because("another"), &());
    assert_eq!(blessed.recordings[0].change, Change::Refused);
    assert!(blessed.recordings[0].error.as_ref().is_some_and(|e| e.contains("has a picture")));
}

#[test]
fn pictures_are_blessed_from_the_reference_alone() {
    let suite = drawn(1);
    let before = suite.bytes(PICTURE);
    let report = suite.bless_by(&gpu(|image| noise(&image, 1, 2)));
    assert_eq!((report.exit_code(), report.recordings.len()), (2, 0));
    assert!(report.errors[0].contains("the CPU reference alone, and not from llvmpipe"), "{report:?}");
    assert_eq!(suite.bytes(PICTURE), before);
}

#[test]
fn a_picture_that_is_too_large_is_not_blessed() {
    let suite = Suite::new(&[]);
    suite.put("recordings/a.lancet", &packed(&SQUARE.replace("[100, 100]", "[640, 360]")));
    let noisy = painter(Kind::Reference, "CPU reference", |mut image| {
        let mut state = 1_u32;
        image.texels.iter_mut().flatten().for_each(|byte| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            *byte = (state >> 24) as u8;
        });
        image
    });
    let report = suite.bless_by(&noisy);
    assert_eq!(report.recordings[0].change, Change::Refused);
    let error = report.recordings[0].error.as_deref().unwrap_or_default();
    assert!(error.starts_with("cut.png: it would take ") && error.contains("524288 at most"), "{error}");
    assert!(list_files(&suite.at("golden")).expect("none").is_empty());
}

#[test]
fn a_lost_device_is_no_verdict() {
    let suite = drawn(1);
    let adapter = gpu(|image| image).adapter().clone();
    let lost: Arc<dyn Studio> = Arc::new(Painter { adapter, spoil: |image| image, lost: true });
    let report = suite.verify_by(&lost);
    assert_eq!((report.exit_code(), only(&report).verdict), (2, Verdict::Unreadable));
    let error = only(&report).error.as_deref();
    assert_eq!(error, Some("it cannot be rendered: the device was lost: unplugged"));
    assert_eq!(suite.gauge_by(&lost, false).exit_code(), 2);
}

#[test]
fn a_page_holds_equal_pictures_once_and_others_twice() {
    let suite = drawn(2);
    let base64 = |image: &Image| crate::verify::html::base64(&assets::write_png(image).expect("a file"));
    let golden = face([128, 96]);
    let page = html(&suite.blob(&reference(), None));
    assert_eq!(page.matches(&base64(&golden)).count(), 2, "one for each recording");
    let page = html(&suite.blob(&gpu(|image| noise(&image, 1, 2)), None));
    assert_eq!(page.matches(&base64(&golden)).count(), 2);
    assert_eq!(page.matches(&base64(&noise(&golden, 1, 2))).count(), 2);
    for word in ["llvmpipe (LLVM 15.0.6", "\"verdict\":\"beyond\"", "\"id\":\"MC\"", "\"unmoved\":2"] {
        assert!(page.contains(word), "{word}");
    }
}

#[test]
fn merged_shards_are_the_whole() {
    let suite = drawn(5);
    suite.put("recordings/wound/broken.lancet", b"garbage");
    suite.put("golden/gone/_run.txt", b"?");
    let studio = gpu(|image| noise(&image, 1, 2));
    let whole = suite.blob(&studio, None).without_times();
    assert_eq!((whole.report.recordings.len(), whole.report.exit_code()), (6, 2));
    for of in [1, 2, 7] {
        let shards = (1..=of).rev().map(|k| {
            let written = suite.blob(&studio, Some(&format!("{k}/{of}"))).text();
            (format!("{k}.json"), Blob::parse(&written).expect("what was just written"))
        });
        let merged = merge(shards.collect()).expect("they are all there");
        assert_eq!(merged.without_times(), whole, "of {of}");
    }
    assert_eq!(merge(vec![("a".into(), whole.clone())]), Ok(whole), "one that is no shard stands for itself");
}

#[test]
fn shards_that_do_not_belong_together_are_not_merged() {
    let suite = drawn(3);
    let shard = |k: &str| (k.to_owned(), suite.blob(&reference(), Some(k)));
    let error = |blobs| merge(blobs).expect_err("they do not").to_string();
    assert_eq!(error(vec![]), "there is nothing to merge");
    assert_eq!(error(vec![shard("1/3"), shard("3/3")]), "missing of 3 shards: 2");
    assert_eq!(error(vec![shard("1/2"), shard("2/2"), shard("1/2")]), "1/2: shard 1 is in 1/2 already");
    assert_eq!(error(vec![shard("1/2"), shard("2/3")]), "2/3: its number of shards is not that of 1/2");
    let whole = ("all".to_owned(), suite.blob(&reference(), None));
    assert!(error(vec![whole, shard("2/2")]).starts_with("all: it is no shard"));
    let device = ("gpu".to_owned(), suite.blob(&gpu(|i| i), Some("2/2")));
    assert_eq!(error(vec![shard("1/2"), device]), "gpu: its renderer is not that of 1/2");
    let first = shard("1/2");
    suite.put("recordings/wound/more.lancet", &packed(SQUARE));
    assert_eq!(error(vec![first, shard("2/2")]), "2/2: its list of recordings is not that of 1/2");
    let mut odd = shard("1/2");
    odd.1.report.shard.as_mut().expect("a shard").index = 9;
    assert!(error(vec![odd]).contains("no such shard"));
    assert!(Blob::parse(b"{}").is_err_and(|e| e.contains("missing field")));
    let newer = String::from_utf8(shard("1/2").1.text())
        .expect("text")
        .replace("\"lancet_blob\":1", "\"lancet_blob\":2");
    assert_eq!(Blob::parse(newer.as_bytes()), Err("a blob of version 2, not 1".into()));
}
