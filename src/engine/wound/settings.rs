//! The settings that `set` events change: which parts of the renderer are on, and how strong they are (Lam 2016, §6.3).
//!
//! A setting begins as the scene's look says, and changes nothing but what is seen; `snap_px` alone has to do with picks.

use std::collections::BTreeMap;

use schemars::{Schema, SchemaGenerator, json_schema};
use serde_json::{Map, json};

use super::event::Value;
use crate::canvas::look::Look;

/// A setting that a `set` event may name.
#[derive(Clone, Copy, Debug)]
pub struct Setting {
    /// Its name in scripts.
    pub name: &'static str,
    /// What it takes.
    pub takes: Takes,
}

/// What a setting takes, and where it goes.
#[derive(Clone, Copy, Debug)]
pub enum Takes {
    /// True or false: a switch of the look.
    Switch(fn(&mut Look) -> &mut bool),
    /// A number in a range: a part of the look.
    Number([f64; 2], fn(&mut Look) -> &mut f32),
    /// A number in a range that is no part of the look, and what it begins as.
    Other([f64; 2], f64),
}

const fn setting(name: &'static str, takes: Takes) -> Setting {
    Setting { name, takes }
}

/// How many settings there were before there was anything to see: the others are digested apart, so that old digests hold.
pub(super) const FIRST: usize = 10;

/// The settings, in the order in which they are digested. New ones go to the end.
pub const SETTINGS: &[Setting] = &[
    setting("snap_px", Takes::Other([0.0, 1000.0], 0.0)),
    setting("shadows", Takes::Switch(|look| &mut look.switches.shadows)),
    setting("transmittance", Takes::Switch(|look| &mut look.switches.transmittance)),
    setting("specular", Takes::Switch(|look| &mut look.switches.specular)),
    setting("scattering", Takes::Switch(|look| &mut look.switches.scattering)),
    setting("discoloration", Takes::Switch(|look| &mut look.switches.discoloration)),
    setting("color-map", Takes::Switch(|look| &mut look.switches.color_map)),
    setting("normal-map", Takes::Switch(|look| &mut look.switches.normal_map)),
    setting("occlusion-map", Takes::Switch(|look| &mut look.switches.occlusion_map)),
    setting("specular-map", Takes::Switch(|look| &mut look.switches.specular_map)),
    setting("ambient", Takes::Number([0.0, 100.0], |look| &mut look.ambient.intensity)),
    // What the colour of every light is multiplied by.
    setting("light-intensity", Takes::Other([0.0, 100.0], 1.0)),
    setting("specular-intensity", Takes::Number([0.0, 100.0], |look| &mut look.skin.specular)),
    setting("bumpiness", Takes::Number([0.0, 10.0], |look| &mut look.skin.bumpiness)),
    // Centimetres; the scattering divides by it.
    setting("scatter-width", Takes::Number([0.001, 10.0], |look| &mut look.scattering.width_cm)),
    setting("translucency", Takes::Number([0.0, 1.0], |look| &mut look.scattering.translucency)),
];

/// The schema of settings by name.
pub(super) fn schema(_: &mut SchemaGenerator) -> Schema {
    let of = |setting: &Setting| match setting.takes {
        Takes::Switch(_) => json!({ "type": "boolean" }),
        Takes::Number([least, most], _) | Takes::Other([least, most], _) => {
            json!({ "type": "number", "minimum": least, "maximum": most })
        }
    };
    let all: Map<String, serde_json::Value> = SETTINGS.iter().map(|s| (s.name.into(), of(s))).collect();
    json_schema!({ "type": "object", "properties": all, "additionalProperties": false })
}

/// What every setting begins as in a scene.
pub(super) fn of_scene(look: &Look, snap_px: f64) -> BTreeMap<String, Value> {
    let mut look = look.clone();
    let mut value = |setting: &Setting| match setting.takes {
        Takes::Switch(place) => Value::Switch(*place(&mut look)),
        Takes::Number(_, place) => Value::Number(f64::from(*place(&mut look))),
        Takes::Other(_, first) => Value::Number(first),
    };
    let mut all: BTreeMap<String, Value> = SETTINGS.iter().map(|s| (s.name.into(), value(s))).collect();
    all.insert("snap_px".into(), Value::Number(snap_px));
    all
}

/// A scene's look as the settings have changed it.
pub(super) fn applied(look: &Look, settings: &BTreeMap<String, Value>) -> Look {
    let mut look = look.clone();
    for setting in SETTINGS {
        match (setting.takes, settings.get(setting.name)) {
            (Takes::Switch(place), Some(Value::Switch(on))) => *place(&mut look) = *on,
            (Takes::Number(_, place), Some(Value::Number(v))) => *place(&mut look) = *v as f32,
            _ => {}
        }
    }
    look
}

/// The value of a setting that is a number.
pub(super) fn number(settings: &BTreeMap<String, Value>, name: &str) -> Option<f64> {
    match settings.get(name) {
        Some(Value::Number(v)) => Some(*v),
        _ => None,
    }
}

/// Whether there is such a setting, and it takes such a value.
pub(super) fn validate(name: &str, value: &Value) -> Result<(), String> {
    let Some(setting) = SETTINGS.iter().find(|known| known.name == name) else {
        let known: Vec<&str> = SETTINGS.iter().map(|known| known.name).collect();
        return Err(format!("set: there is no setting `{name}`; there are {}", known.join(", ")));
    };
    match (setting.takes, value) {
        (Takes::Switch(_), Value::Switch(_)) => Ok(()),
        (Takes::Switch(_), _) => Err(format!("set: `{name}` is true or false")),
        (Takes::Number(range, _) | Takes::Other(range, _), Value::Number(v))
            if (range[0]..=range[1]).contains(v) =>
        {
            Ok(())
        }
        (Takes::Number([least, most], _) | Takes::Other([least, most], _), _) => {
            Err(format!("set: `{name}` is a number from {least} to {most}"))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_setting_begins_as_the_scene_says_and_changes_its_own_part_of_the_look() {
        let mut scene = Look::default();
        scene.switches.shadows = false;
        scene.skin.bumpiness = 0.5;
        let mut settings = of_scene(&scene, 3.0);
        assert_eq!(settings["shadows"], Value::Switch(false));
        assert_eq!(settings["bumpiness"], Value::Number(0.5));
        assert_eq!(number(&settings, "snap_px"), Some(3.0));
        assert_eq!(applied(&scene, &settings), scene);
        settings.insert("shadows".into(), Value::Switch(true));
        settings.insert("scatter-width".into(), Value::Number(2.0));
        scene.switches.shadows = true;
        scene.scattering.width_cm = 2.0;
        assert_eq!(applied(&scene, &settings), scene);
    }

    #[test]
    fn every_setting_has_a_place_of_its_own() {
        let scene = Look::default();
        let looks: Vec<Look> = SETTINGS
            .iter()
            .map(|setting| {
                let mut settings = of_scene(&scene, 0.0);
                let changed = match settings[setting.name] {
                    Value::Switch(on) => Value::Switch(!on),
                    Value::Number(v) => Value::Number(v * 0.5 + 0.125),
                };
                settings.insert(setting.name.into(), changed);
                applied(&scene, &settings)
            })
            .collect();
        let parts = |s: &Setting| !matches!(s.takes, Takes::Other(..));
        for (i, setting) in SETTINGS.iter().enumerate().filter(|(_, s)| parts(s)) {
            assert_eq!(looks.iter().filter(|look| **look == looks[i]).count(), 1, "{}", setting.name);
        }
    }

    #[test]
    fn a_value_of_another_kind_or_out_of_its_range_is_refused() {
        assert_eq!(validate("ambient", &Value::Number(2.0)), Ok(()));
        assert_eq!(validate("snap_px", &Value::Number(1e3)), Ok(()));
        let refused = |name, value| validate(name, &value).unwrap_err();
        assert_eq!(refused("shadows", Value::Number(1.0)), "set: `shadows` is true or false");
        assert_eq!(refused("snap_px", Value::Number(-1.0)), "set: `snap_px` is a number from 0 to 1000");
        assert_eq!(
            refused("translucency", Value::Number(1.5)),
            "set: `translucency` is a number from 0 to 1"
        );
        assert_eq!(
            refused("scatter-width", Value::Number(0.0)),
            "set: `scatter-width` is a number from 0.001 to 10"
        );
        assert!(validate("ambient", &Value::Number(f64::NAN)).is_err());
        assert!(validate("snap_px", &Value::Number(f64::INFINITY)).is_err());
        assert!(
            refused("shadow", Value::Switch(true))
                .starts_with("set: there is no setting `shadow`; there are snap_px")
        );
    }
}
