//! A small engine to test the session with: a list of numbers that events add to.
//!
//! `AD` adds, `HV` halves what has grown too large; each changes the list before it may reject, so that a rollback has something
//! to take back. A negative sum breaks the invariant.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::engine::{Control, Engine, Event, Part, Shown, Stage, Start};
use crate::report::{Buffer, Check, Counter, Outcome, Rejection, Scalar};

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub(crate) enum ToyEvent {
    /// Adds a value, and a little from the seed, to an element; one past the end appends.
    Add(usize, f64),
    /// The second of two adds 1 to each element between them.
    Click(usize),
    /// Whether HV takes part.
    Halve(bool),
    /// A bug: it depends on something that going back does not restore.
    Leak,
    Undo,
    Redo,
    Checkpoint(String),
}

impl Event for ToyEvent {
    fn kind(&self) -> &'static str {
        match self {
            Self::Add(..) => "add",
            Self::Click(_) => "click",
            Self::Halve(_) => "halve",
            Self::Leak => "leak",
            Self::Undo => "undo",
            Self::Redo => "redo",
            Self::Checkpoint(_) => "checkpoint",
        }
    }

    fn control(&self) -> Control<'_> {
        match self {
            Self::Undo => Control::Undo,
            Self::Redo => Control::Redo,
            Self::Checkpoint(name) => Control::Checkpoint(name),
            _ => Control::Step,
        }
    }

    fn validate(&self) -> Result<(), String> {
        Ok(())
    }
}

#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct ToyControl {
    pub(crate) halve: bool,
    pub(crate) pending: Option<usize>,
}

#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct ToyState {
    pub(crate) numbers: Vec<f64>,
    pub(crate) control: ToyControl,
    leaks: u32,
}

impl ToyState {
    pub(crate) fn new(count: usize) -> Self {
        Self { numbers: vec![0.0; count], control: ToyControl { halve: true, pending: None }, leaks: 0 }
    }
}

pub(crate) struct ToyWork {
    from: usize,
    to: usize,
    value: f64,
    halve: bool,
    before: Vec<f64>,
}

pub(crate) struct ToyPatch {
    before: Vec<f64>,
    after: Vec<f64>,
}

pub(crate) struct Toy;

fn add(state: &mut ToyState, work: &mut ToyWork) -> Result<(), Rejection> {
    if work.to > state.numbers.len() {
        return Err(Rejection::new("miss", format!("there is no element {}", work.to)));
    }
    if work.to == state.numbers.len() {
        state.numbers.push(0.0);
    }
    state.numbers[work.from..=work.to].iter_mut().for_each(|n| *n += work.value);
    Ok(())
}

fn halve(state: &mut ToyState, work: &mut ToyWork) -> Result<(), Rejection> {
    state.numbers[work.from..=work.to].iter_mut().filter(|n| **n > 100.0).for_each(|n| *n /= 2.0);
    let large = state.numbers.iter().any(|n| *n > 200.0);
    if large { Err(Rejection::new("too-large", "halving once does not do")) } else { Ok(()) }
}

fn changed(state: &ToyState, work: &ToyWork) -> Vec<Buffer> {
    let mut buffer = Buffer::new("numbers", "x", Scalar::F64, 1);
    for (i, n) in state.numbers.iter().enumerate() {
        if work.before.get(i) != Some(n) {
            buffer.push_f64(i as u32, &[*n]);
        }
    }
    vec![buffer]
}

fn sum(state: &ToyState) -> Check {
    let sum: f64 = state.numbers.iter().sum();
    if sum < 0.0 { Check::fail("sum", format!("{sum} is negative")) } else { Check::pass("sum") }
}

fn open(state: &ToyState, from: usize, to: usize, value: f64) -> Start<ToyWork> {
    let (from, to) = (from.min(to), from.max(to));
    Start::Run(ToyWork { from, to, value, halve: state.control.halve, before: state.numbers.clone() })
}

impl Engine for Toy {
    const NAME: &'static str = "toy";
    const STAGES: &'static [Stage<Self>] = &[
        Stage {
            id: "AD",
            title: "add",
            part: |_| Part::Run,
            run: add,
            job: |_| None,
            buffers: changed,
            check: |state, _| vec![sum(state)],
        },
        Stage {
            id: "NO",
            title: "never",
            part: |_| Part::Absent,
            run: |_, _| Ok(()),
            job: |_| None,
            buffers: |_, _| Vec::new(),
            check: |_, _| Vec::new(),
        },
        Stage {
            id: "HV",
            title: "halve",
            part: |work| if work.halve { Part::Run } else { Part::Skip("switched off") },
            run: halve,
            job: |_| None,
            buffers: changed,
            check: |state, _| vec![Check::at_most("size", state.numbers.len() as f64, 1e6)],
        },
    ];
    type Event = ToyEvent;
    type State = ToyState;
    type Control = ToyControl;
    type Work = ToyWork;
    type Patch = ToyPatch;

    fn start(state: &mut ToyState, event: &ToyEvent, seed: u64) -> Start<ToyWork> {
        let pending = state.control.pending.take();
        match (event, pending) {
            (ToyEvent::Add(at, value), _) => open(state, *at, *at, value + (seed % 7) as f64),
            (ToyEvent::Click(at), Some(first)) => open(state, first, *at, 1.0),
            (ToyEvent::Click(at), None) if *at > state.numbers.len() => {
                Start::Rejected(Rejection::new("miss", "beside the list"))
            }
            (ToyEvent::Click(at), None) => {
                state.control.pending = Some(*at);
                Start::Done(Outcome::Pending)
            }
            (ToyEvent::Halve(on), pending) => {
                state.control.halve = *on;
                Start::Done(if pending.is_some() { Outcome::Cancelled } else { Outcome::None })
            }
            (ToyEvent::Leak, _) => {
                state.leaks += 1;
                Start::Rejected(Rejection::new("leak", state.leaks.to_string()))
            }
            _ => Start::Done(Outcome::None),
        }
    }

    fn interrupt(state: &mut ToyState, event: &ToyEvent) -> bool {
        !matches!(event, ToyEvent::Checkpoint(_)) && state.control.pending.take().is_some()
    }

    fn commit(state: &mut ToyState, work: &mut ToyWork) -> ToyPatch {
        ToyPatch { before: std::mem::take(&mut work.before), after: state.numbers.clone() }
    }

    fn rollback(state: &mut ToyState, work: &mut ToyWork) {
        state.numbers = std::mem::take(&mut work.before);
    }

    fn revert(state: &mut ToyState, patch: &ToyPatch) {
        assert_eq!(state.numbers, patch.after, "patches are taken back newest first");
        state.numbers.clone_from(&patch.before);
    }

    fn apply(state: &mut ToyState, patch: &ToyPatch) {
        assert_eq!(state.numbers, patch.before, "patches are done again in order");
        state.numbers.clone_from(&patch.after);
    }

    fn show(_: &ToyState, work: &ToyWork) -> Shown {
        let counters = [("width".to_string(), Counter::Count((work.to - work.from + 1) as u64))].into();
        Shown { counters, ..Shown::default() }
    }

    fn control(state: &ToyState) -> ToyControl {
        state.control.clone()
    }

    fn set_control(state: &mut ToyState, control: ToyControl) {
        state.control = control;
    }

    fn mode(state: &ToyState) -> &'static str {
        if state.control.halve { "half" } else { "plain" }
    }

    fn buffers(state: &ToyState) -> Vec<Buffer> {
        let mut numbers = Buffer::new("numbers", "x", Scalar::F64, 1);
        state.numbers.iter().enumerate().for_each(|(i, n)| numbers.push_f64(i as u32, &[*n]));
        let mut control = Buffer::new("control", "c", Scalar::U32, 2);
        let pending = state.control.pending.map_or(0, |p| p as u32 + 1);
        control.push_u32(0, &[u32::from(state.control.halve), pending]);
        vec![numbers, control]
    }

    fn check(state: &ToyState) -> Vec<Check> {
        vec![sum(state)]
    }

    fn counts(state: &ToyState) -> Vec<(&'static str, i64)> {
        vec![("numbers", state.numbers.len() as i64)]
    }

    fn state_bytes(state: &ToyState) -> usize {
        state.numbers.len() * 8
    }

    fn patch_bytes(patch: &ToyPatch) -> usize {
        (patch.before.len() + patch.after.len()) * 8
    }

    fn plant(state: &mut ToyState, buffer: &str, element: u32, ulps: i64) -> Result<(), String> {
        if buffer != "numbers" {
            return Err(format!("there is no buffer `{buffer}`"));
        }
        let number = state.numbers.get_mut(element as usize);
        let number = number.ok_or_else(|| format!("there is no element {element}"))?;
        *number = f64::from_bits(number.to_bits().wrapping_add_signed(ulps));
        Ok(())
    }
}
