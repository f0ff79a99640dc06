//! What every fuzz target does: run the bytes, and on a finding leave the recording that leads to it beside libFuzzer's own artifact.
//!
//! libFuzzer stops the process at the first panic, before a stack is unwound. So what the bytes stand for is written from the panic's hook, which
//! comes first; `lancet tui` and `lancet reduce` then open it. It goes into the folder that LANCET_FINDINGS names, else into artifacts/TARGET.

use std::cell::RefCell;
use std::env;
use std::fs;
use std::panic;
use std::path::PathBuf;
use std::process;

use lancet::attack::{Target, target};

thread_local! {
    /// What is being run.
    static RUNNING: RefCell<Option<(&'static str, Vec<u8>)>> = const { RefCell::new(None) };
}

/// To be called once, before the first input.
pub fn begin() {
    let before = panic::take_hook();
    panic::set_hook(Box::new(move |info| {
        RUNNING.with_borrow(|running| {
            if let Some((name, data)) = running {
                keep(name, data);
            }
        });
        before(info);
    }));
}

/// Runs an input on a target; panics with the finding if there is one.
pub fn attack(name: &'static str, data: &[u8]) {
    RUNNING.set(Some((name, data.to_vec())));
    if let Err(finding) = (of(name).run)(data) {
        if let Some(recording) = &finding.recording {
            write(name, recording);
            // The hook would write what the whole input stands for; the finding's own recording says more.
            RUNNING.set(None);
        }
        panic!("{finding}");
    }
    RUNNING.set(None);
}

fn of(name: &str) -> &'static Target {
    target(name).unwrap_or_else(|| panic!("lancet::attack has no target {name}"))
}

fn keep(name: &str, data: &[u8]) {
    if let Some(recording) = (of(name).recording)(data) {
        write(name, &recording);
    }
}

fn write(name: &str, recording: &[u8]) {
    let folder = env::var_os("LANCET_FINDINGS").map_or_else(
        || PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/artifacts")).join(name),
        PathBuf::from,
    );
    let end = if recording.starts_with(b"\x89LNCT") { "lancet" } else { "json" };
    let path = folder.join(format!("{name}-{}.{end}", process::id()));
    match fs::create_dir_all(&folder).and_then(|()| fs::write(&path, recording)) {
        Ok(()) => eprintln!("the recording of it: {}", path.display()),
        Err(error) => eprintln!("the recording of it could not be written: {}: {error}", path.display()),
    }
}
