//! The picture: diffuse and specular light together, as sRGB bytes, before the background.

use rayon::prelude::*;

use super::layers::Layers;
use crate::canvas::image::Image;
use crate::canvas::look::Background;
use crate::render::sat;
use crate::render::srgb::Encoder;

/// The picture that the layers are.
pub(crate) fn compose(layers: &Layers, Background(background): Background) -> Image {
    // It is sRGB already.
    let [r, g, b] = background.map(|channel| (255.0 * sat(channel) + 0.5) as u8);
    let mut image = Image::filled(layers.size.map(|side| side as u32), [r, g, b, 255]);
    let (band, encoder) = (layers.band(), Encoder::get());
    let source =
        (layers.diffuse.par_chunks(band), layers.specular.par_chunks(band), layers.depth.par_chunks(band));
    image.texels.par_chunks_mut(band).zip(source).for_each(|(texels, (diffuse, specular, depth))| {
        for (((texel, diffuse), specular), depth) in texels.iter_mut().zip(diffuse).zip(specular).zip(depth) {
            if depth.is_finite() {
                let byte = |c: usize| encoder.byte(diffuse[c] + specular[c]);
                *texel = [byte(0), byte(1), byte(2), 255];
            }
        }
    });
    image
}
