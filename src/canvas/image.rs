//! Images and maps: how texels lie, what they mean, and how they are sampled (Lam 2016, §6.2).
//!
//! **Texels.** RGBA, 8 bits a channel, rows from the top. Texture coordinates have their origin bottom left (v up), so the texel that
//! holds (u, v) of a w × h map is (⌊u w⌋, ⌊(1 − v) h⌋), each modulo the size: maps repeat. Texel (i, j) has its centre at
//! u = (i + ½)/w, v = 1 − (j + ½)/h.
//!
//! **Sampling** is bilinear between the four nearest centres, each decoded first, with f32 weights; there are no mip levels. Colours
//! are decoded from sRGB to linear light, everything else is value/255.
//!
//! | map | RGB | alpha | missing |
//! | --- | --- | --- | --- |
//! | colour | albedo, sRGB | how far light scatters below it, 0 to 1 | the skin's albedo, 1 |
//! | normal | R and G: the normal's tangent and bitangent parts, 2 v − 1 (v = 128/255 counts as 0) | | flat |
//! | occlusion | R: how much ambient light arrives | | 1 |
//! | specular | R: intensity; G: roughness m | | the skin's own |
//! | discolour | what the centre of the scattering kernel is multiplied by, half of it | how much of that | none |
//!
//! The discolour map begins empty and has the size of the colour map.

use std::fmt;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// An image: RGBA, 8 bits a channel, rows from the top.
#[derive(Clone, PartialEq, Eq, Default)]
pub struct Image {
    /// Width and height.
    pub size: [u32; 2],
    /// Texels, row by row.
    pub texels: Vec<[u8; 4]>,
}

impl fmt::Debug for Image {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Image {} x {}", self.size[0], self.size[1])
    }
}

impl Image {
    /// An image of one colour.
    pub fn filled(size: [u32; 2], texel: [u8; 4]) -> Self {
        Self { size, texels: vec![texel; size[0] as usize * size[1] as usize] }
    }

    /// A texel.
    #[inline]
    pub fn at(&self, x: u32, y: u32) -> [u8; 4] {
        self.texels[y as usize * self.size[0] as usize + x as usize]
    }

    /// Its bytes, texel by texel.
    pub fn bytes(&self) -> &[u8] {
        self.texels.as_flattened()
    }

    /// The first 128 bits of blake3 over size and texels, in hexadecimal.
    pub fn digest(&self) -> String {
        let mut hasher = blake3::Hasher::new();
        self.size.iter().for_each(|side| {
            hasher.update(&side.to_le_bytes());
        });
        hasher.update(self.bytes());
        hasher.finalize().to_hex()[..32].into()
    }
}

/// A map of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum MapId {
    /// Albedo, and scattering strength.
    Color,
    /// Tangent-space normals.
    Normal,
    /// Ambient occlusion.
    Occlusion,
    /// Specular intensity and roughness.
    Specular,
    /// Discoloration of the scattering.
    Discolor,
}

/// The maps of a scene before any cut. What a scene does not have is one texel with the default.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Maps {
    /// Albedo, and scattering strength. Always of the size that is painted on.
    pub color: Image,
    /// Tangent-space normals.
    pub normal: Image,
    /// Ambient occlusion.
    pub occlusion: Image,
    /// Specular intensity and roughness.
    pub specular: Image,
}
