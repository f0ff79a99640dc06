//! Frames of the bust for subjects that want a picture as it is in use.

use std::collections::BTreeMap;
use std::path::Path;

use crate::assets::{self, CacheOptions};
use crate::canvas::Studio;
use crate::canvas::image::Image;
use crate::canvas::look::Background;
use crate::engine::wound::{CameraChange, Value, WoundEvent};
use crate::measure::MeasureError;
use crate::recording::{Keyed, Recorded, Recording, SceneRef};
use crate::replay::{self, OpenError, Options, Shot};

/// What a frame is of.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pose {
    /// Width and height, pixels.
    pub(super) size: [u32; 2],
    /// Eye to the middle of the head, cm.
    pub(super) distance: f64,
    /// The parts that are off, by their settings' names.
    pub(super) off: &'static [&'static str],
}

/// A frame of the bust, and the colour behind it.
pub(super) fn bust(pose: Pose, studio: &dyn Studio) -> Result<(Image, [u8; 4]), MeasureError> {
    let scene = SceneRef::Builtin("bust".into());
    let loaded = assets::open(&scene, Path::new(""), &CacheOptions::off()).map_err(OpenError::Asset)?;
    let off: BTreeMap<String, Value> =
        pose.off.iter().map(|name| ((*name).into(), Value::Switch(false))).collect();
    let camera = CameraChange { azimuth: Some(0.4), zenith: Some(1.45), distance: Some(pose.distance) };
    let events = [WoundEvent::Camera(camera), WoundEvent::Set(off)];
    let recording = Recording {
        scene,
        scene_hash: loaded.scene_hash,
        mesh_hash: loaded.mesh_hash,
        viewport: pose.size,
        seed: 1,
        events: (0..).zip(events).map(|(key, event)| Keyed { key, event }).collect(),
    };
    let options = Options { pictures: true, ..Options::default() };
    let mut replay = replay::open(&WoundEvent::wrap(recording), loaded, options, Some(studio))?;
    replay.finish();
    match (replay.shoot(&Shot::default()), replay.failure()) {
        (Some((frame, _)), _) => Ok((frame.image, Background::default().bytes())),
        (None, Some(error)) => Err(MeasureError::Render(error.clone())),
        (None, None) => Err(MeasureError::Rejected("the engine has no picture".into())),
    }
}
