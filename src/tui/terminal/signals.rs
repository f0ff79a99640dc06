//! Signals as flags: one asks the program to end, another says that it was stopped and goes on.
//!
//! They are watched from the first time the terminal is taken. While it is not held they do what they always do, so that the
//! program can be ended after its screen is gone.

use std::io;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, OnceLock};

static SIGNALS: OnceLock<Signals> = OnceLock::new();

/// What was signalled.
#[derive(Default)]
pub(super) struct Signals {
    ended: Arc<AtomicBool>,
    continued: Arc<AtomicBool>,
    /// The terminal is not held.
    free: Arc<AtomicBool>,
}

impl Signals {
    /// Begins to watch, if that was not done before.
    pub(super) fn watch() -> io::Result<&'static Self> {
        if let Some(signals) = SIGNALS.get() {
            return Ok(signals);
        }
        let signals = Self::default();
        signals.free.store(true, Ordering::SeqCst);
        signals.register()?;
        Ok(SIGNALS.get_or_init(|| signals))
    }

    #[cfg(unix)]
    fn register(&self) -> io::Result<()> {
        use signal_hook::consts::{SIGCONT, SIGHUP, SIGINT, SIGQUIT, SIGTERM};
        use signal_hook::flag;
        for signal in [SIGTERM, SIGHUP, SIGINT, SIGQUIT] {
            flag::register_conditional_default(signal, Arc::clone(&self.free))?;
            flag::register(signal, Arc::clone(&self.ended))?;
        }
        flag::register(SIGCONT, Arc::clone(&self.continued)).map(drop)
    }

    #[cfg(not(unix))]
    fn register(&self) -> io::Result<()> {
        Ok(())
    }

    /// Says whether the terminal is held.
    pub(super) fn hold(&self, held: bool) {
        self.free.store(!held, Ordering::SeqCst);
    }

    /// Whether the program was asked to end.
    pub(super) fn ended(&self) -> bool {
        self.ended.load(Ordering::SeqCst)
    }

    /// Whether the program was stopped and goes on.
    pub(super) fn continued(&self) -> bool {
        self.continued.load(Ordering::SeqCst)
    }

    /// What was done about it is done.
    pub(super) fn forget_continued(&self) {
        self.continued.store(false, Ordering::SeqCst);
    }
}

/// Stops the program until it is made to go on. The signal that can be ignored: in a group that no shell looks after the system ignores it,
/// where the program would never go on.
#[cfg(unix)]
pub(super) fn stop() -> io::Result<()> {
    signal_hook::low_level::raise(signal_hook::consts::SIGTSTP)
}

/// There is no stopping here.
#[cfg(not(unix))]
pub(super) fn stop() -> io::Result<()> {
    Ok(())
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;
    use signal_hook::consts::{SIGCONT, SIGHUP};
    use signal_hook::low_level::raise;

    #[test]
    fn signals_raise_flags_while_the_terminal_is_held() {
        let signals = Signals::default();
        signals.register().expect("registered");
        signals.hold(true);
        assert!(!signals.ended() && !signals.continued());
        raise(SIGCONT).expect("raised");
        assert!(signals.continued() && !signals.ended());
        signals.forget_continued();
        assert!(!signals.continued());
        raise(SIGHUP).expect("raised");
        assert!(signals.ended());
    }
}
