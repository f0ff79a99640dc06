//! `lancet render`: a frame of a scene.

use std::io::Write;
use std::path::Path;

use schemars::JsonSchema;
use serde::Serialize;
use serde_json::json;

use super::args::Render;
use super::failure::Failure;
use super::{Console, Done, Status, json, pixels, show};
use crate::canvas::Adapter;
use crate::recording::{SceneRef, Script, ScriptError};
use crate::replay::{Case, Options, Shot};
use crate::report::Pass;

/// The answer in JSON.
#[derive(Serialize, JsonSchema)]
struct Answer<'a> {
    scene: &'a str,
    size: [u32; 2],
    adapter: &'a Adapter,
    /// blake3 of the picture.
    digest: String,
    passes: &'a [Pass],
}

pub(super) fn run(typed: &Render, console: &mut Console<'_>) -> Done {
    let script = Script::parse(script(typed)?.as_bytes()).map_err(|error| as_typed(&error))?;
    let case = Case::new(script.into_unhashed(), Path::new(""))?;
    let studio = pixels::studio(typed.pixels.renderer, console)?;
    let options = Options { pictures: true, everything: typed.pixels.no_skip, ..Options::default() };
    let mut replay = case.replay(&case.recording, options, Some(studio.as_ref()))?;
    replay.finish();
    let (frame, view) = replay.shoot(&Shot::default()).ok_or_else(|| pixels::missing(replay.as_ref()))?;
    pixels::write(&frame.image, &typed.output)?;
    let answer = Answer {
        scene: &typed.scene,
        size: view.size,
        adapter: studio.adapter(),
        digest: frame.image.digest(),
        passes: &frame.passes,
    };
    json::write(&answer, typed.json.to.as_ref(), console)?;
    let to = json::text([&typed.json.to], console);
    writeln!(to, "{}", studio.adapter())?;
    show::passes(&frame.passes, to)?;
    Ok(Status::Verified)
}

/// What is wrong, by the option that it was typed after.
fn as_typed(error: &ScriptError) -> Failure {
    let option = match error.field.as_str() {
        "viewport" => "--size",
        "events[0].camera.azimuth" => "--azimuth",
        "events[0].camera.zenith" => "--zenith",
        "events[0].camera.distance" => "--distance",
        field if field.starts_with("events[1]") => "--set",
        field => field,
    };
    Failure::new(format_args!("{option}: {}", error.message))
}

/// The scene with its camera and settings, as a script.
fn script(typed: &Render) -> Result<String, Failure> {
    let angles = [("azimuth", typed.azimuth), ("zenith", typed.zenith), ("distance", typed.distance)];
    let camera = angles.into_iter().filter_map(|(name, value)| Some((name.to_owned(), json!(value?))));
    let settings = typed.set.iter().map(|setting| (setting.name.clone(), setting.value.clone()));
    let [camera, settings] = [camera.collect(), settings.collect::<serde_json::Map<_, _>>()];
    let script = json!({
        "version": 1, "scene": SceneRef::typed(&typed.scene), "viewport": typed.size.0,
        "events": [{ "camera": serde_json::Value::Object(camera) }, { "set": settings }],
    });
    serde_json::to_string(&script).map_err(Failure::new)
}
