//! Rounder numbers in an event, so that a reduced recording is easier to read.
//!
//! This works on the event as it stands in a script, so it needs to know no engine: numbers that are not whole are tried with no, one, two and
//! three decimals. Whole numbers (ids, counts) stay, and so does what is not valid when rounded.

use serde_json::Value;

use crate::engine::Event;

/// Powers of ten of the decimals that are tried, the roundest first.
const DECIMALS: [f64; 4] = [1.0, 10.0, 100.0, 1000.0];

/// How many numbers stand in an event.
pub(super) fn numbers(event: &impl Event) -> usize {
    let mut count = 0;
    if let Ok(mut script) = serde_json::to_value(event) {
        each_number(&mut script, &mut |_| count += 1);
    }
    count
}

/// The event with its number at a place made rounder, the roundest first.
pub(super) fn rounder<E: Event>(event: &E, place: usize) -> impl Iterator<Item = E> {
    let event = event.clone();
    DECIMALS.into_iter().filter_map(move |decimals| {
        let mut script = serde_json::to_value(&event).ok()?;
        let mut at = 0;
        each_number(&mut script, &mut |number| {
            if at == place {
                *number = (*number * decimals).round() / decimals;
            }
            at += 1;
        });
        let rounder: E = serde_json::from_value(script).ok()?;
        (rounder != event && rounder.validate().is_ok()).then_some(rounder)
    })
}

/// Does something to every number that is not whole.
fn each_number(value: &mut Value, change: &mut dyn FnMut(&mut f64)) {
    match value {
        Value::Number(number) => {
            if let Some(mut v) = number.as_f64().filter(|v| v.fract() != 0.0) {
                change(&mut v);
                *value = v.into();
            }
        }
        Value::Array(values) => values.iter_mut().for_each(|value| each_number(value, change)),
        Value::Object(fields) => fields.values_mut().for_each(|value| each_number(value, change)),
        Value::Null | Value::Bool(_) | Value::String(_) => {}
    }
}
