//! Where two recordings say something else.

use std::fmt;

use super::{AnyRecording, Recorded, Recording, Visit};

/// The first thing that two recordings say differently, as they would say it in a script.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct InputDifference {
    /// The field, such as `seed` or `events[3]`.
    pub field: String,
    /// What each of them says; nothing where it ends before.
    pub says: [Option<String>; 2],
}

impl fmt::Display for InputDifference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [a, b] = self.says.each_ref().map(|says| says.as_deref().unwrap_or("nothing"));
        write!(f, "{}: {a} against {b}", self.field)
    }
}

/// The first thing that two recordings say differently.
pub fn first_difference(a: &AnyRecording, b: &AnyRecording) -> Option<InputDifference> {
    let (a, b) = (a.visit(Say), b.visit(Say));
    let at = (0..a.len().max(b.len())).find(|&at| a.get(at) != b.get(at))?;
    let (field, _) = a.get(at).or(b.get(at))?;
    let says = [&a, &b].map(|said| said.get(at).map(|(_, text)| text.clone()));
    Some(InputDifference { field: field.clone(), says })
}

struct Say;

impl Visit for Say {
    type Output = Vec<(String, String)>;

    fn visit<E: Recorded>(self, recording: &Recording<E>) -> Self::Output {
        let hash = |bytes: [u8; 32]| blake3::Hash::from_bytes(bytes).to_hex().to_string();
        let [width, height] = recording.viewport;
        let head = [
            ("engine", E::ENGINE.to_owned()),
            ("scene", json(&recording.scene)),
            ("scene hash", hash(recording.scene_hash)),
            ("mesh hash", hash(recording.mesh_hash)),
            ("viewport", format!("{width} x {height}")),
            ("seed", recording.seed.to_string()),
        ];
        let events = recording.events.iter().enumerate();
        let events = events.map(|(i, keyed)| {
            (format!("events[{i}]"), format!("{} (key {})", json(&keyed.event), keyed.key))
        });
        head.map(|(field, text)| (field.to_owned(), text)).into_iter().chain(events).collect()
    }
}

/// What has no JSON says why.
fn json(value: &impl serde::Serialize) -> String {
    serde_json::to_string(value).unwrap_or_else(|why| why.to_string())
}
