//! sRGB: from bytes to linear light and back (IEC 61966-2-1).
//!
//! Decoding is a table of 256, from libm in f64. Encoding rounds to the nearest byte, exactly: byte b begins where the decoding of b − ½ lies, so
//! it is a search among 255 thresholds, and one look in a table of `BUCKETS` leaves at most one of them to compare with.

use std::sync::LazyLock;

use super::sat;

/// The linear light of an sRGB value from 0 to 1; what lies outside counts as the nearest, a NaN as 0.
pub fn decode(value: f64) -> f64 {
    let value = if value > 0.0 { value.min(1.0) } else { 0.0 };
    if value <= 0.04045 { value / 12.92 } else { libm::pow((value + 0.055) / 1.055, 2.4) }
}

/// The linear light of three sRGB values, such as a colour of a scene.
pub fn decode_color(color: [f32; 3]) -> [f32; 3] {
    color.map(|channel| decode(channel.into()) as f32)
}

/// The linear light of every byte.
pub fn decoded() -> &'static [f32; 256] {
    static TABLE: LazyLock<[f32; 256]> =
        LazyLock::new(|| std::array::from_fn(|byte| decode(byte as f64 / 255.0) as f32));
    &TABLE
}

/// Into how many parts 0 … 1 is cut for the first look. A byte is never narrower than one of them: the curve's steepest slope is
/// 12.92 × 255 = 3295 bytes.
const BUCKETS: usize = 4096;

/// Turns linear light into bytes.
#[derive(Clone, Debug)]
pub struct Encoder {
    /// Where byte i + 1 begins; the last is never reached.
    begins: [f32; 256],
    /// The byte at the beginning of each bucket.
    first: Vec<u8>,
}

impl Encoder {
    /// The one encoder.
    pub fn get() -> &'static Self {
        static ENCODER: LazyLock<Encoder> = LazyLock::new(Encoder::new);
        &ENCODER
    }

    fn new() -> Self {
        let mut begins: [f32; 256] = std::array::from_fn(|i| decode((i as f64 + 0.5) / 255.0) as f32);
        begins[255] = f32::INFINITY;
        let byte = |bucket: usize| begins.partition_point(|&b| b <= bucket as f32 / BUCKETS as f32) as u8;
        Self { begins, first: (0..=BUCKETS).map(byte).collect() }
    }

    /// The byte nearest to the sRGB value of this light, clamped to 0 … 1; a NaN counts as 0.
    #[inline]
    pub fn byte(&self, light: f32) -> u8 {
        let light = sat(light);
        let byte = self.first[(light * BUCKETS as f32) as usize];
        byte + u8::from(self.begins[usize::from(byte)] <= light)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_byte_comes_back() {
        for byte in 0..=255 {
            assert_eq!(Encoder::get().byte(decoded()[usize::from(byte)]), byte);
        }
    }

    #[test]
    fn encoding_rounds_to_the_nearest_byte() {
        for step in 0..=40_000_u32 {
            let light = step as f32 / 40_000.0;
            let linear = f64::from(light);
            let curve = if linear <= 0.0031308 {
                12.92 * linear
            } else {
                1.055 * libm::pow(linear, 1.0 / 2.4) - 0.055
            };
            let off = (255.0 * curve - f64::from(Encoder::get().byte(light))).abs();
            // The curve's two parts do not quite meet: 1e-4 of a byte.
            assert!(off <= 0.5 + 1e-3, "{light}: {off}");
        }
    }

    #[test]
    fn what_is_no_light_is_black_or_white() {
        let bytes =
            [f32::NAN, -1.0, f32::NEG_INFINITY, 1.0, 7.0, f32::INFINITY].map(|l| Encoder::get().byte(l));
        assert_eq!(bytes, [0, 0, 0, 255, 255, 255]);
        assert_eq!([decode(f64::NAN), decode(-1.0), decode(2.0)], [0.0, 0.0, 1.0]);
    }
}
