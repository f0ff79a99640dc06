//! What is written to standard error while the screen is ours: kept, and shown when the terminal is given back.
//!
//! Drivers, and panics that the program survives, write there without asking, in the middle of a frame. So standard error is led into a pipe
//! for that while, which a thread of its own reads: nobody who writes ever waits, and what is kept has a limit. Where standard error is not
//! a terminal (`2>FILE`) nothing is in anybody's way, and it stays as it is.

#[cfg(unix)]
pub(super) use led_away::Errors;
#[cfg(not(unix))]
pub(super) use left_alone::Errors;

#[cfg(unix)]
mod led_away {
    use std::io::{self, IsTerminal, Read, Write};
    use std::os::fd::{AsFd, OwnedFd};
    use std::sync::mpsc::{Receiver, channel};
    use std::thread;
    use std::time::Duration;

    use rustix::stdio::dup2_stderr;

    use crate::tui::text;

    /// As many bytes are kept, from the beginning: what went wrong first explains the rest.
    pub(super) const MOST: u64 = 64 << 10;

    /// How long the pipe's reader may take to end. It waits for as long as anybody else has got hold of the pipe.
    const PATIENCE: Duration = Duration::from_secs(1);

    /// See the module.
    pub(in crate::tui::terminal) struct Errors {
        before: OwnedFd,
        kept: Receiver<Vec<u8>>,
    }

    impl Errors {
        /// Leads standard error away, if it is a terminal.
        pub(in crate::tui::terminal) fn lead_away() -> io::Result<Option<Self>> {
            let stderr = io::stderr();
            if !stderr.is_terminal() {
                return Ok(None);
            }
            let before = stderr.as_fd().try_clone_to_owned()?;
            let (reader, writer) = io::pipe()?;
            let (send, kept) = channel();
            // Nobody may be left who wants it.
            thread::Builder::new().name("errors".into()).spawn(move || drop(send.send(keep(reader))))?;
            dup2_stderr(&writer)?;
            Ok(Some(Self { before, kept }))
        }

        /// Makes standard error what it was, and writes there what was kept. There is nobody to tell when that fails.
        pub(in crate::tui::terminal) fn give_back(self) {
            let _ = dup2_stderr(&self.before);
            if let Ok(kept) = self.kept.recv_timeout(PATIENCE) {
                let _ = io::stderr().write_all(&kept);
            }
        }
    }

    /// Reads all, keeps the beginning, and says how much more there was.
    pub(super) fn keep(mut from: impl Read) -> Vec<u8> {
        let mut kept = Vec::new();
        let whole = from.by_ref().take(MOST).read_to_end(&mut kept);
        let more = whole.and_then(|_| io::copy(&mut from, &mut io::sink())).unwrap_or(0);
        if more > 0 {
            kept.extend_from_slice(format!("\n... and {} more\n", text::bytes(more)).as_bytes());
        }
        kept
    }
}

#[cfg(not(unix))]
mod left_alone {
    use std::io;

    /// Here standard error stays what it is.
    pub(in crate::tui::terminal) struct Errors;

    impl Errors {
        pub(in crate::tui::terminal) fn lead_away() -> io::Result<Option<Self>> {
            Ok(None)
        }

        pub(in crate::tui::terminal) fn give_back(self) {}
    }
}

#[cfg(all(test, unix))]
mod tests {
    use super::led_away::{MOST, keep};

    #[test]
    fn what_was_written_is_kept_up_to_a_limit_and_the_rest_is_counted() {
        assert_eq!(keep(&b"error: no display\n"[..]), b"error: no display\n");
        let most = MOST as usize;
        let full = vec![b'x'; most];
        assert_eq!(keep(full.as_slice()), full);
        let kept = keep(vec![b'x'; most + 2000].as_slice());
        assert_eq!(&kept[..most], full);
        assert_eq!(String::from_utf8_lossy(&kept[most..]), "\n... and 2.00 kB more\n");
    }
}
