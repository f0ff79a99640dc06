//! The scenes that are cut: the built-in ones, in several sizes, and some of them scaled.
//!
//! A scaled scene says how many centimetres its unit is, so that its cuts gape as wide for their length; one does not, so that they
//! hardly open at all.

use std::sync::Arc;

use crate::assets::builtin::builtin;
use crate::engine::wound::{Scene, State};
use crate::measure::MeasureError;
use crate::measure::scaling::default_scene;
use crate::mesh::{IndexedMesh, Mesh};

/// A scene: its name after `builtin:`, what its coordinates are multiplied by, and how many centimetres a unit then is.
type Row = (&'static str, f64, f64);

const SCENES: [Row; 13] = [
    ("bust", 1.0, 1.0),
    ("sphere:2000", 1.0, 1.0),
    ("grid", 1.0, 1.0),
    ("slab", 1.0, 1.0),
    ("torus", 1.0, 1.0),
    ("two-fingers", 1.0, 1.0),
    ("sphere:20", 1.0, 1.0),
    ("bust:2000", 1.0, 1.0),
    ("bust:30000", 1.0, 1.0),
    ("bust:3000", 1e-6, 1e6),
    ("torus", 1e6, 1e-6),
    ("grid", 1e-6, 1e6),
    ("sphere:500", 1e6, 1.0),
];

/// A scene with its mesh and hierarchy made.
#[derive(Clone)]
pub(super) struct Prepared {
    /// What it is called in reports.
    pub(super) name: String,
    /// Its name after `builtin:`, where it is not scaled.
    pub(super) builtin: Option<&'static str>,
    /// Its surface.
    pub(super) indexed: Arc<IndexedMesh>,
    /// How it is looked at.
    pub(super) scene: Scene,
    /// Before any cut.
    pub(super) state: State,
}

/// Makes them all.
pub(super) fn prepare() -> Result<Vec<Prepared>, MeasureError> {
    SCENES.iter().map(make).collect()
}

fn make(&(name, scale, unit_cm): &Row) -> Result<Prepared, MeasureError> {
    let mut indexed = builtin(name)?.mesh;
    indexed.positions.iter_mut().for_each(|p| *p *= scale);
    let scene = Scene { unit_cm, ..default_scene() };
    let mut state = State::new(Mesh::build(&indexed)?, scene.clone());
    state.mesh_and_bvh();
    let (title, builtin) = match scale == 1.0 {
        true => (name.to_owned(), Some(name)),
        false => (format!("{name} x {scale:e}"), None),
    };
    Ok(Prepared { name: title, builtin, indexed: Arc::new(indexed), scene, state })
}
