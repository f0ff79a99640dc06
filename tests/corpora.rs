//! Every input that a fuzzer ever kept, run again: nothing is found, and every target has a corpus that reaches something.
#![cfg(feature = "attack")]

use std::fs;
use std::path::{Path, PathBuf};

use lancet::attack::{Hits, TARGETS, Target};

/// A corpus is for replaying in seconds; `cargo fuzz cmin` makes a grown one small again.
const MOST_FILES: usize = 600;
const MOST_BYTES: u64 = 512 << 10;

/// The targets with a corpus: the canary has none, since without its bug it is another target's double.
fn kept() -> impl Iterator<Item = &'static Target> {
    TARGETS.iter().filter(|target| target.name != "canary")
}

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz")
}

fn corpus(name: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder().join("corpus").join(name)).unwrap_or_else(|e| panic!("{name}: {e}"));
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.expect("an entry").path()).collect();
    files.sort();
    files
}

fn replay(target: &Target) -> (Hits, Vec<String>) {
    let (mut hits, mut findings) = (Hits::default(), Vec::new());
    for path in corpus(target.name) {
        match target.attempt(&fs::read(&path).expect("a file of the corpus")) {
            Ok(reached) => hits.add(&reached),
            Err(finding) => findings.push(format!("{}: {finding}", path.display())),
        }
    }
    (hits, findings)
}

#[test]
fn nothing_is_found_in_the_corpora() {
    for target in kept() {
        let (hits, findings) = replay(target);
        assert!(findings.is_empty(), "\n{}", findings.join("\n"));
        assert!(hits.0.len() >= 3, "{} reaches but {hits:?}", target.name);
        // An oracle that nothing comes to any longer would find nothing, and say so to nobody.
        let oracles: &[&str] = match target.name {
            "cuts" => &["alike", "commute", "exact", "rational", "session"],
            "fusion" => &["alike", "exact", "rational", "session"],
            "paint" => &["paint"],
            _ => &[],
        };
        for oracle in oracles {
            assert!(hits.0.contains_key(&format!("oracle {oracle}")), "{}: no {oracle}", target.name);
        }
    }
}

#[test]
fn corpora_are_small() {
    for target in kept() {
        let files = corpus(target.name);
        let bytes: u64 = files.iter().map(|path| path.metadata().expect("a file").len()).sum();
        assert!((1..=MOST_FILES).contains(&files.len()), "{}: {} files", target.name, files.len());
        assert!(bytes <= MOST_BYTES, "{}: {bytes} bytes", target.name);
    }
}

#[test]
fn every_target_has_its_thin_file_and_no_file_is_without_one() {
    let entries = fs::read_dir(folder().join("fuzz_targets")).expect("a folder");
    let mut files: Vec<String> = entries
        .map(|entry| entry.expect("an entry").path())
        .map(|path| path.file_stem().expect("a name").to_str().expect("plain").to_owned())
        .collect();
    files.sort();
    let mut names: Vec<&str> = TARGETS.iter().map(|target| target.name).collect();
    names.sort_unstable();
    assert_eq!(files, names);
    let manifest = fs::read_to_string(folder().join("Cargo.toml")).expect("a manifest");
    for name in names {
        let code = fs::read_to_string(folder().join(format!("fuzz_targets/{name}.rs"))).expect("a file");
        assert!(code.contains(&format!("attack(\"{name}\", data)")), "{name}");
        assert!(manifest.contains(&format!("path = \"fuzz_targets/{name}.rs\"")), "{name}");
    }
}
