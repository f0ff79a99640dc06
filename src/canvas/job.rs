//! GP's patch and PP's painting (Lam 2016, §5.3 and §5.4), defined texel by texel.
//!
//! Notation: c_l the line's length and c_h the patch's height, model units; s the arc length along the line and d the signed distance from it, both
//! measured on the surface, d positive to the left of the line as seen from outside; x and y run over the patch from 0 to 1.
//!
//! # The patch ([`PatchJob`])
//!
//! Texel (i, j) of a p_w × p_h patch stands at x = i/(p_w − 1), y = j/(p_h − 1), so the border's texels lie on the border. With
//! X = 2x − 1, D = |y − ½|, the offset o, [`perlin`](#noise) P, [`simplex`](#noise) fBm F:
//!
//! - r_i = max(h P((x + o_x) f, ½), 0.05) (0.45 − 0.5 X²), with f and h the edge's frequency and height: the inner layer;
//! - r_if = (r_i + 0.05)(1 − X²): where it has faded into the outer one;
//! - r_o = 0.25 − 0.3 X⁴: the outer layer; r_of = r_o + 0.05: where that has faded away;
//! - c(y) = dark + (light − dark) sat(½ + F((x, y) + o)): the outer layer's colour.
//!
//! The colour is, the first that holds: for |x − ½| < 0.475, `inner` if D < r_i; if D < r_if the mix of `inner` and c at the
//! texel's side's ½ ± r_if, by (D − r_i)/(r_if − r_i). Then c(y) if D < r_o; if D < r_of the colour c at ½ ± r_o times
//! α = 1 − (D − r_o)/0.05. Else nothing. Colours are mixed as sRGB values; texels are RGBA with the alpha multiplied in, rounded to
//! the nearest of 0 … 255.
//!
//! We depart from the thesis: the noise is kept within the palette, and fades are multiplied through, so that no dark fringe comes in.
//!
//! # The painting ([`PaintJob`])
//!
//! The texels of a face are those whose centres it covers by the top-left rule, its corners rounded to 1/256 of a texel, coordinates as in
//! [`image`](super::image) (maps repeat). Every side in [`PaintFace::open`] has a skirt: the texels outside of it within
//! [`SKIRT`] texels across, and as many beyond its ends, that no face of the mesh covers. (s, d) are affine over a face, and go on so over its
//! skirts. Where two skirts claim a texel, the later in the list has it; a face always wins over a skirt; of two faces (in charts that overlap) the
//! later. So every texel is painted once.
//!
//! At a texel with (s, d):
//! - **colour**: x = 0.025 + 0.95 s/c_l, y = ½ − d/c_h. Within the unit square the patch is sampled, bilinear between texels at
//!   x (p_w − 1), y (p_h − 1), and laid over the map: rgb = patch + (1 − α) rgb, as sRGB values, rounded; the map's alpha stays.
//! - **discoloration**: t = 2 sat(s/c_l) − 1, R = ½ c_h (1 − ½ t²), D the distance from (s, d) to the line from (0, 0) to (c_l, 0),
//!   ρ = 1 − D/(2R), ν = F(m (s, d) + o) with m [`PaintJob::noise_scale`]. For ρ > 0: α = sat(clamp(ν, 0, ρ) + max(0, 1.1 − D/R)), and the
//!   texel is (½ factor, α), rounded. It replaces the one there if its alpha is more (both as bytes).
//!
//! We depart from the thesis: distances are measured on the surface, the inner layer fades to nothing rather than ending at 0.1, and the
//! stronger discoloration stays.
//!
//! # Noise
//!
//! Perlin's and simplex noise in two dimensions without tables, after Gustavson and McEwan (2012): lattice hashes by the
//! permutation polynomial (34 i + 1) i mod 289, gradients at 41 places of a diamond, made unit length by
//! 1.79284291400159 − 0.85373472095314 r², the sums times 2.3 and 130. All in f32.
//! F(p) = Σ amplitude persistenceᵏ simplex(p frequency lacunarityᵏ).

use glam::Vec2;

use super::look::Fbm;
use crate::report::{Buffer, Scalar};

/// How far outside of a chart's border texels are painted too, texels: bilinear sampling reaches one.
pub const SKIRT: f32 = 2.0;

/// GP: the wound patch of a cut.
#[derive(Clone, Debug, PartialEq)]
pub struct PatchJob {
    /// Its size in texels, p_w and p_h, each at least 2.
    pub size: [u32; 2],
    /// Where the noise is looked up, o.
    pub offset: [f32; 2],
    /// `inner`, `dark` and `light`, sRGB.
    pub palette: [[f32; 3]; 3],
    /// Frequency and height of the inner layer's edge, f and h.
    pub edge: [f32; 2],
    /// The outer layer's noise, F.
    pub noise: Fbm,
}

/// A face to paint on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PaintFace {
    /// Its id.
    pub face: u32,
    /// Texture coordinates of its corners.
    pub uv: [Vec2; 3],
    /// (s, d) of its corners, model units.
    pub at: [Vec2; 3],
    /// Bit i: the side from corner i to the next is a border of the chart.
    pub open: u8,
}

/// PP: a patch and a discoloration on the surface around a line.
#[derive(Clone, Debug, PartialEq)]
pub struct PaintJob {
    /// The line's length c_l, model units.
    pub length: f32,
    /// The patch's height c_h, model units.
    pub height: f32,
    /// What the discoloration leaves of each channel.
    pub factor: [f32; 3],
    /// Where its noise is looked up, o.
    pub offset: [f32; 2],
    /// Its noise, F.
    pub noise: Fbm,
    /// Texture widths in a model unit, m.
    pub noise_scale: f32,
    /// The faces within c_h of the line, those within c_h / 2 first.
    pub faces: Vec<PaintFace>,
    /// How many lie within c_h / 2.
    pub inner: usize,
}

/// What a cut puts on the maps.
#[derive(Clone, Debug, PartialEq)]
pub struct Painting {
    /// The patch.
    pub patch: PatchJob,
    /// Where it goes.
    pub paint: PaintJob,
}

impl PatchJob {
    /// Everything that it says, as a buffer to digest.
    pub fn buffer(&self) -> Buffer {
        let mut buffer = Buffer::new("patch", "j", Scalar::F32, 5);
        let [w, h] = self.size.map(|side| side as f32);
        buffer.push_f32(0, &[w, h, self.offset[0], self.offset[1], 0.0]);
        for (row, [r, g, b]) in (1..).zip(self.palette) {
            buffer.push_f32(row, &[r, g, b, 0.0, 0.0]);
        }
        buffer.push_f32(4, &[self.edge[0], self.edge[1], 0.0, 0.0, 0.0]);
        buffer.push_f32(5, &fbm_row(&self.noise));
        buffer
    }
}

fn fbm_row(noise: &Fbm) -> [f32; 5] {
    [noise.octaves as f32, noise.frequency, noise.amplitude, noise.lacunarity, noise.persistence]
}

impl PaintJob {
    /// Everything that it says, as buffers to digest: its figures, and its faces by their order.
    pub fn buffers(&self) -> [Buffer; 3] {
        let mut figures = Buffer::new("paint", "j", Scalar::F32, 5);
        figures.push_f32(0, &[self.length, self.height, self.noise_scale, self.offset[0], self.offset[1]]);
        figures.push_f32(1, &[self.factor[0], self.factor[1], self.factor[2], self.inner as f32, 0.0]);
        figures.push_f32(2, &fbm_row(&self.noise));
        let mut ids = Buffer::new("painted", "p", Scalar::U32, 2);
        let mut places = Buffer::new("surface", "p", Scalar::F32, 12);
        for (i, face) in (0u32..).zip(&self.faces) {
            ids.push_u32(i, &[face.face, face.open.into()]);
            let mut row = [0.0; 12];
            for (corner, (uv, at)) in row.chunks_exact_mut(4).zip(face.uv.iter().zip(&face.at)) {
                corner.copy_from_slice(&[uv.x, uv.y, at.x, at.y]);
            }
            places.push_f32(i, &row);
        }
        [figures, ids, places]
    }
}

impl Painting {
    /// blake3 of its buffers.
    pub fn digest(&self) -> [u8; 32] {
        let mut hasher = blake3::Hasher::new();
        hasher.update(self.patch.buffer().digest().as_bytes());
        self.paint.buffers().iter().for_each(|buffer| {
            hasher.update(buffer.digest().as_bytes());
        });
        *hasher.finalize().as_bytes()
    }

    /// Bytes that it holds.
    pub fn bytes(&self) -> usize {
        size_of::<Self>() + self.paint.faces.capacity() * size_of::<PaintFace>()
    }
}
