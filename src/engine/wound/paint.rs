//! PP: which faces a cut's patch and discoloration go on, and how they lie there (Lam 2016, §5.3.2 and §5.4).
//!
//! The skin is walked once, out to c_h ([`surface`](super::surface)). A face that the line divides is named in the parts that MC will make of
//! it, so that the line is where d = 0 to the last digit, bends included, and from one face to the next nothing jumps. Faces come by their
//! distance from the line, then by id: those within c_h / 2 are a prefix.
//!
//! [`Distance::Texture`] lays the patch on as the thesis does, to compare with: each face goes by the link whose centre is nearest to its
//! own in the texture, and (s, d) are measured there, in texels over ρ. Faces are those of the same walk.

use std::sync::Arc;

use glam::{DVec2, Vec2};
use rustc_hash::FxHashMap;

use super::chain::{At, Chain};
use super::flat::{sides_to_line, triangle_to_line};
use super::patch::{Patch, chance, offset};
use super::settle::Formed;
use super::surface::{Placed, SkinLink, walk};
use crate::canvas::job::{PaintFace, PaintJob, Painting};
use crate::canvas::look::{Distance, Wound};
use crate::mesh::refine::FaceSplit;
use crate::mesh::{FaceId, Mesh, NodeId, Surface};

/// What a corner of a painted face is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Corner {
    /// A node.
    Node(NodeId),
    /// A point of the line, as an index into the chain.
    Point(u32),
}

/// A painting, and what is known of how it came about.
#[derive(Clone, Debug, PartialEq)]
pub struct Painted {
    /// The painting.
    pub painting: Arc<Painting>,
    /// What the corners of its faces are.
    pub corners: Vec<[Corner; 3]>,
    /// Nodes at which fronts meet.
    pub torn: Vec<NodeId>,
    /// Faces within the radius that are left out: see [`Walk::refused`](super::surface::Walk::refused).
    pub refused: Vec<FaceId>,
}

/// A line on a mesh, with all that painting it asks for.
#[derive(Clone, Copy, Debug)]
pub struct Place<'a> {
    /// The mesh, before the line is merged.
    pub mesh: &'a Mesh,
    /// The line, and how it divides faces.
    pub formed: &'a Formed,
    /// Arc length at its points.
    pub arc: &'a [f64],
    /// Its links in skin.
    pub links: &'a [SkinLink],
    /// GP's patch.
    pub patch: &'a Patch,
    /// Size of the colour map.
    pub map: [u32; 2],
}

/// A face to paint on, or a part of one.
struct Piece {
    face: PaintFace,
    corners: [Corner; 3],
    distance: f64,
}

/// Lays a patch and a discoloration on the skin.
pub fn paint(place: &Place<'_>, look: &Wound, seed: u64) -> Painted {
    let radius = place.patch.height;
    let walk = walk(place.mesh, &place.formed.chain, place.links, place.patch.length, radius);
    let by_texture = look.distance == Distance::Texture && place.patch.density > 0.0;
    let pieces = match by_texture {
        true => in_texture(place, &walk.faces),
        false => on_surface(place, &walk.faces),
    };
    // Parts of one face stay in their order. Only keys are moved: a piece is large.
    let mut order: Vec<(f64, u32, usize)> =
        (0..).zip(&pieces).map(|(i, p)| (p.distance, p.face.face, i)).collect();
    order.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    let inner = order.partition_point(|key| key.0 <= 0.5 * radius);
    let corners = order.iter().map(|key| pieces[key.2].corners).collect();
    let faces = order.iter().map(|key| pieces[key.2].face).collect();
    let paint = job(place, look, seed, faces, inner);
    let painting = Arc::new(Painting { patch: place.patch.job.clone(), paint });
    Painted { painting, corners, torn: walk.torn, refused: walk.refused }
}

fn job(place: &Place<'_>, look: &Wound, seed: u64, faces: Vec<PaintFace>, inner: usize) -> PaintJob {
    let between = |[least, most]: [f32; 2], purpose| least + (most - least) * chance(seed, purpose);
    let [r, g, b] = look.discolor;
    PaintJob {
        length: place.patch.length as f32,
        height: place.patch.height as f32,
        factor: [between(r, "discolour red"), between(g, "discolour green"), between(b, "discolour blue")],
        offset: ["discolour x", "discolour y"].map(|purpose| offset(seed, purpose)),
        noise: look.blotches,
        noise_scale: (place.patch.density / f64::from(place.map[0])) as f32,
        faces,
        inner,
    }
}

/// The faces as they were laid down; those under the line in parts.
fn on_surface(place: &Place<'_>, faces: &[Placed]) -> Vec<Piece> {
    let Formed { chain, refinement, made_at } = place.formed;
    let divided: FxHashMap<FaceId, &FaceSplit> = refinement.faces.iter().map(|s| (s.face, s)).collect();
    let mut point_of = vec![0; refinement.points.len()];
    (0u32..).zip(made_at).for_each(|(i, made)| made.iter().for_each(|&m| point_of[m as usize] = i));
    let mut pieces = Vec::with_capacity(faces.len() + 2 * divided.len());
    for placed in faces {
        let open = open_sides(place.mesh, placed.face);
        match divided.get(&placed.face) {
            None => pieces.push(whole(place.mesh, placed, open)),
            Some(split) => {
                let under = Under { place, placed, open, split, chain, point_of: &point_of };
                pieces.extend(split.children.iter().map(|child| under.part(*child)));
            }
        }
    }
    pieces.retain(|piece| piece.distance <= place.patch.height);
    pieces
}

fn whole(mesh: &Mesh, placed: &Placed, open: u8) -> Piece {
    let f = mesh.face(placed.face);
    let uv = f.vertices.map(|v| mesh.vertex(v).uv);
    let face = PaintFace { face: placed.face.0, uv, at: placed.at.map(|at| at.as_vec2()), open };
    Piece { face, corners: f.nodes.map(Corner::Node), distance: placed.distance }
}

/// The sides of a face over which its chart does not go on: a boundary, a gutter, or other vertices across.
fn open_sides(mesh: &Mesh, face: FaceId) -> u8 {
    (0..3).filter(|&side| is_open(mesh, face, side)).fold(0, |open, side| open | 1 << side)
}

fn is_open(mesh: &Mesh, face: FaceId, side: usize) -> bool {
    let f = mesh.face(face);
    let Some(across) = mesh.edge(f.edges[side]).other_face(face).some() else { return true };
    let g = mesh.face(across);
    let Some(there) = g.side(f.edges[side]) else { return true };
    // The face across runs along the edge the other way.
    let ours = [f.vertices[side], f.vertices[(side + 1) % 3]];
    g.surface == Surface::Gutter || [g.vertices[(there + 1) % 3], g.vertices[there]] != ours
}

/// A face under the line.
struct Under<'a> {
    place: &'a Place<'a>,
    placed: &'a Placed,
    open: u8,
    split: &'a FaceSplit,
    chain: &'a Chain,
    /// The chain's point of each point of the refinement.
    point_of: &'a [u32],
}

impl Under<'_> {
    fn part(&self, child: [u8; 3]) -> Piece {
        let corners = child.map(|c| self.corner(c as usize));
        let at = corners.map(|(_, _, at, _)| at);
        let sides = corners.map(|(_, _, _, sides)| sides);
        // A part's side lies on the face's side on which both of its ends lie.
        let open = (0..3)
            .filter(|&i| sides[i] & sides[(i + 1) % 3] & self.open != 0)
            .fold(0, |open, i| open | 1 << i);
        let uv = corners.map(|(_, uv, _, _)| uv);
        let face = PaintFace { face: self.placed.face.0, uv, at: at.map(|at| at.as_vec2()), open };
        let distance = triangle_to_line(&at, sides_to_line(&at, self.place.patch.length));
        Piece { face, corners: corners.map(|(corner, ..)| corner), distance }
    }

    /// What a corner is, its texture coordinates and (s, d), and the face's sides on which it lies, as bits.
    fn corner(&self, local: usize) -> (Corner, Vec2, DVec2, u8) {
        let mesh = self.place.mesh;
        let f = mesh.face(self.placed.face);
        if local < 3 {
            let sides = 1 << local | 1 << ((local + 2) % 3);
            return (
                Corner::Node(f.nodes[local]),
                mesh.vertex(f.vertices[local]).uv,
                self.placed.at[local],
                sides,
            );
        }
        let index = self.point_of[self.split.points[local - 3] as usize];
        let point = &self.chain.points[index as usize];
        let sides = match point.at {
            At::Edge(edge) => f.side(edge).map_or(0, |side| 1 << side),
            _ => 0,
        };
        let at = DVec2::new(self.place.arc[index as usize], 0.0);
        (Corner::Point(index), point.uv_in(mesh, self.placed.face), at, sides)
    }
}

/// The faces with (s, d) measured in the texture (Lam 2016, Algorithms 5.2 and 5.3).
fn in_texture(place: &Place<'_>, faces: &[Placed]) -> Vec<Piece> {
    let scale = DVec2::from(place.map.map(f64::from)) / place.patch.density;
    let chain = &place.formed.chain;
    let ends = |link: &SkinLink| {
        [link.link, link.link + 1].map(|i| chain.points[i].uv_in(place.mesh, link.face).as_dvec2() * scale)
    };
    let links: Vec<(f64, [DVec2; 2])> = place.links.iter().map(|link| (link.start, ends(link))).collect();
    let lay = |placed: &Placed| {
        let mut piece = whole(place.mesh, placed, open_sides(place.mesh, placed.face));
        let corners = piece.face.uv.map(|uv| uv.as_dvec2() * scale);
        let centre = (corners[0] + corners[1] + corners[2]) / 3.0;
        let away = |[a, b]: [DVec2; 2]| ((a + b) * 0.5).distance_squared(centre);
        let nearest = links.iter().min_by(|a, b| away(a.1).total_cmp(&away(b.1)));
        if let Some(&(start, [from, to])) = nearest {
            let along = (to - from).normalize_or(DVec2::X);
            let at = |uv: DVec2| DVec2::new(start + along.dot(uv - from), along.perp_dot(uv - from));
            piece.face.at = corners.map(|uv| at(uv).as_vec2());
        }
        piece
    };
    faces.iter().map(lay).collect()
}
