//! What one run of the program reads and writes, so that no answer destroys what it is the answer to.
//!
//! A path that is typed for an answer may be that of the recording, of its mesh, of a map, of the other answer. All of them are known here by
//! their real paths: whatever was read, and whatever was claimed for an answer. Files that belong to the program, such as goldens and caches, are read and
//! written as often as need be. What is known is known of a thread, which does one thing after the other: what its helpers read is not.

use std::cell::RefCell;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use super::error::{AssetError, Fault, FaultKind};
use super::files::write_file;

thread_local! {
    static READ: RefCell<BTreeSet<PathBuf>> = const { RefCell::new(BTreeSet::new()) };
    static CLAIMED: RefCell<BTreeSet<PathBuf>> = const { RefCell::new(BTreeSet::new()) };
}

/// Forgets everything: another command begins.
pub fn begin_outputs() {
    READ.take();
    CLAIMED.take();
}

/// Remembers a file as one that was read.
pub(super) fn note_read(path: &Path) {
    if let Ok(real) = fs::canonicalize(path) {
        READ.with_borrow_mut(|read| read.insert(real));
    }
}

/// Writes an answer to where it was asked for. Refused over what this run has read, or has written as another answer.
pub fn write_output(path: &Path, bytes: &[u8]) -> Result<(), AssetError> {
    claim_output(path)?;
    write_file(path, bytes)?;
    // Now it has a real path, if it had none before.
    claim(path);
    Ok(())
}

/// Claims a path for an answer that is about to be written. An error says what is there already.
pub fn claim_output(path: &Path) -> Result<(), AssetError> {
    let refuse = |why: &str| Err(Fault::whole(FaultKind::Io, why).in_file(path));
    let Some(real) = fs::canonicalize(path).ok().filter(|real| real.is_file()) else { return Ok(()) };
    if READ.with_borrow(|read| read.contains(&real)) {
        return refuse("would be written over an input");
    }
    match claim(path) {
        true => Ok(()),
        false => refuse("would be written twice, as two answers"),
    }
}

/// Whether nobody had claimed it.
fn claim(path: &Path) -> bool {
    let real = fs::canonicalize(path).ok().filter(|real| real.is_file());
    real.is_none_or(|real| CLAIMED.with_borrow_mut(|claimed| claimed.insert(real)))
}

#[cfg(test)]
mod tests {
    use super::super::files::read_file;
    use super::*;

    #[test]
    fn an_answer_is_never_written_over_an_input_or_another_answer() {
        let folder = tempfile::tempdir().expect("a folder");
        let at = |name: &str| folder.path().join(name);
        fs::create_dir(at("below")).expect("made");
        write_file(&at("input"), b"x").expect("written");
        read_file(&at("input")).expect("read");
        let error = write_output(&at("below/../input"), b"y").expect_err("it was read").to_string();
        assert!(error.contains("input") && error.ends_with("would be written over an input"), "{error}");
        assert_eq!(fs::read(at("input")).expect("read"), b"x");
        write_output(&at("answer"), b"1").expect("written");
        let error = write_output(&at("below/../answer"), b"2").expect_err("it is another's").to_string();
        assert!(error.ends_with("would be written twice, as two answers"), "{error}");
        assert_eq!(fs::read(at("answer")).expect("read"), b"1");
        begin_outputs();
        write_output(&at("below/../answer"), b"3").expect("the next command writes what it wants");
    }

    #[test]
    fn what_was_there_from_another_run_is_written_over() {
        let folder = tempfile::tempdir().expect("a folder");
        let old = folder.path().join("old");
        write_file(&old, b"x").expect("written");
        write_output(&old, b"y").expect("written over");
        assert_eq!(fs::read(&old).expect("read"), b"y");
    }
}
