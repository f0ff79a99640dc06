//! The same recording gives the same digests: linearly, after seeking to and fro under any budget, with more or fewer checks, alone or
//! beside another thread. (That they are the same on other machines and optimisation levels is what the goldens are for.)

use std::path::Path;
use std::thread;

use lancet::assets::{self, CacheOptions, Loaded};
use lancet::engine::wound::{CameraChange, Mode, Pick, WoundEvent};
use lancet::recording::{AnyRecording, Keyed, Recording, SceneRef};
use lancet::replay::{self, Options, Replay};
use lancet::report::{Outcome, RunReport, StateReport};
use support::Random;

mod support;

const SCENES: &[&str] = &["bust:2000", "sphere:2000", "slab", "torus", "two-fingers", "grid"];
/// Events of a recording.
const EVENTS: usize = 60;
const SIDE: u32 = 320;

/// A recording on its scene.
struct Case {
    recording: AnyRecording,
    scene: Loaded,
}

impl Case {
    fn on(name: &str) -> Self {
        let scene = SceneRef::Builtin(name.into());
        let loaded = assets::open(&scene, Path::new(""), &CacheOptions::off()).expect("a built-in scene");
        let mut random = Random::named(name);
        let events = (0..).zip(events(&mut random)).map(|(key, event)| Keyed { key, event }).collect();
        let recording = AnyRecording::Wound(Recording {
            scene,
            scene_hash: loaded.scene_hash,
            mesh_hash: loaded.mesh_hash,
            viewport: [SIDE; 2],
            seed: 7,
            events,
        });
        Self { recording, scene: loaded }
    }

    fn replay(&self, options: Options) -> Box<dyn Replay> {
        replay::open(&self.recording, self.scene.clone(), options, None).expect("its own scene")
    }

    fn run(&self, options: Options) -> RunReport {
        let mut replay = self.replay(options);
        replay.finish();
        let run = replay.run_report("");
        assert_eq!(run.findings().next(), None, "{}", self.recording.scene());
        run
    }
}

/// Everything that can be recorded, at random; mostly cuts.
fn events(random: &mut Random) -> impl Iterator<Item = WoundEvent> + '_ {
    (0..EVENTS).map(|i| match random.below(16) {
        0 => WoundEvent::Undo {},
        1 => WoundEvent::Redo {},
        2 => WoundEvent::Subdivide { at: pixel(random), into: [3, 4, 6][random.below(3) as usize] },
        3 => WoundEvent::Checkpoint(format!("after-{i}")),
        4 | 5 => WoundEvent::Camera(CameraChange {
            azimuth: Some(6.0 * random.unit()),
            zenith: Some(0.4 + 2.4 * random.unit()),
            distance: None,
        }),
        6 => WoundEvent::Mode([Mode::Patch, Mode::Merge, Mode::Carve][random.below(3) as usize]),
        7..=9 => WoundEvent::Click(pixel(random)),
        _ => cut(random),
    })
}

/// Of some 30 pixels.
fn cut(random: &mut Random) -> WoundEvent {
    let from = pixel(random);
    let to = from.map(|x| x + 60.0 * (random.unit() - 0.5));
    WoundEvent::Cut { from: Pick::Pixel(from), to: Pick::Pixel(to) }
}

/// Where most scenes have a surface.
fn pixel(random: &mut Random) -> [f64; 2] {
    [0; 2].map(|_| f64::from(SIDE) * (0.2 + 0.6 * random.unit()))
}

fn cases() -> Vec<Case> {
    SCENES.iter().map(|name| Case::on(name)).collect()
}

#[test]
fn the_recordings_do_what_they_are_for() {
    let runs: Vec<RunReport> = cases().iter().map(|case| case.run(Options::default())).collect();
    for (name, run) in SCENES.iter().zip(&runs) {
        assert!(run.totals.cuts > 5, "{name}: {:?}", run.totals);
        let applied = |kind| run.events.iter().any(|e| e.kind == kind && e.outcome == Outcome::Applied);
        assert!(applied("cut"), "{name}");
    }
    let applied = |kind| {
        runs.iter().flat_map(|run| &run.events).any(|e| e.kind == kind && e.outcome == Outcome::Applied)
    };
    assert!(["click", "subdivide", "undo", "redo"].into_iter().all(applied));
}

#[test]
fn more_checks_change_no_digest() {
    for case in cases() {
        let plain = case.run(Options::default());
        for options in [
            Options { check_every: 1, ..Options::default() },
            Options { paranoid: true, ..Options::default() },
            Options { keep_deltas: true, ..Options::default() },
        ] {
            let run = case.run(options.clone());
            assert_eq!(
                (run.totals.digest, run.end),
                (plain.totals.digest.clone(), plain.end.clone()),
                "{options:?}"
            );
        }
    }
}

#[test]
fn seeking_to_and_fro_gives_what_linear_replay_gives() {
    for case in cases() {
        let linear = case.run(Options::default());
        let states = states(&case);
        for budget_bytes in [0, 10_000, 256 << 20] {
            let mut replay = case.replay(Options { budget_bytes, ..Options::default() });
            let mut random = Random::named("seek");
            for _ in 0..12 {
                let event = random.below(EVENTS as u32 + 1) as usize;
                replay.seek(event);
                assert_eq!(
                    replay.state(),
                    states[event],
                    "event {event}, {budget_bytes} bytes, {}",
                    linear.engine
                );
            }
            replay.seek(EVENTS);
            assert_eq!(replay.run_report("").totals, linear.totals, "{budget_bytes} bytes");
        }
    }
}

/// The state before each event, and at the end.
fn states(case: &Case) -> Vec<StateReport> {
    let mut replay = case.replay(Options::default());
    let mut states = vec![replay.state()];
    while replay.step().is_some() {
        states.push(replay.state());
    }
    states
}

#[test]
fn runs_beside_each_other_do_not_meet() {
    let cases = cases();
    let digests =
        || -> Vec<String> { cases.iter().map(|case| case.run(Options::default()).totals.digest).collect() };
    let alone = digests();
    let beside: Vec<Vec<String>> = thread::scope(|scope| {
        let threads = [scope.spawn(digests), scope.spawn(digests)];
        threads.map(|thread| thread.join().expect("it ends well")).to_vec()
    });
    assert_eq!(beside, [alone.clone(), alone]);
}
