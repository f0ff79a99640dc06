//! From a file to something that can be cut: reading, the cache, the topology, the hierarchy for picks.

use std::path::Path;

use divan::Bencher;
use lancet::assets::builtin::builtin;
use lancet::assets::{self, CacheOptions, export};
use lancet::engine::wound::merge::face_box;
use lancet::geometry::bvh::Bvh;
use lancet::mesh::{IndexedMesh, Mesh};
use lancet::recording::SceneRef;

const SIZES: [usize; 3] = [8_000, 125_000, 1_000_000];

fn main() {
    divan::main();
}

fn bust(faces: usize) -> IndexedMesh {
    builtin(&format!("bust:{faces}")).expect("a bust").mesh
}

#[divan::bench(args = SIZES, sample_count = 5, sample_size = 1)]
fn mesh_build(bencher: Bencher<'_, '_>, faces: usize) {
    let indexed = bust(faces);
    bencher.bench_local(|| Mesh::build(&indexed).expect("a mesh"));
}

#[divan::bench(args = SIZES, sample_count = 5, sample_size = 1)]
fn bvh_build(bencher: Bencher<'_, '_>, faces: usize) {
    let mesh = Mesh::build(&bust(faces)).expect("a mesh");
    bencher.bench_local(|| Bvh::build(mesh.face_count(), &|f| face_box(&mesh, f)));
}

/// The bust as OBJ, in a folder of its own that has a cache as well.
fn folder(faces: usize) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let mesh = Mesh::build(&bust(faces)).expect("a mesh");
    export::save(&mesh, &folder.path().join("bust.obj")).expect("it is written");
    folder
}

fn open(folder: &Path, cache: &CacheOptions) -> assets::Loaded {
    assets::open(&SceneRef::Mesh("bust.obj".into()), folder, cache).expect("it opens")
}

#[divan::bench(args = SIZES, sample_count = 5, sample_size = 1)]
fn obj(bencher: Bencher<'_, '_>, faces: usize) {
    let folder = folder(faces);
    bencher.bench_local(|| open(folder.path(), &CacheOptions::off()));
}

#[divan::bench(args = SIZES, sample_count = 5, sample_size = 1)]
fn cache(bencher: Bencher<'_, '_>, faces: usize) {
    let folder = folder(faces);
    let cache = CacheOptions::at(folder.path().join("cache"));
    open(folder.path(), &cache);
    bencher.bench_local(|| assert!(open(folder.path(), &cache).from_cache));
}
