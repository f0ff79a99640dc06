//! The recorded inputs of the wound engine, as they stand in a script.

use std::collections::BTreeMap;
use std::fmt;

use schemars::JsonSchema;
use serde::de::{Error, MapAccess, Visitor};
use serde::{Deserialize, Serialize};

use super::settings;
use crate::canvas::frame::Orbit;
use crate::engine::{Control, Event, Input};
use crate::mesh::{EdgeId, FaceId, NodeId};
use crate::report::quoted;

/// How far a cut goes (Lam 2016, §6.3).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Mode {
    /// Form the line; paint it.
    Patch,
    /// And merge it into the mesh.
    Merge,
    /// And carve the incision.
    #[default]
    Carve,
}

impl Mode {
    const ALL: [Self; 3] = [Self::Patch, Self::Merge, Self::Carve];

    /// Its name, as in scripts.
    pub(super) fn name(self) -> &'static str {
        WoundEvent::MODES[self as usize]
    }

    fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|mode| mode.name() == name)
    }
}

/// A new view. What is left out stays as it is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CameraChange {
    /// Angle around the vertical axis, radians; 0 looks along −z.
    #[serde(default)]
    pub azimuth: Option<f64>,
    /// Angle from straight up, radians, 0 to π.
    #[serde(default)]
    pub zenith: Option<f64>,
    /// Eye to target, model units.
    #[serde(default)]
    pub distance: Option<f64>,
}

impl From<Orbit> for CameraChange {
    fn from(Orbit { azimuth, zenith, distance }: Orbit) -> Self {
        Self { azimuth: Some(azimuth), zenith: Some(zenith), distance: Some(distance) }
    }
}

/// Where a cut begins or ends.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Pick {
    /// The first surface point under a pixel position, from the top left.
    Pixel([f64; 2]),
    /// A node.
    Node(NodeId),
    /// A point on an edge: its id, and 0 to 1 from its first node to its second.
    Edge(EdgeId, f64),
    /// A point in a face: its id, and the weights of its second and third corner.
    Face(FaceId, f64, f64),
}

/// The value of a setting: `true`, `false` or a number in a script, tagged in a recording.
#[derive(Clone, Copy, Debug, PartialEq, JsonSchema)]
#[schemars(untagged)]
pub enum Value {
    /// On or off.
    Switch(bool),
    /// A number.
    Number(f64),
}

#[derive(Serialize, Deserialize)]
#[serde(untagged, expecting = "this is neither true, false nor a number")]
enum Plain {
    Switch(bool),
    Number(f64),
}

#[derive(Serialize, Deserialize)]
enum Tagged {
    Switch(bool),
    Number(f64),
}

impl Serialize for Value {
    fn serialize<S: serde::Serializer>(&self, s: S) -> Result<S::Ok, S::Error> {
        match (*self, s.is_human_readable()) {
            (Self::Switch(v), true) => Plain::Switch(v).serialize(s),
            (Self::Number(v), true) => Plain::Number(v).serialize(s),
            (Self::Switch(v), false) => Tagged::Switch(v).serialize(s),
            (Self::Number(v), false) => Tagged::Number(v).serialize(s),
        }
    }
}

impl<'de> Deserialize<'de> for Value {
    fn deserialize<D: serde::Deserializer<'de>>(d: D) -> Result<Self, D::Error> {
        if d.is_human_readable() {
            Plain::deserialize(d).map(|v| match v {
                Plain::Switch(v) => Self::Switch(v),
                Plain::Number(v) => Self::Number(v),
            })
        } else {
            Tagged::deserialize(d).map(|v| match v {
                Tagged::Switch(v) => Self::Switch(v),
                Tagged::Number(v) => Self::Number(v),
            })
        }
    }
}

/// Settings by name, none of them twice.
fn once_each<'de, D: serde::Deserializer<'de>>(d: D) -> Result<BTreeMap<String, Value>, D::Error> {
    struct OnceEach;

    impl<'de> Visitor<'de> for OnceEach {
        type Value = BTreeMap<String, Value>;

        fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            f.write_str("settings by name")
        }

        fn visit_map<M: MapAccess<'de>>(self, mut map: M) -> Result<Self::Value, M::Error> {
            let mut all = BTreeMap::new();
            while let Some((name, value)) = map.next_entry::<String, Value>()? {
                if all.contains_key(&name) {
                    return Err(M::Error::custom(format_args!("{} is set twice", quoted(&name))));
                }
                all.insert(name, value);
            }
            Ok(all)
        }
    }

    d.deserialize_map(OnceEach)
}

/// One recorded input of the wound engine.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum WoundEvent {
    /// Looks from elsewhere.
    Camera(CameraChange),
    /// Says how far the next cuts go.
    Mode(Mode),
    /// Clicks on a pixel position: two make a cut.
    Click([f64; 2]),
    /// Cuts between two picks.
    Cut {
        /// Where it begins.
        from: Pick,
        /// Where it ends.
        to: Pick,
    },
    /// Subdivides the face under a pixel position.
    Subdivide {
        /// Where.
        at: [f64; 2],
        /// Into how many faces: 3, 4 or 6.
        #[schemars(extend("enum" = [3, 4, 6]))]
        into: u8,
    },
    /// Takes the last applied edit back.
    Undo {},
    /// Does the last undone edit again.
    Redo {},
    /// Changes settings by name.
    Set(
        #[serde(deserialize_with = "once_each")]
        #[schemars(schema_with = "super::settings::schema")]
        BTreeMap<String, Value>,
    ),
    /// Digests everything and renders a frame.
    Checkpoint(String),
}

impl Event for WoundEvent {
    fn kind(&self) -> &'static str {
        match self {
            Self::Camera(_) => "camera",
            Self::Mode(_) => "mode",
            Self::Click(_) => "click",
            Self::Cut { .. } => "cut",
            Self::Subdivide { .. } => "subdivide",
            Self::Undo {} => "undo",
            Self::Redo {} => "redo",
            Self::Set(_) => "set",
            Self::Checkpoint(_) => "checkpoint",
        }
    }

    fn control(&self) -> Control<'_> {
        match self {
            Self::Undo {} => Control::Undo,
            Self::Redo {} => Control::Redo,
            Self::Checkpoint(name) => Control::Checkpoint(name),
            _ => Control::Step,
        }
    }

    const MODES: &'static [&'static str] = &["patch", "merge", "carve"];

    fn by_hand(input: &Input) -> Option<Self> {
        Some(match input {
            Input::Look(orbit) => Self::Camera((*orbit).into()),
            Input::Mode(name) => Self::Mode(Mode::named(name)?),
            Input::Point(at) => Self::Click(*at),
            Input::Undo => Self::Undo {},
            Input::Redo => Self::Redo {},
            Input::Checkpoint(name) => Self::Checkpoint(name.clone()),
            Input::Script(_) => return None,
        })
    }

    fn validate(&self) -> Result<(), String> {
        match self {
            Self::Camera(change) => validate_camera(change),
            Self::Click(at) => finite("click", at),
            Self::Cut { from, to } => validate_pick("from", from).and_then(|()| validate_pick("to", to)),
            Self::Subdivide { at, into: 3 | 4 | 6 } => finite("at", at),
            Self::Subdivide { into, .. } => Err(format!("into: {into} is not 3, 4 or 6")),
            Self::Set(values) => values.iter().try_for_each(|(name, value)| settings::validate(name, value)),
            Self::Mode(_) | Self::Undo {} | Self::Redo {} | Self::Checkpoint(_) => Ok(()),
        }
    }
}

fn finite(what: &str, values: &[f64]) -> Result<(), String> {
    match values.iter().find(|v| !v.is_finite()) {
        Some(v) => Err(format!("{what}: {v} is not a finite number")),
        None => Ok(()),
    }
}

fn within(what: &str, value: f64, low: f64, high: f64) -> Result<(), String> {
    if (low..=high).contains(&value) {
        Ok(())
    } else {
        Err(format!("{what}: {value} is not in [{low}, {high}]"))
    }
}

fn validate_camera(change: &CameraChange) -> Result<(), String> {
    finite("azimuth", change.azimuth.as_slice())?;
    change.zenith.map_or(Ok(()), |z| within("zenith", z, 0.0, std::f64::consts::PI))?;
    match change.distance {
        Some(d) if !(d.is_finite() && d > 0.0) => Err(format!("distance: {d} is not a positive number")),
        _ => Ok(()),
    }
}

fn validate_pick(what: &str, pick: &Pick) -> Result<(), String> {
    match *pick {
        Pick::Pixel(at) => finite(what, &at),
        Pick::Node(_) => Ok(()),
        Pick::Edge(_, t) => within(what, t, 0.0, 1.0),
        Pick::Face(_, u, v) => {
            within(what, u, 0.0, 1.0)?;
            within(what, v, 0.0, 1.0)?;
            within(&format!("{what}: the sum of the weights"), u + v, 0.0, 1.0)
        }
    }
}
