//! Pores and fine wrinkles, as a normal map.
//!
//! The relief is a height h over the skin, a function of the place in space. The normal of the raised surface is unit(N − g), g the part of ∇h
//! along the surface. The map holds the x and y with which a renderer that computes unit(x T + y B + z N) from *its* interpolated frame finds
//! just this normal; so it is the same on both sides of a seam, however the frames there differ.
//!
//! No feature is narrower than three texels: finer noises are left out where the map is too coarse for them.

use glam::DVec3;

use super::features;
use super::noise::{Noise, noise, stretched};
use super::skin::to_byte;
use super::texels::Site;

/// Noises that make up the skin's grain: cell, cm, and how steep each is.
const GRAIN: [(f64, f64); 4] = [(1.10, 0.02), (0.46, 0.025), (0.21, 0.065), (0.105, 0.07)];
const TEXELS_A_CELL: f64 = 3.0;
/// The relief is never as steep as this z of its normal would say.
const LEAST_UPRIGHT: f64 = 0.7;

/// The relief of the bust at the size of a texel.
pub(super) struct Relief {
    texel_cm: f64,
}

impl Relief {
    pub(super) fn new(texel_cm: f64) -> Self {
        Self { texel_cm }
    }

    /// The texel of the normal map at a site.
    pub(super) fn texel(&self, site: &Site) -> [u8; 4] {
        let slope = self.slope(site.position);
        let n = site.normal;
        let target = (n - (slope - n * n.dot(slope))).normalize();
        let [x, y, z] = in_frame(target, site);
        [to_byte(0.5 * x + 0.5), to_byte(0.5 * y + 0.5), to_byte(0.5 * z + 0.5), 255]
    }

    /// ∇h.
    fn slope(&self, p: DVec3) -> DVec3 {
        let lips = features::lips(p);
        let pores = 1.0 + 0.5 * features::nose(p) + 0.3 * features::cheek(p) - 0.6 * features::lids(p);
        let grain = (1.0 - 0.7 * lips) * pores * (1.0 - 0.3 * features::ear(p));
        self.grain(p) * grain + self.wrinkles(p, lips)
    }

    fn grain(&self, p: DVec3) -> DVec3 {
        let visible = GRAIN.iter().zip(20..).filter(|((cell, _), _)| *cell >= TEXELS_A_CELL * self.texel_cm);
        visible.map(|(&(cell, steepness), seed)| pits(noise(p, cell, seed)) * (steepness * cell)).sum()
    }

    /// Lines across the forehead and around the neck, and upright ones in the lips.
    fn wrinkles(&self, p: DVec3, lips: f64) -> DVec3 {
        let line = |weight: f64, cells: DVec3, steepness: f64, seed: u32| {
            let narrowest = cells.min_element();
            if weight <= 0.0 || narrowest < TEXELS_A_CELL * self.texel_cm {
                return DVec3::ZERO;
            }
            stretched(p, cells, seed).slope * (weight * steepness * narrowest)
        };
        line(features::forehead(p), DVec3::new(6.0, 0.42, 6.0), 0.10, 30)
            + line(features::neck(p), DVec3::new(7.0, 0.55, 7.0), 0.07, 31)
            + line(lips, DVec3::new(0.20, 1.2, 2.0), 0.10, 32)
    }
}

/// The slope of −max(0, v + ½)²: pits with even skin between them.
fn pits(Noise { value, slope }: Noise) -> DVec3 {
    slope * (-2.0 * (value + 0.5).max(0.0))
}

/// The x, y and z with x T + y B + z N along a direction, at length 1. Flat where the frame all but collapses, as in the root of an ear,
/// where the surface folds back on itself: no small step from the normal leads there.
fn in_frame(target: DVec3, site: &Site) -> [f64; 3] {
    let ([t, b], n) = (site.tangents, site.normal);
    let parts = DVec3::new(target.dot(b.cross(n)), target.dot(n.cross(t)), target.dot(t.cross(b)));
    let found = (parts / t.dot(b.cross(n))).normalize_or(DVec3::Z);
    if found.z < LEAST_UPRIGHT { [0.0, 0.0, 1.0] } else { found.to_array() }
}
