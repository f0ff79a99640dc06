//! Shadow maps: what a light sees, how much of it arrives at a point, and how thick the skin is there (Lam 2016, B.1.2.2 and B.2.2.2).
//!
//! A map holds the nearest surface's depth along the light's axis at each texel's centre. **Percentage-closer filtering**: filter² looks, one
//! texel apart, are averaged, each bilinear between four comparisons. The looks overlap, so that all of them together are (filter + 1)²
//! comparisons, weighted (1 − f, 1, …, 1, f)/filter along both axes, f the part of a texel by which the first look is off a centre.
//!
//! A point is held 1.5 texels off the surface, and half a texel nearer to the light, so that the surface does not shadow itself. A filter wider than 3 x 3
//! looks further along a surface that slopes towards the light, and its points are held nearer by as much as that rises.

use glam::DVec3;
use rayon::prelude::*;

use super::lens::Lens;
use super::raster::{BAND, Drawing};
use crate::canvas::frame::Light;
use crate::mesh::Mesh;

/// Of a surface that slopes more than by this cosine no more is made.
const GRAZING: f64 = 0.2;

/// What a shadow map depends on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Key {
    version: u64,
    lens: Lens,
    tan_half: f64,
}

impl Key {
    /// For a light, a version of the mesh, and texels along a side.
    pub(crate) fn new(light: &Light, version: u64, size: u32) -> Self {
        Self { version, lens: Lens::of_light(light, size), tan_half: light.tan_half }
    }
}

/// A shadow map.
#[derive(Clone, Debug)]
pub(crate) struct ShadowMap {
    key: Key,
    depth: Vec<f32>,
}

impl ShadowMap {
    /// Draws one.
    pub(crate) fn new(mesh: &Mesh, key: Key) -> Self {
        let (lens, side) = (&key.lens, key.lens.size[0] as usize);
        let (drawing, farthest) = (Drawing::new(mesh, lens), (1.0 / lens.far) as f32);
        let mut depth = vec![farthest; side * side];
        depth.par_chunks_mut(side * BAND).enumerate().for_each(|(band, texels)| {
            drawing.draw(band, |at, _, inverse| texels[at] = texels[at].max(inverse));
            let far = lens.far as f32;
            texels.iter_mut().for_each(|d| *d = if *d > farthest { 1.0 / *d } else { far });
        });
        Self { key, depth }
    }

    /// The same for points that are given relative to a place.
    pub(crate) fn around(&self, place: DVec3) -> ShadowsAround<'_> {
        ShadowsAround { map: self, lens: self.key.lens.around(place) }
    }

    /// Whether it is this one.
    pub(crate) fn is(&self, key: &Key) -> bool {
        self.key == *key
    }

    /// The average of the looks around a place in the map.
    fn filtered(&self, place: [f64; 2], filter: u32, depth: f32) -> f32 {
        let looks = filter.clamp(1, 9) as i64;
        let [(left, fx), (top, fy)] = place.map(|x| {
            let first = x - 0.5 - 0.5 * (looks - 1) as f64;
            (first.floor() as i64, (first - first.floor()) as f32)
        });
        let weight = |i: i64, f: f32| match i {
            0 => 1.0 - f,
            _ if i == looks => f,
            _ => 1.0,
        };
        let mut sum = 0.0;
        for j in 0..=looks {
            let row: f32 = (0..=looks).map(|i| weight(i, fx) * self.compare(left + i, top + j, depth)).sum();
            sum += weight(j, fy) * row;
        }
        sum / (looks * looks) as f32
    }

    /// 1 if nothing lies before this depth, else 0.
    #[inline]
    fn compare(&self, x: i64, y: i64, depth: f32) -> f32 {
        self.at(x, y).map_or(1.0, |nearest| f32::from(u8::from(depth <= nearest)))
    }

    #[inline]
    fn at(&self, x: i64, y: i64) -> Option<f32> {
        let side = i64::from(self.key.lens.size[0]);
        let within = (0..side).contains(&x) && (0..side).contains(&y);
        within.then(|| self.depth[(y * side + x) as usize])
    }

    /// The depth between four texels; at the border the outermost go on.
    fn bilinear(&self, x: f64, y: f64) -> f64 {
        let last = i64::from(self.key.lens.size[0]) - 1;
        let [(x, fx), (y, fy)] = [x, y].map(|x| (x.floor() as i64, x - x.floor()));
        let at = |x: i64, y: i64| {
            let (x, y) = (x.clamp(0, last), y.clamp(0, last));
            f64::from(self.depth[(y * (last + 1) + x) as usize])
        };
        let row = |y: i64| at(x, y) + fx * (at(x + 1, y) - at(x, y));
        row(y) + fy * (row(y + 1) - row(y))
    }
}

/// How much nearer to the light a point is held, texels, where the surface's normal is at an angle of this cosine to the light's axis.
fn held_nearer(filter: u32, cosine: f64) -> f64 {
    let further = 0.5 * (f64::from(filter.clamp(3, 9)) - 3.0);
    let cosine = cosine.clamp(GRAZING, 1.0);
    0.5 + further * (1.0 - cosine * cosine).sqrt() / cosine
}

/// A shadow map for points that are given relative to a place: far from the origin their own differences keep their digits.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ShadowsAround<'a> {
    map: &'a ShadowMap,
    lens: Lens,
}

impl ShadowsAround<'_> {
    /// How much of the light arrives at a point, from 0 to 1.
    pub(crate) fn lit(&self, point: DVec3, normal: DVec3, filter: u32) -> f32 {
        let lens = &self.lens;
        let size = f64::from(lens.size[0]);
        let texel = 2.0 * lens.see(point).z * self.map.key.tan_half / size;
        let seen = lens.see(point + normal * (1.5 * texel));
        let nearer = texel * held_nearer(filter, -normal.dot(lens.forward()));
        let place = lens.place(seen).filter(|place| place.iter().all(|x| x.abs() < 2.0 * size));
        let Some(place) = place else { return 1.0 };
        self.map.filtered(place, filter, (seen.z - nearer) as f32)
    }

    /// How far along its axis light has gone through the model before it comes to a point; `None` outside of the map.
    pub(crate) fn thickness(&self, point: DVec3) -> Option<f64> {
        let lens = &self.lens;
        let seen = lens.see(point);
        let size = f64::from(lens.size[0]);
        let [x, y] = lens.place(seen).filter(|place| place.iter().all(|x| (0.0..size).contains(x)))?;
        Some((seen.z - self.map.bilinear(x - 0.5, y - 0.5)).abs())
    }
}
