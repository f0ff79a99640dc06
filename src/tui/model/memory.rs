//! What was done before, and is offered again: the answers to each question, and the actions of the palette.

use std::collections::BTreeMap;

use crate::tui::action::Action;
use crate::tui::popups::Question;

/// As many answers to a question, or actions, are remembered.
const MOST: usize = 50;

/// See the module. The newest come first.
#[derive(Clone, Debug, Default)]
pub(in crate::tui) struct Memory {
    answers: BTreeMap<Question, Vec<String>>,
    actions: Vec<Action>,
}

impl Memory {
    /// Remembers an answer.
    pub(in crate::tui) fn answered(&mut self, question: Question, answer: &str) {
        if !answer.is_empty() {
            renew(self.answers.entry(question).or_default(), answer.to_owned());
        }
    }

    /// The answers to a question.
    pub(in crate::tui) fn answers(&self, question: Question) -> &[String] {
        self.answers.get(&question).map_or(&[], Vec::as_slice)
    }

    /// Remembers an action.
    pub(in crate::tui) fn acted(&mut self, action: Action) {
        renew(&mut self.actions, action);
    }

    /// The actions that were chosen.
    pub(in crate::tui) fn actions(&self) -> &[Action] {
        &self.actions
    }
}

fn renew<T: PartialEq>(all: &mut Vec<T>, one: T) {
    all.retain(|other| *other != one);
    all.insert(0, one);
    all.truncate(MOST);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_newest_comes_first_and_nothing_twice() {
        let mut memory = Memory::default();
        ["a", "b", "a", ""].iter().for_each(|answer| memory.answered(Question::Search, answer));
        assert_eq!(memory.answers(Question::Search), ["a", "b"]);
        assert!(memory.answers(Question::GoTo).is_empty(), "each question has its own");
        (0..200).for_each(|n: i32| memory.answered(Question::GoTo, &n.to_string()));
        assert_eq!(memory.answers(Question::GoTo).len(), MOST);
        assert_eq!(memory.answers(Question::GoTo)[0], "199");
    }
}
