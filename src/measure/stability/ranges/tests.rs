//! Where a range ends, and that the ladders tell the engine from plain floats.

use super::ladders::{LADDERS, Ladder, mend};
use super::report::{LadderReport, RangesReport, Until};
use super::rung::{Base, Found, Ours, Rung, Theirs, run};
use super::{Options, measure};
use crate::assets::builtin::builtin;
use crate::measure::Random;
use crate::measure::baseline::Failure;
use crate::measure::stability::part::Broken;
use crate::measure::stability::report::StabilityFinding;
use crate::measure::stability::reproduce;
use crate::mesh::{Mesh, NodeId};
use crate::report::Check;

fn rung(value: f64, failures: usize) -> Rung {
    let failures = if failures == 0 { [].into() } else { [(Failure::Loops, failures)].into() };
    let theirs = Theirs { asked: 9, failures };
    Rung { value, cuts: 9, ours: Ours::default(), plain_f32: theirs.clone(), plain_f64: theirs }
}

fn range(rungs: &[(f64, usize)]) -> Until {
    let rungs: Vec<Rung> = rungs.iter().map(|&(value, failures)| rung(value, failures)).collect();
    Until::of(&rungs, |rung| rung.plain_f32.failures.is_empty())
}

#[test]
fn a_range_ends_before_the_first_failure_on_either_side() {
    assert_eq!(range(&[(0.0, 0), (1.0, 0), (10.0, 2), (100.0, 0)]), Until::Within(0.0, 1.0));
    assert_eq!(range(&[(0.1, 0), (1.0, 0), (10.0, 0), (100.0, 0)]), Until::All);
    assert_eq!(range(&[(0.01, 0), (0.1, 3), (1.0, 0), (10.0, 1)]), Until::Within(1.0, 1.0));
    assert_eq!(range(&[(0.1, 0), (1.0, 1), (10.0, 0)]), Until::Nowhere);
    assert_eq!(range(&[]), Until::Nowhere);
}

#[test]
fn every_ladder_has_a_rung_that_changes_nothing_and_others_that_do() {
    for ladder in &LADDERS {
        let changed = |value: f64| {
            let mut mesh = builtin("bust:2000").expect("a scene").mesh;
            let before = mesh.clone();
            let place = (ladder.place)(value);
            mesh.positions.iter_mut().for_each(|p| *p = place.of(*p));
            let placed = mesh.positions.clone();
            (ladder.spoil)(&mut mesh, value, &mut Random::of(1, 2, "3"));
            assert_eq!(mend(&mut mesh, &placed), 0, "{} {value:e}: a face without area", ladder.name);
            assert!(Mesh::build(&mesh).is_ok());
            mesh != before
        };
        let still: Vec<f64> = ladder.rungs.iter().copied().filter(|&value| !changed(value)).collect();
        let neutral = if ladder.rungs.contains(&1.0) && ladder.name != "rotation" && ladder.name != "noise" {
            1.0
        } else {
            0.0
        };
        assert!(still.contains(&neutral), "{}: {still:?}", ladder.name);
        assert!(still.len() <= 2, "{}: {still:?}", ladder.name);
    }
}

#[test]
fn a_damaged_mesh_is_a_finding_with_its_script() {
    let base = Base::make("grid", 1, 3).expect("the scene");
    let (sound, none) = run(&LADDERS[0], 1e6, std::slice::from_ref(&base), 3).expect("a rung");
    assert!(sound.cuts == 1 && sound.ours.findings == 0 && none.is_empty());
    let scene = base.prepared(&LADDERS[0], 1e6, 3).expect("the scene on it");
    let mut state = scene.state.clone();
    // Turned inside out at a corner: the edges there no longer know their faces.
    let edge = state.mesh.face(state.mesh.anchor(NodeId(0))).edges[0];
    let mut wrong = state.mesh.edge(edge);
    wrong.faces.swap(0, 1);
    state.mesh.set_edge(edge, wrong);
    let mut rung = rung(1e6, 0);
    let broken = rung.cut(&state, &base.events(&LADDERS[0], 1e6)[0]);
    assert!(!broken.is_empty());
    let check = Check::fail("planted", "on purpose");
    let broken =
        Broken { cut: 0, stage: "state".into(), check, events: base.events(&LADDERS[0], 1e6)[0].to_vec() };
    let reproduction = reproduce::of("range", 3, 7, &scene, &broken);
    assert!(
        reproduction.name == "range-3-7-0.json" && reproduction.script.contains("range-3-7-0.scene.json")
    );
}

#[test]
fn every_finding_has_a_file_of_its_own() {
    let bases = ["bust:2000", "grid"].map(|name| Base::make(name, 1, 3).expect("the scene"));
    let found = |ladder: &Ladder, value: f64| {
        let first = |base: &Base| {
            let check = Check::fail("planted", "on purpose");
            let events = base.events(ladder, value)[0].to_vec();
            let broken = Broken { cut: 0, stage: "state".into(), check, events };
            Found::of(ladder, base, base.prepared(ladder, value, 3).expect("the scene on it"), broken)
        };
        bases.iter().map(first).collect::<Vec<_>>()
    };
    let rungs = [(0, 1e2), (0, 1e3), (6, 1e-2)];
    let rungs = rungs.map(|(ladder, value)| (ladder, (rung(value, 0), found(&LADDERS[ladder], value))));
    let options = Options { cuts: 0, per_rung: 2, seed: 3, jobs: 1 };
    let report = RangesReport::join(&options, rungs.into_iter());
    let files: Vec<&str> = report.findings.iter().map(StabilityFinding::file).collect();
    assert_eq!(
        files,
        [
            "range-translation-bust-2000-3-0-0.json",
            "range-translation-grid-3-0-0.json",
            "range-translation-bust-2000-3-1-0.json",
            "range-translation-grid-3-1-0.json",
            "range-short-edges-bust-2000-3-2-0.json",
            "range-short-edges-grid-3-2-0.json",
        ]
    );
}

#[test]
fn the_engine_breaks_nowhere_and_plain_f32_fails_far_away() {
    let report = |jobs| {
        measure(&Options { cuts: 0, per_rung: 4, seed: 5, jobs }, &|_, _, _| {})
            .expect("the scenes are there")
    };
    let (one, two) = (report(1), report(2));
    assert_eq!(one, two);
    for ladder in &one.ladders {
        assert_eq!(ladder.ours, Until::All, "{}", ladder.name);
        assert!(ladder.rungs.iter().all(|rung| rung.cuts == 4), "{}", ladder.name);
    }
    let far = &one.ladders[0];
    assert!(far.rungs[0].ours.applied > 0 && far.rungs[0].plain_f64.failures.is_empty());
    assert!(far.rungs.last().is_some_and(|rung| rung.plain_f32.lost() > 0), "{far:?}");
    assert_eq!(one.tables().len(), 1 + LADDERS.len());
}

#[test]
fn what_fails_is_drawn() {
    let of = |failures: [usize; 2]| {
        let rungs = vec![rung(0.0, failures[0]), rung(1e6, failures[1])];
        let ladder = LadderReport::new(&LADDERS[0], rungs);
        let (name, picture) = ladder.plot();
        assert_eq!(name, "stability-translation.svg");
        assert!(picture.starts_with("<svg") && picture.ends_with("</svg>\n") && !picture.contains("NaN"));
        (picture.matches("class=\"failed\"").count(), picture.contains(">1e6</text>"))
    };
    assert_eq!(of([0, 0]), (0, true));
    assert_eq!(of([0, 3]), (2, true));
    assert_eq!(of([9, 9]), (4, true));
}
