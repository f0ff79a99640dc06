//! One rung: every cut on a fresh copy of the scene as it is there, by the engine and by what it is compared with.

use std::any::Any;
use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;

use glam::DVec3;
use schemars::JsonSchema;
use serde::Serialize;

use super::ladders::{Ladder, mend};
use super::sample::{self, Sample};
use crate::assets::builtin::builtin;
use crate::engine::Engine;
use crate::engine::wound::pick::{Picked, resolve};
use crate::engine::wound::{Scene, State, Wound, WoundEvent};
use crate::measure::baseline::{self, Failure, Scalar};
use crate::measure::drive::{self, Ran};
use crate::measure::exact::{self, Line, Question, Refusal, Section};
use crate::measure::scaling::default_scene;
use crate::measure::stability::part::{Broken, message};
use crate::measure::stability::scenes::Prepared;
use crate::measure::{MeasureError, Random};
use crate::mesh::{IndexedMesh, Mesh};
use crate::report::{Check, Outcome};

/// What became of the engine's cuts.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct Ours {
    /// Applied.
    pub applied: usize,
    /// Refused, by reason.
    pub refused: BTreeMap<String, usize>,
    /// With a broken invariant, a panic, or another line than the exact one.
    pub findings: usize,
}

/// What became of the baseline's.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct Theirs {
    /// Cuts that it was asked for: those with an exact line.
    pub asked: usize,
    /// Failures, by kind.
    pub failures: BTreeMap<Failure, usize>,
}

/// All cuts of a rung.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Rung {
    /// The number that the ladder counts.
    pub value: f64,
    /// Cuts, all scenes together.
    pub cuts: usize,
    /// The engine.
    pub ours: Ours,
    /// f32 with an ε.
    pub plain_f32: Theirs,
    /// f64 with an ε.
    pub plain_f64: Theirs,
}

/// What broke, and on what.
pub(super) struct Found {
    /// What its files are called by: the ladder, and the scene as it is. The cuts of a rung are counted on each of its scenes.
    pub(super) kind: String,
    pub(super) scene: Prepared,
    pub(super) broken: Broken,
}

/// A scene as it is, and its cuts.
pub(super) struct Base {
    name: &'static str,
    indexed: IndexedMesh,
    scene: Scene,
    target: DVec3,
    samples: Vec<Sample>,
}

impl Base {
    pub(super) fn make(name: &'static str, cuts: usize, seed: u64) -> Result<Self, MeasureError> {
        let (indexed, scene) = (builtin(name)?.mesh, default_scene());
        let mut state = State::new(Mesh::build(&indexed)?, scene.clone());
        state.mesh_and_bvh();
        let samples = sample::draw(&state, cuts, &mut Random::of(seed, 0, name));
        Ok(Self { name, indexed, scene, target: state.control.camera.target, samples })
    }

    /// The scene on a rung.
    pub(super) fn prepared(&self, ladder: &Ladder, value: f64, seed: u64) -> Result<Prepared, MeasureError> {
        let (mut indexed, place) = (self.indexed.clone(), (ladder.place)(value));
        indexed.positions.iter_mut().for_each(|p| *p = place.of(*p));
        let before = indexed.positions.clone();
        (ladder.spoil)(&mut indexed, value, &mut Random::of(seed, value.to_bits(), ladder.name));
        mend(&mut indexed, &before);
        let target = Some(place.of(self.target).to_array());
        let scene = Scene { unit_cm: 1.0 / place.scale, target, ..self.scene.clone() };
        let mut state = State::new(Mesh::build(&indexed)?, scene.clone());
        state.mesh_and_bvh();
        let name = format!("{}, {} {value:e}", self.name, ladder.name);
        Ok(Prepared { name, builtin: None, indexed: Arc::new(indexed), scene, state })
    }

    /// The events of every cut, seen from where the eye has gone with the scene.
    pub(super) fn events(&self, ladder: &Ladder, value: f64) -> Vec<[WoundEvent; 3]> {
        let place = (ladder.place)(value);
        let target = place.of(self.target);
        self.samples.iter().map(|sample| sample.events(place.of(sample.eye), target)).collect()
    }
}

/// Makes all cuts of a rung.
pub(super) fn run(
    ladder: &Ladder,
    value: f64,
    bases: &[Base],
    seed: u64,
) -> Result<(Rung, Vec<Found>), MeasureError> {
    let (ours, theirs) = (Ours::default(), Theirs::default());
    let mut rung = Rung { value, cuts: 0, ours, plain_f32: theirs.clone(), plain_f64: theirs };
    let mut found = Vec::new();
    for base in bases.iter().filter(|base| ladder.scenes.contains(&base.name)) {
        let scene = base.prepared(ladder, value, seed)?;
        for (cut, events) in base.events(ladder, value).into_iter().enumerate() {
            let broken = rung.cut(&scene.state, &events);
            if let Some((stage, check)) = broken.into_iter().next() {
                rung.ours.findings += 1;
                let broken = Broken { cut, stage, check, events: events.into() };
                found.push(Found::of(ladder, base, scene.clone(), broken));
            }
        }
    }
    Ok((rung, found))
}

impl Found {
    pub(super) fn of(ladder: &Ladder, base: &Base, scene: Prepared, broken: Broken) -> Self {
        let kind = format!("range-{}-{}", ladder.name, base.name).replace([' ', ':'], "-");
        Self { kind, scene, broken }
    }
}

impl Rung {
    /// Makes one cut; gives what broke.
    pub(super) fn cut(&mut self, before: &State, events: &[WoundEvent; 3]) -> Vec<(String, Check)> {
        self.cuts += 1;
        let mut state = before.clone();
        events[..2].iter().for_each(|event| drop(drive::run(&mut state, event, false)));
        let panicked = |panic: Box<dyn Any + Send>| {
            vec![("panic".to_owned(), Check::fail("no-panic", message(panic.as_ref())))]
        };
        let compared = catch_unwind(AssertUnwindSafe(|| self.compared(&mut state, &events[2])));
        let mut broken = compared.unwrap_or_else(panicked);
        match catch_unwind(AssertUnwindSafe(|| apply(&mut state, &events[2]))) {
            Ok((ran, checks)) => {
                self.count(&ran);
                broken.extend(checks);
            }
            Err(panic) => broken.extend(panicked(panic)),
        }
        broken
    }

    fn count(&mut self, ran: &Ran) {
        self.ours.applied += usize::from(ran.outcome == Outcome::Applied);
        if let Some(rejection) = &ran.rejection {
            *self.ours.refused.entry(rejection.reason.clone()).or_default() += 1;
        }
    }

    /// The exact line beside the engine's and the baseline's.
    fn compared(&mut self, state: &mut State, event: &WoundEvent) -> Vec<(String, Check)> {
        let WoundEvent::Cut { from, to } = *event else { return Vec::new() };
        let (Ok(from), Ok(to)) = (resolve(state, from), resolve(state, to)) else { return Vec::new() };
        let (mesh, eye, picks) = (&state.mesh, state.control.camera.eye(), [from, to]);
        let section = Section::of(mesh, &Question::of(eye, &picks));
        let line = match &section {
            Ok(section) => section.line().map(|line| Some((section, line))),
            // Without an exact answer a line is still a line or none.
            Err(Refusal::NotPosed(_)) => Ok(None),
            Err(refusal) => Err(refusal.clone()),
        };
        if let Ok(line) = &line {
            let exact = line.as_ref().map(|(section, line)| (*section, line));
            self.plain_f32.ask::<f32>(mesh, eye, &picks, baseline::SHARES[0], exact);
            self.plain_f64.ask::<f64>(mesh, eye, &picks, baseline::SHARES[1], exact);
        }
        let differs = exact::compare(mesh, eye, &picks).err();
        differs.map(|d| ("FC".into(), Check::fail("exact", d.to_string()))).into_iter().collect()
    }
}

/// Runs the cut with all checks, and looks at the whole mesh.
fn apply(state: &mut State, event: &WoundEvent) -> (Ran, Vec<(String, Check)>) {
    let ran = drive::run(state, event, true);
    let stages = ran.broken.iter().map(|(stage, check)| ((*stage).to_owned(), check.clone()));
    let whole = Wound::check(state).into_iter().filter(|check| !check.ok);
    let broken = stages.chain(whole.map(|check| ("state".to_owned(), check))).collect();
    (ran, broken)
}

impl Theirs {
    fn ask<S: Scalar>(
        &mut self,
        mesh: &Mesh,
        eye: DVec3,
        picks: &[Picked; 2],
        share: f64,
        exact: Option<(&Section<'_>, &Line)>,
    ) {
        self.asked += 1;
        let epsilon = baseline::epsilon(mesh, share);
        let chain = baseline::cut::<S>(mesh, eye, picks, epsilon);
        let judged = chain.and_then(|chain| match exact {
            Some((section, line)) => baseline::judge(section, line, &chain, epsilon),
            None => Ok(()),
        });
        if let Err(failure) = judged {
            *self.failures.entry(failure).or_default() += 1;
        }
    }

    /// Cuts that came to no line or no mesh.
    pub fn lost(&self) -> usize {
        self.failures.iter().filter(|(failure, _)| failure.is_lost()).map(|(_, count)| count).sum()
    }

    /// Cuts that came to another line than the exact one, beyond what ε allows.
    pub fn wrong(&self) -> usize {
        self.failures.get(&Failure::WrongConstruct).copied().unwrap_or(0)
    }

    /// Whether no cut failed.
    pub fn holds(&self) -> bool {
        self.lost() + self.wrong() == 0
    }
}
