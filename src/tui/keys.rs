//! Which key does what: the table of actions, and what the configuration changes about it.

use std::collections::BTreeMap;

use super::action::{ACTIONS, Action, Row, Scope};
use super::key::Key;
use super::model::{Model, Pane};

/// See the module.
#[derive(Clone, Debug)]
pub(in crate::tui) struct Keys(BTreeMap<Action, Vec<Key>>);

impl Keys {
    /// The keys of the table, with others for the actions that are named in `changed`. A key that is given to an action there is no longer that of
    /// another one in the same scope.
    pub(in crate::tui) fn new(changed: &[(String, Vec<Key>)]) -> Self {
        let own = |name: &str| changed.iter().find(|(other, _)| other == name).map(|(_, keys)| keys.clone());
        let taken = |scope: Scope, key: &Key| {
            let same = |name: &str| ACTIONS.iter().any(|row| row.name == name && row.scope == scope);
            changed.iter().any(|(name, keys)| keys.contains(key) && same(name))
        };
        let usual = |row: &Row| {
            let keys = row.keys.iter().filter_map(|key| key.parse().ok());
            keys.filter(|key| !taken(row.scope, key)).collect()
        };
        Self(ACTIONS.iter().map(|row| (row.action, own(row.name).unwrap_or_else(|| usual(row)))).collect())
    }

    /// The first key of an action, for people.
    pub(in crate::tui) fn first(&self, action: Action) -> Option<Key> {
        self.of(action).first().copied()
    }

    /// The keys of an action.
    pub(in crate::tui) fn of(&self, action: Action) -> &[Key] {
        self.0.get(&action).map_or(&[], Vec::as_slice)
    }

    /// What a key does where the focus is.
    pub(in crate::tui) fn action(&self, key: Key, model: &Model) -> Option<Action> {
        scopes(model).iter().find_map(|scope| {
            let rows = ACTIONS.iter().filter(|row| row.scope == *scope);
            rows.map(|row| row.action).find(|action| self.of(*action).contains(&key))
        })
    }
}

/// The scopes that count, the nearest first.
fn scopes(model: &Model) -> Vec<Scope> {
    let recording = model.recorder.is_some() && model.focus == Pane::Picture;
    let near = if model.focus == Pane::Picture { Scope::Picture } else { Scope::List };
    recording.then_some(Scope::Recording).into_iter().chain([near, Scope::Always]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_key_of_the_table_is_one_and_no_two_actions_of_a_scope_share_one() {
        let keys = Keys::new(&[]);
        for row in ACTIONS {
            assert_eq!(keys.of(row.action).len(), row.keys.len(), "{}", row.name);
            let same = |other: &&super::super::action::Row| {
                other.scope == row.scope && other.keys.iter().any(|key| row.keys.contains(key))
            };
            let sharing: Vec<&str> = ACTIONS.iter().filter(same).map(|other| other.name).collect();
            assert!(sharing.len() <= 1, "{sharing:?}");
        }
    }

    #[test]
    fn the_nearest_scope_has_the_key_and_the_configuration_the_last_word() {
        let mut model = Model::default();
        let key = |text: &str| text.parse::<Key>().expect("a key");
        let usual = Keys::new(&[]);
        assert_eq!(usual.action(key("left"), &model), Some(Action::PreviousEvent));
        model.focus = Pane::Picture;
        assert_eq!(usual.action(key("left"), &model), Some(Action::OrbitLeft));
        let own = Keys::new(&[("quit".into(), vec![key("ctrl-x")])]);
        assert_eq!(own.action(key("ctrl-x"), &model), Some(Action::Quit));
        assert_eq!(own.action(key("q"), &model), None);
        let own = Keys::new(&[("quit".into(), vec![key("l")]), ("zoom-in".into(), vec![key("r")])]);
        assert_eq!(own.action(key("l"), &model), Some(Action::Quit), "no longer a step");
        assert_eq!(own.of(Action::NextEvent), [key("right")]);
        assert_eq!(own.of(Action::Record), [key("r")], "another scope");
    }
}
