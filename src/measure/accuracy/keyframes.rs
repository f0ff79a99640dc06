//! What memory buys: the time of a seek by the bytes that are kept for it.
//!
//! **Truth.** The state before an event, as linear replay comes to it. Every seek has to give that state, digest by digest, whatever is kept: an error is no
//! price to be paid here, and one that is found ends the measurement. What stands against time is memory: patches to walk, and keyframes to run again from.
//!
//! Each round seeks to another event, the same for every budget, from wherever the last round's seek ended.

use std::path::Path;

use super::Ask;
use super::curve::{Curve, Measure, Planted, Row};
use super::turns::{Task, in_turns, timed};
use crate::measure::{MeasureError, Random};
use crate::replay::{Case, Options, Plant, Replay};
use crate::report::{Outcome, StateReport};

/// The recording that is sought in.
const RECORDING: &str = "two-hundred-cuts.lancet";
/// Budgets in kibibytes, those of a quick run first.
const BUDGETS: [usize; 9] = [0, 1 << 10, 4 << 10, 16 << 10, 256 << 10, 512, 2 << 10, 8 << 10, 64 << 10];
const QUICK: usize = 5;
/// The stage and the node in which a defect is planted.
const PLANT: (&str, u32) = ("CI", 0);
/// How often the planted run is looked at.
const LOOKS: usize = 12;

/// Measures it.
pub fn run(ask: &Ask<'_>) -> Result<Vec<Curve>, MeasureError> {
    let mut budgets = ask.of(&BUDGETS, QUICK).to_vec();
    budgets.sort_unstable();
    Ok(vec![measure(&ask.recordings.join(RECORDING), &budgets, ask.rounds)?])
}

fn measure(path: &Path, kibibytes: &[usize], rounds: usize) -> Result<Curve, MeasureError> {
    let case = Case::open(path)?;
    let targets = targets(case.recording.event_count(), rounds + 1);
    let states = linear(&case, &targets, Options::default())?;
    let open = |kib: &usize| {
        let options = Options { budget_bytes: kib << 10, ..Options::default() };
        let mut replay = case.replay(&case.recording, options, None)?;
        replay.finish();
        Ok(Sought { replay, targets: &targets, states: &states, next: 0, kib: *kib })
    };
    let mut all = kibibytes.iter().map(open).collect::<Result<Vec<Sought<'_>>, MeasureError>>()?;
    let mut tasks: Vec<Task<'_>> = all.iter_mut().map(|one| Box::new(|| one.seek_us()) as Task<'_>).collect();
    let timings = in_turns(rounds, &mut tasks)?;
    drop(tasks);
    let rows = all.iter().zip(timings).map(|(one, timing)| {
        let kept = one.replay.kept_bytes() as f64 / f64::from(1 << 20);
        Row::new("states all equal", one.setting(), timing, Some(kept), Vec::new())
    });
    Ok(Curve {
        name: "keyframes".into(),
        title: "Seeking among two hundred cuts by what is kept for it".into(),
        time_of: "a seek to a random event".into(),
        error: Measure::new("memory kept for seeking", "MiB"),
        others: Vec::new(),
        rows: rows.collect(),
        planted: planted(&case)?,
    }
    .with_front())
}

/// A replay in which one seeks.
struct Sought<'a> {
    replay: Box<dyn Replay>,
    targets: &'a [usize],
    states: &'a [StateReport],
    next: usize,
    kib: usize,
}

impl Sought<'_> {
    fn seek_us(&mut self) -> Result<f64, MeasureError> {
        let i = self.next % self.targets.len();
        self.next += 1;
        let target = self.targets[i];
        let ((), us) = timed(|| self.replay.seek(target));
        match self.replay.state() == self.states[i] {
            true => Ok(us),
            false => Err(MeasureError::Rejected(format!(
                "with {} kept, seeking to event {target} gives another state than replaying to it",
                self.setting()
            ))),
        }
    }

    fn setting(&self) -> String {
        match self.kib {
            0 => "nothing".into(),
            1..1024 => format!("{} KiB", self.kib),
            kib => format!("{} MiB", kib >> 10),
        }
    }
}

/// Events to seek to.
fn targets(events: usize, count: usize) -> Vec<usize> {
    let mut random = Random::of(0, 0, "seek");
    (0..count).map(|_| random.below(events + 1)).collect()
}

/// The states before some events, replayed from the beginning.
fn linear(case: &Case, targets: &[usize], options: Options) -> Result<Vec<StateReport>, MeasureError> {
    let mut order: Vec<usize> = (0..targets.len()).collect();
    order.sort_unstable_by_key(|i| targets[*i]);
    let mut replay = case.replay(&case.recording, options, None)?;
    let mut states: Vec<(usize, StateReport)> = Vec::with_capacity(targets.len());
    for i in order {
        while replay.position() < targets[i] && replay.step().is_some() {}
        states.push((i, replay.state()));
    }
    states.sort_unstable_by_key(|state| state.0);
    Ok(states.into_iter().map(|state| state.1).collect())
}

/// One ulp in a node from the first cut on: every state after it is another one.
fn planted(case: &Case) -> Result<Planted, MeasureError> {
    let mut replay = case.replay(&case.recording, Options::default(), None)?;
    let cut = loop {
        match replay.step() {
            Some(event) if event.cut && event.outcome == Outcome::Applied => break event.index,
            Some(_) => {}
            None => return Err(MeasureError::NoCut(RECORDING.into())),
        }
    };
    let targets = targets(case.recording.event_count(), LOOKS);
    let after = targets.iter().filter(|target| **target > cut).count();
    let (stage, element) = PLANT;
    let plant = Plant { event: cut, stage: stage.into(), buffer: "nodes".into(), element, ulps: 1 };
    let states = linear(case, &targets, Options::default())?;
    let others = linear(case, &targets, Options { plant: Some(plant), ..Options::default() })?;
    let differing = states.iter().zip(&others).filter(|(a, b)| a != b).count();
    let what = "states after an ulp was moved".into();
    Ok(Planted { what, value: after as f64, measured: differing as f64 })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn recording() -> std::path::PathBuf {
        Path::new(env!("CARGO_MANIFEST_DIR")).join("recordings/wound/crossing-five-in-a-lattice.lancet")
    }

    #[test]
    fn what_is_kept_is_within_its_budget_and_gives_the_same_states() {
        let curve = measure(&recording(), &[0, 64, 1 << 20], 2).expect("it is sought in");
        let kept: Vec<f64> = curve.rows.iter().map(|row| row.error.expect("bytes")).collect();
        assert!(kept[0] == 0.0 && kept[1] <= 64.0 / 1024.0 && kept[2] > kept[1], "{kept:?}");
    }

    #[test]
    fn a_planted_ulp_is_another_state() {
        let planted = planted(&Case::open(&recording()).expect("a recording")).expect("it is replayed");
        assert!(planted.value > 0.0 && planted.measured == planted.value, "{planted:?}");
    }

    #[test]
    fn another_state_ends_the_measurement() {
        let case = Case::open(&recording()).expect("a recording");
        let targets = [case.recording.event_count()];
        let states = linear(&case, &[0], Options::default()).expect("a state");
        let replay = case.replay(&case.recording, Options::default(), None).expect("it opens");
        let mut sought = Sought { replay, targets: &targets, states: &states, next: 0, kib: 1 };
        assert!(matches!(sought.seek_us(), Err(MeasureError::Rejected(why)) if why.contains("1 KiB")));
    }
}
