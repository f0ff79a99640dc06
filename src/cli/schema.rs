//! `lancet schema`: the JSON Schemas of what goes in and comes out.

use schemars::schema_for;

use super::args::{Schema, SchemaOf, Target};
use super::{Console, Done, Status, json};
use crate::assets::scene::SceneFile;
use crate::recording::script_schema;
use crate::report::RunReport;

pub(super) fn run(typed: &Schema, console: &mut Console<'_>) -> Done {
    let schema = match typed.of {
        SchemaOf::Script => script_schema(),
        SchemaOf::Scene => schema_for!(SceneFile),
        SchemaOf::Report => schema_for!(RunReport),
    };
    json::write(&schema, Some(&Target::Stdout), console)?;
    Ok(Status::Verified)
}
