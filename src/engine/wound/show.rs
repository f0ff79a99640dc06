//! What there is to show of a cut.

use std::collections::{BTreeMap, BTreeSet};

use rustc_hash::FxHashMap;

use super::state::{Cut, State, Work};
use crate::canvas::job::PaintFace;
use crate::engine::Shown;
use crate::mesh::FaceId;
use crate::report::{Counter, Counters, Overlay, Row, Table};

pub(super) fn show(state: &State, work: &Work) -> Shown {
    match work {
        Work::Cut(cut) => {
            let overlays = overlays(state, cut);
            Shown { counters: counters(state, cut), tables: vec![links(cut)], overlays }
        }
        Work::Subdivide { refined, .. } => {
            let children = refined.children.iter().map(|c| c.len() as u64).sum();
            let counters = [("children", children), ("faces", state.mesh.face_count() as u64)];
            let counters = counters.map(|(k, v)| (k.to_owned(), Counter::Count(v)));
            Shown { counters: counters.into_iter().collect(), ..Shown::default() }
        }
    }
}

fn counters(state: &State, cut: &Cut) -> Counters {
    let chain = &cut.formed.chain;
    let mut configurations: BTreeMap<String, u64> = BTreeMap::new();
    for i in 0..chain.links.len() {
        *configurations.entry(chain.configuration(i)).or_default() += 1;
    }
    let mut faces: Vec<_> = chain.links.iter().map(|l| l.face).collect();
    faces.sort_unstable();
    faces.dedup();
    let mut counters: Counters = [("configurations".to_owned(), Counter::ByName(configurations))].into();
    let mut count = |name: &str, n: usize| counters.insert(name.into(), Counter::Count(n as u64));
    count("links", chain.links.len());
    count("faces", faces.len());
    count("snapped", cut.plane.as_ref().map_or(0, |p| p.snapped()));
    if let Some(patch) = &cut.patch {
        count("patch_width", patch.job.size[0] as usize);
        count("patch_height", patch.job.size[1] as usize);
    }
    if let Some(painted) = &cut.painted {
        count("patch_faces", distinct(&painted.painting.paint.faces[..painted.painting.paint.inner]).len());
        count("painted_faces", distinct(&painted.painting.paint.faces).len());
    }
    if !cut.carved.gutter.is_empty() {
        count("gutter_faces", cut.carved.gutter.len());
        let moved = cut.carved.moved.iter().filter(|(n, from)| state.mesh.position(*n) != *from).count();
        count("moved", moved);
        count("narrowed", cut.carved.narrowed);
        count("closed", cut.carved.closed);
        count("shallowed", cut.carved.shallowed);
    }
    counters
}

/// The faces of which some parts are painted, ascending.
fn distinct(parts: &[PaintFace]) -> Vec<u32> {
    let mut faces: Vec<u32> = parts.iter().map(|part| part.face).collect();
    faces.sort_unstable();
    faces.dedup();
    faces
}

fn links(cut: &Cut) -> Table {
    let chain = &cut.formed.chain;
    let row = |i: usize| {
        let [a, b] = [i, i + 1].map(|k| chain.points[k]);
        let face = chain.links[i].face;
        let length = a.position.distance(b.position);
        let cells = [
            chain.configuration(i),
            face.to_string(),
            a.at.to_string(),
            b.at.to_string(),
            format!("{length:.6}"),
        ];
        Row { ids: vec![face.to_string(), a.at.to_string(), b.at.to_string()], cells: cells.to_vec() }
    };
    Table {
        title: "links".into(),
        columns: ["configuration", "face", "from", "to", "length"].map(String::from).to_vec(),
        rows: (0..chain.links.len()).map(row).collect(),
    }
}

fn overlays(state: &State, cut: &Cut) -> Vec<Overlay> {
    let chain = &cut.formed.chain;
    let line = chain.points.iter().map(|p| p.position.to_array()).collect();
    let picks = cut.picked.iter().flatten().map(|p| p.point.position.to_array()).collect();
    let gutter = cut.carved.gutter.iter().map(|f| f.0).collect();
    let painted = cut.painted.as_ref().map_or_else(Vec::new, |p| distinct(&p.painting.paint.faces));
    let mut overlays = vec![
        Overlay::Line { name: "line".into(), points: line },
        Overlay::Points { name: "picks".into(), points: picks },
        Overlay::Faces { name: "gutter".into(), faces: gutter },
        Overlay::Faces { name: "painted".into(), faces: painted },
    ];
    overlays.extend(configurations(cut));
    overlays.extend(stages(state, cut));
    overlays
}

/// The faces that each stage worked on: those that FC's line crosses, GP's patch covers, PP painted; those that MC made of what it divided, and those that CI
/// changed or made.
fn stages(state: &State, cut: &Cut) -> Vec<Overlay> {
    let crossed: BTreeSet<u32> = cut.formed.chain.links.iter().map(|link| link.face.0).collect();
    let painted = cut.painted.as_ref().map(|painted| &painted.painting.paint);
    let inner = painted.map_or_else(Vec::new, |paint| distinct(&paint.faces[..paint.inner]));
    let outer = painted.map_or_else(Vec::new, |paint| distinct(&paint.faces));
    let merged = cut.refined.children.iter().flatten().map(|face| face.0).collect();
    let carved = match cut.carved.gutter.is_empty() {
        true => Vec::new(),
        false => state.mesh.touched_since(cut.before_carve.mark).faces.iter().map(|face| face.0).collect(),
    };
    let sets =
        [("FC", crossed.into_iter().collect()), ("GP", inner), ("PP", outer), ("MC", merged), ("CI", carved)];
    sets.map(|(stage, faces)| Overlay::Faces { name: format!("stage {stage}"), faces }).into()
}

/// The faces that links cross, by configuration: where they were divided, what they were divided into.
fn configurations(cut: &Cut) -> impl Iterator<Item = Overlay> {
    let chain = &cut.formed.chain;
    let split = cut.formed.refinement.faces.iter().zip(&cut.refined.children);
    let children: FxHashMap<FaceId, &Vec<FaceId>> = split.map(|(split, made)| (split.face, made)).collect();
    let mut by_name: BTreeMap<String, BTreeSet<u32>> = BTreeMap::new();
    for (i, link) in chain.links.iter().enumerate() {
        let faces = by_name.entry(format!("configuration {}", chain.configuration(i))).or_default();
        match children.get(&link.face) {
            Some(children) => faces.extend(children.iter().map(|f| f.0)),
            None => drop(faces.insert(link.face.0)),
        }
    }
    by_name.into_iter().map(|(name, faces)| Overlay::Faces { name, faces: faces.into_iter().collect() })
}
