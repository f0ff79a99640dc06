//! The session: event by event the same state as was reached here, whether it keeps everything for seeking, or nothing, or looks at
//! everything after every event; and wherever one seeks, the end is the same.

use super::{Verdict, require};
use crate::attack::drive::digest;
use crate::attack::trial::Ground;
use crate::attack::{Finding, Hits};
use crate::engine::wound::{State, Wound, WoundEvent};
use crate::recording::Recording;
use crate::replay::{Options, Replay, Session};

pub(super) fn look(
    ground: &Ground,
    recording: &Recording<WoundEvent>,
    end: &State,
    hits: &mut Hits,
) -> Verdict {
    if recording.events.is_empty() {
        return Ok(());
    }
    hits.note("oracle session");
    let plain = run(ground, recording, Options::default());
    if let Some(finding) = plain.finding() {
        return Err(Finding::new(&format!("session/{}", finding.name()), finding.check.detail.clone()));
    }
    let digest_here = digest(end);
    require(digest(plain.engine_state()) == digest_here, "session-state", || {
        "it ends in another state".into()
    })?;
    if ground.mesh.face_count() > super::SMALL {
        return seek(ground, recording, 1 << 14, &digest_here);
    }
    let paranoid = run(ground, recording, Options { paranoid: true, ..Options::default() });
    let outcomes = |session: &Session<Wound>| {
        let events = session.run_report("").events;
        events.into_iter().map(|event| (event.outcome, event.reason)).collect::<Vec<_>>()
    };
    require(outcomes(&plain) == outcomes(&paranoid), "session-paranoid", || {
        "looking changes outcomes".into()
    })?;
    // One of them: by all three a recording would be run for most of the time for the third time.
    let budgets = [0, 1 << 14, Options::default().budget_bytes];
    seek(ground, recording, budgets[(recording.seed % budgets.len() as u64) as usize], &digest_here)
}

fn run(ground: &Ground, recording: &Recording<WoundEvent>, options: Options) -> Session<Wound> {
    let events = recording.events.iter().map(|keyed| (keyed.key, keyed.event.clone())).collect();
    let mut session = Session::<Wound>::new(ground.state(), events, recording.seed, options);
    session.finish();
    session
}

/// To a place and back to the end, and step by step back to the beginning.
fn seek(
    ground: &Ground,
    recording: &Recording<WoundEvent>,
    budget_bytes: usize,
    end: &[blake3::Hash],
) -> Verdict {
    let mut session = run(ground, recording, Options { budget_bytes, ..Options::default() });
    let events = recording.events.len();
    for place in [events / 2, 0, events.saturating_sub(1)] {
        session.seek(place);
        session.seek(events);
        let same = digest(session.engine_state()) == end;
        require(same, "session-seek", || format!("the end is another one after seeking to {place}"))?;
    }
    while session.back() {}
    let same = digest(session.engine_state()) == digest(&ground.state());
    require(same, "session-back", || "back at the beginning it is another state".into())?;
    match session.finding() {
        Some(finding) => {
            Err(Finding::new(&format!("session/{}", finding.name()), finding.check.detail.clone()))
        }
        None => Ok(()),
    }
}
