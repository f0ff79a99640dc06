//! What a painting touches: its triangles on the map in the order in which they are drawn, and the map's tiles that they may change.
//!
//! Skirts come first, in the order of the job's faces and their sides, then the faces in theirs; each paints over those before it, and skirts
//! only where no face of the mesh lies ([`mask`](super::mask)). A skirt is a quad outside of an open side, drawn as two triangles; its (s, d) are
//! those of the face's affine map at its rounded corners. It begins a hair within the face, so that rounding leaves no slit between them.
//!
//! Maps repeat: a triangle that reaches over the map's border is there once for each side of it, moved by whole maps. What is left out is
//! said in `spans`.
//!
//! Nothing changes where the line is farther than c_h, or 0.03 c_l along it: there the patch and the discoloration have ended. So a
//! tile that a triangle meets only there is not in the list.

use crate::canvas::job::{PaintFace, PaintJob, SKIRT};

use super::spans::{self, Corners, PARTS, bounds, doubled_area, each_copy, place};

/// Texels along the side of a tile.
pub const TILE: u32 = 64;

/// How far a skirt reaches into its face, texels.
const HAIR: f64 = 2.0 / PARTS as f64;

/// A triangle to draw.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triangle {
    /// Corners in texels from the top left, rounded to 1/256.
    pub corners: [[f32; 2]; 3],
    /// (s, d) there, model units.
    pub at: [[f32; 2]; 3],
    /// Whether it is a skirt's, and must not paint where a face of the mesh lies.
    pub skirt: bool,
}

/// What a painting touches.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Layout {
    /// In the order of drawing; of two that cover a texel the later has it.
    pub triangles: Vec<Triangle>,
    /// The tiles that may change, by [`tile_index`], ascending.
    pub tiles: Vec<u32>,
}

/// How many tiles a map has across and down.
pub fn tiles_of(size: [u32; 2]) -> [u32; 2] {
    size.map(|side| side.div_ceil(TILE))
}

/// The number of a tile: they are counted row by row.
pub fn tile_index([x, y]: [u32; 2], size: [u32; 2]) -> u32 {
    y * tiles_of(size)[0] + x
}

/// The texels of a tile; the last ones of a row or column may be smaller.
pub fn tile_window(index: u32, size: [u32; 2]) -> spans::Window {
    let across = tiles_of(size)[0];
    let from = [index % across * TILE, index / across * TILE];
    spans::Window { from, to: [0, 1].map(|k| (from[k] + TILE).min(size[k])) }
}

/// Lays a painting out on a map.
pub fn lay_out(job: &PaintJob, size: [u32; 2]) -> Layout {
    let placed: Vec<Placed> = job.faces.iter().filter_map(|face| Placed::new(face, size)).collect();
    let skirts = placed.iter().flat_map(|face| face.skirts());
    let faces = placed.iter().map(|face| (face.corners, face.at, false));
    let mut layout = Layout::default();
    for (corners, at, skirt) in skirts.chain(faces) {
        each_copy(corners, size, |copy| {
            if meets(copy, size) {
                layout.triangles.push(Triangle { corners: copy.map(|c| c.map(texels)), at, skirt });
                touch(&mut layout.tiles, copy, at, job, size);
            }
        });
    }
    layout.tiles.sort_unstable();
    layout.tiles.dedup();
    layout
}

/// Exact, below 2^16.
fn texels(parts: i64) -> f32 {
    parts as f32 / PARTS as f32
}

/// The corners of a triangle, in 1/256 of a texel.
pub fn corners(triangle: &Triangle) -> Corners {
    triangle.corners.map(|c| c.map(|texels| (texels * PARTS as f32) as i64))
}

/// Whether a triangle's box has area in common with the map.
fn meets(corners: Corners, size: [u32; 2]) -> bool {
    let [least, most] = bounds(corners);
    (0..2).all(|k| most[k] > 0 && least[k] < i64::from(size[k]) * PARTS)
}

/// A face on the map, with (s, d) as an affine map: `at[0]` + gradient · (p − corner 0).
struct Placed {
    corners: Corners,
    at: [[f32; 2]; 3],
    affine: Affine,
    open: u8,
}

impl Placed {
    fn new(face: &PaintFace, size: [u32; 2]) -> Option<Self> {
        let corners = place(face.uv, size)?;
        let at = face.at.map(|p| p.to_array());
        Some(Self { corners, at, affine: Affine::new(corners, at), open: face.open })
    }

    fn skirts(&self) -> impl Iterator<Item = (Corners, [[f32; 2]; 3], bool)> + '_ {
        let open = (0..3).filter(|side| self.open >> side & 1 == 1);
        open.flat_map(|side| {
            let quad = self.quad(side);
            let at = quad.map(|p| self.affine.at(p).map(|v| v as f32));
            [[0, 1, 2], [0, 2, 3]].map(|half| (half.map(|k: usize| quad[k]), half.map(|k| at[k]), true))
        })
    }

    /// The corners of a side's skirt.
    fn quad(&self, side: usize) -> [[i64; 2]; 4] {
        let [a, b] =
            [self.corners[side], self.corners[(side + 1) % 3]].map(|p| p.map(|v| v as f64 / PARTS as f64));
        let [dx, dy] = [b[0] - a[0], b[1] - a[1]];
        let length = (dx * dx + dy * dy).sqrt();
        let along = [dx / length, dy / length];
        // The inside lies to the right of a side of a clockwise face, y being down.
        let turn = if doubled_area(self.corners) > 0 { 1.0 } else { -1.0 };
        let out = [along[1] * turn, -along[0] * turn];
        let far = f64::from(SKIRT);
        let corner = |p: [f64; 2], ahead: f64, aside: f64| {
            [0, 1].map(|k| spans::round(p[k] + along[k] * ahead + out[k] * aside))
        };
        [corner(a, -far, -HAIR), corner(b, far, -HAIR), corner(b, far, far), corner(a, -far, far)]
    }
}

/// (s, d) over the map, as the affine map that a triangle's corners give. Evaluated in f64, so that slivers are no worse than they are.
#[derive(Clone, Copy, Debug)]
pub struct Affine {
    origin: [i64; 2],
    value: [f64; 2],
    /// Per 1/256 of a texel, right and down, of s and of d.
    gradient: [[f64; 2]; 2],
}

impl Affine {
    /// The map with these values at these corners, which must have area.
    pub fn new(corners: Corners, at: [[f32; 2]; 3]) -> Self {
        let [a, b, c] = corners;
        let area = doubled_area(corners) as f64;
        let [[bx, by], [cx, cy]] = [b, c].map(|p| [p[0] - a[0], p[1] - a[1]].map(|v| v as f64));
        let gradient = [0, 1].map(|k| {
            let [first, second, third] = at.map(|p| f64::from(p[k]));
            let [p, q] = [second - first, third - first];
            [(p * cy - q * by) / area, (q * bx - p * cx) / area]
        });
        Self { origin: a, value: at[0].map(f64::from), gradient }
    }

    /// (s, d) at a place in 1/256 of a texel.
    #[inline]
    pub fn at(&self, [x, y]: [i64; 2]) -> [f64; 2] {
        let (x, y) = ((x - self.origin[0]) as f64, (y - self.origin[1]) as f64);
        let along = |k: usize| self.value[k] + (self.gradient[k][0] * x + self.gradient[k][1] * y);
        [along(0), along(1)]
    }
}

/// Notes the tiles of a triangle's box on which something may change.
fn touch(tiles: &mut Vec<u32>, corners: Corners, at: [[f32; 2]; 3], job: &PaintJob, size: [u32; 2]) {
    let side = i64::from(TILE) * PARTS;
    let [least, most] = bounds(corners);
    let range = |k: usize| {
        let last = i64::from(tiles_of(size)[k]) - 1;
        (least[k].div_euclid(side).max(0), most[k].div_euclid(side).min(last))
    };
    let ((left, right), (top, bottom)) = (range(0), range(1));
    let affine = Affine::new(corners, at);
    for y in top..=bottom {
        for x in left..=right {
            let index = tile_index([x as u32, y as u32], size);
            // Neighbouring triangles mostly lie in the same tile.
            if tiles.last() != Some(&index) && reaches(&affine, [x * side, y * side], side, job) {
                tiles.push(index);
            }
        }
    }
}

/// Whether a painting may reach into a square, (s, d) being this affine map.
fn reaches(affine: &Affine, [x, y]: [i64; 2], side: i64, job: &PaintJob) -> bool {
    let corners = [[x, y], [x + side, y], [x, y + side], [x + side, y + side]].map(|p| affine.at(p));
    let [length, height] = [job.length, job.height].map(f64::from);
    // A hundredth more, for what is rounded.
    let (ahead, aside) = (1.01 * height.max(0.03 * length), 1.01 * height);
    // Of a NaN nothing can be said, so it is not beyond anything.
    let beyond =
        |out: fn([f64; 2], [f64; 3]) -> bool| corners.iter().all(|p| out(*p, [length, ahead, aside]));
    !(beyond(|p, [_, ahead, _]| p[0] < -ahead)
        || beyond(|p, [length, ahead, _]| p[0] > length + ahead)
        || beyond(|p, [.., aside]| p[1] < -aside)
        || beyond(|p, [.., aside]| p[1] > aside))
}

#[cfg(test)]
mod tests;
