//! Maps, and how they are sampled: as [`canvas::image`](crate::canvas::image) says.

use std::sync::LazyLock;

use crate::canvas::image::Image;
use crate::render::srgb;

/// What a channel's bytes stand for.
type Decoding = [f32; 256];

/// value/255.
fn plain() -> &'static Decoding {
    static TABLE: LazyLock<Decoding> = LazyLock::new(|| std::array::from_fn(|byte| byte as f32 / 255.0));
    &TABLE
}

/// 2 value/255 − 1, and nothing in the middle, which 8 bits have no other value for.
fn signed() -> &'static Decoding {
    static TABLE: LazyLock<Decoding> = LazyLock::new(|| {
        std::array::from_fn(|byte| if byte == 128 { 0.0 } else { 2.0 * byte as f32 / 255.0 - 1.0 })
    });
    &TABLE
}

/// A map that can be sampled.
#[derive(Clone, Copy)]
pub(crate) struct Sampler<'a> {
    map: &'a Image,
    color: &'static Decoding,
    alpha: &'static Decoding,
    /// The one value of a map of one texel, or of none.
    constant: Option<[f32; 4]>,
}

impl<'a> Sampler<'a> {
    /// A map of sRGB colours.
    pub(crate) fn srgb(map: &'a Image) -> Self {
        Self::new(map, srgb::decoded())
    }

    /// A map of numbers from 0 to 1.
    pub(crate) fn plain(map: &'a Image) -> Self {
        Self::new(map, plain())
    }

    /// A map of numbers from −1 to 1.
    pub(crate) fn signed(map: &'a Image) -> Self {
        Self::new(map, signed())
    }

    fn new(map: &'a Image, color: &'static Decoding) -> Self {
        let mut sampler = Self { map, color, alpha: plain(), constant: None };
        sampler.constant = match map.texels[..] {
            [] => Some([0.0; 4]),
            [only] => Some(sampler.decode(only)),
            _ => None,
        };
        sampler
    }

    #[inline]
    fn decode(&self, [r, g, b, a]: [u8; 4]) -> [f32; 4] {
        let color = |byte: u8| self.color[usize::from(byte)];
        [color(r), color(g), color(b), self.alpha[usize::from(a)]]
    }

    /// Its value at texture coordinates.
    pub(crate) fn at(&self, [u, v]: [f64; 2]) -> [f32; 4] {
        if let Some(constant) = self.constant {
            return constant;
        }
        let (x, fx) = between(u, self.map.size[0]);
        let (y, fy) = between(1.0 - v, self.map.size[1]);
        let row = |y: u32| {
            let texel = |x: u32| self.decode(self.map.at(x, y));
            mix(texel(x[0]), texel(x[1]), fx)
        };
        mix(row(y[0]), row(y[1]), fy)
    }
}

/// The two texels around a coordinate, and how far it is from the first to the second. Maps repeat.
#[inline]
fn between(coordinate: f64, size: u32) -> ([u32; 2], f32) {
    let place = coordinate * f64::from(size) - 0.5;
    let floor = place.floor();
    let part = place - floor;
    // What is not finite counts as 0.
    let (first, part) =
        if part.is_finite() { (floor.rem_euclid(f64::from(size)) as u32, part as f32) } else { (0, 0.0) };
    ([first, if first + 1 < size { first + 1 } else { 0 }], part)
}

/// From a to b; exactly a where they are equal.
#[inline]
fn mix(a: [f32; 4], b: [f32; 4], part: f32) -> [f32; 4] {
    std::array::from_fn(|c| a[c] + part * (b[c] - a[c]))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn map() -> Image {
        Image {
            size: [2, 2],
            texels: vec![[0, 10, 20, 30], [40, 50, 60, 70], [80, 90, 100, 110], [120, 130, 140, 255]],
        }
    }

    fn bytes(value: [f32; 4]) -> [f32; 4] {
        value.map(|v| (v * 255.0 * 256.0).round() / 256.0)
    }

    #[test]
    fn texels_are_met_at_their_centres_rows_from_the_top() {
        let map = map();
        let at = |uv| bytes(Sampler::plain(&map).at(uv));
        assert_eq!(at([0.25, 0.75]), [0.0, 10.0, 20.0, 30.0]);
        assert_eq!(at([0.75, 0.75]), [40.0, 50.0, 60.0, 70.0]);
        assert_eq!(at([0.25, 0.25]), [80.0, 90.0, 100.0, 110.0]);
    }

    #[test]
    fn between_centres_it_is_bilinear_and_maps_repeat() {
        let map = map();
        let at = |uv| bytes(Sampler::plain(&map).at(uv));
        assert_eq!(at([0.5, 0.5])[0], 60.0);
        assert_eq!(at([0.375, 0.75])[0], 10.0);
        assert_eq!(at([0.0, 0.75])[0], 20.0, "halfway from the last texel to the first");
        assert_eq!(at([-0.625, 2.75])[0], 10.0);
        assert_eq!(at([f64::NAN, f64::INFINITY])[0], 0.0);
    }

    #[test]
    fn colours_are_decoded_before_they_are_mixed() {
        let map = Image { size: [2, 1], texels: vec![[0, 0, 0, 0], [255; 4]] };
        let [r, .., a] = Sampler::srgb(&map).at([0.5, 0.5]);
        assert_eq!([r, a], [0.5, 0.5]);
        let grey = Image::filled([1, 1], [188, 0, 0, 188]);
        let [r, .., a] = Sampler::srgb(&grey).at([0.1, 0.9]);
        assert!((r - 0.5029).abs() < 1e-4 && (a - 188.0 / 255.0).abs() < 1e-6, "{r} {a}");
    }

    #[test]
    fn the_middle_of_a_normal_map_is_flat() {
        let flat = Image::filled([4, 4], [128, 128, 255, 255]);
        assert_eq!(Sampler::signed(&flat).at([0.3, 0.4])[..3], [0.0, 0.0, 1.0]);
        let tilted = Image::filled([1, 1], [0, 255, 255, 255]);
        assert_eq!(Sampler::signed(&tilted).at([0.3, 0.4])[..2], [-1.0, 1.0]);
    }
}
