//! Commands that replay.

use serde_json::Value;

use super::{answer, complaint, file, lancet};
use crate::cli::Status;

/// A square of two triangles, cut by two clicks, missed by a third, and cut back.
const SQUARE: &str = r#"{ "version": 1, "viewport": [100, 100], "seed": 3,
  "scene": { "inline": { "nodes": [[0, 0, 0], [4, 0, 0], [4, 4, 0], [0, 4, 0]], "faces": [[0, 1, 2], [0, 2, 3]] } },
  "events": [ { "mode": "merge" }, { "click": [45, 40] }, { "click": [60, 55] }, { "click": [0.5, 0.5] },
              { "checkpoint": "cut" }, { "undo": {} } ] }"#;

fn square() -> (tempfile::TempDir, String) {
    file("square.json", SQUARE.as_bytes())
}

/// The packed square in a folder of recordings.
fn recordings() -> (tempfile::TempDir, String, String) {
    let (folder, script) = square();
    let home = folder.path().join("recordings");
    let packed = home.join("square.lancet");
    answer(&["pack", &script, "-o", packed.to_str().unwrap()]);
    (folder, home.to_str().unwrap().to_owned(), packed.to_str().unwrap().to_owned())
}

fn json(text: &str) -> Value {
    serde_json::from_str(text).unwrap()
}

#[test]
fn a_replay_reports_stage_by_stage() {
    let (_folder, script) = square();
    let text = answer(&["replay", &script]);
    for expected in ["event  kind", "applied", "rejected: miss", "FC", "MC", "1 cuts, 2 applied, 1 rejected"]
    {
        assert!(text.contains(expected), "{expected} is not in {text}");
    }
    let (status, out, err) = lancet(&["replay", &script, "--json", "-", "--repeat", "3"]);
    let report = json(&out);
    assert_eq!(
        (status, &report["schema"], &report["engine"]),
        (Status::Verified, &1.into(), &"wound".into())
    );
    assert_eq!(report["events"][2]["stages"][0]["id"], "FC");
    assert!(err.contains("1 cuts, 2 applied"), "the table goes beside the answer: {err}");
}

#[test]
fn a_replay_stops_where_it_is_told() {
    let (_folder, script) = square();
    let events = |until: &str| {
        json(&lancet(&["replay", &script, "--until", until, "--json", "-"]).1)["events"].clone()
    };
    assert_eq!(events("2").as_array().unwrap().len(), 3);
    let stages = events("2.FC")[2]["stages"].clone();
    assert_eq!((&stages[0]["skipped"], &stages[3]["skipped"]), (&Value::Null, &"until".into()));
    assert!(complaint(&["replay", &script, "--until", "6"]).contains("there is no event 6; there are 6"));
    assert!(complaint(&["replay", &script, "--until", "2.XY"]).contains("XY"));
    assert_eq!(events("start").as_array().map(Vec::len), Some(0));
    assert!(complaint(&["replay", &script, "--until", "18446744073709551615"]).contains("not EVENT"));
    assert!(complaint(&["replay", &script, "--until", "x"]).contains("4 or 4.MC"));
}

#[test]
fn a_stage_that_an_event_has_not_is_an_error() {
    let (_folder, script) = square();
    let error = complaint(&["replay", &script, "--until", "0.MC"]);
    assert!(error.contains("event 0 (mode) has no stage `MC`; it has none"), "{error}");
    let error = complaint(&["replay", &script, "--until", "3.MC"]);
    assert!(error.contains("event 3 (click, rejected: miss) has no stage `MC`"), "{error}");
    let error = complaint(&["replay", &script, "--until", "2.SD"]);
    assert!(error.contains("it has FC, GP, PP, MC, CI"), "{error}");
}

#[test]
fn a_replay_stops_at_the_first_event_that_is_such_a_one() {
    let (_folder, script) = square();
    let stopped = |stops: &[&str]| {
        let typed = stops.iter().flat_map(|stop| ["--stop-at", stop]);
        let arguments: Vec<&str> = ["replay", &script, "--json", "-"].into_iter().chain(typed).collect();
        let (status, out, err) = lancet(&arguments);
        assert_eq!(status, Status::Verified, "{err}");
        let note = err.lines().next().unwrap().to_owned();
        (json(&out)["events"].as_array().unwrap().len(), note)
    };
    let note = |text: &str| format!("note: {text}");
    assert_eq!(stopped(&["rejected"]), (4, note("stopped after event 3: rejected")));
    assert_eq!(stopped(&["rejected=miss", "MC>0"]), (3, note("stopped after event 2: MC>0")));
    assert_eq!(stopped(&["finding", "rejected=none"]), (6, note("nothing stopped it")));
    let until = lancet(&["replay", &script, "--stop-at", "rejected", "--until", "2.FC"]);
    assert!(until.2.contains("nothing stopped it") && until.1.contains("skipped: until"), "{until:?}");
    let before = lancet(&["replay", &script, "--stop-at", "FC>0", "--until", "5.FC"]);
    assert!(
        before.2.contains("stopped after event 2: FC>0"),
        "it stops before it comes to an event without FC"
    );
    let error = complaint(&["replay", &script, "--stop-at", "XY>1"]);
    assert!(error.contains("--stop-at XY>1: there is no such stage; there are FC, GP"), "{error}");
    assert!(complaint(&["replay", &script, "--stop-at", "cheese"]).contains("COUNTER=NAME"));
    assert!(
        complaint(&["replay", &script, "--stop-at", "finding", "--repeat", "2"])
            .contains("cannot be used with")
    );
}

#[test]
fn a_frame_shows_whatever_the_report_has_to_show() {
    let (folder, script) = square();
    let frame = |overlay: &[&str]| {
        let at = folder.path().join("frame.png").to_str().unwrap().to_owned();
        let renderer = ["replay", &script, "--renderer", "reference", "--until", "2", "--frame", &at];
        answer(&[&renderer[..], overlay].concat());
        std::fs::read(at).unwrap()
    };
    let plain = frame(&[]);
    for names in ["wire", "line", "picks", "configurations", "wire,line"] {
        assert_ne!(frame(&["--overlay", names]), plain, "{names}");
    }
    let report = json(&lancet(&["replay", &script, "--json", "-"]).1);
    let names = report["events"][2]["overlays"]
        .as_array()
        .unwrap()
        .iter()
        .map(|o| o.as_object().unwrap().values().next().unwrap()["name"].as_str().unwrap().to_owned());
    names.for_each(|name| drop(frame(&["--overlay", &name])));
    let at = folder.path().join("none.png");
    let error = complaint(&[
        "replay",
        &script,
        "--renderer",
        "reference",
        "--frame",
        at.to_str().unwrap(),
        "--overlay",
        "cheese",
    ]);
    assert!(
        error.contains("there is no overlay `cheese` of the last cut; there are wire, charts, line, picks"),
        "{error}"
    );
    assert!(!at.exists());
}

#[test]
fn elements_are_marked_in_a_frame_and_in_a_map() {
    let (folder, plain) = square();
    let uv = "[[0, 1, 2], [0, 2, 3]], \"uv\": [[0.1, 0.1], [0.9, 0.1], [0.9, 0.8], [0.1, 0.8]]";
    let script = folder.path().join("textured.json");
    std::fs::write(&script, SQUARE.replace("[[0, 1, 2], [0, 2, 3]]", uv)).unwrap();
    let script = script.to_str().unwrap();
    let at = folder.path().join("frame.png").to_str().unwrap().to_owned();
    let replay = |script| ["replay", script, "--renderer", "reference", "--until", "2", "--frame", &at];
    let frame = |rest: &[&str]| {
        answer(&[&replay(script)[..], rest].concat());
        std::fs::read(&at).unwrap()
    };
    let map = ["--map", "colour"];
    let mut pictures = vec![("frame", frame(&[])), ("map", frame(&map))];
    for ids in ["f0", "e2", "n3", "v1", "f0,n3"] {
        pictures.push((ids, frame(&["--select", ids])));
        pictures.push((ids, frame(&[&["--select", ids][..], &map].concat())));
    }
    pictures.push(("charts", frame(&["--overlay", "charts"])));
    pictures.push(("configurations", frame(&[&["--overlay", "configurations"][..], &map].concat())));
    for (at, (name, picture)) in pictures.iter().enumerate() {
        let same = pictures[..at].iter().find(|(_, before)| before == picture);
        assert_eq!(same.map(|(before, _)| (at, *name, *before)), None, "each shows something else");
    }
    for id in ["f99", "x1", "7", "f", ""] {
        let error = complaint(&[&replay(script)[..], &["--select", id]].concat());
        assert!(error.contains(&format!("--select {id}: there is no such element")), "{error}");
    }
    let error = complaint(&[&replay(&plain)[..], &["--select", "f0", "--map", "colour"]].concat());
    assert!(error.contains("without texture coordinates"), "{error}");
    let error = complaint(&[&replay(script)[..], &["--overlay", "wire,line"], &map].concat());
    assert!(error.contains("--overlay line: it lies in space"), "{error}");
    let error = complaint(&[&replay(script)[..], &["--zenith", "1", "--map", "colour"]].concat());
    assert!(error.contains("cannot be used with"), "{error}");
}

#[test]
fn the_invariants_of_pixels_are_looked_at_where_pixels_are_made() {
    let (folder, _) = square();
    let uv = "[[0, 1, 2], [0, 2, 3]], \"uv\": [[0, 0], [1, 0], [1, 1], [0, 1]]";
    let script = folder.path().join("textured.json");
    std::fs::write(&script, SQUARE.replace("[[0, 1, 2], [0, 2, 3]]", uv)).unwrap();
    let checks = |rest: &[&str]| {
        let replay = ["replay", script.to_str().unwrap(), "--renderer", "reference", "--json", "-"];
        let report = json(&lancet(&[&replay[..], rest].concat()).1);
        report["events"][2]["stages"][1]["checks"].as_array().unwrap().len()
    };
    assert!(checks(&["--pixels"]) > checks(&[]));
}

#[test]
fn a_frame_is_taken_from_elsewhere() {
    let (folder, script) = square();
    let at = folder.path().join("frame.png").to_str().unwrap().to_owned();
    let replay = ["replay", &script, "--renderer", "reference", "--frame", &at];
    let frame = |from: &[&str]| {
        answer(&[&replay[..], from].concat());
        std::fs::read(&at).unwrap()
    };
    let (front, nearer, above) = (frame(&[]), frame(&["--distance", "9"]), frame(&["--zenith", "1.2"]));
    let around = frame(&["--azimuth", "-0.4"]);
    assert!(front != nearer && front != above && front != around && nearer != above);
    assert_eq!(frame(&["--azimuth", "0"]), front, "what is not typed is as it was recorded");
    let wrong = |from: [&str; 2]| complaint(&[&replay[..], &from].concat());
    assert!(wrong(["--zenith", "3.2"]).contains("--zenith: 3.2 is not between 0 and π"));
    assert!(wrong(["--distance", "-1"]).contains("--distance: -1 is not a positive number"));
    assert!(wrong(["--azimuth", "nan"]).contains("--azimuth: NaN is not a number"));
    assert!(complaint(&["replay", &script, "--zenith", "1"]).contains("--frame"));
}

#[test]
fn a_replay_writes_its_mesh_and_its_trace() {
    let (folder, script) = square();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    answer(&["replay", &script, "--until", "2", "--export-mesh", &at("a.obj"), "--trace", &at("t.json")]);
    let obj = std::fs::read_to_string(at("a.obj")).unwrap();
    assert!(obj.lines().filter(|line| line.starts_with("f ")).count() > 2, "{obj}");
    assert!(json(&std::fs::read_to_string(at("t.json")).unwrap())["traceEvents"].is_array());
    assert!(complaint(&["replay", &script, "--export-mesh", &at("a.stl")]).contains("a.stl"));
}

#[test]
fn goldens_are_missing_then_blessed_then_verified() {
    let (_folder, home, _) = recordings();
    let (status, out, _) = lancet(&["verify", &home, "--renderer", "reference"]);
    assert_eq!(status, Status::Diverged);
    assert!(out.contains("missing") && out.contains("1 recordings: 0 verified, 1 failed"), "{out}");
    assert!(
        answer(&["bless", &home, "--reason", "a test", "--dry-run"]).contains("1 goldens would be written")
    );
    assert!(answer(&["bless", &home, "--reason", "a test"]).contains("1 goldens written"));
    assert!(answer(&["bless", &home, "--reason", "a test"]).contains("0 goldens written, 1 as they were"));
    assert!(
        answer(&["verify", &home, "--renderer", "reference"]).contains("1 recordings: 1 verified, 0 failed")
    );
    let report = json(&lancet(&["verify", &home, "--renderer", "reference", "--json", "-"]).1);
    assert_eq!(report["recordings"][0]["verdict"], "verified");
    assert!(complaint(&["bless", &home]).contains("--reason"));
}

#[test]
fn pictures_are_blessed_verified_and_shown() {
    let (folder, home, _) = recordings();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    answer(&["bless", &home, "--reason", "a test"]);
    let text = std::fs::read_to_string(at("golden/square/cut.txt")).unwrap();
    assert!(text.contains("renderer = reference\n") && text.contains("frame width = 100\n"), "{text}");
    let golden = std::fs::read(at("golden/square/cut.png")).unwrap();
    assert!(golden.starts_with(b"\x89PNG"));
    let (junit, page) = (at("junit.xml"), at("page"));
    let verify = ["verify", &home, "--renderer", "reference"];
    let out = answer(&[&verify[..], &["--junit", &junit, "--html", &page]].concat());
    assert!(out.contains("1 pictures by CPU reference"), "{out}");
    assert!(
        std::fs::read_to_string(junit).unwrap().contains("<testcase classname=\"lancet\" name=\"square\"")
    );
    assert!(std::fs::read_to_string(at("page/index.html")).unwrap().contains("\"verdict\":\"equal\""));
    assert!(
        answer(&[&verify[..], &["--no-skip"]].concat()).contains("1 verified"),
        "nothing depends on skips"
    );
    std::fs::write(at("golden/square/cut.png"), &golden[..50]).unwrap();
    let (status, out, _) = lancet(&verify);
    assert!(status == Status::Diverged && out.contains("cut.png: damaged: "), "{out}");
    let gates = ["bless", &home, "--gates", "--renderer", "reference", "--reason", "a test"];
    let (status, out, _) = lancet(&gates);
    assert!(status == Status::Failed && out.contains("the CPU reference is exact"), "{out}");
}

#[test]
fn shards_are_merged() {
    let (folder, home, packed) = recordings();
    std::fs::copy(&packed, folder.path().join("recordings/twin.lancet")).unwrap();
    answer(&["bless", &home, "--reason", "a test"]);
    let blob = |k: &str| {
        let file = folder.path().join(format!("blob-{k}.json")).to_str().unwrap().to_owned();
        let shard = format!("{k}/2");
        let verify = ["verify", &home, "--renderer", "reference", "--shard", &shard, "--blob", &file];
        assert!(answer(&verify).contains(&format!("shard {k} of 2: 1 recordings: 1 verified")));
        file
    };
    let (one, two) = (blob("1"), blob("2"));
    assert!(answer(&["merge", &two, &one]).contains("2 recordings: 2 verified, 0 failed"));
    let (status, out, _) = lancet(&["merge", &one, &two, "--json", "-"]);
    let report = json(&out);
    assert_eq!((status, &report["recordings"][1]["recording"]), (Status::Verified, &"twin".into()));
    assert!(complaint(&["merge", &one]).contains("missing of 2 shards: 2"));
    assert!(complaint(&["merge", &one, &two, &one]).contains("shard 1 is in"));
    assert!(complaint(&["merge", &packed]).contains("square.lancet: no blob of verify: "));
    assert!(complaint(&["verify", &home, "--shard", "3/2"]).contains("not K/N, such as 2/7"));
    assert!(complaint(&["verify", &home, "--shard", "1/2", "--fail-fast"]).contains("cannot be used with"));
}

#[test]
fn a_planted_defect_is_named() {
    let (_folder, home, _) = recordings();
    answer(&["bless", &home, "--reason", "a test"]);
    let (status, out, _) =
        lancet(&["verify", &home, "--renderer", "reference", "--plant", "2.MC:nodes:n4:1"]);
    assert_eq!(status, Status::Diverged);
    assert!(out.contains("event 2, stage MC, buffer nodes, element n4: expected ("), "{out}");
    assert!(complaint(&["verify", &home, "--plant", "2.MC"]).contains("EVENT.STAGE:BUFFER:ELEMENT:ULPS"));
}

#[test]
fn an_unreadable_recording_does_not_hide_the_others() {
    let (folder, home, packed) = recordings();
    answer(&["bless", &home, "--reason", "a test"]);
    let bytes = std::fs::read(&packed).unwrap();
    std::fs::write(folder.path().join("recordings/a.lancet"), &bytes[..100]).unwrap();
    let (status, out, _) = lancet(&["verify", &home, "--renderer", "reference"]);
    assert_eq!(status, Status::Failed);
    assert!(out.contains("1 verified, 0 failed, 1 unreadable") && out.contains("byte 100, frame 1"), "{out}");
}

#[test]
fn runs_are_compared() {
    let (folder, script) = square();
    assert!(answer(&["diff", &script, &script]).contains("the runs are the same"));
    let (_other, moved) = file("moved.json", SQUARE.replace("[60, 55]", "[60, 54]").as_bytes());
    let (status, out, _) = lancet(&["diff", &script, &moved]);
    assert_eq!(status, Status::Diverged);
    assert!(out.contains("the inputs differ first in events[2]: {\"click\":[60.0,55.0]}"), "{out}");
    assert!(out.contains("the runs part at event 2, stage FC"), "{out}");
    let report = folder.path().join("report.json");
    answer(&["replay", &script, "--json", report.to_str().unwrap()]);
    assert!(answer(&["diff", report.to_str().unwrap(), &script]).contains("the runs are the same"));
    assert_eq!(lancet(&["diff", report.to_str().unwrap(), &moved]).0, Status::Diverged);
}

#[test]
fn every_difference_of_two_runs_is_there() {
    let (_folder, script) = square();
    let (_other, missed) = file("missed.json", SQUARE.replace("[60, 55]", "[60, 0.5]").as_bytes());
    let out = lancet(&["diff", &script, &missed]).1;
    let diff = json(&lancet(&["diff", &script, &missed, "--json"]).1);
    let (all, differing) = (diff["divergences"].as_array().unwrap(), diff["differing"].as_u64().unwrap());
    assert!(all.len() > 10 && all.len() as u64 == differing, "{diff}");
    assert_eq!((&all[0], &all[0]["what"]), (&diff["divergence"], &"event 2".into()));
    assert!(diff["inputs"].as_str().unwrap().starts_with("events[2]: "), "{diff}");
    assert_eq!(out.lines().filter(|line| line.starts_with("then at ")).count(), 9, "{out}");
    assert!(out.contains(&format!("\nand {} more\n{differing} facts differ\n", differing - 10)), "{out}");
}

#[test]
fn nothing_is_reduced_where_nothing_breaks() {
    let (_folder, script) = square();
    assert!(complaint(&["reduce", &script, "-o", "-"]).contains("there is nothing to reduce"));
}

#[test]
fn time_against_error_is_stored_plotted_and_held_against_what_was() {
    let folder = tempfile::tempdir().unwrap();
    let [file, plots] = ["curves.json", "plots"].map(|name| folder.path().join(name));
    let [file_name, plots_name] = [&file, &plots].map(|path| path.to_str().unwrap());
    let quick =
        ["measure", "accuracy", "--quick", "--only", "patch", "--rounds", "1", "--renderer", "reference"];
    let run = |more: &[&str]| lancet(&[&quick[..], &["--against", file_name], more].concat());
    let (status, out, _) = run(&["--bless", "--reason", "first", "--plot", plots_name]);
    assert_eq!(status, Status::Verified, "{out}");
    assert!(out.contains("planted") && out.contains("RMS difference, levels of 255"), "{out}");
    assert!(std::fs::read_to_string(plots.join("patch.svg")).unwrap().starts_with("<svg"));
    let (status, out, _) = run(&[]);
    assert_eq!(status, Status::Verified, "{out}");
    // As if everything had been faster and more accurate.
    let mut stored: serde_json::Value = serde_json::from_slice(&std::fs::read(&file).unwrap()).unwrap();
    for row in stored["curves"][0]["rows"].as_array_mut().unwrap() {
        let part = |value: &serde_json::Value| value.as_f64().unwrap() * 1e-3;
        (row["effort"], row["error"]) = (part(&row["effort"]).into(), part(&row["error"]).into());
    }
    std::fs::write(&file, stored.to_string()).unwrap();
    let (status, out, _) = run(&[]);
    assert_eq!(status, Status::Diverged, "{out}");
    assert!(out.contains("finding: patch") && out.contains("less accurate"), "{out}");
    std::fs::write(&file, "{}").unwrap();
    assert_eq!(run(&[]).0, Status::Failed);
    let (status, _, err) = lancet(&["measure", "accuracy", "--only", "cheese", "--renderer", "reference"]);
    assert_eq!(status, Status::Failed, "{err}");
    assert!(err.contains("cheese") && err.contains("painting"), "{err}");
}
