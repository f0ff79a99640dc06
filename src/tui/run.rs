//! The loop: what was typed and told changes the model, the model asks for things, and what changed is drawn.
//!
//! One channel carries keys and finished work alike, so nobody polls: it wakes for a key, a word of the worker's, an encoded picture, the next beat
//! while playing, and now and then for signals.

use std::io;
use std::path::PathBuf;
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::time::{Duration, Instant};

use crossterm::event::Event;

use super::compare::{Comparisons, With};
use super::config::Config;
use super::environment::Environment;
use super::image::encoder::{Encoded, Encoder};
use super::image::protocol::{ImageProtocol, Medium};
use super::keys::Keys;
use super::model::{Effect, Model};
use super::record::Drafts;
use super::terminal::{self, Terminal};
use super::theme::Theme;
use super::worker::{Desk, Told, Worker};
use super::{events, picture, update, view};
use crate::render::Choice;

/// How the program was started.
#[derive(Clone, Debug, Default)]
pub struct Start {
    /// The recording or script to open.
    pub recording: Option<PathBuf>,
    /// Who renders.
    pub renderer: Choice,
    /// Bytes that going back may take, beside what undo and redo need.
    pub budget_bytes: usize,
    /// Where what is recorded is kept until it is saved.
    pub drafts: Drafts,
    /// What to compare it with at once.
    pub compare: Option<With>,
    /// The user's settings.
    pub config: Config,
}

/// Something that happened.
enum News {
    Typed(io::Result<Event>),
    Told(Told),
    Encoded(Box<Result<Encoded, String>>),
}

/// How long what was recorded may take to be kept when all is over.
const GRACE: Duration = Duration::from_secs(10);

/// How long nothing may happen before signals are looked for.
const PATIENCE: Duration = Duration::from_millis(200);

/// Runs it until it is left. The terminal has to be there.
pub fn run(start: Start) -> io::Result<()> {
    let mut app = App::new(start)?;
    let mut turned = Ok(());
    while turned.is_ok() && !app.model.done && !app.terminal.ended() {
        turned = app.turn();
    }
    // What a closed terminal makes of reading and writing is no error of its own.
    let ended = app.terminal.ended();
    app.end();
    if ended { Ok(()) } else { turned }
}

/// How pictures reach the terminal. Its cells may have another size than before.
fn medium((asked, environment): &(ImageProtocol, Environment)) -> Medium {
    Medium::choose(*asked, environment, crossterm::terminal::window_size().ok().as_ref())
}

struct App {
    model: Model,
    theme: Theme,
    keys: Keys,
    news: Receiver<News>,
    worker: Worker,
    encoder: Encoder,
    /// What pictures are shown by, and what decides it.
    protocol: (ImageProtocol, Environment),
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
        let protocol = (start.config.image_protocol, environment);
        let keys = Keys::new(&start.config.keys);
        let mut terminal = Terminal::take(start.config.mouse)?;
        let size = terminal.size()?;
        let comparisons = Comparisons::first(start.compare);
        let mut model = Model { size: [size.width, size.height], comparisons, ..Model::default() };
        model.picture.medium = medium(&protocol);
        update::begin(&mut model, start.recording);
        // The first frame comes before anything that takes time.
        terminal.draw(|frame| view::draw(&model, &theme, &keys, frame.buffer_mut()))?;
        let (send, news) = channel();
        let typed = send.clone();
        terminal::listen(move |event| typed.send(News::Typed(event)).is_ok())?;
        let (choice, budget, drafts) = (start.renderer, start.budget_bytes, start.drafts);
        let made = send.clone();
        let encoder = Encoder::start(move |encoded| drop(made.send(News::Encoded(Box::new(encoded)))))?;
        let worker = Worker::start(
            move || Desk::new(choice, budget).with_drafts(drafts.clone()),
            // A screen that is gone is noticed when the next thing to do is looked for.
            move |told| drop(send.send(News::Told(told))),
        )?;
        let beat = Instant::now();
        Ok(Self { model, theme, keys, news, worker, encoder, protocol, terminal, beat, changed: true })
    }

    fn turn(&mut self) -> io::Result<()> {
        if self.terminal.lost() {
            self.encoder.forget();
            self.changed = true;
        }
        self.carry_out()?;
        if self.changed {
            let Self { model, theme, keys, terminal, .. } = self;
            terminal.draw(|frame| view::draw(model, theme, keys, frame.buffer_mut()))?;
            self.changed = false;
        }
        self.listen()?;
        self.beat();
        Ok(())
    }

    /// Ends. Who has recorded waits until that is kept.
    fn end(mut self) {
        let records = self.model.recorder.is_some() || self.model.kept.unsaved;
        for effect in std::mem::take(&mut self.model.effects) {
            if let Effect::Ask(ask) = effect {
                self.worker.ask(ask);
            }
        }
        if records {
            self.worker.finish(GRACE);
        }
    }

    /// Does what the model wants done outside.
    fn carry_out(&mut self) -> io::Result<()> {
        update::picture::want(&mut self.model);
        for effect in std::mem::take(&mut self.model.effects) {
            match effect {
                Effect::Ask(ask) => self.worker.ask(ask),
                Effect::Copy(text) => match self.terminal.copy(&text) {
                    Ok(()) => {}
                    Err(error) => self.model.complain(format!("not copied: {error}")),
                },
                Effect::Suspend => {
                    self.terminal.suspend()?;
                    self.encoder.forget();
                }
                Effect::Redraw => {
                    self.terminal.redraw()?;
                    self.encoder.forget();
                }
            }
            self.changed = true;
        }
        if let Some(request) = picture::request(&self.model) {
            self.encoder.ask(request);
        }
        Ok(())
    }

    /// Waits for something to happen, and takes all that has.
    fn listen(&mut self) -> io::Result<()> {
        let due = self.model.playing.map(|pause| pause.saturating_sub(self.beat.elapsed()));
        let wait = due.map_or(PATIENCE, |due| due.min(PATIENCE));
        match self.news.recv_timeout(wait) {
            Ok(news) => self.take(news)?,
            Err(RecvTimeoutError::Timeout) => return Ok(()),
            Err(RecvTimeoutError::Disconnected) => self.model.done = true,
        }
        while let Ok(news) = self.news.try_recv() {
            self.take(news)?;
        }
        Ok(())
    }

    fn take(&mut self, news: News) -> io::Result<()> {
        match news {
            News::Typed(event) => {
                let event = event?;
                if matches!(event, Event::Resize(..)) {
                    self.model.picture.medium = medium(&self.protocol);
                }
                self.changed |= events::take(&mut self.model, &self.keys, event);
            }
            News::Encoded(encoded) => {
                update::picture::encoded(&mut self.model, *encoded);
                self.changed = true;
            }
            News::Told(told) => {
                update::told(&mut self.model, told);
                events::catch_up(&mut self.model, &self.keys);
                self.changed = true;
            }
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
