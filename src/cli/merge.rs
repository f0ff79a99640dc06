//! `lancet merge`: one report of the shards of several machines.

use std::path::Path;

use super::args::Merge;
use super::failure::Failure;
use super::verify::deliver;
use super::{Console, Done};
use crate::assets;
use crate::verify::{self, Blob};

pub(super) fn run(typed: &Merge, console: &mut Console<'_>) -> Done {
    let blobs = typed.blobs.iter().map(|path| read(path)).collect::<Result<_, _>>()?;
    let blob = verify::merge(blobs).map_err(Failure::new)?;
    deliver(&blob, &typed.to, [&typed.to.json, &typed.to.junit], console)
}

fn read(path: &Path) -> Result<(String, Blob), Failure> {
    let bytes = assets::read_file(path)?;
    let blob = Blob::parse(&bytes).map_err(|why| Failure::about(path)(&why))?;
    Ok((path.display().to_string(), blob))
}
