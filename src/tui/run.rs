//! The loop: what was typed and told changes the model, the model asks for things, and what changed is drawn.

use std::io;
use std::path::PathBuf;
use std::time::{Duration, Instant};

use super::config::Config;
use super::environment::Environment;
use super::keys::Keys;
use super::model::{Effect, Model};
use super::terminal::Terminal;
use super::theme::Theme;
use super::worker::{Ask, Desk, Worker};
use super::{events, update, view};
use crate::render::Choice;

/// How the program was started.
#[derive(Clone, Debug)]
pub struct Start {
    /// The recording or script to open.
    pub recording: Option<PathBuf>,
    /// Who renders.
    pub renderer: Choice,
    /// Bytes that going back may take, beside what undo and redo need.
    pub budget_bytes: usize,
    /// The user's settings.
    pub config: Config,
}

/// How long an event is waited for while the worker is at work, and while it is not.
const WAIT: [Duration; 2] = [Duration::from_millis(8), Duration::from_millis(100)];

/// Runs it until it is left. The terminal has to be there.
pub fn run(start: Start) -> io::Result<()> {
    let mut app = App::new(start)?;
    while !app.model.done && !app.terminal.ended() {
        app.turn()?;
    }
    Ok(())
}

struct App {
    model: Model,
    theme: Theme,
    keys: Keys,
    worker: Worker,
    terminal: Terminal,
    /// When the last event was played.
    beat: Instant,
    /// Whether something has changed since the last frame.
    changed: bool,
}

impl App {
    fn new(start: Start) -> io::Result<Self> {
        let environment = Environment::read();
        let theme = Theme::chosen(&start.config.theme, &environment);
        let keys = Keys::new(&start.config.keys);
        let terminal = Terminal::take(start.config.mouse)?;
        let size = terminal.size()?;
        let mut model = Model { size: [size.width, size.height], ..Model::default() };
        let worker = Worker::start(Desk::new(start.renderer, start.budget_bytes));
        start.recording.into_iter().for_each(|path| model.ask(Ask::Open(path)));
        Ok(Self { model, theme, keys, worker, terminal, beat: Instant::now(), changed: true })
    }

    fn turn(&mut self) -> io::Result<()> {
        self.carry_out()?;
        if self.changed || self.terminal.lost() {
            let Self { model, theme, keys, terminal, .. } = self;
            terminal.draw(|frame| view::draw(model, theme, keys, frame.buffer_mut()))?;
            self.changed = false;
        }
        self.listen()?;
        self.beat();
        Ok(())
    }

    /// Does what the model wants done outside.
    fn carry_out(&mut self) -> io::Result<()> {
        update::want_picture(&mut self.model);
        for effect in std::mem::take(&mut self.model.effects) {
            match effect {
                Effect::Ask(ask) => self.worker.ask(ask),
                Effect::Copy(text) => match self.terminal.copy(&text) {
                    Ok(()) => self.model.say("copied"),
                    Err(error) => self.model.complain(format!("not copied: {error}")),
                },
                Effect::Suspend => self.terminal.suspend()?,
                Effect::Redraw => self.terminal.redraw()?,
            }
            self.changed = true;
        }
        Ok(())
    }

    /// Waits a little for what is typed, then takes what was told.
    fn listen(&mut self) -> io::Result<()> {
        let wait = WAIT[usize::from(!self.model.is_busy() && self.model.playing.is_none())];
        let mut waited = crossterm::event::poll(wait)?;
        while waited {
            self.changed |= events::take(&mut self.model, &self.keys, crossterm::event::read()?);
            waited = crossterm::event::poll(Duration::ZERO)?;
        }
        while let Ok(told) = self.worker.told.try_recv() {
            update::told(&mut self.model, told);
            self.changed = true;
        }
        Ok(())
    }

    /// Plays the next event, if it is time for one.
    fn beat(&mut self) {
        if self.model.playing.is_some_and(|pause| self.beat.elapsed() >= pause) {
            update::beat(&mut self.model);
            self.beat = Instant::now();
            self.changed = true;
        }
    }
}
