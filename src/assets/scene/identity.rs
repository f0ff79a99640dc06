//! What makes two scenes the same: a hash over what they say.
//!
//! Recordings hold it. So it must not change when a scene can say more: of a look only what differs from the default counts, each such
//! value by its path, and maps count only where there are some.

use serde_json::Value;

use super::SceneSettings;
use crate::canvas::look::Look;

/// A map's field in the scene, and blake3 of the bytes of its file.
pub(in crate::assets) type MapHash = (&'static str, [u8; 32]);

impl SceneSettings {
    /// blake3 over every value in order: what is optional after a 0 or 1, and −0 as 0; then what the look and the maps add.
    pub(in crate::assets) fn hash(&self, maps: &[MapHash]) -> [u8; 32] {
        let mut hasher = blake3::Hasher::new();
        let mut put = |values: &[f64]| {
            hasher.update(&[values.len() as u8]);
            values.iter().for_each(|v| {
                hasher.update(&(v + 0.0).to_le_bytes());
            });
        };
        put(&[self.unit_cm, self.snap_px, self.fov_y, self.azimuth, self.zenith]);
        put(self.target.as_ref().map_or(&[], |t| t.as_slice()));
        put(self.distance.as_slice());
        let files = maps.iter().map(|(field, hash)| {
            let hash = blake3::Hash::from_bytes(*hash).to_hex();
            format!("maps.{field}={hash}")
        });
        for line in said(&self.look).into_iter().chain(files) {
            hasher.update(&(line.len() as u32).to_le_bytes());
            hasher.update(line.as_bytes());
        }
        *hasher.finalize().as_bytes()
    }
}

/// Every value of a look that is not the default, as `path=value`, sorted.
fn said(look: &Look) -> Vec<String> {
    let json = |look: &Look| serde_json::to_value(look).unwrap_or_default();
    let mut lines = Vec::new();
    list("", &json(look), &json(&Look::default()), &mut lines);
    lines.sort_unstable();
    lines
}

fn list(path: &str, value: &Value, usual: &Value, lines: &mut Vec<String>) {
    if value == usual {
        return;
    }
    match value {
        Value::Object(fields) => {
            fields
                .iter()
                .for_each(|(name, v)| list(&format!("{path}.{name}"), v, &usual[name.as_str()], lines));
        }
        Value::Array(items) => {
            lines.push(format!("{path}=[{}]", items.len()));
            let items = items.iter().enumerate();
            items.for_each(|(i, v)| list(&format!("{path}.{i}"), v, &usual[i], lines));
        }
        Value::Number(number) if number.as_f64() == Some(0.0) => lines.push(format!("{path}=0")),
        leaf => lines.push(format!("{path}={leaf}")),
    }
}
