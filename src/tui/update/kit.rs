//! Models to test with.

use std::sync::Arc;

use crate::report::{Counter, EventReport, Outcome, Rejection, StageReport};
use crate::tui::model::{Model, Place};
use crate::tui::worker::{Opened, Standing};

/// Four events, of which three have run: a mode, a rejected click, and a cut with three stages of which one was skipped.
pub(in crate::tui) fn model() -> Model {
    let opened = Opened {
        path: Some("some/where.lancet".into()),
        engine: "an-engine".into(),
        stages: ["AA", "SO", "AB"].map(|id| (id.into(), "a stage".into())).to_vec(),
        lines: ["mode", "click", "cut", "cut"].map(|kind| format!("{{\"{kind}\":[]}}")).to_vec(),
        scene: "builtin:some".into(),
        viewport: [640, 480],
        renderer: "none".into(),
    };
    let reports = reports().into_iter().map(Arc::new).collect();
    let mut model = Model { opened: Some(opened), reports, size: [80, 24], ..Model::default() };
    model.standing = Some(standing(Place::START));
    model
}

/// The reports of the events that have run.
pub(in crate::tui) fn reports() -> Vec<EventReport> {
    let mut click = EventReport::new(1, "click");
    click.reject(Rejection::new("miss", "beside it"));
    let stage = |id: &str, us| StageReport { us, skipped: None, ..StageReport::skipped(id, "") };
    let stages = vec![stage("AA", 700.0), StageReport::skipped("SO", "mode"), stage("AB", 20.0)];
    let by_name = Counter::ByName([("x".into(), 2), ("y".into(), 0)].into());
    let counters = [("sorts".into(), by_name), ("hops".into(), Counter::Count(3))].into();
    let outcome = Outcome::Applied;
    let cut = EventReport { stages, counters, outcome, cut: true, ..EventReport::new(2, "cut") };
    vec![EventReport::new(0, "mode"), click, cut]
}

/// The worker at a place.
pub(in crate::tui) fn standing(place: Place) -> Standing {
    Standing { place, within: None, sizes: Vec::new(), orbit: None, mode: "one", kept_bytes: 0 }
}

/// Lets the last event run, too.
pub(in crate::tui) fn report_all(model: &mut Model) {
    model.reports.push(Arc::new(EventReport::new(3, "cut")));
}
