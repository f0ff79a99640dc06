//! A scene in JSON: a mesh, its maps, and how it is looked at and lit.
//!
//! ```json
//! { "mesh": "head.obj", "unit_cm": 1.0, "snap_px": 0.0, "fov_y": 0.6,
//!   "target": [0, 0, 0], "azimuth": 0, "zenith": 1.57, "distance": 10,
//!   "maps": { "color": "color.png", "scattering": "strength.png", "normal": "normal.png",
//!             "occlusion": "occlusion.png", "specular": "specular.dds", "irradiance": "sky.jpg" },
//!   "lights": [ { "azimuth": 0.7, "zenith": 1.1, "distance": 4, "color": [1.25, 1.18, 1.08] } ],
//!   "ambient": { "intensity": 0.35 }, "shadows": { "size": 1024, "filter": 3 },
//!   "skin": { "roughness": 0.35 }, "scattering": { "width_cm": 0.6 }, "wound": { "inner": [0.42, 0.05, 0.05] },
//!   "background": [0.13, 0.14, 0.16], "switches": { "shadows": true } }
//! ```
//!
//! All but `mesh` may be left out, and so may every field of every part; the parts from `lights` to `switches` are those of
//! [`Look`]. Unknown fields are errors, and so is a value out of its range (`ranges` holds them).
//!
//! The hash of a scene (`identity`) covers what it says and every byte of its maps. What is at its default does not count, so that
//! a scene that says nothing about its look has the hash that it had before there were looks.

mod identity;
mod ranges;
#[cfg(test)]
mod tests;

use std::f64::consts::FRAC_PI_2;

pub(super) use identity::MapHash;
use serde::de::IgnoredAny;
use serde::{Deserialize, Serialize};

use super::error::{Fault, FaultKind};
use crate::canvas::look::{Ambient, Background, Look, Scattering, Shadows, Skin, Spotlight, Switches, Wound};

/// Whether some JSON means to be a scene rather than a script, which has a scene and no mesh beside it.
pub fn is_description(bytes: &[u8]) -> bool {
    #[derive(Deserialize)]
    struct Fields {
        mesh: Option<IgnoredAny>,
        scene: Option<IgnoredAny>,
    }
    serde_json::from_slice(bytes).is_ok_and(|Fields { mesh, scene }| mesh.is_some() && scene.is_none())
}

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
    /// The images on the mesh. What is left out is the built-in mesh's own, else the skin's.
    #[serde(default)]
    pub maps: MapFiles,
    /// Spotlights; none given is three: key, fill and rim.
    #[serde(default)]
    pub lights: Option<Vec<Spotlight>>,
    /// Light from everywhere.
    #[serde(default)]
    pub ambient: Ambient,
    /// How shadows are looked up.
    #[serde(default)]
    pub shadows: Shadows,
    /// The skin.
    #[serde(default)]
    pub skin: Skin,
    /// How light scatters in it.
    #[serde(default)]
    pub scattering: Scattering,
    /// What a cut paints.
    #[serde(default)]
    pub wound: Wound,
    /// sRGB colour behind the model.
    #[serde(default)]
    pub background: Background,
    /// Which parts are on. `set` events change them.
    #[serde(default)]
    pub switches: Switches,
}

/// Images, as PNG, JPEG or DDS; paths are relative to the scene. How texels are read is told in [`crate::canvas::image`].
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct MapFiles {
    /// Albedo; its alpha is how far light scatters, in full where it has none.
    pub color: Option<String>,
    /// How far light scatters: its first channel stands in for the colour map's alpha. It has the colour map's size.
    pub scattering: Option<String>,
    /// Tangent-space normals.
    pub normal: Option<String>,
    /// Ambient occlusion, the first channel.
    pub occlusion: Option<String>,
    /// Specular intensity and roughness, the first and the second channel.
    pub specular: Option<String>,
    /// The surroundings as an equirectangular picture: it gives the ambient light's irradiance.
    pub irradiance: Option<String>,
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

/// What a scene says besides its mesh and maps.
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
    /// Light, skin and wounds.
    pub look: Look,
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
            look: Look::default(),
        }
    }
}

impl SceneFile {
    /// Reads a scene file; every value in it is within its range.
    pub fn read(bytes: &[u8]) -> Result<Self, Fault> {
        let file: Self = serde_json::from_slice(bytes)
            .map_err(|error| Fault::line(error.line() as u64, FaultKind::Syntax, error.to_string()))?;
        file.settings().validate()?;
        Ok(file)
    }

    /// What it says besides its mesh and maps.
    pub fn settings(&self) -> SceneSettings {
        self.clone().into_parts().1
    }

    /// Its mesh, its settings and its maps.
    fn into_parts(self) -> (String, SceneSettings, MapFiles) {
        let Self { mesh, unit_cm, snap_px, fov_y, target, azimuth, zenith, distance, maps, .. } = self;
        let Self { lights, ambient, shadows, skin, scattering, wound, background, switches, .. } = self;
        let look = Look { lights, ambient, shadows, skin, scattering, wound, background, switches };
        (mesh, SceneSettings { unit_cm, snap_px, fov_y, target, azimuth, zenith, distance, look }, maps)
    }
}

/// Reads a scene file: its mesh as written, its settings, and its maps as written.
pub(super) fn parse(bytes: &[u8]) -> Result<(String, SceneSettings, MapFiles), Fault> {
    SceneFile::read(bytes).map(SceneFile::into_parts)
}
