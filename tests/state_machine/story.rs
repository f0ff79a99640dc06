//! What was done so far, for whoever has to find out what went wrong.

use std::any::Any;
use std::fmt::{Display, Write};
use std::path::Path;

use lancet::recording::AnyRecording;
use lancet::replay::save;

/// See the module.
#[derive(Default)]
pub(crate) struct Story {
    /// The recording as it is now.
    pub(crate) recording: Option<AnyRecording>,
    lines: Vec<String>,
}

impl Story {
    /// Tells what is done next.
    pub(crate) fn tell(&mut self, what: impl Display) {
        self.lines.push(what.to_string());
    }

    /// Writes the recording, and what was done beside it; what shrinks further is written over it. Says where they are.
    pub(crate) fn keep(&self, folder: &Path, wrong: &str) -> Result<String, String> {
        let recording = self.recording.as_ref().ok_or("there was none yet")?;
        let [script, text] = ["state-machine.json", "state-machine.txt"].map(|name| folder.join(name));
        save(recording, Path::new(""), &script).map_err(|error| error.to_string())?;
        let mut told = format!("{wrong}\n\n");
        for line in &self.lines {
            let _ = writeln!(told, "{line}");
        }
        std::fs::write(&text, told).map_err(|error| error.to_string())?;
        Ok(format!("the recording is {}, what was done {}", script.display(), text.display()))
    }
}

/// What a panic says.
pub(crate) fn panic_text(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().copied();
    text.or_else(|| panic.downcast_ref::<String>().map(String::as_str)).unwrap_or("without a message").into()
}
