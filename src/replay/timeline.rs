//! What a session keeps so that it can go back: a step for every event, and keyframes, under one byte budget.
//!
//! A step holds the control state on its two sides and what it did to the body. When the budget is spent, the steps farthest from
//! where the session stands go first; from then on whole states are kept as keyframes, in half of the budget, and twice as far
//! apart whenever that half is full. Undo needs its own patches and holds them whatever the budget.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::engine::Engine;

/// What can be undone and redone, newest last.
pub(super) struct Stacks<E: Engine> {
    pub(super) undo: Vec<Arc<E::Patch>>,
    pub(super) redo: Vec<Arc<E::Patch>>,
    /// Edits so far: commits, undos and redos.
    pub(super) edits: usize,
}

impl<E: Engine> Default for Stacks<E> {
    fn default() -> Self {
        Self { undo: Vec::new(), redo: Vec::new(), edits: 0 }
    }
}

impl<E: Engine> Clone for Stacks<E> {
    fn clone(&self) -> Self {
        Self { undo: self.undo.clone(), redo: self.redo.clone(), edits: self.edits }
    }
}

impl<E: Engine> Stacks<E> {
    /// Takes the newest edit back. False when there is none.
    pub(super) fn undo(&mut self, state: &mut E::State) -> bool {
        let Some(patch) = self.undo.pop() else { return false };
        E::revert(state, &patch);
        self.redo.push(patch);
        true
    }

    /// Does the last undone edit again. False when there is none.
    pub(super) fn redo(&mut self, state: &mut E::State) -> bool {
        let Some(patch) = self.redo.pop() else { return false };
        E::apply(state, &patch);
        self.undo.push(patch);
        true
    }

    /// Keeps a new edit; returns what can no longer be redone.
    pub(super) fn commit(&mut self, patch: Arc<E::Patch>) -> Vec<Arc<E::Patch>> {
        self.undo.push(patch);
        std::mem::take(&mut self.redo)
    }

    /// Takes everything back that was ever done to the body.
    pub(super) fn rewind(&mut self, state: &mut E::State) {
        while let Some(patch) = self.undo.pop() {
            E::revert(state, &patch);
        }
        *self = Self::default();
    }
}

/// What an event did to the body.
pub(super) enum Change<E: Engine> {
    /// Nothing.
    None,
    /// An edit, and what could be redone before it.
    Commit { patch: Arc<E::Patch>, cleared: Vec<Arc<E::Patch>> },
    /// It took the newest edit back.
    Undo,
    /// It did the last undone edit again.
    Redo,
}

impl<E: Engine> Change<E> {
    pub(super) fn is_edit(&self) -> bool {
        !matches!(self, Self::None)
    }

    /// Does it again.
    fn forward(&self, state: &mut E::State, stacks: &mut Stacks<E>) {
        match self {
            Self::None => {}
            Self::Commit { patch, .. } => {
                E::apply(state, patch);
                stacks.commit(Arc::clone(patch));
            }
            Self::Undo => assert!(stacks.undo(state), "the stacks are those from before the event"),
            Self::Redo => assert!(stacks.redo(state), "the stacks are those from before the event"),
        }
        stacks.edits += usize::from(self.is_edit());
    }

    /// Takes it back.
    fn backward(&self, state: &mut E::State, stacks: &mut Stacks<E>) {
        match self {
            Self::None => {}
            Self::Commit { patch, cleared } => {
                E::revert(state, patch);
                stacks.undo.pop();
                stacks.redo.clone_from(cleared);
            }
            Self::Undo => assert!(stacks.redo(state), "the stacks are those from after the event"),
            Self::Redo => assert!(stacks.undo(state), "the stacks are those from after the event"),
        }
        stacks.edits -= usize::from(self.is_edit());
    }

    fn bytes(&self) -> usize {
        match self {
            Self::Commit { patch, cleared } => E::patch_bytes(patch) + size_of_val(cleared.as_slice()),
            _ => 0,
        }
    }
}

/// An event that was run, as it can be walked.
pub(super) struct Step<E: Engine> {
    pub(super) before: E::Control,
    pub(super) after: E::Control,
    pub(super) change: Change<E>,
}

impl<E: Engine> Step<E> {
    pub(super) fn forward(&self, state: &mut E::State, stacks: &mut Stacks<E>) {
        self.change.forward(state, stacks);
        E::set_control(state, self.after.clone());
    }

    pub(super) fn backward(&self, state: &mut E::State, stacks: &mut Stacks<E>) {
        self.change.backward(state, stacks);
        E::set_control(state, self.before.clone());
    }

    fn bytes(&self) -> usize {
        size_of::<Self>() + self.change.bytes()
    }
}

/// A whole state, with what can be undone and redone in it.
pub(super) struct Keyframe<E: Engine> {
    pub(super) state: E::State,
    pub(super) stacks: Stacks<E>,
}

impl<E: Engine> Keyframe<E> {
    fn bytes(&self) -> usize {
        let patches = self.stacks.undo.len() + self.stacks.redo.len();
        E::state_bytes(&self.state) + patches * size_of::<Arc<E::Patch>>()
    }
}

/// Events between two keyframes at first.
const FIRST_STRIDE: usize = 16;

/// Steps and keyframes by event.
pub(super) struct Timeline<E: Engine> {
    budget: usize,
    steps: BTreeMap<usize, Step<E>>,
    step_bytes: usize,
    keyframes: BTreeMap<usize, Keyframe<E>>,
    keyframe_bytes: usize,
    stride: usize,
    /// Whether a step had to go, so that keyframes are of use.
    spent: bool,
}

impl<E: Engine> Timeline<E> {
    pub(super) fn new(budget: usize) -> Self {
        Self {
            budget,
            steps: BTreeMap::new(),
            step_bytes: 0,
            keyframes: BTreeMap::new(),
            keyframe_bytes: 0,
            stride: FIRST_STRIDE,
            spent: false,
        }
    }

    pub(super) fn step(&self, event: usize) -> Option<&Step<E>> {
        self.steps.get(&event)
    }

    /// The last keyframe at or before an event.
    pub(super) fn keyframe(&self, event: usize) -> Option<(usize, &Keyframe<E>)> {
        self.keyframes.range(..=event).next_back().map(|(&at, keyframe)| (at, keyframe))
    }

    /// Bytes of all that is kept.
    pub(super) fn bytes(&self) -> usize {
        self.step_bytes + self.keyframe_bytes
    }

    pub(super) fn keep_step(&mut self, event: usize, step: Step<E>) {
        self.step_bytes += step.bytes();
        if let Some(old) = self.steps.insert(event, step) {
            self.step_bytes -= old.bytes();
        }
        self.trim(event);
    }

    /// Forgets what is known of an event and of all after it.
    pub(super) fn truncate(&mut self, events: usize) {
        let steps = self.steps.split_off(&events);
        self.step_bytes -= steps.values().map(Step::bytes).sum::<usize>();
        let keyframes = self.keyframes.split_off(&(events + 1));
        self.keyframe_bytes -= keyframes.values().map(Keyframe::bytes).sum::<usize>();
    }

    /// Whether a keyframe before this event is worth its bytes.
    pub(super) fn wants_keyframe(&self, event: usize, state_bytes: usize) -> bool {
        let new = event > 0 && !self.keyframes.contains_key(&event);
        self.spent && new && event.is_multiple_of(self.stride) && state_bytes <= self.budget / 2
    }

    pub(super) fn keep_keyframe(&mut self, event: usize, keyframe: Keyframe<E>) {
        self.keyframe_bytes += keyframe.bytes();
        self.keyframes.insert(event, keyframe);
        while self.keyframe_bytes > self.budget / 2 && !self.keyframes.is_empty() {
            self.stride *= 2;
            let stride = self.stride;
            self.keyframes.retain(|at, _| at.is_multiple_of(stride));
            self.keyframe_bytes = self.keyframes.values().map(Keyframe::bytes).sum();
        }
        self.trim(event);
    }

    /// Drops the steps farthest from an event until the budget holds.
    fn trim(&mut self, event: usize) {
        while self.bytes() > self.budget {
            let ends = (self.steps.keys().next().copied(), self.steps.keys().next_back().copied());
            let (Some(first), Some(last)) = ends else { return };
            let farthest = if event.abs_diff(first) >= event.abs_diff(last) { first } else { last };
            let dropped = self.steps.remove(&farthest);
            self.step_bytes -= dropped.map_or(0, |step| step.bytes());
            self.spent = true;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::replay::toy::{Toy, ToyControl, ToyState};

    fn step() -> Step<Toy> {
        Step { before: ToyControl::default(), after: ToyControl::default(), change: Change::None }
    }

    fn keyframe() -> Keyframe<Toy> {
        Keyframe { state: ToyState::new(10), stacks: Stacks::default() }
    }

    #[test]
    fn the_steps_farthest_away_go_first() {
        let mut timeline = Timeline::new(3 * step().bytes());
        (0..6).for_each(|event| timeline.keep_step(event, step()));
        let kept = |t: &Timeline<Toy>| t.steps.keys().copied().collect::<Vec<_>>();
        assert_eq!(kept(&timeline), [3, 4, 5]);
        timeline.keep_step(1, step());
        assert_eq!(kept(&timeline), [1, 3, 4]);
        assert_eq!(timeline.bytes(), 3 * step().bytes());
    }

    #[test]
    fn keyframes_come_when_the_budget_is_spent_and_thin_out() {
        let room = keyframe().bytes();
        let mut timeline = Timeline::<Toy>::new(8 * room);
        assert!(!timeline.wants_keyframe(16, room), "steps do");
        (0..40).for_each(|event| timeline.keep_step(event, step()));
        assert!(timeline.wants_keyframe(16, room) && !timeline.wants_keyframe(17, room));
        assert!(!timeline.wants_keyframe(16, 5 * room), "one would fill more than half");
        for event in (16..=16 * 6).step_by(16) {
            timeline.keep_keyframe(event, keyframe());
        }
        assert_eq!(timeline.keyframes.keys().copied().collect::<Vec<_>>(), [32, 64, 96]);
        assert_eq!(timeline.keyframe(70).map(|(at, _)| at), Some(64));
        assert!(timeline.bytes() <= 8 * room);
    }
}
