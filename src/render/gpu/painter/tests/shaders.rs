//! The painter's structs as its shaders read them.

use crate::render::gpu::painter::{paint, patch, place};
use crate::render::gpu::tests::shaders::assert_laid_out;

#[test]
fn every_struct_lies_as_the_shader_reads_it() {
    let tables = [
        ("patch", patch::Fbm::table()),
        ("patch", patch::Patch::table()),
        ("place", place::Triangle::table()),
        ("place", place::Shift::table()),
        ("paint", paint::Paint::table()),
        ("paint", paint::Tile::table()),
        ("paint", paint::Fault::table()),
        ("paint", paint::Faults::table()),
    ];
    assert_laid_out(&tables, &["patch", "place", "paint"]);
}
