//! Where a picture is taken from, when not from where the recording looks.

use std::f64::consts::PI;

use super::args::Viewpoint;
use super::failure::Failure;
use crate::canvas::frame::Orbit;
use crate::replay::Replay;

/// What cannot be meant is refused before anything is replayed.
pub(super) fn require_possible(typed: Viewpoint) -> Result<(), Failure> {
    require("--azimuth", typed.azimuth, f64::is_finite, "a number")?;
    require("--zenith", typed.zenith, |z| (0.0..=PI).contains(&z), "between 0 and π")?;
    require("--distance", typed.distance, |d| d.is_finite() && d > 0.0, "a positive number")
}

fn require(flag: &str, typed: Option<f64>, is: impl Fn(f64) -> bool, what: &str) -> Result<(), Failure> {
    match typed.filter(|value| !is(*value)) {
        Some(value) => Err(Failure::new(format_args!("{flag}: {value} is not {what}"))),
        None => Ok(()),
    }
}

/// Where to look from; none where nothing was typed. What was not typed is as the recording has it.
pub(super) fn of(typed: Viewpoint, replay: &dyn Replay) -> Result<Option<Orbit>, Failure> {
    let Viewpoint { azimuth, zenith, distance } = typed;
    if [azimuth, zenith, distance].iter().all(Option::is_none) {
        return Ok(None);
    }
    let now = replay
        .orbit()
        .ok_or_else(|| Failure::new("this engine has no camera to look from elsewhere with"))?;
    Ok(Some(Orbit {
        azimuth: azimuth.unwrap_or(now.azimuth),
        zenith: zenith.unwrap_or(now.zenith),
        distance: distance.unwrap_or(now.distance),
    }))
}
