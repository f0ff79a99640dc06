//! GP's and PP's invariants of pixels, as functions over images and texels, whoever painted.
//!
//! | check | of | holds if |
//! | --- | --- | --- |
//! | `border` | GP | the patch's outermost texels are transparent |
//! | `palette` | GP | every colour is a mixture of the palette's three |
//! | `within` | PP | what changed lies on a face of the job, or on its skirts and on no face |
//! | `finite` | PP | every (s, d) that was used is a number |
//!
//! They use other means than those who paint: `within` asks for each texel of a face's box on which side of the face's sides it lies, in f64
//! and with the coordinates as they are in the job.

use glam::{DVec2, Vec3, dvec2};

use super::spans::{COPIES, FARTHEST};
use crate::canvas::image::Image;
use crate::canvas::job::{PaintFace, PaintJob, PatchJob, SKIRT};
use crate::report::Check;

/// How far a colour may be from the palette, premultiplied, in 1/255: half for each of three channels and for what the alpha was rounded by, and
/// as much again for the conversion of a device.
const OFF_PALETTE: f32 = 2.0;

/// How far a texel's centre may lie outside of a face or a skirt, texels: more than corners are rounded by.
const OUTSIDE: f64 = 1.0 / 64.0;

/// How many culprits are named.
const NAMED: usize = 8;

/// A check that no texel breaks, with how many do.
fn none(check: &str, what: &str, bad: &[[u32; 2]]) -> Check {
    let fault = || Check::fail(check, format!("{} {what}", bad.len()));
    let verdict = if bad.is_empty() { Check::pass(check) } else { fault() };
    let names = bad.iter().take(NAMED).map(|[x, y]| format!("t{x},{y}"));
    Check { value: Some(bad.len() as f64), ..verdict }.culprits(names)
}

/// GP's invariants of a patch.
pub fn patch(job: &PatchJob, patch: &Image) -> Vec<Check> {
    vec![border(patch), palette(job, patch)]
}

/// The texels of an image.
fn texels(image: &Image) -> impl Iterator<Item = [u32; 2]> {
    let [w, h] = image.size;
    (0..h).flat_map(move |y| (0..w).map(move |x| [x, y]))
}

/// The patch's outermost texels are transparent, so it ends nowhere in a step.
pub fn border(patch: &Image) -> Check {
    let [w, h] = patch.size;
    let outermost = texels(patch).filter(|[x, y]| *x == 0 || *y == 0 || x + 1 == w || y + 1 == h);
    let bad: Vec<_> = outermost.filter(|[x, y]| patch.at(*x, *y)[3] != 0).collect();
    none("border", "texels of the border are not transparent", &bad)
}

/// Every colour lies within the triangle of `inner`, `dark` and `light`, to rounding. The triangle is scaled by the texel's alpha instead of
/// dividing the texel by it, which would scale the rounding.
pub fn palette(job: &PatchJob, patch: &Image) -> Check {
    let hull = job.palette.map(Vec3::from);
    let near = |[x, y]: &[u32; 2]| {
        let [r, g, b, a] = patch.at(*x, *y).map(f32::from);
        distance(Vec3::new(r, g, b), hull.map(|c| c * a)) <= OFF_PALETTE
    };
    let bad: Vec<_> = texels(patch).filter(|texel| !near(texel)).collect();
    none("palette", "texels have a colour that no mixture of the palette gives", &bad)
}

/// The distance of a point from a triangle, which may be a line or a point.
fn distance(p: Vec3, [a, b, c]: [Vec3; 3]) -> f32 {
    let sides = [(a, b), (b, c), (c, a)];
    let normal = (b - a).cross(c - a);
    let area = normal.length();
    if area > 0.0 && sides.iter().all(|(from, to)| normal.dot((to - from).cross(p - from)) >= 0.0) {
        return (normal.dot(p - a) / area).abs();
    }
    sides.iter().map(|(from, to)| to_segment(p, *from, *to)).fold(f32::INFINITY, f32::min)
}

fn to_segment(p: Vec3, a: Vec3, b: Vec3) -> f32 {
    let along = b - a;
    let length = along.length_squared();
    let t = if length > 0.0 { ((p - a).dot(along) / length).clamp(0.0, 1.0) } else { 0.0 };
    p.distance(a + along * t)
}

/// Every texel that changed lies on a face of the job; or on a skirt of one and, by the mesh's mask, on no face at all.
pub fn within(job: &PaintJob, size: [u32; 2], mask: &[u8], changed: &[[u32; 2]]) -> Check {
    let board = Board::new(job, size, changed);
    let free = |[x, y]: [u32; 2]| mask.get(y as usize * size[0] as usize + x as usize) == Some(&0);
    let allowed = |texel: [u32; 2]| match board.at(texel) {
        Lies::OnFace => true,
        Lies::OnSkirt => free(texel),
        Lies::Outside => false,
    };
    let bad: Vec<_> = changed.iter().copied().filter(|texel| !allowed(*texel)).collect();
    none("within", "texels changed that lie on no face of the painting and on no free skirt", &bad)
}

/// Every coordinate is a number; `used` are texels with their (s, d).
pub fn finite(used: impl IntoIterator<Item = ([u32; 2], [f32; 2])>) -> Check {
    let wrong = used.into_iter().filter(|(_, at)| !at.iter().all(|v| v.is_finite()));
    let bad: Vec<_> = wrong.map(|(texel, _)| texel).collect();
    none("finite", "texels were painted with coordinates that are no numbers", &bad)
}

/// Where a texel lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Lies {
    Outside,
    OnSkirt,
    OnFace,
}

/// Where the texels lie of the box around those that changed.
struct Board {
    from: [u32; 2],
    size: [u32; 2],
    marks: Vec<Lies>,
}

impl Board {
    fn new(job: &PaintJob, map: [u32; 2], changed: &[[u32; 2]]) -> Self {
        let fold = |pick: fn(u32, u32) -> u32| {
            changed.iter().copied().reduce(|p, q| [pick(p[0], q[0]), pick(p[1], q[1])])
        };
        let (from, to) = (fold(u32::min).unwrap_or([1; 2]), fold(u32::max).unwrap_or([0; 2]));
        let size = [0, 1].map(|k| to[k] + 1 - from[k]);
        let marks = vec![Lies::Outside; size[0] as usize * size[1] as usize];
        let mut board = Self { from, size, marks };
        let shapes = job.faces.iter().filter_map(|face| Shape::new(face, map));
        shapes.for_each(|shape| board.mark(&shape, map.map(f64::from)));
        board
    }

    fn index(&self, [x, y]: [u32; 2]) -> usize {
        (y - self.from[1]) as usize * self.size[0] as usize + (x - self.from[0]) as usize
    }

    /// One of those that changed.
    fn at(&self, texel: [u32; 2]) -> Lies {
        self.marks[self.index(texel)]
    }

    /// Marks the texels of a face and of its skirts, wherever maps repeat to.
    fn mark(&mut self, shape: &Shape, [w, h]: [f64; 2]) {
        let [least, most] = shape.bounds(1.5 * f64::from(SKIRT));
        let maps = |from: f64, to: f64, side: f64| (from / side).floor() as i64..=(to / side).floor() as i64;
        for j in maps(least.y, most.y, h) {
            for i in maps(least.x, most.x, w) {
                let by = dvec2(i as f64 * w, j as f64 * h);
                self.mark_copy(shape, [least - by, most - by], by);
            }
        }
    }

    fn mark_copy(&mut self, shape: &Shape, [least, most]: [DVec2; 2], by: DVec2) {
        let range = |least: f64, most: f64, k: usize| {
            // Casts end at the type's bounds.
            (least.floor() as u32).max(self.from[k])..(most.ceil() as u32).min(self.from[k] + self.size[k])
        };
        let (rows, columns) = (range(least.y, most.y, 1), range(least.x, most.x, 0));
        for y in rows {
            for x in columns.clone() {
                let lies = shape.lies(dvec2(f64::from(x) + 0.5, f64::from(y) + 0.5) + by);
                let index = self.index([x, y]);
                self.marks[index] = self.marks[index].max(lies);
            }
        }
    }
}

/// A face and its skirts on the map, in texels.
struct Shape {
    corners: [DVec2; 3],
    /// Unit vectors along the sides, and outwards.
    along: [DVec2; 3],
    out: [DVec2; 3],
    open: u8,
}

impl Shape {
    /// `None` without area, or where [`spans`](super::spans) leaves the face out.
    fn new(face: &PaintFace, map: [u32; 2]) -> Option<Self> {
        let [w, h] = map.map(f64::from);
        let corners = face.uv.map(|c| dvec2(f64::from(c.x) * w, (1.0 - f64::from(c.y)) * h));
        let along = [0, 1, 2].map(|i| (corners[(i + 1) % 3] - corners[i]).normalize_or_zero());
        let area = (corners[1] - corners[0]).perp_dot(corners[2] - corners[0]);
        let out = along.map(|t| dvec2(t.y, -t.x) * area.signum());
        let shape = Self { corners, along, out, open: face.open };
        let [least, most] = shape.bounds(0.0);
        let fits = (most - least).cmple(dvec2(w, h) * COPIES as f64 + 1.0).all();
        let near = face.uv.iter().all(|c| c.abs().max_element() <= FARTHEST);
        (area != 0.0 && fits && near).then_some(shape)
    }

    fn bounds(&self, margin: f64) -> [DVec2; 2] {
        let [a, b, c] = self.corners;
        [a.min(b).min(c) - margin, a.max(b).max(c) + margin]
    }

    fn lies(&self, p: DVec2) -> Lies {
        let [least, most] = self.bounds(OUTSIDE);
        let outside = |side: usize| self.out[side].dot(p - self.corners[side]);
        if p.clamp(least, most) == p && (0..3).all(|side| outside(side) <= OUTSIDE) {
            return Lies::OnFace;
        }
        let far = f64::from(SKIRT) + OUTSIDE;
        let skirted = (0..3).filter(|side| self.open >> side & 1 == 1).any(|side| {
            let length = self.corners[side].distance(self.corners[(side + 1) % 3]);
            let ahead = self.along[side].dot(p - self.corners[side]);
            (-OUTSIDE..=far).contains(&outside(side)) && (-far..=length + far).contains(&ahead)
        });
        if skirted { Lies::OnSkirt } else { Lies::Outside }
    }
}

#[cfg(test)]
mod tests;
