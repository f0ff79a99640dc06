//! Fifteen hundred random and hostile cuts: nothing breaks, and the answer does not depend on the threads.

use lancet::measure::stability::{Options, StabilityReport, measure};

fn report(cuts: usize, jobs: usize) -> StabilityReport {
    measure(&Options { cuts, per_rung: 0, seed: 20_161, jobs }, &|_, _, _| {}).expect("the scenes are there")
}

#[test]
fn random_and_hostile_cuts_break_no_invariant() {
    let report = report(1_500, 2);
    let findings: Vec<String> =
        report.findings.iter().map(|f| format!("{}: {:?}\n{}", f.scene, f.check, f.script)).collect();
    assert!(findings.is_empty(), "{}", findings.join("\n"));
    assert_eq!(report.cuts, 1_500);
    assert!(report.scenes.iter().all(|scene| scene.cuts > 0 && scene.applied > 0), "{:?}", report.scenes);
    // Every kind is there, and most of what meets the surface is applied.
    assert!(
        report.kinds.iter().all(|kind| kind.cuts >= 200 && 2 * kind.applied > kind.two_hits),
        "{:?}",
        report.kinds
    );
}

#[test]
fn the_answer_does_not_depend_on_the_threads() {
    let (one, three) = (report(200, 1), report(200, 3));
    assert_eq!(one, three);
    assert_ne!(one.scenes, report(300, 2).scenes);
}
