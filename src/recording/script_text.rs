//! How a script is written: one field a line, one event a line, spaces after commas and colons.

use std::io::{self, Write};

use serde::Serialize;
use serde_json::Value;
use serde_json::ser::{Formatter, Serializer};

use super::{Keyed, Recorded, Recording, Script, Visit, WriteError};

impl Script {
    /// Writes the script.
    pub fn write(&self, to: &mut dyn Write) -> Result<(), WriteError> {
        self.unhashed().visit(Print(to))
    }
}

struct Print<'w>(&'w mut dyn Write);

impl Visit for Print<'_> {
    type Output = Result<(), WriteError>;

    fn visit<E: Recorded>(self, recording: &Recording<E>) -> Self::Output {
        recording.validate().map_err(WriteError::Invalid)?;
        let to = self.0;
        writeln!(to, "{{\n  \"version\": 1,\n  \"engine\": \"{}\",", E::ENGINE)?;
        field(to, "scene", &recording.scene)?;
        field(to, "viewport", &recording.viewport)?;
        field(to, "seed", &recording.seed)?;
        keys(to, &recording.events)?;
        events(to, &recording.events)?;
        Ok(writeln!(to, "}}")?)
    }
}

fn field(to: &mut dyn Write, name: &str, value: &impl Serialize) -> io::Result<()> {
    write!(to, "  \"{name}\": ")?;
    print(to, value)?;
    writeln!(to, ",")
}

/// Keys are written only where they are not the indices.
fn keys<E>(to: &mut dyn Write, events: &[Keyed<E>]) -> io::Result<()> {
    if (0..).zip(events).all(|(index, keyed)| index == keyed.key) {
        return Ok(());
    }
    field(to, "keys", &events.iter().map(|keyed| keyed.key).collect::<Vec<u32>>())
}

fn events<E: Serialize>(to: &mut dyn Write, events: &[Keyed<E>]) -> io::Result<()> {
    write!(to, "  \"events\": [")?;
    for (index, keyed) in events.iter().enumerate() {
        write!(to, "{}\n    ", if index == 0 { "" } else { "," })?;
        print(to, &without_nulls(serde_json::to_value(&keyed.event)?))?;
    }
    writeln!(to, "{}]", if events.is_empty() { "" } else { "\n  " })
}

/// What an event leaves out is left out of the script as well.
fn without_nulls(value: Value) -> Value {
    match value {
        Value::Object(fields) => {
            fields.into_iter().filter(|(_, v)| !v.is_null()).map(|(k, v)| (k, without_nulls(v))).collect()
        }
        other => other,
    }
}

fn print(to: &mut dyn Write, value: &impl Serialize) -> io::Result<()> {
    Ok(value.serialize(&mut Serializer::with_formatter(to, Spaced))?)
}

/// JSON on one line, with spaces after commas and colons.
struct Spaced;

impl Formatter for Spaced {
    fn begin_array_value<W: Write + ?Sized>(&mut self, to: &mut W, first: bool) -> io::Result<()> {
        if first { Ok(()) } else { to.write_all(b", ") }
    }

    fn begin_object_key<W: Write + ?Sized>(&mut self, to: &mut W, first: bool) -> io::Result<()> {
        if first { Ok(()) } else { to.write_all(b", ") }
    }

    fn begin_object_value<W: Write + ?Sized>(&mut self, to: &mut W) -> io::Result<()> {
        to.write_all(b": ")
    }
}
