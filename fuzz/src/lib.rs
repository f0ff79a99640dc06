//! What every fuzz target does: run the bytes, and on a finding leave the recording that leads to it beside libFuzzer's own artifact.
//!
//! libFuzzer stops the process at the first panic, before a stack is unwound. So what was being run is written from the panic's hook, which
//! comes first; `lancet tui` and `lancet reduce` then open it. It goes into the folder that LANCET_FINDINGS names, else into artifacts/TARGET.

use std::cell::Cell;
use std::env;
use std::fs;
use std::panic;
use std::path::PathBuf;
use std::process;

use lancet::attack::{target, under_way};

thread_local! {
    /// The target that is being run.
    static RUNNING: Cell<&'static str> = const { Cell::new("") };
}

/// To be called once, before the first input.
pub fn begin() {
    let before = panic::take_hook();
    panic::set_hook(Box::new(move |info| {
        // Nothing is run here: what panicked once would do so again, and a panic within a hook ends everything.
        if let Some(recording) = under_way() {
            write(RUNNING.get(), &recording);
        }
        before(info);
    }));
}

/// Runs an input on a target; panics with the finding if there is one.
pub fn attack(name: &'static str, data: &[u8]) {
    RUNNING.set(name);
    let target = target(name).unwrap_or_else(|| panic!("lancet::attack has no target {name}"));
    if let Err(finding) = (target.run)(data) {
        if let Some(recording) = &finding.recording {
            write(name, recording);
        }
        panic!("{finding}");
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
