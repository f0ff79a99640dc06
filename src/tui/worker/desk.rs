//! The worker's desk: the recording that is open, and how each thing that is asked is done.
//!
//! The desk knows no thread. It is told of things to do one by one, and asks its [`Line`] whether to go on; so a test can work through it step
//! by step, and the screen's own thread never waits for a cut or a picture.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

use super::ask::{Ask, Frame, Opened, Standing, Told};
use super::camera::{self, Camera, Taken};
use super::compare;
use super::recording::{self, Making};
use crate::assets;
use crate::canvas::Studio;
use crate::recording::{SceneRef, VIEWPORT};
use crate::render::{self, Choice};
use crate::replay::{self, Case, Options, Replay};
use crate::report::{EventReport, Stop};
use crate::tui::compare::Job;
use crate::tui::model::Place;
use crate::tui::record::Drafts;
use crate::tui::shot::{self, Picture, Shot, Sight};

/// The way back to the screen.
pub(in crate::tui) trait Line {
    /// Tells the screen something.
    fn tell(&mut self, told: Told);
    /// Whether something else is wanted by now.
    fn is_interrupted(&mut self) -> bool;
    /// Whether anything at all is wanted by now.
    fn is_wanted(&mut self) -> bool;
}

/// What is said where something should be open.
const NOTHING: &str = "no recording is open";

/// What is open.
pub(super) struct Open {
    pub(super) case: Case,
    pub(super) replay: Box<dyn Replay>,
    pub(super) place: Place,
    /// The report of the event that is held, as far as it ran.
    pub(super) within: Option<Arc<EventReport>>,
    /// How many events' reports were told.
    pub(super) told: usize,
    pub(super) found: bool,
    pub(super) ended: bool,
    /// What is kept of it while it is recorded.
    pub(super) making: Option<Making>,
}

/// See the module.
pub(in crate::tui) struct Desk {
    choice: Choice,
    budget_bytes: usize,
    studio: Option<Box<dyn Studio>>,
    drafts: Drafts,
    camera: Camera,
    open: Option<Open>,
}

impl Desk {
    /// A desk with nothing on it. The renderer is opened with the first recording.
    pub(in crate::tui) fn new(choice: Choice, budget_bytes: usize) -> Self {
        Self {
            choice,
            budget_bytes,
            studio: None,
            drafts: Drafts::default(),
            camera: Camera::default(),
            open: None,
        }
    }

    /// The same, which keeps what is recorded as drafts.
    #[must_use]
    pub(in crate::tui) fn with_drafts(self, drafts: Drafts) -> Self {
        Self { drafts, ..self }
    }

    /// Does one thing.
    pub(in crate::tui) fn handle(&mut self, ask: Ask, line: &mut dyn Line) {
        let urgent = ask.is_urgent();
        if !ask.keeps_the_state() {
            self.camera.forget();
        }
        if let Err(why) = self.try_to(ask, line) {
            line.tell(Told::Failed(why));
        }
        line.tell(Told::Idle { urgent });
    }

    fn try_to(&mut self, ask: Ask, line: &mut dyn Line) -> Result<(), String> {
        match ask {
            Ask::Open(path) => self.open_file(&path, line),
            Ask::Go(place) => self.opened()?.go(place, line),
            Ask::Run { from, stops } => self.opened()?.run(from, &stops, line),
            Ask::Learn => self.opened()?.learn(line),
            Ask::Shoot(shot) => {
                self.shoot(*shot, line);
                Ok(())
            }
            Ask::Identify { place, sight, at } => {
                let face = self.opened()?.face(place, &sight, at)?;
                line.tell(Told::Identified(face));
                Ok(())
            }
            Ask::SavePicture { path, what } => self.save_picture(path, what, line),
            Ask::Check => {
                let state = self.opened()?.replay.state();
                line.tell(Told::Checked(Box::new(state)));
                Ok(())
            }
            Ask::Begin { scene, viewport } => self.begin(SceneRef::typed(&scene), viewport, line),
            Ask::GoOn(events) => self.opened()?.go_on(events, line),
            Ask::Record(hand) => {
                let (open, drafts) = self.recorded()?;
                open.record(hand, drafts, line)
            }
            Ask::DropLast => {
                let (open, drafts) = self.recorded()?;
                open.drop_last(drafts, line)
            }
            Ask::Save(path) => self.opened()?.save(&path, line),
            Ask::Drafts => self.list_drafts(line),
            Ask::Compare(job) => {
                self.compare(&job, line);
                Ok(())
            }
            Ask::Cancel | Ask::StopComparing => Ok(()),
        }
    }

    fn recorded(&mut self) -> Result<(&mut Open, &Drafts), String> {
        let Self { open, drafts, .. } = self;
        Ok((open.as_mut().ok_or(NOTHING)?, drafts))
    }

    fn list_drafts(&mut self, line: &mut dyn Line) -> Result<(), String> {
        let making = self.open.as_ref().and_then(|open| open.making.as_ref());
        let drafts = self.drafts.list(making.map(Making::slot))?;
        line.tell(Told::Drafts(drafts));
        Ok(())
    }

    fn begin(&mut self, scene: SceneRef, viewport: [u32; 2], line: &mut dyn Line) -> Result<(), String> {
        line.tell(Told::Progress { what: "opening", done: 0, of: 0 });
        let case = recording::begin(scene, viewport)?;
        self.show(case, None, line)?.tell_recording(true, line);
        Ok(())
    }

    /// Makes a comparison, which has nothing to do with what is open here.
    pub(in crate::tui) fn compare(&self, job: &Job, line: &mut dyn Line) {
        compare::carry_out(job, self.choice, line);
    }

    fn opened(&mut self) -> Result<&mut Open, String> {
        self.open.as_mut().ok_or_else(|| NOTHING.into())
    }

    /// Opens a recording, goes on with a draft, or begins a recording on a scene.
    fn open_file(&mut self, path: &Path, line: &mut dyn Line) -> Result<(), String> {
        line.tell(Told::Progress { what: "opening", done: 0, of: 0 });
        if self.drafts.has(path) {
            let taken_up = self.take_up(path, line);
            return taken_up.or_else(|why| self.list_drafts(line).and(Err(why)));
        }
        if let Some(scene) = replay::scene_at(path).map_err(|error| error.to_string())? {
            return self.begin(scene, VIEWPORT, line);
        }
        let case = Case::open(path).map_err(|error| error.to_string())?;
        self.show(case, Some(path), line).map(drop)
    }

    /// A draft is a recording that was not ended: it is gone on with. Until it is this program's own it may still change.
    fn take_up(&mut self, path: &Path, line: &mut dyn Line) -> Result<(), String> {
        let slot = self.drafts.take_up(path)?;
        let case = Case::open(slot.path().unwrap_or(path)).map_err(|error| error.to_string())?;
        let open = self.show(case, None, line)?;
        open.making = Some(Making::taking_up(slot));
        open.tell_recording(true, line);
        open.go(Place::after(open.replay.len()), line)
    }

    /// Sees to it that what is not saved is a draft, now that nothing more is done here.
    pub(in crate::tui) fn leave(mut self) -> Result<(), String> {
        let Self { open, drafts, .. } = &mut self;
        open.as_mut().map_or(Ok(()), |open| open.keep(drafts))
    }

    /// Puts a recording on the desk.
    fn show(&mut self, case: Case, path: Option<&Path>, line: &mut dyn Line) -> Result<&mut Open, String> {
        if let Some(before) = &mut self.open {
            before.keep(&self.drafts)?;
        }
        let studio = match self.studio.take() {
            Some(studio) => studio,
            None => render::studio(self.choice).map_err(|error| error.to_string())?,
        };
        let studio = self.studio.insert(studio);
        let options = Options { pictures: true, budget_bytes: self.budget_bytes, ..Options::default() };
        let replay = case.replay(&case.recording, options, Some(studio.as_ref()));
        let replay = replay.map_err(|error| error.to_string())?;
        let recording = &case.recording;
        line.tell(Told::Opened(Box::new(Opened {
            path: path.map(Path::to_owned),
            engine: replay.engine().into(),
            stages: replay.stages().into_iter().map(|(id, title)| (id.into(), title.into())).collect(),
            lines: recording.event_lines(),
            scene: recording.scene().to_string(),
            viewport: recording.viewport(),
            renderer: studio.adapter().to_string(),
        })));
        let open = self.open.insert(Open::new(case, replay));
        open.stand(line);
        Ok(open)
    }

    fn shoot(&mut self, shot: Shot, line: &mut dyn Line) {
        let clock = Instant::now();
        let number = shot.number;
        line.tell(match self.take(shot) {
            Ok(picture) => {
                let ms = clock.elapsed().as_secs_f64() * 1e3;
                Told::Picture(Box::new(Picture { ms, ..picture }))
            }
            Err(why) => Told::NoPicture { number, why },
        });
    }

    /// Takes a picture.
    fn take(&mut self, shot: Shot) -> Result<Picture, String> {
        let Self { open, camera, .. } = self;
        let open = open.as_mut().ok_or(NOTHING)?;
        let of = open.source().map(|report| report.index);
        let overlays = open.source().map_or_else(Vec::new, |report| report.overlays.clone());
        let Taken { image, sight, legend } = camera.take(open.replay.as_mut(), &overlays, &shot)?;
        Ok(Picture { shot, place: open.place, image, sight, of, legend, ms: 0.0 })
    }

    fn save_picture(&mut self, path: PathBuf, what: Frame, line: &mut dyn Line) -> Result<(), String> {
        let image = match what {
            Frame::Shot(shot) => self.take(*shot)?.image,
            Frame::Image(image) => image,
        };
        let png = assets::write_png(&image).map_err(|fault| fault.to_string())?;
        assets::write_file(&path, &png).map_err(|error| error.to_string())?;
        line.tell(Told::PictureSaved { path, size: image.size });
        Ok(())
    }
}

impl Open {
    fn new(case: Case, replay: Box<dyn Replay>) -> Self {
        let (place, within, making) = (Place::START, None, None);
        Self { case, replay, place, within, told: 0, found: false, ended: false, making }
    }

    /// The report whose lines and sets of faces are drawn.
    fn source(&self) -> Option<&EventReport> {
        shot::source(self.within.as_deref(), self.place.events, |event| self.replay.event(event))
    }

    /// The face that is seen at a place of a picture.
    fn face(&self, place: Place, sight: &Sight, at: [f64; 2]) -> Result<Option<String>, String> {
        if place != self.place {
            return Err("this picture is of another place: try again when the right one is there".into());
        }
        Ok(self.replay.mesh().and_then(|mesh| camera::face_at(mesh, sight, at)))
    }

    fn go(&mut self, place: Place, line: &mut dyn Line) -> Result<(), String> {
        let place = Place { events: place.events.min(self.replay.len()), ..place };
        let arrived = self.seek(place.events, line);
        match place.stage {
            Some(stage) if arrived && place.events < self.replay.len() => self.enter(place.events, stage)?,
            _ => {}
        }
        self.stand(line);
        Ok(())
    }

    /// Goes to before an event, telling how far it is and what ran. False when it was interrupted.
    fn seek(&mut self, event: usize, line: &mut dyn Line) -> bool {
        self.within = None;
        // Reports come out of the session one by one, so what has not run yet is stepped.
        let known = self.told.min(event);
        let from = self.replay.position();
        let of = from.abs_diff(event);
        let arrived = self.replay.seek_while(known, &mut |at| {
            line.tell(Told::Progress { what: "seeking", done: from.abs_diff(at), of });
            !line.is_interrupted()
        });
        let arrived = arrived && self.run_to(event, line);
        self.place = Place { events: self.replay.position(), stage: None };
        arrived
    }

    /// Runs up to an event. False when it was interrupted.
    fn run_to(&mut self, event: usize, line: &mut dyn Line) -> bool {
        while self.replay.position() < event {
            if self.replay.step().is_none() {
                break;
            }
            self.tell_news(line);
            if self.replay.position() < event {
                let (done, of) = (self.replay.position(), event);
                line.tell(Told::Progress { what: "running", done, of });
                if line.is_interrupted() {
                    return false;
                }
            }
        }
        true
    }

    /// Stops after one of the stages that an event has, counted in the rows of its report.
    fn enter(&mut self, event: usize, stage: usize) -> Result<(), String> {
        let id =
            self.replay.event(event).and_then(|report| report.stages.get(stage)).map(|row| row.id.clone());
        let Some(id) = id else { return Ok(()) };
        self.within = Some(Arc::new(self.replay.hold(event, &id)?));
        self.place = Place { events: event, stage: Some(stage) };
        Ok(())
    }

    /// Runs what has not run yet, for as long as nobody wants anything else, and comes back. What is held stays held.
    fn learn(&mut self, line: &mut dyn Line) -> Result<(), String> {
        let (place, end) = (self.place, self.replay.len());
        if self.within.is_some() || self.told == end {
            return Ok(());
        }
        self.replay.seek(self.told);
        while !line.is_wanted() && self.replay.step().is_some() {
            self.tell_news(line);
            line.tell(Told::Progress { what: "running ahead", done: self.told, of: end });
        }
        self.replay.seek(place.events);
        Ok(())
    }

    fn run(&mut self, from: usize, stops: &[Stop], line: &mut dyn Line) -> Result<(), String> {
        let end = self.replay.len();
        if !self.seek(from.min(end), line) {
            self.stand(line);
            return Ok(());
        }
        loop {
            if self.replay.step().is_none() {
                line.tell(Told::Stopped("the end".into()));
                break;
            }
            self.tell_news(line);
            let at = self.replay.position();
            self.place = Place { events: at, stage: None };
            let report = self.replay.event(at - 1);
            if let Some(stop) = report.and_then(|report| stops.iter().find(|stop| stop.hits(report))) {
                line.tell(Told::Stopped(stop.to_string()));
                break;
            }
            line.tell(Told::Progress { what: "running", done: at, of: end });
            if line.is_interrupted() {
                break;
            }
        }
        self.stand(line);
        Ok(())
    }

    /// Tells what ran for the first time.
    pub(super) fn tell_news(&mut self, line: &mut dyn Line) {
        while let Some(report) = self.replay.event(self.told) {
            line.tell(Told::Report(Arc::new(report.clone())));
            self.told += 1;
        }
        if let (false, Some(finding)) = (self.found, self.replay.finding()) {
            line.tell(Told::Finding(Box::new(finding.clone())));
            self.found = true;
        }
        if !self.ended && self.replay.position() == self.replay.len() {
            self.ended = true;
            self.replay.end().into_iter().for_each(|end| line.tell(Told::End(Box::new(end.clone()))));
        }
    }

    /// Tells where it is.
    pub(super) fn stand(&mut self, line: &mut dyn Line) {
        line.tell(Told::At(Box::new(Standing {
            place: self.place,
            within: self.within.clone(),
            sizes: self.replay.sizes(),
            orbit: self.replay.orbit(),
            mode: self.replay.mode(),
            kept_bytes: self.replay.kept_bytes(),
        })));
    }
}
