//! Which values a scene may hold, field by field.
//!
//! Within them no formula of the renderers divides by zero, overflows, or asks for more memory than there is.

use std::f64::consts::PI;
use std::fmt;

use super::SceneSettings;
use crate::assets::error::{Fault, FaultKind, Place};
use crate::canvas::look::{Ambient, Fbm, Look, Scattering, Skin, Spotlight, Wound};

/// More lights than this are a mistake; each has a shadow map of its own.
const MOST_LIGHTS: usize = 64;
/// More than any sensible intensity, distance or frequency, and far from overflowing f32.
const LARGE: f64 = 1e6;
/// As far as a light may aim, model units: as large as a mesh's coordinates may be. Squares of it are finite.
const FARTHEST: f64 = 1e50;
/// As far as a light may stand, in radii of the model: from farther away a shadow map's depths, as f32, have no digits left for it.
const FARTHEST_LIGHT: f64 = 1e3;

/// What a number must be.
#[derive(Clone, Copy)]
enum Rule {
    Finite,
    /// Both ends are allowed.
    Between(f64, f64),
    /// The lower end is not allowed, the upper is.
    Above(f64, f64),
    /// Both ends are allowed, even numbers are not.
    Odd(f64, f64),
}

use Rule::{Above, Between, Finite, Odd};

/// A share, or a channel of a colour in sRGB.
const UNIT: Rule = Between(0.0, 1.0);
const POSITIVE: Rule = Between(0.0, LARGE);

impl Rule {
    fn holds(self, v: f64) -> bool {
        match self {
            Finite => v.is_finite(),
            Between(low, high) => v >= low && v <= high,
            Above(low, high) => v > low && v <= high,
            Odd(low, high) => v >= low && v <= high && v % 2.0 == 1.0,
        }
    }
}

impl fmt::Display for Rule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Finite => write!(f, "must be finite"),
            Between(low, high) => write!(f, "must be between {low} and {high}"),
            Above(low, high) => write!(f, "must be more than {low}, and at most {high}"),
            Odd(low, high) => write!(f, "must be an odd number between {low} and {high}"),
        }
    }
}

fn require(field: &str, value: impl Into<f64>, rule: Rule) -> Result<(), Fault> {
    let value = value.into();
    if rule.holds(value) { Ok(()) } else { Err(refuse(field, format!("{value} {rule}"))) }
}

fn require_all<V: Into<f64>>(
    field: &str,
    values: impl IntoIterator<Item = V>,
    rule: Rule,
) -> Result<(), Fault> {
    values.into_iter().try_for_each(|value| require(field, value, rule))
}

fn refuse(field: &str, detail: String) -> Fault {
    Fault::new(Place::Field(field.into()), FaultKind::Number, detail)
}

impl SceneSettings {
    /// Refuses the first value that is out of its range, with its field.
    pub(super) fn validate(&self) -> Result<(), Fault> {
        require("unit_cm", self.unit_cm, Between(1e-9, 1e9))?;
        require("snap_px", self.snap_px, Between(0.0, 1000.0))?;
        require("fov_y", self.fov_y, Between(1e-3, 3.0))?;
        require("azimuth", self.azimuth, Finite)?;
        require("zenith", self.zenith, Between(0.0, PI))?;
        require_all("target", self.target.into_iter().flatten(), Finite)?;
        require_all("distance", self.distance, Above(0.0, f64::MAX))?;
        validate_look(&self.look)
    }
}

fn validate_look(look: &Look) -> Result<(), Fault> {
    let lights = look.lights.as_deref().unwrap_or_default();
    if lights.len() > MOST_LIGHTS {
        return Err(refuse("lights", format!("{} lights are more than {MOST_LIGHTS}", lights.len())));
    }
    for (i, light) in lights.iter().enumerate() {
        validate_light(light, |field| format!("lights[{i}].{field}"))?;
    }
    validate_ambient(&look.ambient)?;
    require("shadows.size", look.shadows.size, Between(16.0, 8192.0))?;
    require("shadows.filter", look.shadows.filter, Between(1.0, 9.0))?;
    validate_skin(&look.skin)?;
    validate_scattering(&look.scattering)?;
    validate_wound(&look.wound)?;
    require_all("background", look.background.0, UNIT)
}

fn validate_light(light: &Spotlight, name: impl Fn(&str) -> String) -> Result<(), Fault> {
    require(&name("azimuth"), light.azimuth, Finite)?;
    require(&name("zenith"), light.zenith, Between(0.0, PI))?;
    require(&name("distance"), light.distance, Above(1.0, FARTHEST_LIGHT))?;
    require_all(&name("target"), light.target.into_iter().flatten(), Between(-FARTHEST, FARTHEST))?;
    require_all(&name("color"), light.color, POSITIVE)?;
    // A cone of half a turn has no plane to be projected onto.
    require(&name("cone"), light.cone, Between(1e-3, 1.5))?;
    require(&name("softness"), light.softness, UNIT)
}

fn validate_ambient(ambient: &Ambient) -> Result<(), Fault> {
    require("ambient.intensity", ambient.intensity, POSITIVE)?;
    require_all("ambient.irradiance", ambient.irradiance.into_iter().flatten(), Between(-LARGE, LARGE))
}

fn validate_skin(skin: &Skin) -> Result<(), Fault> {
    require_all("skin.albedo", skin.albedo, UNIT)?;
    require("skin.intensity", skin.intensity, UNIT)?;
    require("skin.roughness", skin.roughness, UNIT)?;
    require("skin.specular", skin.specular, POSITIVE)?;
    require("skin.bumpiness", skin.bumpiness, POSITIVE)?;
    require("skin.reflectance", skin.reflectance, UNIT)
}

fn validate_scattering(scattering: &Scattering) -> Result<(), Fault> {
    require("scattering.width_cm", scattering.width_cm, Above(0.0, 100.0))?;
    require_all("scattering.strength", scattering.strength, UNIT)?;
    require_all("scattering.falloff", scattering.falloff, UNIT)?;
    require("scattering.samples", scattering.samples, Odd(3.0, 41.0))?;
    require("scattering.translucency", scattering.translucency, UNIT)
}

fn validate_wound(wound: &Wound) -> Result<(), Fault> {
    for (field, colour) in
        [("wound.inner", wound.inner), ("wound.dark", wound.dark), ("wound.light", wound.light)]
    {
        require_all(field, colour, UNIT)?;
    }
    require("wound.edge", wound.edge[0], Between(0.0, 1e4))?;
    require("wound.edge", wound.edge[1], Between(0.0, 1e3))?;
    validate_fbm(&wound.noise, |field| format!("wound.noise.{field}"))?;
    validate_fbm(&wound.blotches, |field| format!("wound.blotches.{field}"))?;
    require_all("wound.discolor", wound.discolor.into_iter().flatten(), UNIT)?;
    if let Some([least, most]) = wound.discolor.into_iter().find(|[least, most]| least > most) {
        return Err(refuse("wound.discolor", format!("{least} to {most} is no range")));
    }
    require_all("wound.tissue", wound.tissue.into_iter().flatten(), UNIT)
}

/// Sixteen octaves within these bounds stay finite in f32.
fn validate_fbm(noise: &Fbm, name: impl Fn(&str) -> String) -> Result<(), Fault> {
    require(&name("octaves"), noise.octaves, Between(1.0, 16.0))?;
    require(&name("frequency"), noise.frequency, Between(0.0, 1e4))?;
    require(&name("amplitude"), noise.amplitude, Between(0.0, 1e3))?;
    require(&name("lacunarity"), noise.lacunarity, Between(0.0, 8.0))?;
    require(&name("persistence"), noise.persistence, Between(0.0, 8.0))
}
