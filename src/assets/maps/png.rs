//! Images as PNG, for goldens and frames: as small as may be, and back without loss.

use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder as _};

use super::decode;
use crate::assets::error::{Fault, FaultKind};
use crate::canvas::image::Image;

/// An image as a PNG file; without alpha where every texel is opaque. The same image gives the same bytes.
pub fn write_png(image: &Image) -> Result<Vec<u8>, Fault> {
    let [width, height] = image.size;
    if image.texels.len() != width as usize * height as usize || image.texels.is_empty() {
        let detail = format!("{} texels are no image of {width} x {height}", image.texels.len());
        return Err(Fault::whole(FaultKind::Empty, detail));
    }
    let opaque = image.texels.iter().all(|t| t[3] == 255);
    let rgb: Vec<u8> =
        if opaque { image.texels.iter().flat_map(|&[r, g, b, _]| [r, g, b]).collect() } else { Vec::new() };
    let (bytes, color) = match opaque {
        true => (rgb.as_slice(), ExtendedColorType::Rgb8),
        false => (image.bytes(), ExtendedColorType::Rgba8),
    };
    let mut file = Vec::new();
    PngEncoder::new_with_quality(&mut file, CompressionType::Best, FilterType::Adaptive)
        .write_image(bytes, width, height, color)
        .map_err(|error| Fault::whole(FaultKind::Io, error.to_string()))?;
    Ok(file)
}

/// The image in a PNG file. Whatever the bytes, an image or an error.
pub fn read_png(bytes: &[u8]) -> Result<Image, Fault> {
    if !bytes.starts_with(b"\x89PNG") {
        return Err(Fault::whole(FaultKind::Syntax, "is no PNG file"));
    }
    decode::decode(bytes)
}
