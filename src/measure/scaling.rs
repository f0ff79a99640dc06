//! What the same cut and the same pick cost as the mesh grows.
//!
//! The scene is `bust:N`. At every size the cut begins at the same pixel and crosses the same number of links, so it shrinks with the edges.
//! Since opening and depth of a cut follow from its length in centimetres (Lam 2016, §4.3), the unit grows as the cut shrinks: it is as long
//! everywhere, and opens as many edges wide. What is left to differ is what grows with the mesh. The sizes take turns, round by
//! round, so that whatever else runs on the machine disturbs them all alike. Every cut is committed and then taken back, and each
//! round ends with picks all over the face.
//!
//! Not promised: the whole cost of a large mesh in use. A cut that is repeated finds its surroundings in the processor's caches.

use std::time::Instant;

use schemars::JsonSchema;
use serde::Serialize;

use super::drive::{self, Ran};
use super::figure::table;
use super::{Figure, MeasureError, Progress, Random};
use crate::assets::SceneSettings;
use crate::assets::builtin::builtin;
use crate::canvas::look::Look;
use crate::engine::Engine;
use crate::engine::wound::{Mode, Pick, Scene, State, Work, Wound, WoundEvent, pick};
use crate::mesh::Mesh;
use crate::report::Table;

/// Faces of the meshes, about; the first is what the others are compared with.
pub const SIZES: [usize; 6] = [8_000, 32_000, 125_000, 500_000, 2_000_000, 4_000_000];
/// The sizes of a quick run.
pub const QUICK: [usize; 3] = [8_000, 32_000, 125_000];

const VIEWPORT: [u32; 2] = [1280, 720];
/// Where the cut begins: on the forehead.
const START: [f64; 2] = [620.0, 215.0];
/// Where it goes from there: across, and a little down, so that it follows no row of the mesh.
const DIRECTION: [f64; 2] = [0.96, 0.28];
/// What the cut crosses at every size: about what a large cut of the thesis's does.
const LINKS: usize = 24;
/// The first length that is tried on the smallest mesh, pixels.
const FIRST_LENGTH_PX: f64 = 100.0;
/// How often the length is corrected to meet the number of links.
const CORRECTIONS: usize = 60;
/// Picks in a round.
const PICKS: usize = 64;
/// Where picks go, pixels: the face.
const PICKED: [[f64; 2]; 2] = [[560.0, 720.0], [200.0, 480.0]];

/// What one mesh came to.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Size {
    /// Faces.
    pub faces: usize,
    /// Links of the cut.
    pub links: usize,
    /// Microseconds of FC, MC and CI.
    pub us: [Figure; 3],
    /// Microseconds of the three together.
    pub total_us: Figure,
    /// The total over that of the first size.
    pub ratio: f64,
    /// MC and CI together over those of the first size.
    pub merge_carve_ratio: f64,
    /// Microseconds of a pick.
    pub pick_us: Figure,
    /// Microseconds from the second click until the pick after the cut is answered.
    pub ready_us: Figure,
    /// Seconds to make the topology from positions and faces.
    pub mesh_build_s: f64,
    /// Seconds to make the hierarchy for picks.
    pub bvh_build_s: f64,
    /// Bytes a face, topology and hierarchy included.
    pub bytes_per_face: f64,
}

/// All sizes.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct ScalingReport {
    /// How many rounds were run.
    pub rounds: usize,
    /// The sizes, ascending.
    pub sizes: Vec<Size>,
}

/// A mesh that waits for its next round.
struct Runner {
    state: State,
    event: WoundEvent,
    links: usize,
    length_cm: f64,
    mesh_build_s: f64,
    bvh_build_s: f64,
    rounds: Vec<Round>,
}

/// Microseconds of one round.
struct Round {
    stages: [f64; 3],
    pick: f64,
    ready: f64,
}

/// Measures some sizes of the bust, in so many rounds.
pub fn measure(
    sizes: &[usize],
    rounds: usize,
    progress: Progress<'_>,
) -> Result<ScalingReport, MeasureError> {
    let mut runners: Vec<Runner> = Vec::with_capacity(sizes.len());
    for (done, &faces) in sizes.iter().enumerate() {
        progress(done, sizes.len() + rounds, &format!("bust:{faces}"));
        let first_cm = runners.first().map(|first| first.length_cm);
        runners.push(Runner::new(faces, first_cm)?);
    }
    let mut random = Random::of(0, 0, "picks");
    for round in 0..=rounds {
        progress(sizes.len() + round, sizes.len() + rounds, "cuts and picks");
        let pixels: Vec<[f64; 2]> =
            (0..PICKS).map(|_| PICKED.map(|[low, high]| random.within(low, high))).collect();
        runners.iter_mut().try_for_each(|runner| runner.round(&pixels))?;
        if round == 0 {
            // It warmed up.
            runners.iter_mut().for_each(|runner| runner.rounds.clear());
        }
    }
    let mut sizes: Vec<Size> = runners.iter().map(Runner::size).collect();
    compare(&mut sizes);
    Ok(ScalingReport { rounds, sizes })
}

/// Fills in the ratios to the first size.
fn compare(sizes: &mut [Size]) {
    let merge_carve = |s: &Size| s.us[1].median + s.us[2].median;
    let Some(first) = sizes.first().map(|s| (s.total_us.median, merge_carve(s))) else { return };
    for size in sizes {
        size.ratio = size.total_us.median / first.0;
        size.merge_carve_ratio = merge_carve(size) / first.1;
    }
}

/// Seconds that something takes.
fn timed<T>(run: impl FnOnce() -> T) -> (T, f64) {
    let clock = Instant::now();
    let value = run();
    (value, clock.elapsed().as_secs_f64())
}

impl Runner {
    /// Makes the bust, and finds its cut. The unit is such that the cut is as many centimetres long as `first_cm` says; a centimetre for
    /// the first.
    fn new(faces: usize, first_cm: Option<f64>) -> Result<Self, MeasureError> {
        let indexed = builtin(&format!("bust:{faces}"))?.mesh;
        let (mesh, mesh_build_s) = timed(|| Mesh::build(&indexed));
        drop(indexed);
        let mut state = State::new(mesh?, default_scene());
        let ((), bvh_build_s) = timed(|| {
            state.mesh_and_bvh();
        });
        let (event, found) = fitting_cut(&mut state)?;
        let length_cm = first_cm.unwrap_or(found.length);
        let unit_cm = length_cm / found.length;
        let mut state = State::new(state.mesh, Scene { unit_cm, ..default_scene() });
        state.mesh_and_bvh();
        let links = found.links;
        Ok(Self { state, event, links, length_cm, mesh_build_s, bvh_build_s, rounds: Vec::new() })
    }

    fn round(&mut self, pixels: &[[f64; 2]]) -> Result<(), MeasureError> {
        let state = &mut self.state;
        let ((ran, hit), ready_s) = timed(|| {
            let ran = drive::run(state, &self.event, false);
            (ran, pick::resolve(state, Pick::Pixel(START)))
        });
        let Some(patch) = &ran.patch else { return Err(rejected(state, &ran)) };
        Wound::revert(state, patch);
        hit.map_err(|r| MeasureError::Rejected(r.detail))?;
        // Once for the caches, since the other sizes had their turns in between; then for the clock.
        let all = |state: &mut State| {
            pixels.iter().filter(|&&p| pick::resolve(state, Pick::Pixel(p)).is_ok()).count()
        };
        all(state);
        let (_, picks_s) = timed(|| all(state));
        let stages = ["FC", "MC", "CI"].map(|id| ran.us(id));
        self.rounds.push(Round { stages, pick: picks_s * 1e6 / pixels.len() as f64, ready: ready_s * 1e6 });
        Ok(())
    }

    fn size(&self) -> Size {
        let figure = |of: &dyn Fn(&Round) -> f64| Figure::of(self.rounds.iter().map(of));
        let faces = self.state.mesh.face_count();
        Size {
            faces,
            links: self.links,
            us: [0, 1, 2].map(|stage| figure(&|r| r.stages[stage])),
            total_us: figure(&|r| r.stages.iter().sum()),
            ratio: 1.0,
            merge_carve_ratio: 1.0,
            pick_us: figure(&|r| r.pick),
            ready_us: figure(&|r| r.ready),
            mesh_build_s: self.mesh_build_s,
            bvh_build_s: self.bvh_build_s,
            bytes_per_face: Wound::state_bytes(&self.state) as f64 / faces as f64,
        }
    }
}

/// How a scene of which nothing else is said is looked at.
pub(super) fn default_scene() -> Scene {
    let SceneSettings { unit_cm, snap_px, fov_y, target, azimuth, zenith, distance, .. } =
        SceneSettings::default();
    let (look, map_size) = (Look::default(), [1024; 2]);
    Scene { viewport: VIEWPORT, unit_cm, snap_px, fov_y, target, azimuth, zenith, distance, look, map_size }
}

fn rejected(state: &State, ran: &Ran) -> MeasureError {
    let why = ran.rejection.as_ref().map_or("", |r| &r.detail);
    MeasureError::Rejected(format!("the cut on {} faces is rejected: {why}", state.mesh.face_count()))
}

/// A line as FC forms it.
#[derive(Clone, Copy)]
struct Found {
    links: usize,
    /// Arc length, model units.
    length: f64,
}

/// The cut whose length makes it cross as many links as wanted.
fn fitting_cut(state: &mut State) -> Result<(WoundEvent, Found), MeasureError> {
    let mut length_px = FIRST_LENGTH_PX * (SIZES[0] as f64 / state.mesh.face_count() as f64).sqrt();
    let mut best = (length_px, form(state, length_px)?);
    for _ in 0..CORRECTIONS {
        // All of what is missing at once would jump to and fro over the number.
        length_px *= 1.0 + 0.5 * (LINKS as f64 / best.1.links.max(1) as f64 - 1.0).clamp(-0.5, 1.0);
        let found = form(state, length_px)?;
        if found.links.abs_diff(LINKS) <= best.1.links.abs_diff(LINKS) {
            best = (length_px, found);
        }
        if found.links == LINKS {
            break;
        }
    }
    Ok((cut(best.0), best.1))
}

fn cut(length_px: f64) -> WoundEvent {
    let end = [0, 1].map(|k| START[k] + DIRECTION[k] * length_px);
    WoundEvent::Cut { from: Pick::Pixel(START), to: Pick::Pixel(end) }
}

/// The line of the cut of a length.
fn form(state: &mut State, length_px: f64) -> Result<Found, MeasureError> {
    state.control.mode = Mode::Patch;
    let ran = drive::run(state, &cut(length_px), false);
    state.control.mode = Mode::Carve;
    match (&ran.patch, &ran.work) {
        (Some(_), Some(Work::Cut(cut))) => {
            let chain = &cut.formed.chain;
            Ok(Found { links: chain.links.len(), length: chain.length() })
        }
        _ => Err(rejected(state, &ran)),
    }
}

impl ScalingReport {
    /// The report for people.
    pub fn tables(&self) -> Vec<Table> {
        let columns = [
            "faces",
            "links",
            "FC µs",
            "MC µs",
            "CI µs",
            "total µs",
            "ratio",
            "MC+CI ratio",
            "pick µs",
            "ready µs",
            "mesh s",
            "BVH s",
            "bytes a face",
        ];
        let title = format!(
            "The same cut and pick on larger meshes: median ± half the quartile range of {} rounds",
            self.rounds
        );
        vec![table(&title, &columns, self.sizes.iter().map(Size::cells))]
    }
}

impl Size {
    fn cells(&self) -> Vec<String> {
        let head = [self.faces.to_string(), self.links.to_string()];
        let us = self.us.iter().chain([&self.total_us]).map(|figure| figure.text(1));
        let tail = [
            format!("{:.2}", self.ratio),
            format!("{:.2}", self.merge_carve_ratio),
            self.pick_us.text(2),
            self.ready_us.text(1),
            format!("{:.3}", self.mesh_build_s),
            format!("{:.3}", self.bvh_build_s),
            format!("{:.0}", self.bytes_per_face),
        ];
        head.into_iter().chain(us).chain(tail).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_cut_crosses_as_many_links_on_every_mesh_and_leaves_no_trace() {
        let first = Runner::new(8_000, None).expect("a bust");
        let second = Runner::new(32_000, Some(first.length_cm)).expect("a bust");
        let mut runners = [first, second];
        for runner in &mut runners {
            assert_eq!(runner.links, LINKS);
            let before = Wound::counts(&runner.state);
            runner.round(&[START]).expect("it is applied");
            assert_eq!(Wound::counts(&runner.state), before);
            let size = runner.size();
            assert!(size.total_us.median > 0.0 && size.pick_us.median > 0.0);
            assert!(size.ready_us.median > size.total_us.median);
        }
    }

    #[test]
    fn ratios_are_to_the_first_size() {
        let size = |us: f64| Size {
            faces: 8,
            links: 1,
            us: [us; 3].map(|us| Figure::of([us])),
            total_us: Figure::of([3.0 * us]),
            ratio: 0.0,
            merge_carve_ratio: 0.0,
            pick_us: Figure::default(),
            ready_us: Figure::default(),
            mesh_build_s: 0.0,
            bvh_build_s: 0.0,
            bytes_per_face: 0.0,
        };
        let mut sizes = [size(2.0), size(3.0)];
        compare(&mut sizes);
        assert_eq!(sizes.map(|s| [s.ratio, s.merge_carve_ratio]), [[1.0, 1.0], [1.5, 1.5]]);
    }
}
