//! What holds for every recording, whatever its engine and form.

use rustc_hash::FxHashSet;

use super::SceneRef;
use crate::engine::{Control, Event};
use crate::report::quoted;

/// Width and height of a view where nobody says otherwise.
pub const VIEWPORT: [u32; 2] = [1280, 720];
/// The largest side of a view, pixels.
pub(super) const MAX_SIDE: u32 = 16_384;
/// The longest name of a checkpoint.
pub(super) const MAX_NAME: usize = 64;

/// Looks at a view's width and height.
pub(super) fn viewport(sides: [u32; 2]) -> Result<(), String> {
    match sides.iter().find(|side| !(1..=MAX_SIDE).contains(side)) {
        Some(side) => Err(format!("a side of {side} pixels is not within 1 to {MAX_SIDE}")),
        None => Ok(()),
    }
}

/// Looks at what comes before the events.
pub(super) fn head(of: &SceneRef, sides: [u32; 2]) -> Result<(), String> {
    scene(of).map_err(|what| format!("scene.{what}"))?;
    viewport(sides).map_err(|what| format!("viewport: {what}"))
}

/// Looks at a mesh that is written out: a script can hold no number that is not finite.
fn scene(scene: &SceneRef) -> Result<(), String> {
    let SceneRef::Inline(mesh) = scene else { return Ok(()) };
    if let Some(i) = mesh.nodes.iter().position(|at| at.iter().any(|v| !v.is_finite())) {
        return Err(format!("inline.nodes[{i}]: {:?} is not a place", mesh.nodes[i]));
    }
    match mesh.uv.iter().position(|uv| uv.iter().any(|v| !v.is_finite())) {
        Some(i) => Err(format!("inline.uv[{i}]: {:?} is not a place", mesh.uv[i])),
        None => Ok(()),
    }
}

/// The checkpoints named so far: their goldens are files, so that a name is plain and stands for one of them.
#[derive(Default)]
pub(super) struct Names(FxHashSet<String>);

impl Names {
    /// Looks at the next event. The error begins with its kind and the field at fault: `cut.from: …`.
    pub(super) fn admit<E: Event>(&mut self, event: &E) -> Result<(), String> {
        let kind = event.kind();
        event.validate().map_err(|what| below(kind, &what))?;
        match event.control() {
            Control::Checkpoint(name) => self.name(name).map_err(|what| format!("{kind}: {what}")),
            _ => Ok(()),
        }
    }

    fn name(&mut self, name: &str) -> Result<(), String> {
        let plain = |b: u8| b.is_ascii_lowercase() || b.is_ascii_digit() || b == b'-';
        if !(1..=MAX_NAME).contains(&name.len()) || !name.bytes().all(plain) {
            return Err(format!("{} is not 1 to {MAX_NAME} of a-z, 0-9 and -", quoted(name)));
        }
        match self.0.insert(name.to_owned()) {
            true => Ok(()),
            false => Err(format!("there is a checkpoint named {} already", quoted(name))),
        }
    }
}

/// An event's complaint begins with a field of it, or with its kind where it is but one value.
fn below(kind: &str, what: &str) -> String {
    match what.split_once(':') {
        Some((field, _)) if field == kind => what.to_owned(),
        _ => format!("{kind}.{what}"),
    }
}
