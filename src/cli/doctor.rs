//! `lancet doctor`: the program and the machine, for a report of something strange.

use std::thread::available_parallelism;

use super::table::TextTable;
use super::{Console, Done, Status};
use crate::assets::{self, CacheOptions};
use crate::recording::{ENGINES, VERSION};
use crate::render::{self, Choice};

pub(super) fn run(console: &mut Console<'_>) -> Done {
    let build = if cfg!(debug_assertions) { "debug" } else { "release" };
    let canary = cfg!(feature = "canary");
    let features = [
        ("attack", cfg!(feature = "attack")),
        ("canary", canary),
        ("gltf", cfg!(feature = "gltf")),
        ("gpu", cfg!(feature = "gpu")),
        ("tui", cfg!(feature = "tui")),
    ];
    let features: Vec<&str> = features.into_iter().filter(|(_, on)| *on).map(|(name, _)| name).collect();
    let gpu = render::studio(Choice::Gpu).map_or_else(|error| error.to_string(), |s| s.adapter().to_string());
    let threads = available_parallelism().map_or_else(|e| e.to_string(), |n| n.to_string());
    let mut table = TextTable::pairs();
    table.pair("lancet", format!("{} ({build})", env!("CARGO_PKG_VERSION")));
    table.pair("features", if features.is_empty() { "none".into() } else { features.join(", ") });
    if canary {
        table.pair(
            "CANARY",
            "a bug is planted in the engine: this program is for trying the fuzzers, and verifies nothing",
        );
    }
    table.pair("gpu", gpu);
    table.pair("engines", ENGINES.join(", "));
    table.pair("recordings", format!("format versions 1 to {VERSION}"));
    table.pair("machine", format!("{} {}, {threads} threads", std::env::consts::OS, std::env::consts::ARCH));
    table.pair("cache", cache(&CacheOptions::from_environment()));
    table.write(&mut console.out)?;
    Ok(Status::Verified)
}

fn cache(options: &CacheOptions) -> String {
    let Some(folder) = &options.folder else { return "off".into() };
    match assets::list_files(folder) {
        Ok(files) => format!("{}, {} files", folder.display(), files.len()),
        Err(error) => error.to_string(),
    }
}
