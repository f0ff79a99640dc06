//! What a recording was recorded on.
//!
//! A script says `"builtin:bust"`, or an object of one key: `{"mesh": "head.obj"}`. A file holds the same as a tagged value.

use std::borrow::Cow;
use std::fmt;
use std::path::{Component, Path, PathBuf};

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::value::MapAccessDeserializer;
use serde::de::{Error, MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::report::quoted;

const PREFIX: &str = "builtin:";
const EXPECTED: &str = "\"builtin:NAME\", {\"file\": …}, {\"mesh\": …} or {\"inline\": …}";

/// Where a scene comes from. Paths are relative to the recording.
// `remote` makes the derived forms functions of the type, so that the traits below can choose.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(remote = "Self", rename_all = "lowercase")]
pub enum SceneRef {
    /// `"builtin:bust"`: made by code.
    Builtin(String),
    /// `{"file": "scene.json"}`: a scene description.
    File(PathBuf),
    /// `{"mesh": "head.obj"}`: a mesh, everything else at its default.
    Mesh(PathBuf),
    /// `{"inline": {"nodes": …, "faces": …, "uv": …}}`: a mesh in the recording itself.
    Inline(InlineMesh),
}

/// A mesh written out in a script. Its nodes and faces keep their indices as ids.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct InlineMesh {
    /// Positions, in model units.
    pub nodes: Vec<[f64; 3]>,
    /// Triangles, counter-clockwise from outside.
    pub faces: Vec<[u32; 3]>,
    /// Texture coordinates by node; empty for none.
    #[serde(default)]
    pub uv: Vec<[f32; 2]>,
}

impl SceneRef {
    /// What `builtin:NAME` names.
    pub fn parse_builtin(text: &str) -> Option<Self> {
        let name = text.strip_prefix(PREFIX).filter(|name| !name.is_empty())?;
        Some(Self::Builtin(name.to_owned()))
    }

    /// What a person types for a scene: `builtin:NAME`, a scene description that ends in `.json`, or else a mesh.
    pub fn typed(text: &str) -> Self {
        let is_description = Path::new(text).extension().is_some_and(|end| end.eq_ignore_ascii_case("json"));
        let file = || if is_description { Self::File(text.into()) } else { Self::Mesh(text.into()) };
        Self::parse_builtin(text).unwrap_or_else(file)
    }

    /// The same scene, seen from another folder. Both folders are absolute; a scene that is no file stays as it is.
    #[must_use]
    pub fn moved(&self, from: &Path, to: &Path) -> Self {
        match self {
            Self::File(path) => Self::File(moved(path, from, to)),
            Self::Mesh(path) => Self::Mesh(moved(path, from, to)),
            Self::Builtin(_) | Self::Inline(_) => self.clone(),
        }
    }
}

impl fmt::Display for SceneRef {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Builtin(name) => write!(f, "{PREFIX}{name}"),
            Self::File(path) => write!(f, "scene {}", path.display()),
            Self::Mesh(path) => write!(f, "mesh {}", path.display()),
            Self::Inline(mesh) => {
                write!(f, "inline mesh of {} nodes, {} faces", mesh.nodes.len(), mesh.faces.len())
            }
        }
    }
}

/// A relative path, relative to another folder. Lexical: a symbolic link on the way is not followed.
fn moved(path: &Path, from: &Path, to: &Path) -> PathBuf {
    if path.is_absolute() || from == to {
        return path.to_owned();
    }
    let target = from.join(path);
    let (target, to) = (plain(&target), plain(to));
    let shared = target.iter().zip(&to).take_while(|(a, b)| a == b).count();
    let up = to.iter().skip(shared).map(|_| Component::ParentDir);
    up.chain(target.iter().skip(shared).copied()).map(|c| c.as_os_str()).collect()
}

/// The components of an absolute path without `.` and `..`.
fn plain(path: &Path) -> Vec<Component<'_>> {
    path.components().fold(Vec::new(), |mut plain, component| {
        match component {
            Component::CurDir => {}
            Component::ParentDir if matches!(plain.last(), Some(Component::Normal(_))) => {
                plain.pop();
            }
            other => plain.push(other),
        }
        plain
    })
}

impl Serialize for SceneRef {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Builtin(name) if to.is_human_readable() => to.collect_str(&format_args!("{PREFIX}{name}")),
            _ => Self::serialize(self, to),
        }
    }
}

impl<'de> Deserialize<'de> for SceneRef {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        if from.is_human_readable() { from.deserialize_any(InScript) } else { Self::deserialize(from) }
    }
}

struct InScript;

impl<'de> Visitor<'de> for InScript {
    type Value = SceneRef;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(EXPECTED)
    }

    fn visit_str<X: Error>(self, text: &str) -> Result<SceneRef, X> {
        SceneRef::parse_builtin(text)
            .ok_or_else(|| X::custom(format_args!("{} is no scene; expected {EXPECTED}", quoted(text))))
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<SceneRef, A::Error> {
        match SceneRef::deserialize(MapAccessDeserializer::new(map))? {
            SceneRef::Builtin(name) => {
                Err(A::Error::custom(format_args!("write \"{PREFIX}{name}\" for a built-in scene")))
            }
            scene => Ok(scene),
        }
    }
}

impl JsonSchema for SceneRef {
    fn schema_name() -> Cow<'static, str> {
        "SceneRef".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let inline = generator.subschema_for::<InlineMesh>();
        let keyed = |key: &str, schema: Schema, what: &str| {
            json_schema!({
                "type": "object", "description": what, "properties": { key: schema }, "required": [key],
                "additionalProperties": false,
            })
        };
        let path = || json_schema!({ "type": "string" });
        json_schema!({
            "description": "Where a scene comes from. Paths are relative to the recording.",
            "oneOf": [
                { "type": "string", "pattern": "^builtin:.+$", "description": "A scene that is made by code." },
                keyed("file", path(), "A scene description."),
                keyed("mesh", path(), "A mesh, everything else at its default."),
                keyed("inline", inline, "A mesh in the recording itself."),
            ],
        })
    }
}
