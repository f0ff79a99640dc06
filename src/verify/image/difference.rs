//! A picture of how two pictures differ.

use crate::canvas::image::Image;

/// How often a difference is taken: what a gate lets through is a few levels of 255.
const AMPLIFIED: u8 = 8;
/// What is added wherever there is a difference at all, so that one level can be told from none.
const LIFTED: u8 = 56;

/// How an actual picture differs from its golden: black where it does not; else, a channel at a time, 56 and eight times the absolute
/// difference, at most 255, so that a difference of one level is 64 and one of 25 or more is full. It has the size of the actual picture, and is
/// white where the golden has no pixel. It is opaque; alpha is not compared.
pub fn difference(golden: &Image, actual: &Image) -> Image {
    let [width, height] = actual.size;
    let pixels = (0..height).flat_map(|y| (0..width).map(move |x| [x, y]));
    let inside = |[x, y]: [u32; 2]| x < golden.size[0] && y < golden.size[1];
    let texel = |at @ [x, y]: [u32; 2]| match inside(at) {
        true => apart(golden.at(x, y), actual.at(x, y)),
        false => [255; 4],
    };
    Image { size: actual.size, texels: pixels.map(texel).collect() }
}

fn apart([r, g, b, _]: [u8; 4], [to_r, to_g, to_b, _]: [u8; 4]) -> [u8; 4] {
    let channel = |from: u8, to: u8| match from.abs_diff(to) {
        0 => 0,
        apart => apart.saturating_mul(AMPLIFIED).saturating_add(LIFTED),
    };
    [channel(r, to_r), channel(g, to_g), channel(b, to_b), 255]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_differs_shows_and_what_does_not_is_black() {
        let golden = Image::filled([3, 2], [10, 20, 30, 255]);
        let mut actual = golden.clone();
        (actual.texels[1], actual.texels[5]) = ([11, 20, 255, 255], [10, 10, 30, 0]);
        let shown = difference(&golden, &actual);
        assert_eq!(shown.size, [3, 2]);
        assert_eq!((shown.at(1, 0), shown.at(2, 1)), ([64, 0, 255, 255], [0, 136, 0, 255]));
        assert_eq!(shown.texels.iter().filter(|texel| **texel == [0, 0, 0, 255]).count(), 4);
    }

    #[test]
    fn a_golden_of_another_size_differs_where_it_ends() {
        let actual = Image::filled([3, 2], [7; 4]);
        let shown = difference(&Image::filled([2, 9], [7; 4]), &actual);
        assert_eq!((shown.size, shown.at(1, 1), shown.at(2, 0)), ([3, 2], [0, 0, 0, 255], [255; 4]));
        assert_eq!(difference(&actual, &Image::default()), Image::default());
    }
}
