//! The inside of the cut: two walls from the rims to the bottom (Lam 2016, §4.3.2).
//!
//! The thesis digs along the first view ray by one depth for all. At a grazing view that runs under the skin, and in an ear it comes out at the back.
//! Here each bottom node goes along minus the normal, averaged along the line and projected into the cutting plane; at
//! most half as deep as there is tissue; and less, by halves, wherever the gutter would cross the surface or itself. Crossing is
//! decided by exact signs, so that the gutter crosses nothing is a promise.
//!
//! The gutter is a chart of its own in a texture of its own: u runs along the line, v from 1 at the rims to 0 at the bottom.

use std::ops::RangeInclusive;

use glam::{DVec3, Vec2};
use rustc_hash::FxHashMap;

use super::opening::Opening;
use super::slit::Slit;
use super::{Carved, Obstacle, Opened, Place, arc_lengths, least};
use crate::engine::wound::merge::{Line, face_box};
use crate::geometry::bvh::{Aabb, Ray};
use crate::geometry::crossing::{Corners, cross};
use crate::mesh::{Edge, EdgeId, Face, FaceId, Mesh, NodeId, Surface, Vertex, VertexId};
use crate::report::Rejection;

/// How much of the tissue below a node its gutter may take.
const SHARE_OF_TISSUE: f64 = 0.5;
/// How often a depth is reduced to keep the gutter from crossing something.
const ATTEMPTS: usize = 24;
/// After how many of them the opening narrows too.
const PATIENCE: usize = 5;

/// The direction in which the gutter goes down from each opened node: in the cutting plane, unit length.
///
/// The normal is averaged along the line over as far as the gutter is deep: over less, neighbouring directions would meet before they
/// reach the bottom, and the walls fold.
pub fn inward(place: &Place<'_>, line: &Line, range: &RangeInclusive<usize>, depth: f64) -> Vec<DVec3> {
    let mesh = &*place.mesh;
    let nodes = &line.nodes[range.clone()];
    let s = arc_lengths(mesh, nodes);
    let last = nodes.len() - 1;
    let share = |i: usize| s[(i + 1).min(last)] - s[i.saturating_sub(1)];
    let mut sums = Vec::with_capacity(nodes.len() + 1);
    sums.push(DVec3::ZERO);
    for (i, &node) in nodes.iter().enumerate() {
        sums.push(sums[i] + node_normal(mesh, node) * share(i));
    }
    let averaged = |i: usize| {
        let from = s.partition_point(|&v| v < s[i] - 0.5 * depth).min(i.saturating_sub(1));
        let to = s.partition_point(|&v| v <= s[i] + 0.5 * depth).max((i + 2).min(last + 1));
        sums[to] - sums[from]
    };
    (0..nodes.len())
        .map(|i| in_plane(place, averaged(i).normalize_or_zero(), tangent(mesh, nodes, i)))
        .collect()
}

fn tangent(mesh: &Mesh, nodes: &[NodeId], i: usize) -> DVec3 {
    mesh.position(nodes[(i + 1).min(nodes.len() - 1)]) - mesh.position(nodes[i.saturating_sub(1)])
}

fn node_normal(mesh: &Mesh, node: NodeId) -> DVec3 {
    let areas = mesh.fan(node).map(|(f, _)| {
        let [a, b, c] = mesh.triangle(f);
        (b - a).cross(c - a)
    });
    areas.sum::<DVec3>().normalize_or_zero()
}

/// Minus a normal, projected into the plane. Where the surface lies in the plane nothing is left of it: then across the line,
/// away from the eye.
fn in_plane(place: &Place<'_>, normal: DVec3, tangent: DVec3) -> DVec3 {
    let unit = place.plane.unit();
    let projected = normal - unit * unit.dot(normal);
    if projected.length() > 1e-3 * normal.length() {
        return -projected.normalize();
    }
    let [eye, a, _] = place.plane.points;
    let across = tangent.cross(unit).normalize_or(DVec3::Z);
    if across.dot(a - eye) < 0.0 { -across } else { across }
}

/// Makes the gutter, as deep as it can be.
pub(super) fn dig(
    place: &mut Place<'_>,
    carved: &mut Carved,
    opening: Opening,
    slit: &Slit,
    inward: &[DVec3],
) -> Result<(), Obstacle> {
    bound_depths(place, carved, inward)?;
    let last = carved.opened.len() - 1;
    for i in 1..last {
        let o = carved.opened[i];
        carved.opened[i].bottom = place.mesh.push_node(o.at + inward[i] * o.depth);
    }
    carved.opened[0].depth = 0.0;
    carved.opened[last].depth = 0.0;
    let links = build(place.mesh, carved, slit);
    carved.gutter = links.iter().flatten().copied().collect();
    keep_clear(place, carved, opening, inward, &links)?;
    for (i, link) in links.iter().enumerate() {
        let beside = slit.right_faces[i].0;
        link.iter().for_each(|_| place.bvh.insert(beside, &|f| face_box(place.mesh, f)));
    }
    shade(place.mesh, carved);
    Ok(())
}

/// Half of the tissue below each node, or the planned depth if that is less.
fn bound_depths(place: &Place<'_>, carved: &mut Carved, inward: &[DVec3]) -> Result<(), Obstacle> {
    let last = carved.opened.len() - 1;
    for i in 1..last {
        let o = &mut carved.opened[i];
        let tissue = thickness(place, o, inward[i], o.depth / SHARE_OF_TISSUE);
        o.depth = o.depth.min(tissue * SHARE_OF_TISSUE);
        if o.depth < least(place.largest) {
            let detail = format!("there are {tissue:e} of tissue below {}", o.left);
            return Err(Obstacle { nodes: vec![i], why: Rejection::new("no-tissue", detail) });
        }
    }
    Ok(())
}

/// How far it is to the next face below a node, not counting those that meet there; at least `enough` is not told apart.
///
/// The hierarchy also offers faces whose own box the ray does not enter. Where one lies edge-on it would be met by rounding alone; so its box counts
/// as well, and the answer does not depend on how the hierarchy came about.
fn thickness(place: &Place<'_>, o: &Opened, direction: DVec3, enough: f64) -> f64 {
    let (ray, mut nearest) = (Ray { origin: o.at, direction }, enough);
    place.bvh.along(ray, enough, |item| {
        let face = place.mesh.face(FaceId(item));
        if face.corner(o.left).is_none()
            && face.corner(o.right).is_none()
            && let Some(entered) = ray.enters(&face_box(place.mesh, item), nearest)
            && let Some(t) = distance_along(o.at, direction, place.mesh.triangle(FaceId(item)))
        {
            nearest = nearest.min(t.max(entered));
        }
        nearest
    });
    nearest
}

/// Where a ray meets a triangle (Möller and Trumbore 1997); rounded, as nothing but a bound comes of it.
fn distance_along(origin: DVec3, direction: DVec3, [a, b, c]: [DVec3; 3]) -> Option<f64> {
    let (e1, e2) = (b - a, c - a);
    let p = direction.cross(e2);
    let det = e1.dot(p);
    let s = origin - a;
    let q = s.cross(e1);
    let (u, v, t) = (s.dot(p) / det, direction.dot(q) / det, e2.dot(q) / det);
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0).then_some(t)
}

/// The gutter's faces, link by link, and the edges between them.
fn build(mesh: &mut Mesh, carved: &Carved, slit: &Slit) -> Vec<Vec<FaceId>> {
    let vertices: Vec<[VertexId; 3]> = carved.opened.iter().map(|o| rim_vertices(mesh, carved, o)).collect();
    let mut edges: FxHashMap<(NodeId, NodeId), EdgeId> = FxHashMap::default();
    for i in 0..slit.left_edges.len() {
        edges.insert(key(slit.left[i], slit.left[i + 1]), slit.left_edges[i]);
        edges.insert(key(slit.right[i], slit.right[i + 1]), slit.right_edges[i]);
    }
    let corner = |i: usize, which: usize| {
        let o = &carved.opened[i];
        ([o.left, o.right, o.bottom][which], vertices[i][which])
    };
    let (left, right, bottom) = (0, 1, 2);
    let last = carved.opened.len() - 1;
    let mut links = Vec::with_capacity(last);
    for i in 0..last {
        let mut triangles = Vec::with_capacity(4);
        if i > 0 {
            triangles.push([corner(i + 1, left), corner(i, left), corner(i, bottom)]);
            triangles.push([corner(i, right), corner(i + 1, right), corner(i, bottom)]);
        }
        if i + 1 < last {
            triangles.push([corner(i + 1, left), corner(i, bottom), corner(i + 1, bottom)]);
            triangles.push([corner(i, bottom), corner(i + 1, right), corner(i + 1, bottom)]);
        }
        links.push(triangles.into_iter().map(|t| add_face(mesh, t, &mut edges)).collect());
    }
    for i in 1..last {
        let bottom = carved.opened[i].bottom;
        let edge = edges[&key(carved.opened[i].left, bottom)];
        let face = mesh.edge(edge).faces.into_iter().find_map(FaceId::some).unwrap_or(FaceId::NONE);
        mesh.set_anchor(bottom, face);
    }
    links
}

fn key(a: NodeId, b: NodeId) -> (NodeId, NodeId) {
    (a.min(b), a.max(b))
}

/// The gutter's own vertices at an opened node: left rim, right rim, bottom. One for all three at an end.
fn rim_vertices(mesh: &mut Mesh, carved: &Carved, o: &Opened) -> [VertexId; 3] {
    let u = (o.s / carved.length) as f32;
    let mut make = |v: f32| mesh.push_vertex(Vertex { uv: Vec2::new(u, v), ..Vertex::default() });
    if o.left == o.right {
        return [make(1.0); 3];
    }
    [make(1.0), make(1.0), make(0.0)]
}

fn add_face(
    mesh: &mut Mesh,
    corners: [(NodeId, VertexId); 3],
    edges: &mut FxHashMap<(NodeId, NodeId), EdgeId>,
) -> FaceId {
    let id = FaceId::of(mesh.face_count());
    let sides = [0, 1, 2].map(|i| {
        let nodes = [corners[i].0, corners[(i + 1) % 3].0];
        let edge = *edges
            .entry(key(nodes[0], nodes[1]))
            .or_insert_with(|| mesh.push_edge(Edge { nodes, faces: [FaceId::NONE; 2] }));
        let mut value = mesh.edge(edge);
        value.faces[usize::from(value.nodes[0] != nodes[0])] = id;
        mesh.set_edge(edge, value);
        edge
    });
    mesh.push_face(Face {
        nodes: corners.map(|c| c.0),
        vertices: corners.map(|c| c.1),
        edges: sides,
        surface: Surface::Gutter,
    })
}

/// Makes the gutter shallower wherever it crosses something, until it crosses nothing.
///
/// Less depth alone helps where the bottom is in the way. Where a rim is (it was moved through a wall of an earlier cut, say), the
/// opening narrows too: with neither width nor depth the gutter is the line, which crosses nothing.
fn keep_clear(
    place: &mut Place<'_>,
    carved: &mut Carved,
    mut opening: Opening,
    inward: &[DVec3],
    links: &[Vec<FaceId>],
) -> Result<(), Obstacle> {
    let mut halved = vec![0usize; carved.opened.len()];
    let all: Vec<usize> = (0..links.len()).collect();
    let mut suspects = all.clone();
    let mut narrowed = false;
    while !suspects.is_empty() {
        let shallow = crossing_nodes(place, carved, links, &suspects);
        if shallow.is_empty() && std::mem::take(&mut narrowed) {
            // What an opening that narrowed let go may have come to lie elsewhere.
            suspects.clone_from(&all);
            continue;
        }
        for &i in &shallow {
            halved[i] += 1;
            let o = &mut carved.opened[i];
            o.depth *= if halved[i] > PATIENCE { 0.25 } else { 0.5 };
            if halved[i] > ATTEMPTS || o.depth < least(place.largest) {
                let detail = format!("however shallow, the gutter at {} crosses something", o.left);
                return Err(Obstacle { nodes: vec![i], why: Rejection::new("no-tissue", detail) });
            }
            place.mesh.set_position(o.bottom, o.at + inward[i] * o.depth);
        }
        let mut changed = shallow.clone();
        let stuck: Vec<usize> = shallow.into_iter().filter(|&i| halved[i] > PATIENCE).collect();
        if !stuck.is_empty() {
            let before: Vec<f64> = carved.opened.iter().map(|o| o.half_width).collect();
            opening.narrow(place, carved, &stuck)?;
            changed.extend((0..before.len()).filter(|&i| before[i] != carved.opened[i].half_width));
            narrowed = true;
        }
        suspects = changed.iter().flat_map(|&i| [i - 1, i]).collect();
        suspects.sort_unstable();
        suspects.dedup();
    }
    carved.shallowed = carved.opened.iter().filter(|o| o.left != o.right && o.depth < carved.depth).count();
    Ok(())
}

/// The inner nodes of the links among `suspects` that cross something, and of the links that they cross.
fn crossing_nodes(
    place: &Place<'_>,
    carved: &Carved,
    links: &[Vec<FaceId>],
    suspects: &[usize],
) -> Vec<usize> {
    let mut nodes = Vec::new();
    for &i in suspects {
        let link = Link::new(place, carved, links, i);
        let rivals = link.crossed_links(place, carved, links);
        if !rivals.is_empty() || link.crosses_surface(place) {
            nodes.extend(std::iter::once(i).chain(rivals).flat_map(|j| [j, j + 1]));
        }
    }
    nodes.sort_unstable();
    nodes.dedup();
    nodes.retain(|&i| carved.opened[i].left != carved.opened[i].right);
    nodes
}

/// A face of the gutter, made ready for being tested against many.
struct Wall {
    corners: Corners,
    normal: DVec3,
    /// Farther from the wall's plane than this is off it, whatever was rounded.
    slack: f64,
}

impl Wall {
    fn new(place: &Place<'_>, face: FaceId) -> Self {
        let corners = corners(place.mesh, face);
        let [a, b, c] = corners.at;
        let normal = (b - a).cross(c - a);
        let slack = 1e-13 * place.largest * (b - a).abs().element_sum() * (c - a).abs().element_sum();
        Self { corners, normal, slack }
    }

    /// Whether the wall crosses a face; most are told apart by a few products.
    fn crosses(&self, other: &Corners) -> bool {
        !self.has_on_one_side(other) && overlap(&self.corners.at, &other.at) && cross(&self.corners, other)
    }

    fn has_on_one_side(&self, other: &Corners) -> bool {
        let (mut above, mut below) = (true, true);
        for i in (0..3).filter(|&i| !self.corners.ids.contains(&other.ids[i])) {
            let height = self.normal.dot(other.at[i] - self.corners.at[0]);
            above &= height > self.slack;
            below &= height < -self.slack;
        }
        above || below
    }
}

/// Whether the boxes around two triangles overlap.
fn overlap([a, b, c]: &[DVec3; 3], [d, e, f]: &[DVec3; 3]) -> bool {
    let apart = |low: DVec3, high: DVec3| low.cmpgt(high).any();
    !apart(a.min(*b).min(*c), d.max(*e).max(*f)) && !apart(d.min(*e).min(*f), a.max(*b).max(*c))
}

fn corners(mesh: &Mesh, face: FaceId) -> Corners {
    Corners { ids: mesh.face(face).nodes.map(|n| n.0), at: mesh.triangle(face) }
}

/// One end of a link of the gutter: the plane through the node's spoke, from the rims to the bottom, across the line.
///
/// The rims move along û alone, so they lie in it too, and a link is held between the planes of its two ends. What lies beyond one
/// of them crosses nothing of the link: this tells nearly all neighbours apart, the gutter's other links first of all.
struct Spoke {
    ids: [u32; 3],
    at: DVec3,
    /// Away from the link.
    outward: DVec3,
    slack: f64,
}

impl Spoke {
    /// The plane at the end `here` of a link whose other end is `there`; `None` where the link reaches through it.
    fn new(place: &Place<'_>, here: &Opened, there: &Opened) -> Option<Self> {
        let bottom = place.mesh.position(here.bottom);
        let outward = place.plane.unit().cross(bottom - here.at);
        let across = here.at - there.at;
        let outward = if outward.dot(across) < 0.0 { -outward } else { outward };
        let slack = 1e-13 * place.largest * outward.abs().element_sum();
        let spoke =
            Self { ids: [here.left, here.right, here.bottom].map(|n| n.0), at: here.at, outward, slack };
        let corners = [there.left, there.right, there.bottom].map(|n| place.mesh.position(n));
        corners.iter().all(|&p| spoke.height(p) < -slack).then_some(spoke)
    }

    fn height(&self, point: DVec3) -> f64 {
        self.outward.dot(point - self.at)
    }

    /// Whether a face lies beyond the plane, but for corners that it shares with the spoke.
    fn is_before(&self, other: &Corners) -> bool {
        (0..3).all(|i| self.ids.contains(&other.ids[i]) || self.height(other.at[i]) > self.slack)
    }

    /// Whether a spoke of the gutter lies beyond the plane.
    fn is_before_spoke(&self, place: &Place<'_>, other: &Opened) -> bool {
        self.height(other.at) > self.slack && self.height(place.mesh.position(other.bottom)) > self.slack
    }
}

/// A link of the gutter, made ready for being tested against many faces.
struct Link {
    index: usize,
    walls: Vec<Wall>,
    /// At its start and at its end.
    spokes: [Option<Spoke>; 2],
}

impl Link {
    fn new(place: &Place<'_>, carved: &Carved, links: &[Vec<FaceId>], index: usize) -> Self {
        let (start, end) = (&carved.opened[index], &carved.opened[index + 1]);
        Self {
            index,
            walls: links[index].iter().map(|&f| Wall::new(place, f)).collect(),
            spokes: [Spoke::new(place, start, end), Spoke::new(place, end, start)],
        }
    }

    fn crosses(&self, other: &Corners) -> bool {
        if self.spokes.iter().flatten().any(|s| s.is_before(other)) {
            return false;
        }
        self.walls.iter().any(|w| w.crosses(other))
    }

    /// Whether the link crosses a face of the surface around it.
    fn crosses_surface(&self, place: &Place<'_>) -> bool {
        let points: Vec<DVec3> = self.walls.iter().flat_map(|w| w.corners.at).collect();
        let mut found = false;
        place.bvh.overlapping(&Aabb::around(&points), |item| {
            found = self.crosses(&corners(place.mesh, FaceId(item)));
            !found
        });
        found
    }

    /// The other links that this one crosses.
    fn crossed_links(&self, place: &Place<'_>, carved: &Carved, links: &[Vec<FaceId>]) -> Vec<usize> {
        // A neighbour shares the spoke itself, so only its far end counts.
        let apart = |j: usize| {
            let (spoke, shared) = if j < self.index {
                (&self.spokes[0], self.index)
            } else {
                (&self.spokes[1], self.index + 1)
            };
            let ends = [j, j + 1].into_iter().filter(|&k| k != shared);
            let is_before = |s: &Spoke| ends.clone().all(|k| s.is_before_spoke(place, &carved.opened[k]));
            spoke.as_ref().is_some_and(is_before)
        };
        let others = (0..links.len()).filter(|&j| j != self.index && !apart(j));
        others.filter(|&j| links[j].iter().any(|&f| self.crosses(&corners(place.mesh, f)))).collect()
    }
}

/// Normals and tangents of the gutter's own vertices, from its faces.
fn shade(mesh: &mut Mesh, carved: &Carved) {
    let Some(along) = carved.opened.last().map(|o| (o.at - carved.opened[0].at).normalize_or(DVec3::X))
    else {
        return;
    };
    let mut sums: Vec<(VertexId, DVec3)> = Vec::with_capacity(carved.gutter.len() * 3);
    for &f in &carved.gutter {
        let [a, b, c] = mesh.triangle(f);
        let normal = (b - a).cross(c - a);
        sums.extend(mesh.face(f).vertices.map(|v| (v, normal)));
    }
    sums.sort_by_key(|s| s.0);
    for group in sums.chunk_by(|a, b| a.0 == b.0) {
        let normal = group.iter().map(|g| g.1).sum::<DVec3>().normalize_or(DVec3::Y);
        let mut vertex = mesh.vertex(group[0].0);
        (vertex.normal, vertex.tangent) = (normal.as_vec3(), along.as_vec3());
        mesh.set_vertex(group[0].0, crate::mesh::build::orthonormal(vertex));
    }
}

/// Whether a gutter face crosses any face of the mesh: the promise, for who wants to see it kept.
pub fn crosses_something(place: (&Mesh, &crate::geometry::bvh::Bvh), face: FaceId) -> Option<FaceId> {
    let (mesh, bvh) = place;
    let (mine, bounds) = (corners(mesh, face), face_box(mesh, face.0));
    let mut found = None;
    bvh.overlapping(&bounds, |item| {
        let other = FaceId(item);
        if other != face && face_box(mesh, item).overlaps(&bounds) && cross(&mine, &corners(mesh, other)) {
            found = Some(other);
        }
        found.is_none()
    });
    found
}
