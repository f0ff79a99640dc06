//! The script: a recording as people write it, in JSON, without hashes.
//!
//! Unknown fields are errors, and an error says at which line, column and field. Which engine the events are for is read first.

use std::fmt;
use std::marker::PhantomData;

use schemars::generate::SchemaSettings;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{DeserializeOwned, Error, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};
use serde_json::Value;

use super::any::{ForEngine, for_engine};
use super::rules::{self, MAX_SIDE, Names, VIEWPORT};
use super::{AnyRecording, ENGINES, Keyed, Recorded, Recording, SceneRef, ScriptError};
use crate::engine::Event;
use crate::report::quoted;

const VERSION: u64 = 1;

/// A script that was read: a recording that lacks its hashes.
#[derive(Clone, Debug, PartialEq)]
pub struct Script(AnyRecording);

impl Script {
    /// Reads a script.
    pub fn parse(text: &[u8]) -> Result<Self, ScriptError> {
        let text = text.strip_prefix(b"\xef\xbb\xbf").unwrap_or(text);
        let Peek { engine, .. } = parse(text)?;
        let unknown = || ScriptError { at: None, field: "engine".into(), message: "no such engine".into() };
        for_engine(&engine.0, Parse(text)).unwrap_or_else(|| Err(unknown())).map(Self)
    }

    /// A recording as a script, without its hashes.
    pub fn of(recording: &AnyRecording) -> Self {
        let mut recording = recording.clone();
        recording.set_hashes([[0; 32]; 2]);
        Self(recording)
    }

    /// The recording, with the hashes that the scene and its mesh are found to have.
    pub fn pack<X>(
        self,
        hashes: impl FnOnce(&SceneRef) -> Result<([u8; 32], [u8; 32]), X>,
    ) -> Result<AnyRecording, X> {
        let Self(mut recording) = self;
        let (scene, mesh) = hashes(recording.scene())?;
        recording.set_hashes([scene, mesh]);
        Ok(recording)
    }

    /// The recording, its hashes zero.
    pub fn unhashed(&self) -> &AnyRecording {
        &self.0
    }

    /// The same, given away.
    pub fn into_unhashed(self) -> AnyRecording {
        self.0
    }

    /// Says where the scene is.
    pub fn set_scene(&mut self, scene: SceneRef) {
        self.0.set_scene(scene);
    }
}

/// The schema of scripts, for all engines.
pub fn script_schema() -> Schema {
    let mut generator = SchemaSettings::draft2020_12().into_generator();
    let each = |name| for_engine(name, Describe(&mut generator));
    let documents: Vec<Schema> = ENGINES.iter().copied().filter_map(each).collect();
    let mut schema = json_schema!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "lancet script", "description": "What was done to a scene, event by event.",
        "anyOf": documents,
    });
    schema.insert("$defs".into(), generator.take_definitions(true).into());
    schema
}

struct Describe<'g>(&'g mut SchemaGenerator);

impl ForEngine for Describe<'_> {
    type Output = Schema;

    fn run<E: Recorded>(self) -> Schema {
        self.0.subschema_for::<Document<E>>()
    }
}

/// What is looked at first: the version, then the engine.
#[derive(Deserialize)]
struct Peek {
    #[serde(rename = "version")]
    _version: Version,
    #[serde(default)]
    engine: Engine,
}

/// A script as it stands.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, bound = "E: Event")]
struct Document<E: Event> {
    #[serde(rename = "version")]
    _version: Version,
    /// Which engine the events are for.
    #[serde(default, rename = "engine")]
    _engine: Engine,
    /// What it is done to.
    scene: SceneRef,
    #[serde(default)]
    viewport: Viewport,
    /// What all randomness comes from, together with the events' keys.
    #[serde(default)]
    seed: u64,
    events: Events<E>,
    /// The events' keys, where they are not their indices.
    #[serde(default)]
    keys: Option<Vec<u32>>,
}

fn parse<T: DeserializeOwned>(text: &[u8]) -> Result<T, ScriptError> {
    let mut json = serde_json::Deserializer::from_slice(text);
    let value = serde_path_to_error::deserialize(&mut json)
        .map_err(|error| plainly(located(&error.path().to_string(), error.inner()), text))?;
    json.end().map_err(|error| located("", &error))?;
    Ok(value)
}

/// serde_json appends the place to its message, and says 0 where it knows none. Ours that begin with `[` go on with the path.
fn located(path: &str, error: &serde_json::Error) -> ScriptError {
    let (line, column) = (error.line(), error.column());
    let text = error.to_string();
    let message = text.strip_suffix(&format!(" at line {line} column {column}")).unwrap_or(&text);
    // A path that ends in the middle of something ends in a question mark.
    let path = path.trim_end_matches(['?', '.']);
    let (field, message) = match message.split_once(": ") {
        Some((below, message)) if below.starts_with('[') => (format!("{path}{below}"), message),
        _ => (path.to_owned(), message),
    };
    ScriptError { at: (line > 0).then_some((line, column)), field, message: message.to_owned() }
}

/// What the parser says of JSON that is sound, where it meets more or less than one key, or more elements than it asked for.
const BESIDE_THE_POINT: [&str; 3] = ["expected value", "trailing comma", "trailing characters"];

/// Says what is wrong where the parser says something that is true of broken JSON alone.
fn plainly(error: ScriptError, text: &[u8]) -> ScriptError {
    let sound = BESIDE_THE_POINT.contains(&error.message.as_str()).then(|| serde_json::from_slice(text).ok());
    let root: Option<Value> = sound.flatten();
    let message = match root.as_ref().and_then(|root| find(root, &error.field)) {
        Some(Value::Object(keys)) if keys.is_empty() => "one key says what it is, and here is none".into(),
        Some(Value::Object(keys)) if keys.len() > 1 => {
            let names: Vec<String> = keys.keys().map(quoted).collect();
            format!("one key says what it is, and here are {}", names.join(" and "))
        }
        Some(Value::Array(elements)) => format!("{} elements are too many", elements.len()),
        _ => error.message,
    };
    ScriptError { message, ..error }
}

/// The value at a path such as `scene.inline.faces[0]`.
fn find<'v>(root: &'v Value, path: &str) -> Option<&'v Value> {
    let steps = path.split(['.', '[']).filter(|step| !step.is_empty());
    steps.into_iter().try_fold(root, |value, step| match step.strip_suffix(']') {
        Some(index) => value.get(index.parse::<usize>().ok()?),
        None => value.get(step),
    })
}

struct Parse<'a>(&'a [u8]);

impl ForEngine for Parse<'_> {
    type Output = Result<AnyRecording, ScriptError>;

    fn run<E: Recorded>(self) -> Self::Output {
        let Document::<E> { scene, viewport, seed, events, keys, .. } = parse(self.0)?;
        let events = keyed(events.0, keys)?;
        let (scene_hash, mesh_hash) = ([0; 32], [0; 32]);
        Ok(E::wrap(Recording { scene, scene_hash, mesh_hash, viewport: viewport.0, seed, events }))
    }
}

fn keyed<E>(events: Vec<E>, keys: Option<Vec<u32>>) -> Result<Vec<Keyed<E>>, ScriptError> {
    let keys = keys.unwrap_or_else(|| (0..).take(events.len()).collect());
    if keys.len() != events.len() {
        let message = format!("{} keys for {} events", keys.len(), events.len());
        return Err(ScriptError { at: None, field: "keys".into(), message });
    }
    Ok(keys.into_iter().zip(events).map(|(key, event)| Keyed { key, event }).collect())
}

struct Version;

impl<'de> Deserialize<'de> for Version {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        match u64::deserialize(from)? {
            VERSION => Ok(Self),
            other => Err(D::Error::custom(format_args!("version {other}; this program knows 1"))),
        }
    }
}

impl JsonSchema for Version {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Version".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "const": VERSION, "description": "Version of the script." })
    }
}

struct Engine(String);

impl Default for Engine {
    fn default() -> Self {
        Self(ENGINES[0].to_owned())
    }
}

impl<'de> Deserialize<'de> for Engine {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let name = String::deserialize(from)?;
        if ENGINES.contains(&name.as_str()) {
            return Ok(Self(name));
        }
        let (name, known) = (quoted(name), ENGINES.join(", "));
        Err(D::Error::custom(format_args!("there is no engine {name}; there is {known}")))
    }
}

impl JsonSchema for Engine {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Engine".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "enum": ENGINES, "default": ENGINES[0] })
    }
}

#[derive(Deserialize)]
#[serde(try_from = "[u32; 2]")]
struct Viewport([u32; 2]);

impl Default for Viewport {
    fn default() -> Self {
        Self(VIEWPORT)
    }
}

impl TryFrom<[u32; 2]> for Viewport {
    type Error = String;

    fn try_from(sides: [u32; 2]) -> Result<Self, String> {
        rules::viewport(sides).map(|()| Self(sides))
    }
}

impl JsonSchema for Viewport {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Viewport".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "type": "array", "items": { "type": "integer", "minimum": 1, "maximum": MAX_SIDE },
            "minItems": 2, "maxItems": 2, "default": Self::default().0,
            "description": "Width and height of the view, pixels.",
        })
    }
}

/// The events, looked at one by one as they are read, so that a complaint has its place in the text.
#[derive(JsonSchema)]
#[schemars(transparent)]
struct Events<E>(Vec<E>);

impl<'de, E: Event> Deserialize<'de> for Events<E> {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_seq(Each(PhantomData))
    }
}

struct Each<E>(PhantomData<E>);

impl<'de, E: Event> Visitor<'de> for Each<E> {
    type Value = Events<E>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a list of events")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Events<E>, A::Error> {
        let (mut names, mut events) = (Names::default(), Vec::new());
        while let Some(event) = list.next_element()? {
            names
                .admit(&event)
                .map_err(|what| A::Error::custom(format_args!("[{}].{what}", events.len())))?;
            events.push(event);
        }
        Ok(Events(events))
    }
}
