//! Noise passes, defects do not.

use super::gates::GatesFile;
use super::plant::planted;
use super::*;

pub(in crate::verify) const BACKGROUND: [u8; 4] = [33, 36, 41, 255];

/// A fixed hash of a place.
fn hash(x: u32, y: u32, salt: u32) -> u32 {
    let mut h = x.wrapping_mul(0x9e37_79b9) ^ y.wrapping_mul(0x85eb_ca6b) ^ salt.wrapping_mul(0xc2b2_ae35);
    h = (h ^ (h >> 15)).wrapping_mul(0x2c1b_3c6d);
    h = (h ^ (h >> 12)).wrapping_mul(0x297a_2d39);
    h ^ (h >> 15)
}

/// Something like a face: an ellipse of shaded skin with pores, before a background.
pub(in crate::verify) fn face(size: [u32; 2]) -> Image {
    let mut image = Image::filled(size, BACKGROUND);
    let [w, h] = size.map(f64::from);
    for (at, texel) in image.texels.iter_mut().enumerate() {
        let [x, y] = [at as u32 % size[0], at as u32 / size[0]];
        let [u, v] = [(f64::from(x) + 0.5) / w * 2.0 - 1.0, (f64::from(y) + 0.5) / h * 2.0 - 1.0];
        let r2 = (u * u + v * v) / 0.64;
        if r2 < 1.0 {
            let light = (1.0 - r2).sqrt() * 0.6 + 0.3 - 0.15 * u;
            let pore = f64::from(hash(x, y, 7) % 9) - 4.0;
            *texel = [220.0, 170.0, 145.0].map(|c: f64| (c * light + pore).clamp(0.0, 255.0) as u8).alpha();
        }
    }
    image
}

trait Opaque {
    fn alpha(self) -> [u8; 4];
}

impl Opaque for [u8; 3] {
    fn alpha(self) -> [u8; 4] {
        [self[0], self[1], self[2], 255]
    }
}

/// Every channel off by up to so much, up or down; on every pixel, or on every `one_in`th on average.
pub(in crate::verify) fn noise(image: &Image, off: i16, one_in: u32) -> Image {
    let mut noisy = image.clone();
    for (at, texel) in noisy.texels.iter_mut().enumerate() {
        let h = hash(at as u32, 1, 3);
        if h % one_in == 0 {
            (0..3).for_each(|c| {
                let sign = if h >> (8 + c) & 1 == 0 { off } else { -off };
                texel[c] = (i16::from(texel[c]) + sign).clamp(0, 255) as u8;
            });
        }
    }
    noisy
}

fn distance(golden: &Image, found: &Image) -> Distance {
    measure(golden, found, &Skin::of(golden, BACKGROUND)).distance
}

fn entry(measured: Distance) -> Known {
    Known { adapter: "llvmpipe*".into(), reason: "a test".into(), measured }
}

#[test]
fn zz_print() {
    for size in [[64, 64], [320, 180], [640, 360]] {
        let golden = face(size);
        let skin = Skin::of(&golden, BACKGROUND);
        println!("{size:?} half {:?}", distance(&golden, &noise(&golden, 1, 2)));
        println!("two {:?}", distance(&golden, &noise(&golden, 2, 1)));
        for d in [Defect::Hole, Defect::Crack, Defect::Tone, Defect::Shift] {
            println!("{d} {:?}", planted(&golden, &skin, d).map(|i| distance(&golden, &i)));
        }
        let t = std::time::Instant::now();
        prove(&golden, &skin, &GatesFile::default().general().most);
        println!("{:?}", t.elapsed());
        let t = std::time::Instant::now();
        super::distance::structure(&golden, &noise(&golden, 1, 2));
        println!("{:?}", t.elapsed());
    }
}
