//! A program in a pseudo-terminal: what it shows, and how it leaves the terminal.
//!
//! A thread reads what the program writes into a terminal of our own (vt100). Who waits for something waits until it is shown, however long
//! the machine takes, and no longer; what never comes fails with the screen as it was.

use std::io::{Read, Write};
use std::num::NonZeroU16;
use std::path::Path;
use std::process::Command;
use std::sync::mpsc::channel;
use std::sync::{Arc, Condvar, Mutex, MutexGuard};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use portable_pty::{Child, CommandBuilder, ExitStatus, MasterPty, PtySize, native_pty_system};
use vt100::{MouseProtocolMode, Parser, Screen};

/// Who waits longer waits for what never comes.
const DEADLINE: Duration = Duration::from_secs(60);

/// A part of the screen, in columns and rows from 0.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Area {
    pub(crate) x: u16,
    pub(crate) y: u16,
    pub(crate) width: u16,
    pub(crate) height: u16,
}

/// What the program has written so far.
struct Shown {
    parser: Parser,
    bytes: Vec<u8>,
    /// Nothing more comes, or nobody looks.
    over: bool,
}

struct Seen {
    shown: Mutex<Shown>,
    changed: Condvar,
}

impl Seen {
    fn lock(&self) -> MutexGuard<'_, Shown> {
        self.shown.lock().expect("no reader panics")
    }

    /// Waits until something holds.
    fn until(&self, what: &str, mut holds: impl FnMut(&Shown) -> bool) -> MutexGuard<'_, Shown> {
        let begin = Instant::now();
        let mut shown = self.lock();
        while !holds(&shown) {
            let left = DEADLINE.checked_sub(begin.elapsed()).filter(|_| !shown.over);
            let Some(left) = left else {
                let screen = shown.parser.screen().contents();
                drop(shown);
                panic!("{what} never came; the screen:\n{screen}")
            };
            shown = self.changed.wait_timeout(shown, left).expect("no reader panics").0;
        }
        shown
    }
}

/// A program in its terminal.
pub(crate) struct Program {
    running: Running,
    master: Box<dyn MasterPty>,
    writer: Box<dyn Write + Send>,
    seen: Arc<Seen>,
    reader: JoinHandle<()>,
    /// The terminal's settings (echo, lines, signals) before the program came, as text.
    settings: String,
    pub(crate) started: Instant,
}

impl Program {
    /// Starts `lancet tui` in a terminal of some columns and rows. What it keeps lies in a folder.
    pub(crate) fn start(folder: &Path, arguments: &[&str], size: [u16; 2]) -> Self {
        let pair = native_pty_system().openpty(pty_size(size)).expect("a pseudo-terminal");
        let reader = pair.master.try_clone_reader().expect("a reader");
        let writer = pair.master.take_writer().expect("a writer");
        let settings = settings(pair.master.as_ref());
        let mut command = CommandBuilder::new(env!("CARGO_BIN_EXE_lancet"));
        command.args(["tui", "--renderer", "reference"]);
        command.args(arguments);
        command.cwd(folder);
        command.env("TERM", "xterm-256color");
        let looks = ["NO_COLOR", "COLORTERM", "COLORFGBG", "TERM_PROGRAM", "TMUX"];
        looks.iter().for_each(|variable| command.env_remove(variable));
        for variable in ["LANCET_STATE_DIR", "LANCET_CACHE_DIR", "XDG_CONFIG_HOME"] {
            command.env(variable, folder);
        }
        let started = Instant::now();
        let child = pair.slave.spawn_command(command).expect("the program starts");
        let [columns, rows] = size.map(|side| NonZeroU16::new(side).expect("a size"));
        let shown = Shown { parser: Parser::new(rows, columns, 0), bytes: Vec::new(), over: false };
        let seen = Arc::new(Seen { shown: Mutex::new(shown), changed: Condvar::new() });
        let reader = thread::spawn({
            let seen = Arc::clone(&seen);
            move || read(reader, &seen)
        });
        Self { running: Running(child), master: pair.master, writer, seen, reader, settings, started }
    }

    /// Waits until the screen shows a text.
    pub(crate) fn expect(&self, text: &str) -> String {
        self.until(text, |screen| screen.contents().contains(text))
    }

    /// Waits until the screen is so. What it shows then.
    pub(crate) fn until(&self, what: &str, mut is: impl FnMut(&Screen) -> bool) -> String {
        self.seen.until(what, |shown| is(shown.parser.screen())).parser.screen().contents()
    }

    /// Waits until these bytes were written so many times.
    pub(crate) fn until_written(&self, bytes: &[u8], times: usize) {
        let count = |shown: &Shown| shown.bytes.windows(bytes.len()).filter(|part| *part == bytes).count();
        drop(self.seen.until("a sequence", |shown| count(shown) >= times));
    }

    /// Types.
    pub(crate) fn press(&mut self, bytes: &str) {
        self.writer.write_all(bytes.as_bytes()).and_then(|()| self.writer.flush()).expect("typed");
    }

    /// Presses the left button on a cell and lets it go.
    pub(crate) fn click(&mut self, [x, y]: [u16; 2]) {
        let (column, row) = (x + 1, y + 1);
        self.press(&format!("\x1b[<0;{column};{row}M\x1b[<0;{column};{row}m"));
    }

    /// The inside of a pane's border, found by its title.
    pub(crate) fn pane(&self, title: &str) -> Area {
        let shown = self.seen.lock();
        let screen = shown.parser.screen();
        let (rows, columns) = screen.size();
        let cell = |x, y| screen.cell(y, x).map_or(String::new(), |cell| cell.contents().to_owned());
        let is_title =
            |x: u16, y: u16| title.chars().zip(x..).all(|(letter, x)| cell(x, y) == letter.to_string());
        let places = (0..rows.get()).flat_map(|y| (0..columns.get()).map(move |x| [x, y]));
        let [x, top] = places.into_iter().find(|[x, y]| is_title(*x, *y)).expect("the pane's title");
        let left = (0..x).rev().find(|x| cell(*x, top) == "┌").expect("a corner");
        let right = (x..columns.get()).find(|x| cell(*x, top) == "┐").expect("a corner");
        let bottom = (top..rows.get()).find(|y| cell(left, *y) == "└").expect("a corner");
        Area { x: left + 1, y: top + 1, width: right - left - 1, height: bottom - top - 1 }
    }

    /// Makes the terminal larger or smaller.
    pub(crate) fn resize(&mut self, size: [u16; 2]) {
        let [columns, rows] = size.map(|side| NonZeroU16::new(side).expect("a size"));
        self.seen.lock().parser.set_size(rows, columns);
        self.master.resize(pty_size(size)).expect("resized");
    }

    /// Sends a signal, by its name.
    pub(crate) fn signal(&self, name: &str) {
        let process = self.process().to_string();
        let sent = Command::new("kill").args(["-s", name, &process]).status().expect("kill");
        assert!(sent.success());
    }

    /// The program's number.
    pub(crate) fn process(&self) -> u32 {
        self.running.0.process_id().expect("it runs")
    }

    /// Waits until the program has ended by itself. The terminal has to be as it was before.
    pub(crate) fn left(mut self) -> (ExitStatus, String) {
        let seen = Arc::clone(&self.seen);
        let begin = Instant::now();
        let mut shown = seen.lock();
        while !shown.over {
            let left = DEADLINE.checked_sub(begin.elapsed()).expect("the program ends");
            shown = seen.changed.wait_timeout(shown, left).expect("no reader panics").0;
        }
        let status = self.running.0.wait().expect("a status");
        let screen = shown.parser.screen();
        assert!(!screen.alternate_screen() && !screen.hide_cursor() && !screen.bracketed_paste());
        assert_eq!(screen.mouse_protocol_mode(), MouseProtocolMode::None);
        assert_eq!(last_of(&shown.bytes, [b"\x1b[?1004h", b"\x1b[?1004l"]), Some(1), "focus is still told");
        assert_eq!(settings(self.master.as_ref()), self.settings, "echo, lines and signals");
        (status, screen.contents())
    }

    /// Closes the terminal while the program runs. How it ended.
    pub(crate) fn close(mut self) -> ExitStatus {
        // The reader has the terminal open too: it looks away with the next thing that it sees.
        self.seen.lock().over = true;
        self.press("\x0c");
        self.reader.join().expect("no reader panics");
        drop((self.master, self.writer));
        let mut running = self.running;
        let (send, ended) = channel();
        let mut killer = running.0.clone_killer();
        thread::spawn(move || send.send(running.0.wait()));
        ended.recv_timeout(DEADLINE).map(|status| status.expect("a status")).unwrap_or_else(|_| {
            let _ = killer.kill();
            panic!("the program goes on without a terminal")
        })
    }
}

/// A program that ends with the test, whatever becomes of that.
struct Running(Box<dyn Child + Send + Sync>);

impl Drop for Running {
    fn drop(&mut self) {
        if let Ok(None) = self.0.try_wait() {
            let _ = self.0.kill();
        }
    }
}

fn read(mut from: Box<dyn Read + Send>, seen: &Seen) {
    let mut buffer = [0; 4096];
    loop {
        // When nobody has the terminal open any more, reading fails on some systems, and ends on others.
        let count = from.read(&mut buffer).unwrap_or(0);
        let mut shown = seen.lock();
        shown.over |= count == 0;
        shown.parser.process(&buffer[..count]);
        shown.bytes.extend_from_slice(&buffer[..count]);
        seen.changed.notify_all();
        if shown.over {
            return;
        }
    }
}

fn pty_size([cols, rows]: [u16; 2]) -> PtySize {
    PtySize { rows, cols, ..PtySize::default() }
}

fn settings(master: &dyn MasterPty) -> String {
    let settings = master.get_termios().expect("a terminal has settings");
    format!("{settings:?}")
}

/// Which of some sequences was written last.
fn last_of(bytes: &[u8], sequences: [&[u8]; 2]) -> Option<usize> {
    let place = |sequence: &[u8]| bytes.windows(sequence.len()).rposition(|part| part == sequence);
    let places = sequences.map(place);
    (0..2).filter(|which| places[*which].is_some()).max_by_key(|which| places[*which])
}
