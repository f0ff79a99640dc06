//! `lancet check`: what a mesh is, and what had to be repaired to read it.

use std::path::Path;

use schemars::JsonSchema;
use serde::Serialize;

use super::args::Check;
use super::{Console, Done, Status, json};
use crate::assets::{self, CacheOptions, MeshFacts, Note};
use crate::recording::SceneRef;

/// The answer in JSON.
#[derive(Serialize, JsonSchema)]
struct Answer<'a> {
    mesh: &'a str,
    mesh_hash: String,
    #[serde(flatten)]
    facts: &'a MeshFacts,
    notes: &'a [Note],
    from_cache: bool,
}

pub(super) fn run(typed: &Check, console: &mut Console<'_>) -> Done {
    let cache = CacheOptions::from_environment();
    let loaded = assets::open(&SceneRef::typed(&typed.mesh), Path::new(""), &cache)?;
    let facts = assets::inspect(&loaded.mesh);
    let answer = Answer {
        mesh: &typed.mesh,
        mesh_hash: blake3::Hash::from_bytes(loaded.mesh_hash).to_hex().to_string(),
        facts: &facts,
        notes: &loaded.notes,
        from_cache: loaded.from_cache,
    };
    json::write(&answer, typed.json.to.as_ref(), console)?;
    if typed.json.to.is_none() {
        assets::inspect::write_facts(&facts, &loaded.notes, &mut console.out)?;
    }
    Ok(Status::Verified)
}
