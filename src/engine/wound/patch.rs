//! GP: how large a cut's wound patch is, and what is drawn on it (Lam 2016, §5.3 and §5.3.1).
//!
//! **Notation.** L the length of the line, model units; ρ the texel density: texels of the colour map per model unit along the line; p_w and p_h
//! the patch's size in texels; c_h its height on the skin, model units.
//!
//! **Size.** ρ = Σ |Δuv ⊙ size| / Σ |Δx| over the links that lie in skin, p_w = max(8, ⌈L ρ⌉), p_h = max(4, round(2 log₁₀(p_w) √p_w)),
//! c_h = L p_h / p_w. The patch reaches c_h / 2 to either side, the discoloration c_h.
//!
//! Where we depart from the thesis: it takes the distance of the line's two ends in texture space, which is another length on a bent line and
//! none at all across charts. On a straight line in one undistorted chart the two are equal. p_w is at most [`WIDEST`], since texture
//! coordinates may be anything.
//!
//! **Chance.** What differs from cut to cut is drawn by a hash of the event's seed and a purpose, so nothing shifts when other events
//! come, go, or are rejected.

use glam::DVec2;

use super::chain::Chain;
use super::surface::SkinLink;
use crate::canvas::job::PatchJob;
use crate::canvas::look::Wound;
use crate::mesh::Mesh;

/// The widest patch that is made, texels.
pub const WIDEST: f64 = 4096.0;

/// A patch, and how it lies on the skin.
#[derive(Clone, Debug, PartialEq)]
pub struct Patch {
    /// What to draw.
    pub job: PatchJob,
    /// L, model units.
    pub length: f64,
    /// c_h, model units.
    pub height: f64,
    /// ρ, texels per model unit.
    pub density: f64,
}

/// The patch of a line on a colour map of a size.
pub fn plan(mesh: &Mesh, chain: &Chain, links: &[SkinLink], map: [u32; 2], look: &Wound, seed: u64) -> Patch {
    let (length, density) = (chain.length(), density(mesh, chain, links, map));
    let size = size(length * density);
    let offset = ["patch x", "patch y"].map(|purpose| offset(seed, purpose));
    let palette = [look.inner, look.dark, look.light];
    let job = PatchJob { size, offset, palette, edge: look.edge, noise: look.noise };
    Patch { job, length, height: length * f64::from(size[1]) / f64::from(size[0]), density }
}

/// ρ; 0 where all texture coordinates are one.
fn density(mesh: &Mesh, chain: &Chain, links: &[SkinLink], map: [u32; 2]) -> f64 {
    let map = DVec2::from(map.map(f64::from));
    let texels = |link: &SkinLink| {
        let face = mesh.face(link.face);
        // By weights: the difference of two rounded texture coordinates would be nothing on a very short link.
        let [from, to] = [link.link, link.link + 1].map(|i| chain.points[i].weights_in(mesh, link.face));
        let step =
            (0..3).map(|i| mesh.vertex(face.vertices[i]).uv.as_dvec2() * (to[i] - from[i])).sum::<DVec2>();
        (step * map).length()
    };
    let sums = links.iter().fold([0.0; 2], |[t, l], link| [t + texels(link), l + link.length]);
    let density = sums[0] / sums[1];
    if density.is_finite() { density } else { 0.0 }
}

/// p_w and p_h for a line that is so many texels long.
fn size(texels: f64) -> [u32; 2] {
    let width = texels.ceil().clamp(8.0, WIDEST);
    let height = (2.0 * libm::log10(width) * width.sqrt()).round().max(4.0);
    [width as u32, height as u32]
}

/// A number in [0, 1) that depends on a seed and a purpose alone; it has the digits of an f32.
pub fn chance(seed: u64, purpose: &str) -> f32 {
    let mut hasher = blake3::Hasher::new();
    hasher.update(&seed.to_le_bytes());
    hasher.update(purpose.as_bytes());
    let [a, b, c, ..] = *hasher.finalize().as_bytes();
    u32::from_le_bytes([a, b, c, 0]) as f32 / (1 << 24) as f32
}

/// Where a noise is looked up: 0 to 100, as in the thesis.
pub fn offset(seed: u64, purpose: &str) -> f32 {
    100.0 * chance(seed, purpose)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_size_follows_the_thesis_within_its_bounds() {
        // Lam 2016, Figure 5.4: a third to a quarter of the width, for widths of 100 to 500.
        assert_eq!(size(99.2), [100, 40]);
        assert_eq!(size(500.0), [500, 121]);
        assert_eq!(size(0.0), [8, 5]);
        assert_eq!(size(1e300), [4096, 462]);
    }

    #[test]
    fn chance_hangs_on_seed_and_purpose_and_stays_in_its_range() {
        assert_eq!(chance(7, "x"), chance(7, "x"));
        assert!(chance(7, "x") != chance(8, "x") && chance(7, "x") != chance(7, "y"));
        let draws: Vec<f32> = (0..1000).map(|seed| offset(seed, "patch x")).collect();
        assert!(draws.iter().all(|v| (0.0..100.0).contains(v)));
        let mean = draws.iter().sum::<f32>() / 1000.0;
        assert!((mean - 50.0).abs() < 3.0, "{mean}");
    }
}
