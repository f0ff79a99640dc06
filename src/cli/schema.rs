//! `lancet schema`: the JSON Schemas of what goes in and comes out.

use super::args::{Schema, SchemaOf, Target};
use super::{Console, Done, Status, json};
use crate::recording::script_schema;

pub(super) fn run(typed: &Schema, console: &mut Console<'_>) -> Done {
    let schema = match typed.of {
        SchemaOf::Script => script_schema(),
    };
    json::write(&schema, Some(&Target::Stdout), console)?;
    Ok(Status::Verified)
}
