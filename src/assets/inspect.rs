//! What a mesh is: counts, topology, sizes. For `lancet check`, and for people who wonder why a cut was rejected.
//!
//! Genus: a closed surface of c parts has χ = 2 c − 2 g; with b boundary loops, χ + b takes the place of χ.
//! A **needle** has a longest side over a thousand times its height.

use std::io::{self, Write};

use serde::{Deserialize, Serialize};

use super::Note;
use crate::mesh::{Edge, FaceId, Mesh, NodeId, Union};

/// Longest side over height from which a face counts as a needle.
const NEEDLE: f64 = 1000.0;

/// Everything about a mesh that can be counted or measured. Lengths in model units.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
pub struct MeshFacts {
    /// Triangles.
    pub faces: usize,
    /// Points of the surface.
    pub nodes: usize,
    /// Nodes' attributes, one for each chart that a node lies in.
    pub vertices: usize,
    /// Undirected edges.
    pub edges: usize,
    /// Parts that are joined over edges.
    pub components: usize,
    /// Whether every edge has two faces.
    pub closed: bool,
    /// Edges with one face.
    pub boundary_edges: usize,
    /// Rings that the boundary edges form.
    pub boundary_loops: usize,
    /// Whether the faces around every node are one fan.
    pub manifold: bool,
    /// Whether neighbours run through their edge in opposite directions.
    pub oriented: bool,
    /// Nodes − edges + faces.
    pub euler: i64,
    /// Handles, all parts together.
    pub genus: i64,
    /// Whether it has texture coordinates.
    pub textured: bool,
    /// Charts; 0 without texture coordinates.
    pub charts: usize,
    /// Edges at which texture coordinates differ from side to side.
    pub seam_edges: usize,
    /// Area of all faces.
    pub area: f64,
    /// Volume inside; an open mesh has none.
    pub volume: Option<f64>,
    /// Corners of the axis-parallel box around all nodes.
    pub bounds: [[f64; 3]; 2],
    /// Length of the shortest edge.
    pub shortest_edge: f64,
    /// Area of the smallest face.
    pub smallest_face: f64,
    /// Faces whose longest side is more than a thousand times their height.
    pub needles: usize,
    /// Bytes that the mesh takes in memory.
    pub bytes: usize,
}

/// Counts and measures a mesh. Linear in its size.
pub fn inspect(mesh: &Mesh) -> MeshFacts {
    let boundary: Vec<&Edge> = mesh.edges().iter().filter(|e| e.is_boundary()).collect();
    let euler = mesh.node_count() as i64 - mesh.edge_count() as i64 + mesh.face_count() as i64;
    let (components, boundary_loops) = (count(&mesh.parts(|_| true)), loops(mesh, &boundary));
    let textured = mesh.is_textured();
    let seams = |e: &&Edge| textured && mesh.is_seam(e);
    let sizes = Sizes::of(mesh);
    MeshFacts {
        faces: mesh.face_count(),
        nodes: mesh.node_count(),
        vertices: mesh.vertex_count(),
        edges: mesh.edge_count(),
        components,
        closed: boundary.is_empty(),
        boundary_edges: boundary.len(),
        boundary_loops,
        manifold: has_whole_fans(mesh),
        oriented: mesh.edges().iter().all(|e| is_oriented(mesh, e)),
        euler,
        genus: components as i64 - (euler + boundary_loops as i64) / 2,
        textured,
        charts: if textured { count(&mesh.charts()) } else { 0 },
        seam_edges: mesh.edges().iter().filter(seams).count(),
        area: sizes.area,
        volume: boundary.is_empty().then_some(sizes.volume),
        bounds: mesh.bounds().map(|p| p.to_array()),
        shortest_edge: shortest_edge(mesh),
        smallest_face: sizes.smallest,
        needles: sizes.needles,
        bytes: mesh.bytes(),
    }
}

/// How many parts have these names, each that of its lowest member.
fn count(names: &[u32]) -> usize {
    names.iter().enumerate().filter(|(i, name)| *i == **name as usize).count()
}

fn loops(mesh: &Mesh, boundary: &[&Edge]) -> usize {
    let mut union = Union::new(mesh.node_count());
    boundary.iter().for_each(|e| union.join(e.nodes[0].0, e.nodes[1].0));
    let mut names: Vec<u32> = boundary.iter().map(|e| union.find(e.nodes[0].0)).collect();
    names.sort_unstable();
    names.dedup();
    names.len()
}

fn has_whole_fans(mesh: &Mesh) -> bool {
    let mut faces = vec![0usize; mesh.node_count()];
    mesh.faces().iter().flat_map(|f| f.nodes).for_each(|n| faces[n.at()] += 1);
    faces.iter().enumerate().all(|(n, &count)| mesh.fan(NodeId::of(n)).count() == count)
}

fn is_oriented(mesh: &Mesh, edge: &Edge) -> bool {
    let runs = |face: FaceId, [from, to]: [NodeId; 2]| {
        let nodes = mesh.face(face).nodes;
        (0..3).any(|i| nodes[i] == from && nodes[(i + 1) % 3] == to)
    };
    let [a, b] = edge.nodes;
    runs(edge.faces[0], [a, b]) && (edge.is_boundary() || runs(edge.faces[1], [b, a]))
}

fn shortest_edge(mesh: &Mesh) -> f64 {
    let length = |e: &Edge| mesh.position(e.nodes[0]).distance(mesh.position(e.nodes[1]));
    mesh.edges().iter().map(length).fold(f64::INFINITY, f64::min)
}

struct Sizes {
    area: f64,
    volume: f64,
    smallest: f64,
    needles: usize,
}

impl Sizes {
    fn of(mesh: &Mesh) -> Self {
        let mut sizes = Self { area: 0.0, volume: 0.0, smallest: f64::INFINITY, needles: 0 };
        // Seen from a corner of the box the terms of the volume stay small.
        let (origin, mut six_volumes) = (mesh.bounds()[0], 0.0);
        for face in 0..mesh.face_count() {
            let [a, b, c] = mesh.triangle(FaceId::of(face)).map(|p| p - origin);
            let area = 0.5 * (b - a).cross(c - a).length();
            let longest = a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a));
            sizes.area += area;
            six_volumes += a.dot(b.cross(c));
            sizes.smallest = sizes.smallest.min(area);
            sizes.needles += usize::from(2.0 * area * NEEDLE < longest);
        }
        sizes.volume = six_volumes / 6.0;
        sizes
    }
}

/// Writes what is known about a mesh, and what was changed while reading it, for a person.
pub fn write_facts(facts: &MeshFacts, notes: &[Note], out: &mut dyn Write) -> io::Result<()> {
    let f = facts;
    let yes = |b: bool| if b { "yes" } else { "no" };
    let [low, high] = f.bounds;
    let charts =
        if f.textured { format!("{}, {} seam edges", f.charts, f.seam_edges) } else { "none".into() };
    let rows = [
        ("faces", f.faces.to_string()),
        ("nodes", format!("{} ({} vertices)", f.nodes, f.vertices)),
        ("edges", f.edges.to_string()),
        ("components", f.components.to_string()),
        (
            "closed",
            format!("{} ({} boundary edges in {} loops)", yes(f.closed), f.boundary_edges, f.boundary_loops),
        ),
        ("manifold", yes(f.manifold).into()),
        ("oriented", yes(f.oriented).into()),
        ("euler", format!("{} (genus {})", f.euler, f.genus)),
        ("charts", charts),
        ("area", f.area.to_string()),
        ("volume", f.volume.map_or("none, it is open".into(), |v| v.to_string())),
        ("bounds", format!("{low:?} to {high:?}")),
        ("shortest edge", f.shortest_edge.to_string()),
        ("smallest face", format!("{} ({} needles)", f.smallest_face, f.needles)),
        ("memory", format!("{} bytes, {} a face", f.bytes, f.bytes / f.faces.max(1))),
    ];
    for (name, value) in rows {
        writeln!(out, "{name:<14} {value}")?;
    }
    for note in notes {
        writeln!(out, "note: {} x {}: {}", note.what, note.count, note.detail)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use glam::{DVec3, Vec2};

    use super::*;
    use crate::mesh::IndexedMesh;

    /// A torus of n x n quads, with one chart cut open along both circles.
    fn torus(n: u32) -> Mesh {
        let turn = |i: u32| f64::from(i) / f64::from(n) * std::f64::consts::TAU;
        let (mut mesh, at) = (IndexedMesh::default(), |i: u32, j: u32| i % n * n + j % n);
        for i in 0..n {
            for j in 0..n {
                let (s, c) = libm::sincos(turn(j));
                let (t, d) = libm::sincos(turn(i));
                mesh.positions.push(DVec3::new((2.0 + c) * d, (2.0 + c) * t, s));
                let corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
                let nodes = corners.map(|(i, j)| at(i, j));
                let uvs = corners.map(|(i, j)| i * (n + 1) + j);
                for [a, b, c] in [[0, 1, 2], [0, 2, 3]] {
                    mesh.faces.push([nodes[a], nodes[b], nodes[c]]);
                    mesh.face_uvs.push([uvs[a], uvs[b], uvs[c]]);
                }
            }
        }
        mesh.uvs =
            (0..(n + 1) * (n + 1)).map(|k| Vec2::new((k / (n + 1)) as f32, (k % (n + 1)) as f32)).collect();
        Mesh::build(&mesh).expect("a torus")
    }

    #[test]
    fn a_torus_is_told() {
        let facts = inspect(&torus(16));
        assert_eq!((facts.faces, facts.nodes, facts.edges, facts.vertices), (512, 256, 768, 289));
        assert_eq!((facts.components, facts.euler, facts.genus), (1, 0, 1));
        assert!(facts.closed && facts.manifold && facts.oriented && facts.textured);
        assert_eq!((facts.charts, facts.seam_edges), (1, 32));
        let smooth = 2.0 * 2.0 * std::f64::consts::PI * std::f64::consts::PI;
        assert!(facts.volume.is_some_and(|v| v > 0.9 * smooth && v < smooth), "{:?}", facts.volume);
    }

    #[test]
    fn an_open_strip_is_told() {
        let strip = IndexedMesh {
            positions: [[0., 0., 0.], [3., 0., 0.], [3., 4., 0.], [0., 4., 0.]].map(DVec3::from).to_vec(),
            faces: vec![[0, 1, 2], [0, 2, 3]],
            ..IndexedMesh::default()
        };
        let facts = inspect(&Mesh::build(&strip).expect("a strip"));
        assert_eq!((facts.boundary_edges, facts.boundary_loops, facts.genus), (4, 1, 0));
        assert_eq!((facts.area, facts.shortest_edge, facts.smallest_face), (12.0, 3.0, 6.0));
        assert!(!facts.closed && !facts.textured && facts.charts == 0);
        let mut text = Vec::new();
        let note = Note::new("welded", 2, "nodes".into());
        write_facts(&facts, &[note], &mut text).expect("to memory");
        let text = String::from_utf8(text).expect("text");
        assert!(text.contains("closed         no (4 boundary edges in 1 loops)"), "{text}");
        assert!(text.ends_with("note: welded x 2: nodes\n"));
    }
}
