//! The terminal, taken for a while and given back as it was.
//!
//! Whatever ends the program, the terminal is given back: [`Drop`] does it on every ordinary way out, and a panic hook before the
//! panic's message is written, so that it lands where it can be read. A panic of another thread does not end the program; its
//! message waits with all else that is written to standard error meanwhile (`errors.rs`). Signals that ask the program to end raise a flag instead, so that the loop
//! leaves in order ([`Terminal::ended`]). Giving back twice is harmless.
//!
//! A frame is composed in memory and goes out in one piece, as a synchronized update. So a frame is shown whole or not at all, a
//! resize does not flicker, and a panic half way through one leaves nothing behind. What could be lost
//! while the program goes on (`kill -STOP` and `fg`) is taken again with the next frame.

mod errors;
mod events;
mod signals;

use std::cell::RefCell;
use std::io::{self, IsTerminal, Write};
use std::panic;
use std::rc::Rc;
use std::sync::{Mutex, MutexGuard, Once, PoisonError};
use std::thread::{self, ThreadId};

use ratatui::Frame;
use ratatui::backend::CrosstermBackend;
use ratatui::crossterm::clipboard::CopyToClipboard;
use ratatui::crossterm::event::{
    DisableBracketedPaste, DisableFocusChange, DisableMouseCapture, EnableBracketedPaste, EnableFocusChange,
    EnableMouseCapture,
};
use ratatui::crossterm::queue;
use ratatui::crossterm::style::{Attribute, SetAttribute};
use ratatui::crossterm::terminal::{
    BeginSynchronizedUpdate, EndSynchronizedUpdate, EnterAlternateScreen, LeaveAlternateScreen,
    disable_raw_mode, enable_raw_mode,
};
use ratatui::crossterm::{cursor, terminal};
use ratatui::layout::Size;

use errors::Errors;
pub use events::listen;
use signals::Signals;

/// Terminals drop longer sequences; xterm's and tmux's limits lie above it.
const MOST_COPIED: usize = 100_000;

/// Who has the terminal now. Locked while something is written to it, so that nothing is written to one that was given back.
static TAKEN: Mutex<Option<Taken>> = Mutex::new(None);
static HOOK: Once = Once::new();

/// The terminal is ours.
struct Taken {
    /// The thread without which the program does not go on.
    by: ThreadId,
    /// Standard error, led away.
    errors: Option<Errors>,
}

/// The terminal, while it is ours.
pub struct Terminal {
    screen: ratatui::Terminal<CrosstermBackend<Pending>>,
    pending: Pending,
    mouse: bool,
    signals: &'static Signals,
}

impl Terminal {
    /// Whether there is a terminal to take: one that is read from and written to.
    pub fn is_there() -> bool {
        io::stdin().is_terminal() && io::stdout().is_terminal()
    }

    /// Takes the terminal: raw mode, another screen without a cursor, pastes in one piece, changes of focus, and the mouse if wanted.
    pub fn take(mouse: bool) -> io::Result<Self> {
        let signals = Signals::watch()?;
        HOOK.call_once(give_back_on_panic);
        let pending = Pending::default();
        let screen = ratatui::Terminal::new(CrosstermBackend::new(pending.clone()))?;
        signals.hold(true);
        take(mouse).inspect_err(|_| signals.hold(taken().is_some()))?;
        Ok(Self { screen, pending, mouse, signals })
    }

    /// Draws a frame.
    pub fn draw(&mut self, view: impl FnOnce(&mut Frame<'_>)) -> io::Result<()> {
        if self.lost() {
            self.take_again()?;
        }
        let drawn = self.screen.draw(view).map(drop);
        let frame = self.pending.take();
        drawn?;
        send(&synchronized(&frame)?)
    }

    /// Draws everything anew with the next frame, also where nothing has changed.
    pub fn redraw(&mut self) -> io::Result<()> {
        let area = self.size()?.into();
        self.screen.resize(area)
    }

    /// Its size in cells.
    pub fn size(&self) -> io::Result<Size> {
        self.screen.size()
    }

    /// Whether somebody else wrote to the screen, so that a frame is due.
    pub fn lost(&self) -> bool {
        self.signals.continued() || taken().is_none()
    }

    /// Whether the program was asked to end: by a signal, or because the terminal was closed. No event comes with it, so a wait for events
    /// needs a limit.
    pub fn ended(&self) -> bool {
        self.signals.ended()
    }

    /// Gives the terminal back, stops the program as Ctrl-Z does elsewhere, and takes it again when the program goes on. Where nobody could
    /// make it go on (without a shell's job control), the system lets it go on at once.
    pub fn suspend(&mut self) -> io::Result<()> {
        give_back();
        signals::stop()?;
        self.take_again()
    }

    /// Copies a text to the user's clipboard, by the terminal (OSC 52). Whether it allows that it does not say.
    pub fn copy(&mut self, text: &str) -> io::Result<()> {
        if text.len() > MOST_COPIED {
            let size = super::text::bytes(text.len() as u64);
            return Err(io::Error::other(format!("too much to copy: {size}, at most 100 kB")));
        }
        let mut bytes = Vec::new();
        queue!(bytes, CopyToClipboard::to_clipboard_from(text))?;
        send(&bytes)
    }

    fn take_again(&mut self) -> io::Result<()> {
        // Raw mode, which is set once, may have been taken away by a shell.
        give_back();
        self.signals.forget_continued();
        take(self.mouse)?;
        self.redraw()
    }
}

impl Drop for Terminal {
    fn drop(&mut self) {
        give_back();
        self.signals.hold(false);
    }
}

/// What is composed, and not yet written. Flushing does nothing.
#[derive(Clone, Default)]
struct Pending(Rc<RefCell<Vec<u8>>>);

impl Pending {
    fn take(&self) -> Vec<u8> {
        self.0.take()
    }
}

impl Write for Pending {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.borrow_mut().write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

fn taken() -> MutexGuard<'static, Option<Taken>> {
    TAKEN.lock().unwrap_or_else(PoisonError::into_inner)
}

fn take(mouse: bool) -> io::Result<()> {
    let mut taken = taken();
    if taken.is_some() {
        return Err(io::Error::other("the terminal is taken already"));
    }
    let now = taken.insert(Taken { by: thread::current().id(), errors: None });
    let entered = enable_raw_mode().and_then(|()| write_out(&enter(mouse)?));
    let entered = entered.and_then(|()| Errors::lead_away()).map(|errors| now.errors = errors);
    drop(taken);
    entered.inspect_err(|_| give_back())
}

/// Gives the terminal back, if it was taken. There is nobody to tell when that fails.
fn give_back() {
    if let Some(Taken { errors, .. }) = taken().take() {
        let _ = leave().and_then(|bytes| write_out(&bytes));
        let _ = disable_raw_mode();
        errors.into_iter().for_each(Errors::give_back);
    }
}

fn give_back_on_panic() {
    let before = panic::take_hook();
    panic::set_hook(Box::new(move |info| {
        if taken().as_ref().is_some_and(|taken| taken.by == thread::current().id()) {
            give_back();
        }
        before(info);
    }));
}

/// Writes to the terminal while it is ours. What else there is would land in the user's shell.
fn send(bytes: &[u8]) -> io::Result<()> {
    let taken = taken();
    if taken.is_some() { write_out(bytes) } else { Ok(()) }
}

fn write_out(bytes: &[u8]) -> io::Result<()> {
    let mut out = io::stdout().lock();
    out.write_all(bytes)?;
    out.flush()
}

fn enter(mouse: bool) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    queue!(bytes, EnterAlternateScreen, terminal::Clear(terminal::ClearType::All), cursor::Hide)?;
    queue!(bytes, EnableBracketedPaste, EnableFocusChange)?;
    if mouse {
        queue!(bytes, EnableMouseCapture)?;
    }
    Ok(bytes)
}

fn leave() -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    queue!(bytes, EndSynchronizedUpdate, DisableMouseCapture, DisableFocusChange, DisableBracketedPaste)?;
    queue!(bytes, SetAttribute(Attribute::Reset), cursor::Show, LeaveAlternateScreen)?;
    Ok(bytes)
}

fn synchronized(frame: &[u8]) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::with_capacity(frame.len() + 16);
    queue!(bytes, BeginSynchronizedUpdate)?;
    bytes.extend_from_slice(frame);
    queue!(bytes, EndSynchronizedUpdate)?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use std::num::NonZeroU16;

    use super::*;
    use vt100::{MouseProtocolMode, Parser};

    /// What a program finds that comes after us.
    fn state(parser: &Parser) -> (bool, bool, bool, MouseProtocolMode, String) {
        let screen = parser.screen();
        let modes = (screen.alternate_screen(), screen.hide_cursor(), screen.bracketed_paste());
        (modes.0, modes.1, modes.2, screen.mouse_protocol_mode(), screen.contents())
    }

    #[test]
    fn what_is_taken_is_given_back_even_twice() {
        let mut parser =
            Parser::new(NonZeroU16::new(5).expect("rows"), NonZeroU16::new(20).expect("columns"), 0);
        parser.process(b"$ lancet tui\r\n");
        let before = state(&parser);
        for mouse in [true, false] {
            parser.process(&enter(mouse).expect("bytes"));
            let (alternate, hidden, paste, protocol, contents) = state(&parser);
            assert!(alternate && hidden && paste && contents.is_empty());
            assert_eq!(protocol != MouseProtocolMode::None, mouse);
            parser.process(b"\x1b[1;31mhalf a fra");
            parser.process(&leave().expect("bytes"));
            assert_eq!(state(&parser), before);
            parser.process(&leave().expect("bytes"));
            assert_eq!(state(&parser), before);
        }
        parser.process(b"$");
        let cell = parser.screen().cell(1, 0).expect("a cell");
        assert!(!cell.bold() && cell.fgcolor() == vt100::Color::Default, "styles do not leak");
    }

    #[test]
    fn a_frame_is_a_synchronized_update() {
        let frame = synchronized(b"frame").expect("bytes");
        assert_eq!(frame, b"\x1b[?2026hframe\x1b[?2026l");
    }

    #[test]
    fn nothing_is_written_before_it_is_sent() {
        let pending = Pending::default();
        let mut backend = CrosstermBackend::new(pending.clone());
        backend.write_all(b"half").and_then(|()| Write::flush(&mut backend)).expect("to memory");
        assert_eq!(pending.take(), b"half");
        assert_eq!(pending.take(), b"");
    }

    #[test]
    fn a_terminal_that_was_not_taken_is_not_written_to() {
        assert!(taken().is_none());
        send(b"\x1b[2Jthis would clear the screen of the one who runs the tests").expect("nothing");
        give_back();
        assert!(taken().is_none());
    }
}
