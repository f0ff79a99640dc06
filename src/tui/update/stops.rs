//! Breakpoints: what stops a run, and where.
//!
//! Events that have run are searched in their reports, at once; the worker runs only those that have not.

use std::collections::BTreeSet;

use crate::report::{Counter, EventReport, Stop};
use crate::tui::model::{Model, Place};
use crate::tui::update::step::go;
use crate::tui::worker::Ask;

/// Adds a breakpoint.
pub(in crate::tui) fn add(model: &mut Model, text: &str) -> Result<(), String> {
    let stop: Stop = text.trim().parse()?;
    let stages = model.opened.as_ref().map_or(&[][..], |opened| &opened.stages);
    if let Some(stage) = stop.stage().filter(|stage| !stages.iter().any(|(id, _)| id == stage)) {
        let ids: Vec<&str> = stages.iter().map(|(id, _)| id.as_str()).collect();
        let there =
            if ids.is_empty() { "nothing is open".into() } else { format!("there are {}", ids.join(", ")) };
        return Err(format!("there is no stage `{stage}`; {there}"));
    }
    if model.stops.contains(&stop) {
        return Err(format!("`{stop}` is there already"));
    }
    model.stops.push(stop);
    Ok(())
}

/// The breakpoint that an event meets, if it has run and meets one.
pub(in crate::tui) fn hit(model: &Model, event: usize) -> Option<&Stop> {
    let report = model.report(event)?;
    model.stops.iter().find(|stop| stop.hits(report))
}

/// Whether an event meets a breakpoint.
pub(in crate::tui) fn hits(model: &Model, event: usize) -> bool {
    hit(model, event).is_some()
}

/// The events that have run and meet a breakpoint.
pub(in crate::tui) fn met(model: &Model, stop: &Stop) -> Vec<usize> {
    let met = |event: &usize| model.report(*event).is_some_and(|report| stop.hits(report));
    (0..model.reports.len()).filter(met).collect()
}

/// Goes to the next event that meets a breakpoint; after the last one to the first.
pub(super) fn next(model: &mut Model, stop: &Stop) {
    let met = met(model, stop);
    let here = model.place.event();
    let on = met.iter().find(|event| here.is_none_or(|here| **event > here)).or(met.first());
    match on {
        Some(event) => {
            go(model, Place::after(event + 1));
            model.say(format!("event {event} meets `{stop}`"));
        }
        None if model.reports.len() < model.len() => {
            model.say(format!("none of the events that have run meets `{stop}`"));
        }
        None => model.say(format!("no event meets `{stop}`")),
    }
}

/// Runs on to where a breakpoint is met, or to the end.
pub(super) fn run_on(model: &mut Model) {
    let known = model.reports.len();
    model.playing = None;
    // Within an event, that one is gone through to its end first.
    match (model.place.events..known).find(|event| hits(model, *event)) {
        Some(event) => {
            go(model, Place::after(event + 1));
            halt(model, event);
        }
        None if known < model.len() => model.ask(Ask::Run { from: known, stops: model.stops.clone() }),
        None => {
            go(model, Place::after(model.len()));
            model.say("stopped: the end");
        }
    }
}

/// Stops playing at an event that meets a breakpoint.
pub(super) fn halt(model: &mut Model, event: usize) {
    if let Some(stop) = hit(model, event).map(ToString::to_string) {
        model.playing = None;
        model.say(format!("stopped: {stop}"));
    }
}

/// Breakpoints that the events that have run would meet, and the stages, as they are typed.
pub(super) fn words(model: &Model) -> Vec<String> {
    let mut words: BTreeSet<String> = model.reports.iter().flat_map(|report| counted(report)).collect();
    words.extend(
        model.reports.iter().filter_map(|report| Some(format!("rejected={}", report.reason.as_ref()?))),
    );
    let stages = model.opened.iter().flat_map(|opened| &opened.stages).map(|(id, _)| format!("{id}>"));
    ["finding".into(), "rejected".into()].into_iter().chain(words).chain(stages).collect()
}

/// What an event counted.
fn counted(report: &EventReport) -> Vec<String> {
    let words = |(counter, value): (&String, &Counter)| match value {
        Counter::Count(count) => vec![format!("{counter}={count}")],
        Counter::ByName(counts) => {
            let names = counts.iter().filter(|(_, count)| **count > 0);
            names.map(|(name, _)| format!("{counter}={name}")).collect()
        }
    };
    report.counters.iter().flat_map(words).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tui::action::Action;
    use crate::tui::model::Effect;
    use crate::tui::update::{act, beat, kit, told};
    use crate::tui::worker::Told;

    fn stopped_at(model: &mut Model, stops: &[&str]) -> (usize, String) {
        stops.iter().for_each(|stop| add(model, stop).expect(stop));
        act(model, Action::RunOn);
        (model.place.events, model.message.as_ref().map_or_else(String::new, |said| said.text.clone()))
    }

    fn asked(model: &mut Model) -> Vec<String> {
        let effects = std::mem::take(&mut model.effects);
        effects
            .iter()
            .filter_map(|e| match e {
                Effect::Ask(ask) => Some(format!("{ask:?}")),
                _ => None,
            })
            .collect()
    }

    #[test]
    fn what_has_run_is_not_run_again() {
        let mut model = kit::model();
        assert_eq!(stopped_at(&mut model, &["sorts=x"]), (3, "stopped: sorts=x".into()));
        model.place = Place::START;
        assert_eq!(stopped_at(&mut model, &["rejected"]), (2, "stopped: rejected".into()));
        assert!(asked(&mut model).iter().all(|ask| ask.starts_with("Go(")));
        model.place = Place::after(3);
        act(&mut model, Action::RunOn);
        let asked = asked(&mut model);
        assert!(asked.len() == 1 && asked[0].starts_with("Run { from: 3,"), "{asked:?}");
    }

    #[test]
    fn without_a_breakpoint_and_with_all_known_it_goes_to_the_end_at_once() {
        let mut model = kit::model();
        kit::report_all(&mut model);
        assert_eq!(stopped_at(&mut model, &["finding"]), (4, "stopped: the end".into()));
        assert!(asked(&mut model).iter().all(|ask| ask.starts_with("Go(")));
    }

    #[test]
    fn playing_stops_at_a_breakpoint_and_goes_on_from_it() {
        let mut model = kit::model();
        kit::report_all(&mut model);
        add(&mut model, "rejected=miss").expect("a breakpoint");
        let play = |model: &mut Model| {
            act(model, Action::Play);
            while model.playing.is_some() {
                beat(model);
                model.standing = Some(kit::standing(model.place));
            }
            model.place.events
        };
        assert_eq!([play(&mut model), play(&mut model)], [2, 4]);
    }

    #[test]
    fn playing_stops_at_a_breakpoint_that_was_not_known_before() {
        let mut model = kit::model();
        let rejected = model.reports.remove(1);
        model.reports.truncate(1);
        add(&mut model, "rejected").expect("a breakpoint");
        (model.place, model.standing) = (Place::after(1), Some(kit::standing(Place::after(1))));
        act(&mut model, Action::Play);
        beat(&mut model);
        assert!(model.playing.is_some() && model.place == Place::after(2));
        told(&mut model, Told::Report(rejected));
        assert_eq!(model.playing, None);
    }

    #[test]
    fn a_breakpoint_that_can_never_be_met_is_refused() {
        let mut model = kit::model();
        add(&mut model, "AA>0.5").expect("a stage");
        assert_eq!(add(&mut model, "AA>.5"), Err("`AA>0.5` is there already".into()));
        assert_eq!(add(&mut model, "ZZ>1"), Err("there is no stage `ZZ`; there are AA, SO, AB".into()));
        assert!(add(&mut model, "nonsense").is_err_and(|error| error.contains("rejected=REASON")));
        assert_eq!((hits(&model, 1), hits(&model, 2), hits(&model, 3)), (false, true, false));
    }

    #[test]
    fn what_would_stop_is_offered() {
        let words = words(&kit::model());
        assert_eq!(words, ["finding", "rejected", "hops=3", "rejected=miss", "sorts=x", "AA>", "SO>", "AB>"]);
    }
}
