//! What cuts in view add to a frame, and what their discoloration adds to the scattering (Lam 2016, §6.5.2 and §6.5.3: Table 6.3
//! and Figure 6.7).
//!
//! One view of the bust, 1280 x 720 as in the thesis, with a grid of short cuts on the face. A scene for each number of cuts is kept ready, and the
//! frames are taken in turns, so that what disturbs one disturbs all. Times are the passes' own, the device's where it can be
//! asked, without reading the picture back.

use std::path::Path;

use schemars::JsonSchema;
use serde::Serialize;

use super::published::{FRAMES, LOCALIZED};
use crate::assets::{self, CacheOptions};
use crate::canvas::Studio;
use crate::engine::wound::{Pick, Value, WoundEvent};
use crate::measure::figure::table;
use crate::measure::{Figure, MeasureError, Progress};
use crate::recording::{Keyed, Recorded, Recording, SceneRef};
use crate::replay::{self, OpenError, Options, Replay, Shot};
use crate::report::{Outcome, Pass, Table};

const VIEWPORT: [u32; 2] = [1280, 720];
/// Numbers of cuts at which the scattering is compared.
const SCATTERING_AT: [usize; 2] = [10, 50];

/// Frames with a number of cuts in view.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct FrameTime {
    /// How many cuts.
    pub cuts: usize,
    /// Milliseconds of all passes together.
    pub ms: Figure,
    /// What it takes more than without cuts, as a share: the median over frames taken in turns.
    pub more: f64,
    /// The thesis's milliseconds.
    pub thesis_ms: f64,
}

/// Scattering with and without local discoloration.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Scattering {
    /// How many cuts.
    pub cuts: usize,
    /// Milliseconds without discoloration.
    pub plain_ms: Figure,
    /// Milliseconds with it.
    pub localized_ms: Figure,
    /// What it adds, as a share: the median over frames taken in turns.
    pub more: f64,
    /// Tiles with skin that are discoloured, as a share.
    pub discoloured: f64,
    /// What it adds in the thesis.
    pub thesis_more: f64,
}

/// Both tests.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Frames {
    /// How many frames of each kind were taken.
    pub repeat: usize,
    /// Table 6.3.
    pub frames: Vec<FrameTime>,
    /// Figure 6.7.
    pub scattering: Vec<Scattering>,
}

/// Takes the frames.
pub fn measure(repeat: usize, studio: &dyn Studio, progress: Progress<'_>) -> Result<Frames, MeasureError> {
    progress(0, 2, "frames with 0 to 30 cuts");
    let frames = frame_times(repeat, studio)?;
    progress(1, 2, "scattering");
    let scattering = SCATTERING_AT.map(|cuts| scattering(cuts, repeat, studio));
    let scattering = scattering.into_iter().collect::<Result<_, _>>()?;
    Ok(Frames { repeat, frames, scattering })
}

fn frame_times(repeat: usize, studio: &dyn Studio) -> Result<Vec<FrameTime>, MeasureError> {
    let mut views =
        FRAMES.map(|(cuts, _)| view(cuts, true, studio)).into_iter().collect::<Result<Vec<_>, _>>()?;
    let rounds =
        rounds(&mut views, repeat, |passes| passes.iter().filter(|p| p.id != "upload").map(|p| p.us).sum())?;
    let row = |i: usize| FrameTime {
        cuts: FRAMES[i].0,
        ms: Figure::of(rounds.iter().map(|round| round[i] / 1e3)),
        more: Figure::of(rounds.iter().map(|round| round[i] / round[0] - 1.0)).median,
        thesis_ms: FRAMES[i].1,
    };
    Ok((0..FRAMES.len()).map(row).collect())
}

fn scattering(cuts: usize, repeat: usize, studio: &dyn Studio) -> Result<Scattering, MeasureError> {
    let views = [false, true].map(|discoloration| view(cuts, discoloration, studio));
    let mut views = views.into_iter().collect::<Result<Vec<_>, _>>()?;
    let of_scattering = |passes: &[Pass]| scattering_passes(passes).map(|pass| pass.us).sum();
    let rounds = rounds(&mut views, repeat, of_scattering)?;
    let at = |i: usize| Figure::of(rounds.iter().map(|round| round[i] / 1e3));
    Ok(Scattering {
        cuts,
        plain_ms: at(0),
        localized_ms: at(1),
        more: Figure::of(rounds.iter().map(|round| round[1] / round[0] - 1.0)).median,
        discoloured: share_discoloured(&frame(views[1].as_mut())?),
        thesis_more: LOCALIZED,
    })
}

fn scattering_passes(passes: &[Pass]) -> impl Iterator<Item = &Pass> {
    passes.iter().filter(|pass| pass.id.starts_with("scatter"))
}

/// Tiles that are worked through with discoloration, of those with skin.
fn share_discoloured(passes: &[Pass]) -> f64 {
    let tiles = |id: &str| passes.iter().find(|pass| pass.id == id).map_or(0, |pass| pass.tiles);
    f64::from(tiles("discolor")) / f64::from(tiles("scatter").max(1))
}

/// A figure of a frame of each view, in turns, after one that warms up.
fn rounds(
    views: &mut [Box<dyn Replay>],
    repeat: usize,
    figure: impl Fn(&[Pass]) -> f64,
) -> Result<Vec<Vec<f64>>, MeasureError> {
    let mut round =
        || views.iter_mut().map(|view| frame(view.as_mut()).map(|passes| figure(&passes))).collect();
    let rounds: Result<Vec<Vec<f64>>, MeasureError> = (0..=repeat).map(|_| round()).collect();
    rounds.map(|rounds| rounds.into_iter().skip(1).collect())
}

fn frame(view: &mut dyn Replay) -> Result<Vec<Pass>, MeasureError> {
    match (view.shoot(&Shot::default()), view.failure()) {
        (Some((frame, _)), _) => Ok(frame.passes),
        (None, Some(error)) => Err(MeasureError::Render(error.clone())),
        (None, None) => Err(MeasureError::Rejected("the engine has no picture".into())),
    }
}

/// The bust with so many cuts in view.
fn view(cuts: usize, discoloration: bool, studio: &dyn Studio) -> Result<Box<dyn Replay>, MeasureError> {
    let scene = SceneRef::Builtin("bust".into());
    let loaded = assets::open(&scene, Path::new(""), &CacheOptions::off()).map_err(OpenError::Asset)?;
    let set = WoundEvent::Set([("discoloration".into(), Value::Switch(discoloration))].into());
    let events = std::iter::once(set).chain(grid());
    let recording = Recording {
        scene,
        scene_hash: loaded.scene_hash,
        mesh_hash: loaded.mesh_hash,
        viewport: VIEWPORT,
        seed: 1,
        events: (0..).zip(events).map(|(key, event)| Keyed { key, event }).collect(),
    };
    let options = Options { pictures: true, ..Options::default() };
    let mut replay = replay::open(&WoundEvent::wrap(recording), loaded, options, Some(studio))?;
    let mut left = cuts;
    while left > 0 {
        match replay.step() {
            Some(event) => left -= usize::from(event.cut && event.outcome == Outcome::Applied),
            None => return Err(MeasureError::Rejected(format!("{left} of {cuts} cuts could not be made"))),
        }
    }
    // The switch stands at the beginning: without a cut nothing has been run yet.
    if cuts == 0 {
        replay.step();
    }
    Ok(replay)
}

/// Short cuts on the face, at the pixels of a grid whose rows are shifted, one beside the other in an order that leaves room around each.
fn grid() -> impl Iterator<Item = WoundEvent> {
    let place = |i: u32| [f64::from(i * 7 % 10), f64::from(i * 3 % 7)];
    (0..70).map(place).map(|[column, row]| {
        let [x, y] = [540.0 + 19.0 * column + 5.0 * (row % 2.0), 190.0 + 42.0 * row];
        WoundEvent::Cut { from: Pick::Pixel([x, y]), to: Pick::Pixel([x + 11.0, y + 21.0]) }
    })
}

impl Frames {
    /// The tests for people.
    pub fn tables(&self) -> [Table; 2] {
        let percent = |share: f64| format!("{:+.1} %", share * 100.0);
        let first = FRAMES[0].1;
        let frames = self.frames.iter().map(|f| {
            let thesis = percent(f.thesis_ms / first - 1.0);
            vec![f.cuts.to_string(), f.ms.text(3), percent(f.more), format!("{:.3}", f.thesis_ms), thesis]
        });
        let scattering = self.scattering.iter().map(|s| {
            let share = format!("{:.1} %", s.discoloured * 100.0);
            let ms = [s.plain_ms.text(3), s.localized_ms.text(3)];
            let [plain, localized] = ms;
            vec![s.cuts.to_string(), share, plain, localized, percent(s.more), percent(s.thesis_more)]
        });
        let of = |what: &str| {
            format!("{what}: median ± half the quartile range of {} frames taken in turns", self.repeat)
        };
        [
            table(&of("Table 6.3, cuts in view"), &["cuts", "frame ms", "more", "thesis ms", "more"], frames),
            table(
                &of("Figure 6.7, local discoloration"),
                &["cuts", "tiles discoloured", "plain ms", "localized ms", "more", "thesis"],
                scattering,
            ),
        ]
    }
}
