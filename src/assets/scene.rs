//! A scene in JSON: a mesh, and how it is looked at.
//!
//! ```json
//! { "mesh": "head.obj", "unit_cm": 1.0, "snap_px": 0.0, "fov_y": 0.6,
//!   "target": [0, 0, 0], "azimuth": 0, "zenith": 1.57, "distance": 10 }
//! ```
//!
//! All but `mesh` may be left out. Unknown fields are errors, and so is a value out of its range.

use std::f64::consts::{FRAC_PI_2, PI};

use serde::{Deserialize, Serialize};

use super::error::{Fault, FaultKind, Place};

/// A scene file as it is written.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SceneFile {
    /// A mesh file, relative to the scene, or `builtin:NAME`.
    pub mesh: String,
    /// How many centimetres a model unit is.
    #[serde(default = "one")]
    pub unit_cm: f64,
    /// A pick snaps to a node within so many pixels.
    #[serde(default)]
    pub snap_px: f64,
    /// Vertical field of view, in radians.
    #[serde(default = "default_fov")]
    pub fov_y: f64,
    /// What the camera looks at; without it the centre of the bounding box.
    #[serde(default)]
    pub target: Option<[f64; 3]>,
    /// The camera's azimuth, in radians.
    #[serde(default)]
    pub azimuth: f64,
    /// The camera's angle from the upward axis, in radians.
    #[serde(default = "default_zenith")]
    pub zenith: f64,
    /// The camera's distance from its target, in model units; without it, far enough to see all.
    #[serde(default)]
    pub distance: Option<f64>,
}

fn one() -> f64 {
    1.0
}

fn default_fov() -> f64 {
    0.6
}

fn default_zenith() -> f64 {
    FRAC_PI_2
}

/// What a scene says besides its mesh.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
pub struct SceneSettings {
    /// How many centimetres a model unit is.
    pub unit_cm: f64,
    /// A pick snaps to a node within so many pixels.
    pub snap_px: f64,
    /// Vertical field of view, in radians.
    pub fov_y: f64,
    /// What the camera looks at; without it the centre of the bounding box.
    pub target: Option<[f64; 3]>,
    /// The camera's azimuth, in radians.
    pub azimuth: f64,
    /// The camera's angle from the upward axis, in radians.
    pub zenith: f64,
    /// The camera's distance from its target, in model units; without it, far enough to see all.
    pub distance: Option<f64>,
}

impl Default for SceneSettings {
    fn default() -> Self {
        Self {
            unit_cm: one(),
            snap_px: 0.0,
            fov_y: default_fov(),
            target: None,
            azimuth: 0.0,
            zenith: default_zenith(),
            distance: None,
        }
    }
}

impl SceneSettings {
    /// blake3 over every value in order: what is optional after a 0 or 1, and −0 as 0.
    pub(super) fn hash(&self) -> [u8; 32] {
        let mut hasher = blake3::Hasher::new();
        let mut put = |values: &[f64]| {
            hasher.update(&[values.len() as u8]);
            values.iter().for_each(|v| {
                hasher.update(&(v + 0.0).to_le_bytes());
            });
        };
        put(&[self.unit_cm, self.snap_px, self.fov_y, self.azimuth, self.zenith]);
        put(self.target.as_ref().map_or(&[], |t| t.as_slice()));
        put(self.distance.as_slice());
        *hasher.finalize().as_bytes()
    }

    fn validate(&self) -> Result<(), Fault> {
        let within = |low: f64, high: f64| move |v: f64| v >= low && v <= high;
        let finite = |v: f64| v.is_finite();
        require("unit_cm", self.unit_cm, "must be between 1e-9 and 1e9", within(1e-9, 1e9))?;
        require("snap_px", self.snap_px, "must be between 0 and 1000", within(0.0, 1000.0))?;
        require("fov_y", self.fov_y, "must be between 0.001 and 3 radians", within(1e-3, 3.0))?;
        require("azimuth", self.azimuth, "must be finite", finite)?;
        require("zenith", self.zenith, "must be between 0 and π", within(0.0, PI))?;
        for &coordinate in self.target.iter().flatten() {
            require("target", coordinate, "must be finite", finite)?;
        }
        let distance = self.distance.unwrap_or(1.0);
        require("distance", distance, "must be more than 0, and finite", |v| v > 0.0 && v.is_finite())
    }
}

fn require(field: &str, value: f64, rule: &str, holds: impl Fn(f64) -> bool) -> Result<(), Fault> {
    if holds(value) {
        return Ok(());
    }
    let detail = format!("{value} {rule}");
    Err(Fault::new(Place::Field(field.into()), FaultKind::Number, detail))
}

/// Reads a scene file: its mesh as written, and its settings.
pub(super) fn parse(bytes: &[u8]) -> Result<(String, SceneSettings), Fault> {
    let file: SceneFile = serde_json::from_slice(bytes)
        .map_err(|error| Fault::line(error.line() as u64, FaultKind::Syntax, error.to_string()))?;
    let SceneFile { mesh, unit_cm, snap_px, fov_y, target, azimuth, zenith, distance } = file;
    let settings = SceneSettings { unit_cm, snap_px, fov_y, target, azimuth, zenith, distance };
    settings.validate()?;
    Ok((mesh, settings))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn everything_but_the_mesh_may_be_left_out() {
        let (mesh, settings) = parse(br#"{"mesh": "head.obj"}"#).expect("valid");
        assert_eq!((mesh.as_str(), settings), ("head.obj", SceneSettings::default()));
        let text = br#"{"mesh": "builtin:bust", "unit_cm": 2.5, "target": [1, 2, 3], "distance": 9}"#;
        let (_, settings) = parse(text).expect("valid");
        assert_eq!(
            (settings.unit_cm, settings.target, settings.distance),
            (2.5, Some([1.0, 2.0, 3.0]), Some(9.0))
        );
    }

    #[test]
    fn errors_name_the_line_or_the_field() {
        let place = |text: &str| parse(text.as_bytes()).expect_err("invalid").place;
        assert_eq!(place("{\n\"mesh\": \"a.obj\",\n\"colour\": 1}"), Place::Line(3));
        assert_eq!(place("{\"mesh\":"), Place::Line(1));
        for (field, value) in
            [("unit_cm", "0"), ("snap_px", "-1"), ("fov_y", "3.5"), ("zenith", "-0.1"), ("distance", "0")]
        {
            let text = format!("{{\"mesh\": \"a.obj\", \"{field}\": {value}}}");
            assert_eq!(place(&text), Place::Field(field.into()));
        }
    }

    #[test]
    fn the_hash_tells_settings_apart() {
        let base = SceneSettings::default();
        let others = [
            SceneSettings { unit_cm: 2.0, ..base.clone() },
            SceneSettings { distance: Some(1.0), ..base.clone() },
            SceneSettings { target: Some([0.0; 3]), ..base.clone() },
        ];
        assert!(others.iter().all(|o| o.hash() != base.hash()));
        assert_eq!(SceneSettings { azimuth: -0.0, ..base.clone() }.hash(), base.hash());
    }
}
