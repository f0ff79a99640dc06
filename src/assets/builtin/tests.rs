//! What a user of the scenes relies on.

use std::collections::{BTreeMap, BTreeSet};

use glam::{DVec3, Vec2};

use super::{Builtin, BuiltinError, builtin, list};
use crate::mesh::{IndexedMesh, Mesh};

const FIXED: [&str; 5] = ["bust", "slab", "torus", "two-fingers", "grid"];

fn make(name: &str) -> IndexedMesh {
    builtin(name).unwrap_or_else(|e| panic!("{name}: {e}")).mesh
}

fn sides(face: [u32; 3]) -> [(u32, u32); 3] {
    [(face[0], face[1]), (face[1], face[2]), (face[2], face[0])]
}

fn corners(mesh: &IndexedMesh, f: usize) -> [DVec3; 3] {
    mesh.faces[f].map(|n| mesh.positions[n as usize])
}

fn longest(t: [DVec3; 3]) -> f64 {
    t[0].distance(t[1]).max(t[1].distance(t[2])).max(t[2].distance(t[0]))
}

fn double_area(t: [DVec3; 3]) -> f64 {
    (t[1] - t[0]).cross(t[2] - t[0]).length()
}

/// Six times the signed volume of a tetrahedron.
fn volume([a, b, c]: [DVec3; 3], d: DVec3) -> f64 {
    (b - a).cross(c - a).dot(d - a)
}

fn euler(mesh: &IndexedMesh) -> i64 {
    let edges: BTreeSet<_> =
        mesh.faces.iter().flat_map(|&f| sides(f)).map(|(a, b)| (a.min(b), a.max(b))).collect();
    mesh.positions.len() as i64 - edges.len() as i64 + mesh.faces.len() as i64
}

/// The number of parts that `faces` fall into, joined over shared sides.
fn parts(faces: &[[u32; 3]]) -> usize {
    let owner: BTreeMap<_, usize> = (0..faces.len()).flat_map(|f| sides(faces[f]).map(|s| (s, f))).collect();
    let (mut seen, mut count) = (vec![false; faces.len()], 0);
    for start in 0..faces.len() {
        let mut open = vec![start];
        count += usize::from(!seen[start]);
        while let Some(f) = open.pop() {
            if !std::mem::replace(&mut seen[f], true) {
                open.extend(sides(faces[f]).iter().filter_map(|&(a, b)| owner.get(&(b, a))));
            }
        }
    }
    count
}

fn assert_sound(name: &str, mesh: &IndexedMesh) {
    Mesh::build(mesh).unwrap_or_else(|e| panic!("{name}: {e}"));
    let directed: BTreeSet<_> = mesh.faces.iter().flat_map(|&f| sides(f)).collect();
    assert!(directed.iter().all(|&(a, b)| directed.contains(&(b, a))), "{name} is not closed");
    let swept: f64 = (0..mesh.faces.len()).map(|f| volume(corners(mesh, f), DVec3::ZERO)).sum();
    assert!(swept < 0.0, "{name} is inside out");
    for f in 0..mesh.faces.len() {
        let t = corners(mesh, f);
        assert!(double_area(t) > 0.02 * longest(t) * longest(t), "{name}: face {f} is a sliver: {t:?}");
    }
}

fn assert_charted(name: &str, mesh: &IndexedMesh, charts: usize) {
    assert_eq!(parts(&mesh.face_uvs), charts, "{name}");
    let inside = |uv: &Vec2| (0.0..=1.0).contains(&uv.x) && (0.0..=1.0).contains(&uv.y);
    assert!(mesh.uvs.iter().all(inside), "{name} leaves the atlas");
    for (f, t) in mesh.face_uvs.iter().enumerate() {
        let [a, b, c] = t.map(|i| mesh.uvs[i as usize].as_dvec2());
        assert!((b - a).perp_dot(c - a) > 0.0, "{name}: face {f} is flipped in its chart");
    }
}

/// No texel of 1024² may lie in two charts, nor next to one that lies in another.
fn assert_apart(name: &str, mesh: &IndexedMesh) {
    const SIDE: usize = 1024;
    let chart = chart_of_face(mesh);
    let mut owner = vec![usize::MAX; SIDE * SIDE];
    let mut filled = 0.0;
    for (f, t) in mesh.face_uvs.iter().enumerate() {
        let [a, b, c] = t.map(|i| mesh.uvs[i as usize].as_dvec2() * SIDE as f64);
        filled += 0.5 * (b - a).perp_dot(c - a);
        let (low, high) = (a.min(b).min(c) - 2.0, a.max(b).max(c) + 2.0);
        for (x, y) in (low.y as usize..=high.y as usize)
            .flat_map(|y| (low.x as usize..=high.x as usize).map(move |x| (x, y)))
        {
            let p = glam::DVec2::new(x as f64 + 0.5, y as f64 + 0.5);
            let near = [(a, b), (b, c), (c, a)]
                .iter()
                .all(|&(s, e)| (e - s).perp_dot(p - s) > -1.5 * (e - s).length());
            let texel = &mut owner[y.min(SIDE - 1) * SIDE + x.min(SIDE - 1)];
            if near {
                assert!(
                    *texel == usize::MAX || *texel == chart[f],
                    "{name}: two charts meet at texel ({x}, {y})"
                );
                *texel = chart[f];
            }
        }
    }
    let covered = owner.iter().filter(|&&c| c != usize::MAX).count() as f64;
    assert!(filled < covered, "{name}: a chart covers itself: {filled} of {covered} texels");
}

fn chart_of_face(mesh: &IndexedMesh) -> Vec<usize> {
    let mut chart: Vec<usize> = (0..mesh.uvs.len()).collect();
    loop {
        let before = chart.clone();
        for t in &mesh.face_uvs {
            let least = t.iter().map(|&i| chart[i as usize]).min().unwrap_or(0);
            t.iter().for_each(|&i| chart[i as usize] = least);
        }
        if chart == before {
            return mesh.face_uvs.iter().map(|t| chart[t[0] as usize]).collect();
        }
    }
}

/// Pairs of faces that pass through each other.
fn crossings(mesh: &IndexedMesh) -> Vec<(usize, usize)> {
    let bounds = |f: usize| {
        let [a, b, c] = corners(mesh, f);
        (a.min(b).min(c), a.max(b).max(c))
    };
    let mut order: Vec<usize> = (0..mesh.faces.len()).collect();
    order.sort_by(|&f, &g| bounds(f).0.x.total_cmp(&bounds(g).0.x));
    let boxes: Vec<_> = order.iter().map(|&f| bounds(f)).collect();
    let mut found = Vec::new();
    for (i, &f) in order.iter().enumerate() {
        let (low, high) = boxes[i];
        for (j, &g) in order.iter().enumerate().skip(i + 1).take_while(|&(j, _)| boxes[j].0.x <= high.x) {
            let apart = low.cmpgt(boxes[j].1).any() || boxes[j].0.cmpgt(high).any();
            if !apart && (pierces(mesh, f, g) || pierces(mesh, g, f)) {
                found.push((f, g));
            }
        }
    }
    found
}

/// Whether a side of `f` that shares no node with `g` passes through `g`.
fn pierces(mesh: &IndexedMesh, f: usize, g: usize) -> bool {
    // Sides within a plane touch there by rounding: only a clear passage counts.
    const CLEARLY: f64 = 1e-9;
    let [a, b, c] = corners(mesh, g);
    let free = |&(s, e): &(u32, u32)| !mesh.faces[g].contains(&s) && !mesh.faces[g].contains(&e);
    sides(mesh.faces[f]).iter().filter(|side| free(side)).any(|&(s, e)| {
        let (s, e) = (mesh.positions[s as usize], mesh.positions[e as usize]);
        let around = [(a, b), (b, c), (c, a)].map(|(p, q)| volume([s, e, p], q));
        let ends = [volume([a, b, c], s), -volume([a, b, c], e)];
        let agree = |v: &[f64]| v.iter().all(|&x| x > CLEARLY) || v.iter().all(|&x| x < -CLEARLY);
        agree(&around) && agree(&ends)
    })
}

#[test]
fn every_scene_is_sound_and_charted() {
    for (name, charts, holes) in [
        ("bust", 9, 2),
        ("slab", 6, 2),
        ("torus", 1, 0),
        ("two-fingers", 12, 4),
        ("grid", 6, 2),
        ("sphere:2000", 5, 2),
    ] {
        let mesh = make(name);
        assert_sound(name, &mesh);
        assert_charted(name, &mesh, charts);
        assert_apart(name, &mesh);
        assert_eq!(euler(&mesh), holes, "Euler characteristic of {name}");
        assert_eq!(crossings(&mesh).first(), None, "{name} passes through itself");
    }
}

#[test]
fn the_same_bytes_every_time() {
    for name in FIXED {
        assert_eq!(digest(&make(name)), digest(&make(name)), "{name}");
    }
}

fn digest(mesh: &IndexedMesh) -> blake3::Hash {
    let positions = mesh.positions.iter().flat_map(|p| p.to_array()).flat_map(|x| x.to_bits().to_le_bytes());
    let uvs = mesh.uvs.iter().flat_map(|p| p.to_array()).flat_map(|x| x.to_bits().to_le_bytes());
    let indices = mesh.faces.iter().chain(&mesh.face_uvs).flatten().flat_map(|i| i.to_le_bytes());
    blake3::hash(&positions.chain(uvs).chain(indices).collect::<Vec<u8>>())
}

#[test]
fn sizes_are_met_within_a_tenth() {
    for wanted in [2_000, 3_000, 5_000, 9_000, 20_000, 60_000] {
        let mesh = make(&format!("bust:{wanted}"));
        let got = mesh.faces.len();
        assert!(got.abs_diff(wanted) * 10 <= wanted, "bust:{wanted} has {got} faces");
        assert_eq!((euler(&mesh), parts(&mesh.face_uvs)), (2, 9), "bust:{wanted}");
        assert_eq!(crossings(&mesh).first(), None, "bust:{wanted} passes through itself");
        let got = make(&format!("sphere:{wanted}")).faces.len();
        assert!(got.abs_diff(wanted) * 10 <= wanted, "sphere:{wanted} has {got} faces");
    }
    assert_eq!(make("bust"), make("bust:9000"));
}

#[test]
fn sizes_share_one_shape() {
    let (coarse, fine) = (make("bust:4000"), make("bust:20000"));
    let first = coarse.positions.len().min(600);
    for p in &coarse.positions[..first] {
        let nearest = fine.positions.iter().map(|q| q.distance_squared(*p)).fold(f64::MAX, f64::min);
        assert!(nearest < 1e-12, "{p} is not on the finer bust");
    }
}

#[test]
fn the_face_is_finer_than_the_skull() {
    let mesh = make("bust");
    let median = |inside: &dyn Fn(DVec3) -> bool| {
        let sizes = (0..mesh.faces.len()).map(|f| corners(&mesh, f));
        let mut areas: Vec<f64> =
            sizes.filter(|t| inside((t[0] + t[1] + t[2]) / 3.0)).map(|t| 0.5 * double_area(t)).collect();
        areas.sort_by(f64::total_cmp);
        areas[areas.len() / 2]
    };
    let skull = median(&|p| p.y > 0.0 && p.z < -4.0 && p.x.abs() < 6.0);
    let near = |c: DVec3, r: f64| move |p: DVec3| p.distance(DVec3::new(c.x * p.x.signum(), c.y, c.z)) < r;
    for (what, part) in [
        ("nose", near(DVec3::new(0.0, -2.5, 9.5), 1.6)),
        ("lips", near(DVec3::new(0.0, -5.6, 8.8), 2.0)),
        ("eyes", near(DVec3::new(3.1, 0.7, 7.7), 1.6)),
    ] {
        let fine = median(&part);
        assert!(skull > 4.0 * fine, "{what}: {fine} cm² against {skull} cm² at the back");
    }
}

#[test]
fn the_bust_is_symmetric_and_of_a_heads_size() {
    let mesh = make("bust");
    let key = |p: DVec3| (p + DVec3::ZERO).to_array().map(f64::to_bits);
    let nodes: BTreeSet<_> = mesh.positions.iter().map(|&p| key(p)).collect();
    let mirrored = mesh.positions.iter().filter(|p| nodes.contains(&key(DVec3::new(-p.x, p.y, p.z)))).count();
    assert_eq!(mirrored, mesh.positions.len());
    let low = mesh.positions.iter().copied().fold(DVec3::MAX, DVec3::min);
    let high = mesh.positions.iter().copied().fold(DVec3::MIN, DVec3::max);
    let size = high - low;
    assert!((15.0..20.0).contains(&size.x) && (25.0..30.0).contains(&size.y), "{size}");
    let tip = mesh.positions.iter().copied().max_by(|p, q| p.z.total_cmp(&q.z)).unwrap_or_default();
    assert!(tip.x.abs() < 0.5 && tip.y.abs() < 4.0, "the nose is foremost, not {tip}");
    let widest = mesh.positions.iter().copied().max_by(|p, q| p.x.total_cmp(&q.x)).unwrap_or_default();
    assert!((-4.0..4.0).contains(&widest.y) && widest.z.abs() < 5.0, "the ears are outermost, not {widest}");
}

#[test]
fn the_grid_is_exact() {
    let mesh = make("grid");
    assert!(
        mesh.positions
            .iter()
            .flat_map(|p| p.to_array())
            .all(|x| x * 4.0 == (x * 4.0).trunc() && x.abs() <= 4.0)
    );
    let facing = (0..mesh.faces.len()).filter(|&f| corners(&mesh, f).iter().all(|p| p.z == 0.5)).count();
    assert_eq!(facing, 2 * 32 * 32);
}

#[test]
fn the_fingers_are_two() {
    let mesh = make("two-fingers");
    assert_eq!(parts(&mesh.faces), 2);
    let gap = mesh.positions.iter().map(|p| p.x.abs()).fold(f64::MAX, f64::min);
    assert!((gap - 0.2).abs() < 1e-9, "{gap}");
    assert!(mesh.positions.iter().all(|p| p.y.abs() <= 3.5 + 1e-12 && p.z.abs() <= 0.75 + 1e-12));
}

#[test]
fn what_there_is_not_is_refused_with_what_there_is() {
    for name in ["", "busts", "bust ", "BUST", "grid2"] {
        assert_eq!(builtin(name), Err(BuiltinError::Unknown(name.to_owned())));
    }
    for name in [
        "bust:",
        "bust:1999",
        "bust:4000001",
        "bust:-1",
        "bust:1e4",
        "sphere",
        "sphere:19",
        "bust:99999999999999999999999",
    ] {
        assert!(matches!(builtin(name), Err(BuiltinError::Faces { .. })), "{name}");
    }
    assert_eq!(builtin("slab:40"), Err(BuiltinError::Fixed("slab")));
    let said = BuiltinError::Unknown("x".to_owned()).to_string();
    assert!(list().iter().all(|l| said.contains(l.name)), "{said}");
    assert!(list().iter().all(|l| !l.about.is_empty() && builtin(&l.name.replace('N', "2000")).is_ok()));
}

#[test]
fn a_model_unit_is_a_centimetre() {
    assert!(FIXED.iter().all(|name| matches!(builtin(name), Ok(Builtin { unit_cm: 1.0, .. }))));
}
