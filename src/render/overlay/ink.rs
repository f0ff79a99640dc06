//! How much of a colour each pixel takes: of all that was asked for there, the most.

use crate::canvas::image::Image;

/// Shares of a colour, pixel by pixel.
pub(super) struct Ink(Vec<u8>);

impl Ink {
    /// None yet.
    pub(super) fn none(size: [u32; 2]) -> Self {
        Self(vec![0; size[0] as usize * size[1] as usize])
    }

    /// Asks for a share at a pixel.
    #[inline]
    pub(super) fn ask(&mut self, at: usize, share: u8) {
        self.0[at] = self.0[at].max(share);
    }

    /// Mixes the colour into a picture.
    pub(super) fn lay(&self, image: &mut Image, colour: [u8; 3]) {
        for (texel, share) in image.texels.iter_mut().zip(&self.0) {
            blend(texel, colour, *share);
        }
    }
}

/// Mixes a share of a colour, in 1/255, into a texel; its alpha stays.
#[inline]
pub(super) fn blend(texel: &mut [u8; 4], colour: [u8; 3], share: u8) {
    let share = u32::from(share);
    for (value, over) in texel.iter_mut().zip(colour) {
        *value = ((u32::from(*value) * (255 - share) + u32::from(over) * share + 127) / 255) as u8;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strokes_that_cross_do_not_add_up_and_the_stronger_one_stays() {
        let mut ink = Ink::none([3, 1]);
        [(0, 51), (0, 51), (1, 255), (1, 51)].into_iter().for_each(|(at, share)| ink.ask(at, share));
        let mut image = Image::filled([3, 1], [100, 0, 0, 7]);
        ink.lay(&mut image, [0, 0, 100]);
        assert_eq!(image.texels, [[80, 0, 20, 7], [0, 0, 100, 7], [100, 0, 0, 7]]);
    }
}
