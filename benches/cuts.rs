//! The stages of the thesis's eighteen cuts, one by one, and a pick.

mod kit;

use std::cell::{Cell, RefCell};

use divan::Bencher;
use kit::{Cutter, look, stage};
use lancet::assets::SceneSettings;
use lancet::assets::builtin::builtin;
use lancet::engine::wound::{Pick, State, pick};
use lancet::measure::thesis::published::CUTS;
use lancet::mesh::Mesh;

fn main() {
    divan::main();
}

fn samples() -> impl Iterator<Item = &'static str> {
    CUTS.iter().map(|sample| sample.name)
}

/// A stage by itself: what comes before it is done, and what it did is taken back, while the clock stands.
fn bench(bencher: Bencher<'_, '_>, sample: &str, id: &str) {
    let (cutter, stage) = (RefCell::new(Cutter::at(sample)), stage(id));
    bencher
        .with_inputs(|| cutter.borrow_mut().prepare(id))
        .bench_local_values(|()| cutter.borrow_mut().run(stage));
}

// One run a sample: a state can stand before only one cut at a time.
#[divan::bench(args = samples(), sample_count = 200, sample_size = 1)]
fn fc(bencher: Bencher<'_, '_>, sample: &str) {
    bench(bencher, sample, "FC");
}

#[divan::bench(args = samples(), sample_count = 200, sample_size = 1)]
fn gp(bencher: Bencher<'_, '_>, sample: &str) {
    bench(bencher, sample, "GP");
}

#[divan::bench(args = samples(), sample_count = 200, sample_size = 1)]
fn pp(bencher: Bencher<'_, '_>, sample: &str) {
    bench(bencher, sample, "PP");
}

#[divan::bench(args = samples(), sample_count = 200, sample_size = 1)]
fn mc(bencher: Bencher<'_, '_>, sample: &str) {
    bench(bencher, sample, "MC");
}

#[divan::bench(args = samples(), sample_count = 200, sample_size = 1)]
fn ci(bencher: Bencher<'_, '_>, sample: &str) {
    bench(bencher, sample, "CI");
}

/// Picks on a lattice over the face, one after another.
#[divan::bench(args = [8_000, 125_000, 1_000_000])]
fn pick_on(bencher: Bencher<'_, '_>, faces: usize) {
    let bust = builtin(&format!("bust:{faces}")).expect("a bust").mesh;
    let mut state =
        State::new(Mesh::build(&bust).expect("a mesh"), look(&SceneSettings::default(), [1280, 720]));
    state.mesh_and_bvh();
    let next = Cell::new(0u32);
    bencher
        .with_inputs(|| {
            let i = next.replace(next.get() + 1);
            [560.0 + f64::from(i * 37 % 160), 200.0 + f64::from(i * 59 % 280)]
        })
        .bench_local_values(|pixel| pick::resolve(&mut state, Pick::Pixel(pixel)));
}
