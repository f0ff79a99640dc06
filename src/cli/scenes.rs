//! `lancet scenes`: the scenes that are made by code.

use super::table::TextTable;
use super::{Console, Done, Status};
use crate::assets::builtin;

pub(super) fn run(console: &mut Console<'_>) -> Done {
    let mut table = TextTable::new(&["scene", "what it is"]);
    builtin::list()
        .iter()
        .for_each(|scene| table.row([format!("builtin:{}", scene.name), scene.about.into()]));
    table.write(&mut console.out)?;
    Ok(Status::Verified)
}
