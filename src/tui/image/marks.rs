//! Marks in the pixels of a pane, for pictures that go by a protocol: no character can lie over them.
//!
//! A mark is light within a dark border, so that it is seen on anything.

use super::window::Fit;
use crate::canvas::image::Image;

/// What a mark looks like.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sign {
    /// Two lines that cross.
    Cross,
    /// A dot.
    Dot,
}

/// Something marked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mark {
    /// Where, in shares of the picture's width and height.
    pub share: [f64; 2],
    /// What with.
    pub sign: Sign,
}

const BORDER: [u8; 4] = [0, 0, 0, 255];

impl Sign {
    fn colour(self) -> [u8; 4] {
        match self {
            Self::Cross => [240, 228, 66, 255],
            Self::Dot => [238, 106, 31, 255],
        }
    }

    /// Whether a pixel so far from the middle is part of the sign with a border so wide. `reach` is half its size.
    fn covers(self, [x, y]: [i64; 2], reach: i64, border: i64) -> bool {
        match self {
            Self::Cross => x.abs().min(y.abs()) <= border && x.abs().max(y.abs()) <= reach,
            Self::Dot => x * x + y * y <= (reach / 2 + border).pow(2),
        }
    }
}

/// Draws a mark over what a pane shows, so large that it reaches from its middle over so many pixels.
pub fn draw(image: &mut Image, fit: &Fit, mark: &Mark, reach: u32) {
    let Some(middle) = fit.share_to_pane(mark.share) else { return };
    let (middle, reach) = (middle.map(|at| at as i64), i64::from(reach));
    let size = image.size.map(i64::from);
    for (x, y) in (-reach - 1..=reach + 1).flat_map(|y| (-reach - 1..=reach + 1).map(move |x| (x, y))) {
        let at = [middle[0] + x, middle[1] + y];
        let inside = (0..2).all(|k| (0..size[k]).contains(&at[k]));
        let colour = match mark.sign {
            sign if sign.covers([x, y], reach, 0) => sign.colour(),
            sign if sign.covers([x, y], reach + 1, 1) => BORDER,
            _ => continue,
        };
        if inside {
            image.texels[(at[1] * size[0] + at[0]) as usize] = colour;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tui::image::window::Window;

    #[test]
    fn a_mark_is_where_it_belongs_and_stays_in_the_picture() {
        let (size, grey) = ([40, 20], [90, 90, 90, 255]);
        for sign in [Sign::Cross, Sign::Dot] {
            for share in [[0.5, 0.5], [0.0, 0.0], [0.999, 0.1], [2.0, 0.5]] {
                let mut image = Image::filled(size, grey);
                let fit = Window::default().fit(size, size);
                draw(&mut image, &fit, &Mark { share, sign }, 4);
                let changed = image.texels.iter().filter(|texel| **texel != grey).count();
                if share[0] > 1.0 {
                    assert_eq!(changed, 0, "it is not in the picture");
                    continue;
                }
                let at = [0, 1].map(|k| (share[k] * f64::from(size[k])) as u32);
                assert_eq!(image.at(at[0], at[1]), sign.colour());
                assert!(changed > 3 && changed < 100, "{changed}");
                let far = [(at[0] + 20) % 40, (at[1] + 10) % 20];
                assert_eq!(image.at(far[0], far[1]), grey);
            }
        }
    }
}
