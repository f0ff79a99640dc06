//! The subjects as a whole.

use super::*;

#[test]
fn subjects_are_called_by_their_names() {
    let names: Vec<&str> = chosen(&[]).expect("all").iter().map(|s| s.name).collect();
    assert_eq!(names, SUBJECTS.iter().map(|s| s.name).collect::<Vec<_>>());
    assert_eq!(chosen(&["painting".into()]).expect("one").len(), 1);
    let error = chosen(&["cheese".into()]).err().expect("there is no such subject");
    assert!(error.to_string().contains("painting"), "{error}");
}
