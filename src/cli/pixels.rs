//! Who makes the pixels that were asked for, and where pictures go.

use std::path::Path;

use super::args::{Map, Renderer};
use super::console::Console;
use super::failure::Failure;
use crate::assets;
use crate::canvas::image::{Image, MapId};
use crate::canvas::{Kind, Studio};
use crate::render::{self, Choice};
use crate::replay::Replay;

/// Opens the renderer that was typed. What `auto` came to is said where it is the CPU reference.
pub(super) fn studio(typed: Renderer, console: &mut Console<'_>) -> Result<Box<dyn Studio>, Failure> {
    let studio = render::studio(choice(typed)).map_err(Failure::new)?;
    if typed == Renderer::Auto && studio.adapter().kind == Kind::Reference {
        console.err.note("no Vulkan adapter: the CPU reference renders");
    }
    Ok(studio)
}

pub(super) fn choice(typed: Renderer) -> Choice {
    match typed {
        Renderer::Auto => Choice::Auto,
        Renderer::Gpu => Choice::Gpu,
        Renderer::Reference => Choice::Reference,
    }
}

/// Writes a picture.
pub(super) fn write(image: &Image, path: &Path) -> Result<(), Failure> {
    let bytes = assets::write_png(image).map_err(|error| Failure::about(path)(&error))?;
    Ok(assets::write_output(path, &bytes)?)
}

/// What a replay that gave no picture has to say for itself.
pub(super) fn missing(replay: &dyn Replay) -> Failure {
    match replay.failure() {
        Some(error) => Failure::new(error),
        None => Failure::new("this engine has no picture"),
    }
}

pub(super) fn map_id(typed: Map) -> MapId {
    match typed {
        Map::Colour => MapId::Color,
        Map::Discolor => MapId::Discolor,
        Map::Normal => MapId::Normal,
        Map::Occlusion => MapId::Occlusion,
        Map::Specular => MapId::Specular,
    }
}
