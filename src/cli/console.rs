//! Where a command writes: the answer to `out`, everything else to `err`.
//!
//! A reader that goes away (`lancet info … | head -1`) is no failure: what follows is dropped, and the verdict stays. Colour is for terminals,
//! unless `NO_COLOR`, `CLICOLOR_FORCE` or `TERM` say otherwise; styles cross as ANSI only where it is wanted.

use std::fmt::Display;
use std::io::{self, BufWriter, ErrorKind, IsTerminal, Write};
use std::time::{Duration, Instant};

use anstream::{AutoStream, ColorChoice};
use anstyle::{AnsiColor, Style};
use clap::builder::StyledStr;

use crate::report::printable;

/// The two streams of a command.
pub struct Console<'a> {
    pub(super) out: Channel<'a>,
    pub(super) err: Channel<'a>,
}

impl<'a> Console<'a> {
    /// Standard output and standard error.
    pub fn standard() -> Self {
        let (out, err) = (io::stdout(), io::stderr());
        let colour = [AutoStream::choice(&out), AutoStream::choice(&err)].map(|c| c != ColorChoice::Never);
        let terminal = err.is_terminal();
        Self {
            out: Channel::new(Box::new(BufWriter::new(out)), colour[0], false),
            err: Channel::new(Box::new(err), colour[1], terminal),
        }
    }

    /// Two writers, without colour.
    pub fn plain(out: &'a mut (dyn Write + Send), err: &'a mut (dyn Write + Send)) -> Self {
        Self {
            out: Channel::new(Box::new(out), false, false),
            err: Channel::new(Box::new(err), false, false),
        }
    }
}

/// One stream.
pub(super) struct Channel<'a> {
    to: Box<dyn Write + Send + 'a>,
    /// Its reader has gone away.
    gone: bool,
    colour: bool,
    progress: Option<Line>,
}

/// The progress line of a terminal.
struct Line {
    since: Instant,
    drawn: Option<Instant>,
}

/// What takes less is not worth a line.
const PATIENCE: Duration = Duration::from_secs(1);
const BETWEEN_DRAWINGS: Duration = Duration::from_millis(100);
const ERASE_LINE: &str = "\r\x1b[2K";

impl<'a> Channel<'a> {
    fn new(to: Box<dyn Write + Send + 'a>, colour: bool, terminal: bool) -> Self {
        let progress = terminal.then(|| Line { since: Instant::now(), drawn: None });
        Self { to, gone: false, colour, progress }
    }

    /// Text in a style, where there is colour.
    pub(super) fn paint(&self, style: Style, text: impl Display) -> String {
        if self.colour { format!("{style}{text}{style:#}") } else { text.to_string() }
    }

    pub(super) fn good(&self, text: impl Display) -> String {
        self.paint(AnsiColor::Green.on_default(), text)
    }

    pub(super) fn bad(&self, text: impl Display) -> String {
        self.paint(AnsiColor::Red.on_default().bold(), text)
    }

    pub(super) fn faint(&self, text: impl Display) -> String {
        self.paint(Style::new().dimmed(), text)
    }

    /// A complaint. There is nobody to tell when it cannot be written.
    pub(super) fn error(&mut self, what: &dyn Display) {
        let (label, what) = (self.bad("error:"), printable(what));
        let _ = writeln!(self, "{label} {what}").and_then(|()| self.flush());
    }

    /// Something that the user should know.
    pub(super) fn note(&mut self, what: impl Display) {
        let label = self.faint("note:");
        let _ = writeln!(self, "{label} {what}");
    }

    /// A text of clap's.
    pub(super) fn styled(&mut self, text: &StyledStr) {
        let text = if self.colour { text.ansi().to_string() } else { text.to_string() };
        let _ = self.write_all(text.as_bytes()).and_then(|()| self.flush());
    }

    /// Begins a piece of work that may take long.
    pub(super) fn work<'c>(&'c mut self) -> Work<'c, 'a> {
        Work(self)
    }

    fn progress(&mut self, what: &dyn Display) {
        let Some(line) = &mut self.progress else { return };
        let waits = line.since.elapsed() < PATIENCE;
        if waits || line.drawn.is_some_and(|at| at.elapsed() < BETWEEN_DRAWINGS) {
            return;
        }
        line.drawn = Some(Instant::now());
        let _ = write!(self.to, "{ERASE_LINE}{what}").and_then(|()| self.to.flush());
    }

    /// Takes the progress line away.
    fn erase(&mut self) -> io::Result<()> {
        match self.progress.as_mut().and_then(|line| line.drawn.take()) {
            Some(_) => self.to.write_all(ERASE_LINE.as_bytes()),
            None => Ok(()),
        }
    }

    /// A broken pipe counts as written.
    fn unless_gone<T>(&mut self, written: io::Result<T>, dropped: T) -> io::Result<T> {
        match written {
            Err(error) if error.kind() == ErrorKind::BrokenPipe => {
                self.gone = true;
                Ok(dropped)
            }
            other => other,
        }
    }
}

/// A piece of work that shows how far it is: on a terminal, after a second, and at most ten times a second. Its line goes with it.
pub(super) struct Work<'c, 'w>(&'c mut Channel<'w>);

impl Work<'_, '_> {
    /// Shows how far it is.
    pub(super) fn show(&mut self, what: impl Display) {
        self.0.progress(&what);
    }
}

impl Drop for Work<'_, '_> {
    fn drop(&mut self) {
        // A terminal that cannot be written to shows no line either.
        let _ = self.0.erase().and_then(|()| self.0.to.flush());
    }
}

impl Write for Channel<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if self.gone {
            return Ok(bytes.len());
        }
        let written = self.erase().and_then(|()| self.to.write(bytes));
        self.unless_gone(written, bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        if self.gone {
            return Ok(());
        }
        let flushed = self.erase().and_then(|()| self.to.flush());
        self.unless_gone(flushed, ())
    }
}

impl Drop for Channel<'_> {
    fn drop(&mut self) {
        let _ = self.flush();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What a terminal gets from a command that has run for some time.
    fn terminal(since: Duration, command: impl FnOnce(&mut Channel<'_>)) -> String {
        let mut written = Vec::new();
        let mut channel = Channel::new(Box::new(&mut written), true, true);
        channel.progress = Some(Line { since: Instant::now().checked_sub(since).unwrap(), drawn: None });
        command(&mut channel);
        drop(channel);
        String::from_utf8(written).unwrap()
    }

    #[test]
    fn progress_shows_after_a_second_and_goes_before_anything_else() {
        let command = |channel: &mut Channel<'_>| {
            let mut work = channel.work();
            (1..=3).for_each(|i| work.show(format_args!("{i} of 3")));
            drop(work);
            writeln!(channel, "done").unwrap();
        };
        assert_eq!(
            terminal(Duration::from_secs(2), command),
            format!("{ERASE_LINE}1 of 3{ERASE_LINE}done\n")
        );
        assert_eq!(terminal(Duration::ZERO, command), "done\n");
    }

    #[test]
    fn colour_is_for_those_who_want_it() {
        assert_eq!(terminal(Duration::ZERO, |c| write!(c, "{}", c.good("x")).unwrap()), "\x1b[32mx\x1b[0m");
        let mut plain = Vec::new();
        let mut channel = Channel::new(Box::new(&mut plain), false, false);
        write!(channel, "{}", channel.bad("x")).unwrap();
        drop(channel);
        assert_eq!(plain, b"x");
    }
}
