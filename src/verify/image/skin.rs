//! What is known of a golden before anything is compared with it: which of its pixels show the model, and how steep it is.
//!
//! A pixel is skin where it is not of the background's colour, which the session tells with the frame. A pixel of the model that happens to
//! have just that colour is missed; what is measured over the skin is a mean, and does not depend on single pixels.

use super::distance::slope;
use crate::canvas::image::Image;

/// A channel that is this bright is seen to go dark.
const LIT: u8 = 64;

/// The skin of a golden.
#[derive(Clone, Debug)]
pub(crate) struct Skin {
    background: [u8; 4],
    /// How many pixels it has.
    pub(super) pixels: u32,
    /// Across and down: the sum of the squares of the golden's doubled slopes.
    pub(super) steepness: [u64; 2],
    /// By corner of pixels, row by row: how many lit pixels of it lie above and left.
    sums: Vec<u32>,
    size: [u32; 2],
    /// The middle of what is lit.
    middle: [u32; 2],
}

impl Skin {
    /// The skin of a golden, before a background.
    pub(crate) fn of(golden: &Image, background: [u8; 4]) -> Self {
        let size = golden.size;
        let (sums, steepness) = (Vec::new(), steepness(golden));
        let mut skin = Self { background, pixels: 0, steepness, sums, size, middle: [0; 2] };
        skin.pixels = golden.texels.iter().filter(|t| skin.holds(**t)).count() as u32;
        skin.sum_up(golden);
        skin
    }

    /// Whether a texel of the golden is skin.
    #[inline]
    pub(super) fn holds(&self, texel: [u8; 4]) -> bool {
        texel != self.background
    }

    fn is_lit(&self, [r, g, b, a]: [u8; 4]) -> bool {
        self.holds([r, g, b, a]) && r.max(g).max(b) >= LIT
    }

    fn sum_up(&mut self, golden: &Image) {
        let [width, height] = self.size.map(|side| side as usize);
        self.sums = vec![0; (width + 1) * (height + 1)];
        let mut middle = [0_u64; 2];
        for y in 0..height {
            let mut row = 0;
            for x in 0..width {
                if self.is_lit(golden.texels[y * width + x]) {
                    row += 1;
                    middle = [middle[0] + x as u64, middle[1] + y as u64];
                }
                self.sums[(y + 1) * (width + 1) + x + 1] = self.sums[y * (width + 1) + x + 1] + row;
            }
        }
        let lit = u64::from(self.lit()).max(1);
        self.middle = middle.map(|sum| (sum / lit) as u32);
    }

    /// How many pixels of it are lit.
    pub(super) fn lit(&self) -> u32 {
        self.sums.last().copied().unwrap_or(0)
    }

    /// How many pixels of a rectangle are lit.
    fn lit_within(&self, [x, y]: [u32; 2], [w, h]: [u32; 2]) -> u32 {
        let at = |x: u32, y: u32| self.sums[y as usize * (self.size[0] as usize + 1) + x as usize];
        at(x + w, y + h) + at(x, y) - at(x + w, y) - at(x, y + h)
    }

    /// The place of a rectangle that is lit all over, nearest to the middle; the first of several. None where it fits nowhere.
    pub(super) fn place(&self, rectangle: [u32; 2]) -> Option<[u32; 2]> {
        let [w, h] = rectangle;
        let columns = (self.size[0] + 1).saturating_sub(w);
        let rows = (self.size[1] + 1).saturating_sub(h);
        let corners = (0..rows).flat_map(|y| (0..columns).map(move |x| [x, y]));
        let lit = corners.filter(|corner| self.lit_within(*corner, rectangle) == w * h);
        lit.min_by_key(|[x, y]| {
            let off = |along: u32, side: u32, middle: u32| u64::from((along + side / 2).abs_diff(middle));
            let (dx, dy) = (off(*x, w, self.middle[0]), off(*y, h, self.middle[1]));
            dx * dx + dy * dy
        })
    }
}

fn steepness(golden: &Image) -> [u64; 2] {
    let [width, height] = golden.size.map(|side| side as usize);
    let slopes = (0..height).flat_map(|y| (0..width).map(move |x| slope(golden, [x, y])));
    slopes.fold([0; 2], |[across, down], [dx, dy]| [across + (dx * dx) as u64, down + (dy * dy) as u64])
}
